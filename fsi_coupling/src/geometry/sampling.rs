//! Boundary particles from an outline: layers parallel to its faces, inside the body.
//!
//! The outline is cut into faces at its corners; each face carries layers at depths ½Δx, 1½Δx, … Every layer is
//! trimmed where another face is nearer, and its visible part is divided evenly. Where two faces meet at a convex
//! corner, each puts half a particle on the bisector: without them the tip has a hole of a spacing's radius,
//! through which water enters. A re-entrant corner, whose layers leave a gap, gets a fan. The half of a symmetric
//! body is its right half, with half of each particle on the plane of symmetry.

use sph_core::WallPoint;

use crate::geometry::outline::Outline;
use crate::geometry::outline_shares::share_outline;
use crate::geometry::polygon::normal;
use crate::geometry::rows::WallRows;

/// Neighbouring sides that turn by more than this belong to different faces.
pub(crate) const CORNER_DEG: f64 = 20.0;
/// Layers are walked in steps of this share of the spacing when trimming.
const TRIM: f64 = 0.02;

/// Layers of boundary particles inside an outline; with `half`, of the part x ≥ 0 only.
pub fn sample(outline: &Outline, rows: &WallRows, half: bool) -> Vec<WallPoint> {
    let WallRows { spacing, layers, .. } = *rows;
    let mut points = Vec::new();
    for part in outline.loops() {
        let faces = faces(part);
        for layer in 0..layers {
            let depth = WallRows::depth(layer, spacing);
            for (k, face) in faces.iter().enumerate() {
                let before = &faces[(k + faces.len() - 1) % faces.len()];
                let after = &faces[(k + 1) % faces.len()];
                let convex = [turn(before, face), turn(face, after)].map(|turn| turn > CORNER_DEG.to_radians());
                sample_layer(outline, face, convex, rows.is_shifted(layer), depth, spacing, &mut points);
                sample_fan(face, after, depth, spacing, &mut points);
            }
        }
    }
    let mut points = if half { right_half(points, spacing) } else { points };
    share_outline(outline, spacing, half, &mut points);
    points
}

/// What lies right of x = 0. On the plane, the half of a corner's particle that the right face owns, and half of any
/// other.
fn right_half(points: Vec<WallPoint>, spacing: f64) -> Vec<WallPoint> {
    let right = |p: WallPoint| {
        let upright = p.normal[0].abs() < 1e-9;
        match (p.at[0] / spacing, upright) {
            (x, _) if x > 1e-6 => Some(p),
            (x, _) if x < -1e-6 => None,
            (_, true) => Some(WallPoint { at: [0.0, p.at[1]], area: 0.5 * p.area, ..p }),
            (_, false) => (p.normal[0] > 0.0).then_some(WallPoint { at: [0.0, p.at[1]], ..p }),
        }
    };
    points.into_iter().filter_map(right).collect()
}

/// A chain of sides without a sharp corner, as points; counter-clockwise, so the fluid is on its right.
pub(crate) type Face = Vec<[f64; 2]>;

fn faces(v: &[[f64; 2]]) -> Vec<Face> {
    let n = v.len();
    let turn = |k: usize| turn_of(normal(v[(k + n - 1) % n], v[k]), normal(v[k], v[(k + 1) % n]));
    let breaks: Vec<usize> = (0..n).filter(|&k| turn(k).abs() > CORNER_DEG.to_radians()).collect();
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

/// Turn of the normal from the end of a face to the start of the next [rad]: positive at a convex corner.
fn turn(face: &Face, next: &Face) -> f64 {
    turn_of(normal(face[face.len() - 2], face[face.len() - 1]), normal(next[0], next[1]))
}

pub(crate) fn turn_of(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
}

/// A place on a layer: position and the face's outward normal there.
pub(crate) type Station = ([f64; 2], [f64; 2]);

/// The offset of a face at a depth, as a polyline with normals and running length.
pub(crate) fn offset(face: &Face, depth: f64) -> Vec<(f64, Station)> {
    let normals: Vec<[f64; 2]> = face.windows(2).map(|p| normal(p[0], p[1])).collect();
    let mut length = 0.0;
    let mut layer: Vec<(f64, Station)> = Vec::with_capacity(face.len());
    for k in 0..face.len() {
        let (a, b) = (normals[k.saturating_sub(1)], normals[k.min(normals.len() - 1)]);
        let (sum, dot) = ([a[0] + b[0], a[1] + b[1]], a[0] * b[0] + a[1] * b[1]);
        let mitre = [sum[0] / (1.0 + dot), sum[1] / (1.0 + dot)];
        let at = [face[k][0] - depth * mitre[0], face[k][1] - depth * mitre[1]];
        if let Some((_, (last, _))) = layer.last() {
            length += (at[0] - last[0]).hypot(at[1] - last[1]);
        }
        let size = sum[0].hypot(sum[1]);
        layer.push((length, (at, [sum[0] / size, sum[1] / size])));
    }
    layer
}

/// The station at running length `s` of a layer.
fn station(layer: &[(f64, Station)], s: f64) -> Station {
    let k = layer.partition_point(|(length, _)| *length < s).clamp(1, layer.len() - 1);
    let ((s0, (a, na)), (s1, (b, nb))) = (layer[k - 1], layer[k]);
    let t = if s1 > s0 { (s - s0) / (s1 - s0) } else { 0.0 };
    let mix = |p: [f64; 2], q: [f64; 2]| [p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])];
    // on a straight side both ends' normals would blend with the neighbours': take the side's own
    let n = if t < 1e-9 {
        na
    } else if t > 1.0 - 1e-9 {
        nb
    } else {
        normal(a, b)
    };
    (mix(a, b), n)
}

