//! Boundary particles from an outline: rows parallel to its faces, inside the body.
//!
//! The outline is cut into faces at its corners; each face carries rows at depths ½Δx, 1½Δx, … Every row
//! is trimmed where another face is nearer (at convex corners rows of both faces would overlap), and its
//! visible part is divided evenly, so that rows keep half a spacing from the bisector of a corner. A
//! re-entrant corner, whose rows leave a gap, gets a fan.

use sph_core::WallPoint;

use crate::outline::Outline;
use crate::polygon::normal;

/// Neighbouring sides that turn by more than this belong to different faces.
const CORNER_DEG: f64 = 20.0;
/// Rows are walked in steps of this share of the spacing when trimming.
const TRIM: f64 = 0.02;

/// Boundary particles of `layers` rows at the given spacing [m]; with `half`, of the part x > 0 only.
pub fn sample(outline: &Outline, spacing: f64, layers: usize, half: bool) -> Vec<WallPoint> {
    let mut points = Vec::new();
    for part in outline.loops() {
        let faces = faces(part, half);
        for layer in 0..layers {
            let depth = (layer as f64 + 0.5) * spacing;
            for (k, face) in faces.iter().enumerate() {
                sample_row(outline, face, depth, spacing, half, &mut points);
                sample_fan(face, &faces[(k + 1) % faces.len()], depth, spacing, half, &mut points);
            }
        }
    }
    points
}

/// A chain of sides without a sharp corner, as points; counter-clockwise, so the fluid is on its right.
type Face = Vec<[f64; 2]>;

fn faces(v: &[[f64; 2]], half: bool) -> Vec<Face> {
    let n = v.len();
    let turn = |k: usize| {
        let (a, b) = (normal(v[(k + n - 1) % n], v[k]), normal(v[k], v[(k + 1) % n]));
        (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).to_degrees()
    };
    let breaks: Vec<usize> =
        (0..n).filter(|&k| turn(k).abs() > CORNER_DEG || (half && v[k][0].abs() < 1e-12)).collect();
    if breaks.is_empty() {
        return vec![(0..=n).map(|k| v[k % n]).collect()];
    }
    let run = |i: usize| {
        let (start, end) = (breaks[i], breaks[(i + 1) % breaks.len()]);
        let count = if end > start { end - start } else { end + n - start };
        (0..=count).map(|k| v[(start + k) % n]).collect()
    };
    (0..breaks.len()).map(run).collect()
}

/// A place on a row: position and the face's outward normal there.
type Station = ([f64; 2], [f64; 2]);

/// The offset of a face at a depth, as a polyline with normals and running length.
fn offset(face: &Face, depth: f64) -> Vec<(f64, Station)> {
    let normals: Vec<[f64; 2]> = face.windows(2).map(|p| normal(p[0], p[1])).collect();
    let mut length = 0.0;
    let mut row: Vec<(f64, Station)> = Vec::with_capacity(face.len());
    for k in 0..face.len() {
        let (a, b) = (normals[k.saturating_sub(1)], normals[k.min(normals.len() - 1)]);
        let (sum, dot) = ([a[0] + b[0], a[1] + b[1]], a[0] * b[0] + a[1] * b[1]);
        let mitre = [sum[0] / (1.0 + dot), sum[1] / (1.0 + dot)];
        let at = [face[k][0] - depth * mitre[0], face[k][1] - depth * mitre[1]];
        if let Some((_, (last, _))) = row.last() {
            length += (at[0] - last[0]).hypot(at[1] - last[1]);
        }
        let size = sum[0].hypot(sum[1]);
        row.push((length, (at, [sum[0] / size, sum[1] / size])));
    }
    row
}

/// The station at running length `s` of a row.
fn station(row: &[(f64, Station)], s: f64) -> Station {
    let k = row.partition_point(|(length, _)| *length < s).clamp(1, row.len() - 1);
    let ((s0, (a, na)), (s1, (b, nb))) = (row[k - 1], row[k]);
    let t = if s1 > s0 { (s - s0) / (s1 - s0) } else { 0.0 };
    let mix = |p: [f64; 2], q: [f64; 2]| [p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])];
    // on a straight side both ends' normals would blend with the neighbours': take the side's own
    let own = normal(a, b);
    let n = if s1 > s0 { own } else { mix(na, nb) };
    (mix(a, b), n)
}