/// A layer of one face; `convex` says which of its ends are convex corners, `shifted` that it is shifted by half a part.
fn sample_layer(
    outline: &Outline,
    face: &Face,
    convex: [bool; 2],
    shifted: bool,
    depth: f64,
    spacing: f64,
    points: &mut Vec<WallPoint>,
) {
    let layer = offset(face, depth);
    let intervals = visible(outline, &layer, depth, spacing);
    for (k, interval) in intervals.iter().enumerate() {
        let at_corner = [convex[0] && k == 0, convex[1] && k + 1 == intervals.len()];
        divide(&layer, *interval, at_corner.map(|corner| corner != shifted), depth, spacing, points);
    }
}

/// The intervals of running length in which a layer lies at its depth from the outline: no other face is nearer.
fn visible(outline: &Outline, layer: &[(f64, Station)], depth: f64, spacing: f64) -> Vec<[f64; 2]> {
    let total = layer[layer.len() - 1].0;
    let steps = (total / (TRIM * spacing)).ceil().max(1.0) as usize;
    let ds = total / steps as f64;
    let seen = |s: f64| outline.signed_distance(station(layer, s).0) < -depth + 1e-9 * spacing;
    // where visibility changes between the middles of two steps, by bisection; at the ends, the ends
    let edge = |k: usize| {
        if k == 0 || k == steps {
            return k as f64 * ds;
        }
        let (mut from, mut to) = ((k as f64 - 0.5) * ds, (k as f64 + 0.5) * ds);
        let after = seen(to);
        for _ in 0..50 {
            let middle = 0.5 * (from + to);
            if seen(middle) == after { to = middle } else { from = middle }
        }
        0.5 * (from + to)
    };
    let mut intervals = Vec::new();
    let mut start = None;
    for k in 0..=steps {
        let here = k < steps && seen((k as f64 + 0.5) * ds);
        match (start, here) {
            (None, true) => start = Some(edge(k)),
            (Some(s0), false) => {
                intervals.push([s0, edge(k)]);
                start = None;
            }
            _ => {}
        }
    }
    intervals
}

/// Points that divide [s0, s1] into equal parts. At a corner (`at_corner`) the first stands on the bisector, with half a part; at
/// other ends it keeps half a part away.
pub(crate) fn divide(
    layer: &[(f64, Station)],
    [s0, s1]: [f64; 2],
    at_corner: [bool; 2],
    depth: f64,
    spacing: f64,
    points: &mut Vec<WallPoint>,
) {
    let [first, last] = at_corner.map(|corner| if corner { 0.5 } else { 0.0 });
    // n points: s1 − s0 = (n − first − last) parts
    let fewest = if at_corner == [true; 2] { 2.0 } else { 1.0 };
    let count = ((s1 - s0) / spacing + first + last).round().max(fewest);
    let part = (s1 - s0) / (count - first - last);
    let spaced = (part * spacing).sqrt();
    for k in 0..count as usize {
        let (at, normal) = station(layer, s0 + (k as f64 + 0.5 - first) * part);
        let tip = (at_corner[0] && k == 0) || (at_corner[1] && k + 1 == count as usize);
        let share = if tip { 0.5 } else { 1.0 };
        points.push(WallPoint {
            at,
            normal,
            area: share * part * spacing,
            spacing: spaced,
            depth,
            outline: Default::default(),
            midline: None,
        });
    }
}

/// The gap between the layers of two faces that meet at a re-entrant corner.
pub(crate) fn sample_fan(face: &Face, next: &Face, depth: f64, spacing: f64, points: &mut Vec<WallPoint>) {
    let corner = next[0];
    let a = normal(face[face.len() - 2], face[face.len() - 1]);
    let turn = turn(face, next);
    if turn > -CORNER_DEG.to_radians() {
        return;
    }
    let arc = -turn * depth;
    let count = (arc / spacing).round() as usize;
    let part = arc / count as f64;
    for k in 0..count {
        let angle = a[1].atan2(a[0]) + turn * (k as f64 + 0.5) / count as f64;
        let normal = [angle.cos(), angle.sin()];
        let at = [corner[0] - depth * normal[0], corner[1] - depth * normal[1]];
        points.push(WallPoint {
            at,
            normal,
            area: part * spacing,
            spacing: (part * spacing).sqrt(),
            depth,
            outline: Default::default(),
            midline: None,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::shape::Shape;

    #[test]
    fn layers_fill_three_spacings_under_every_face_of_a_wedge() {
        let wedge = Shape::Wedge { deadrise_deg: 30.0, breadth: 1.0, side_height: 0.3 };
        let [lo, hi] = crate::geometry::polygon::bounding_box(&wedge.outline());
        let wedge = Outline::of(&wedge).unwrap();
        let s = 0.02;
        let points = sample(&wedge, &WallRows::filled(s, 3), false);
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

    /// A body that is symmetric, and whose keel, arc or deck meets the plane of symmetry.
    fn symmetric_bodies() -> [Shape; 3] {
        [
            Shape::Wedge { deadrise_deg: 30.0, breadth: 1.0, side_height: 0.3 },
            Shape::Arc { radius: 1.0, breadth: 1.2, side_height: 0.3 },
            Shape::Box { breadth: 0.93, height: 0.4 },
        ]
    }

    #[test]
    fn a_half_and_its_mirror_image_are_the_whole() {
        for shape in symmetric_bodies() {
            let outline = Outline::of(&shape).unwrap();
            let (half, whole) = (
                sample(&outline, &WallRows::filled(0.05, 3), true),
                sample(&outline, &WallRows::filled(0.05, 3), false),
            );
            let area = |points: &[WallPoint]| points.iter().map(|p| p.area).sum::<f64>();
            assert!((2.0 * area(&half) / area(&whole) - 1.0).abs() < 1e-9, "{shape:?}");
            for p in &half {
                for side in [1.0, -1.0] {
                    let same = |q: &&WallPoint| {
                        (q.at[0] - side * p.at[0]).hypot(q.at[1] - p.at[1]) < 1e-9
                            && (q.normal[0] - side * p.normal[0]).hypot(q.normal[1] - p.normal[1]) < 1e-9
                    };
                    let q = whole.iter().find(same).unwrap_or_else(|| panic!("{shape:?}: no image of {p:?}"));
                    let share = if p.at[0] == 0.0 && p.normal[0].abs() < 1e-9 { 0.5 } else { 1.0 };
                    assert!((share * q.area - p.area).abs() < 1e-9 * q.area, "{p:?} and {q:?}");
                }
            }
        }
    }

    #[test]
    fn every_convex_corner_has_two_halves_of_a_particle_on_its_bisector() {
        let s = 0.05;
        for shape in symmetric_bodies() {
            let outline = Outline::of(&shape).unwrap();
            let points = sample(&outline, &WallRows::filled(s, 1), false);
            let v = &outline.loops()[0];
            let n = v.len();
            for k in 0..n {
                let (a, b) = (normal(v[(k + n - 1) % n], v[k]), normal(v[k], v[(k + 1) % n]));
                if turn_of(a, b) < CORNER_DEG.to_radians() {
                    continue;
                }
                let mitre = 0.5 * s / (1.0 + a[0] * b[0] + a[1] * b[1]);
                let at = [v[k][0] - mitre * (a[0] + b[0]), v[k][1] - mitre * (a[1] + b[1])];
                let found = points.iter().filter(|p| (p.at[0] - at[0]).hypot(p.at[1] - at[1]) < 1e-6).count();
                assert_eq!(found, 2, "{shape:?}: corner {:?}", v[k]);
            }
        }
    }

    #[test]
    fn normals_point_out_of_the_body() {
        let hull =
            Outline::polygon(&[[-1.0, 0.5], [-0.5, 0.0], [0.0, 0.3], [0.5, 0.0], [1.0, 0.5], [1.0, 1.0], [-1.0, 1.0]])
                .unwrap();
        for p in sample(&hull, &WallRows::filled(0.03, 3), false) {
            let d = hull.signed_distance(p.at);
            let out = [p.at[0] + 1e-4 * p.normal[0], p.at[1] + 1e-4 * p.normal[1]];
            assert!(hull.signed_distance(out) > d, "at {:?}", p.at);
        }
    }
}