fn sample_row(outline: &Outline, face: &Face, depth: f64, spacing: f64, half: bool, points: &mut Vec<WallPoint>) {
    let row = offset(face, depth);
    let total = row[row.len() - 1].0;
    let steps = (total / (TRIM * spacing)).ceil().max(1.0) as usize;
    let ds = total / steps as f64;
    let visible = |s: f64| {
        let (at, _) = station(&row, s);
        outline.signed_distance(at) < -depth * (1.0 - 1e-6) + 1e-4 * spacing && !(half && at[0] < 0.0)
    };
    let mut start = None;
    for k in 0..=steps {
        let seen = k < steps && visible((k as f64 + 0.5) * ds);
        match (start, seen) {
            (None, true) => start = Some(k as f64 * ds),
            (Some(s0), false) => {
                divide(&row, s0, k as f64 * ds, spacing, points);
                start = None;
            }
            _ => {}
        }
    }
}

/// Points at the middles of equal parts of [s0, s1].
fn divide(row: &[(f64, Station)], s0: f64, s1: f64, spacing: f64, points: &mut Vec<WallPoint>) {
    let count = ((s1 - s0) / spacing).round() as usize;
    for k in 0..count {
        let part = (s1 - s0) / count as f64;
        let (at, normal) = station(row, s0 + (k as f64 + 0.5) * part);
        points.push(WallPoint { at, normal, area: part * spacing });
    }
}

/// The gap between the rows of two faces that meet at a re-entrant corner.
fn sample_fan(face: &Face, next: &Face, depth: f64, spacing: f64, half: bool, points: &mut Vec<WallPoint>) {
    let corner = next[0];
    let a = normal(face[face.len() - 2], face[face.len() - 1]);
    let b = normal(next[0], next[1]);
    let turn = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
    if turn > -CORNER_DEG.to_radians() {
        return;
    }
    let arc = -turn * depth;
    let count = (arc / spacing).round() as usize;
    for k in 0..count {
        let angle = a[1].atan2(a[0]) + turn * (k as f64 + 0.5) / count as f64;
        let normal = [angle.cos(), angle.sin()];
        let at = [corner[0] - depth * normal[0], corner[1] - depth * normal[1]];
        if !(half && at[0] < 0.0) {
            points.push(WallPoint { at, normal, area: arc / count as f64 * spacing });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;

    #[test]
    fn rows_fill_three_spacings_under_every_face_of_a_wedge() {
        let wedge = Shape::Wedge { deadrise_deg: 30.0, breadth: 1.0, side_height: 0.3 };
        let [lo, hi] = crate::polygon::bounding_box(&wedge.outline());
        let wedge = Outline::of(&wedge).unwrap();
        let s = 0.02;
        let points = sample(&wedge, s, 3, false);
        for p in &points {
            let d = -wedge.signed_distance(p.at) / s;
            assert!([0.5, 1.5, 2.5].iter().any(|l| (d - l).abs() < 1e-3), "a point at depth {d} spacings");
        }
        // area of the strip of depth 3s inside the outline, by counting a fine lattice
        let fine = s / 16.0;
        let mut strip = 0.0;
        for i in 0..((hi[0] - lo[0]) / fine) as usize {
            for j in 0..((hi[1] - lo[1]) / fine) as usize {
                let at = [lo[0] + (i as f64 + 0.5) * fine, lo[1] + (j as f64 + 0.5) * fine];
                let d = -wedge.signed_distance(at);
                strip += if d > 0.0 && d < 3.0 * s { fine * fine } else { 0.0 };
            }
        }
        let sampled: f64 = points.iter().map(|p| p.area).sum();
        assert!((sampled / strip - 1.0).abs() < 0.01, "sampled {sampled}, strip {strip}");
    }

    #[test]
    fn a_half_and_its_mirror_image_are_the_whole() {
        let arc = Outline::of(&Shape::Arc { radius: 1.0, breadth: 1.2, side_height: 0.3 }).unwrap();
        let half = sample(&arc, 0.05, 3, true);
        assert!(half.iter().all(|p| p.at[0] > 0.0));
        let nearest = half.iter().map(|p| p.at[0]).fold(f64::MAX, f64::min);
        assert!((nearest / 0.025 - 1.0).abs() < 0.1, "first point at {nearest}");
    }

    #[test]
    fn normals_point_out_of_the_body() {
        let hull =
            Outline::polygon(&[[-1.0, 0.5], [-0.5, 0.0], [0.0, 0.3], [0.5, 0.0], [1.0, 0.5], [1.0, 1.0], [-1.0, 1.0]])
                .unwrap();
        for p in sample(&hull, 0.03, 3, false) {
            let d = hull.signed_distance(p.at);
            let out = [p.at[0] + 1e-4 * p.normal[0], p.at[1] + 1e-4 * p.normal[1]];
            assert!(hull.signed_distance(out) > d, "at {:?}", p.at);
        }
    }
}
