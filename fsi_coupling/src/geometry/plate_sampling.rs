//! Boundary particles of thin walls: plates wet on both sides, of any thickness (THEORY WA9, WA10).
//!
//! Each face has layers at depths ½Δx, 1½Δx, … below it, however thin the plate is: deep layers may lie in the water of
//! the other side, which does not see them. So do the ends: their layers lie along the plate, as wide as it is thick. The
//! normal of a particle gives the water that it faces (WA9).

use sph_core::WallPoint;

use crate::geometry::outline::Outline;
use crate::geometry::plate::{Plate, mitred};
use crate::geometry::polygon::normal;
use crate::geometry::rows::WallRows;
use crate::geometry::sampling::{self, CORNER_DEG, Station, divide, offset, sample_fan, turn_of};

/// Least share of a layer's area that is worth a particle.
const LEAST_SHARE: f64 = 1e-3;

/// Boundary particles of a body's surface, and the plate that it is where its faces are too close for two sets of layers; with
/// `half`, of the part x ≥ 0 only.
pub fn boundary_particles(outline: &Outline, rows: &WallRows, half: bool) -> (Vec<WallPoint>, Option<Plate>) {
    let Some(plate) = outline.plate().filter(|plate| plate.is_thin(rows)) else {
        return (sampling::sample(outline, rows, half), None);
    };
    let points = sample(plate, rows);
    (if half { right_half(points, rows.spacing) } else { points }, Some(plate.clone()))
}

/// Boundary particles of a plate: layers below each face and each end, mitred at bends. They belong to plate 0. Bends must be
/// wider than the layers reach: see [`too_tight`](crate::geometry::plate::too_tight).
pub fn sample(plate: &Plate, &WallRows { spacing, layers, .. }: &WallRows) -> Vec<WallPoint> {
    let (middle, thickness) = (plate.line(), plate.thickness);
    let back: Vec<[f64; 2]> = middle.iter().rev().copied().collect();
    let mut points = Vec::new();
    let half = 0.5 * thickness;
    for line in [&middle, &back] {
        let parts = faces(line, half);
        for layer in 0..layers {
            let depth = WallRows::depth(layer, spacing);
            for (k, part) in parts.iter().enumerate() {
                let stations = layer_of(line, part, half, depth);
                divide(&stations, [0.0, stations[stations.len() - 1].0], part.convex, depth, spacing, &mut points);
                if let Some(next) = parts.get(k + 1) {
                    sample_fan(&part.face, &next.face, depth, spacing, &mut points);
                }
            }
            end_layer(line, thickness, depth, spacing, &mut points);
        }
    }
    points.into_iter().map(|p| WallPoint { midline: Some(0), ..p }).collect()
}

/// A layer behind the last end of a line, as wide as the plate is thick.
fn end_layer(line: &[[f64; 2]], thickness: f64, depth: f64, spacing: f64, points: &mut Vec<WallPoint>) {
    let (from, end) = (line[line.len() - 2], line[line.len() - 1]);
    let out = normal(from, end);
    let along = [-out[1], out[0]];
    let count = (thickness / spacing).round().max(1.0);
    let part = thickness / count;
    for k in 0..count as usize {
        let across = (k as f64 + 0.5) * part - 0.5 * thickness;
        let at = [0, 1].map(|c| end[c] - depth * along[c] + across * out[c]);
        points.push(WallPoint {
            at,
            normal: along,
            area: part * spacing,
            spacing,
            depth,
            outline: Default::default(),
            midline: None,
        });
    }
}

/// The part x ≥ 0 of a plate that is its own image in x = 0: particles whose place on the surface lies there.
pub fn right_half(points: Vec<WallPoint>, spacing: f64) -> Vec<WallPoint> {
    let right = |p: WallPoint| match (p.at[0] + p.depth * p.normal[0]) / spacing {
        x if x > 1e-6 => Some(p),
        x if x < -1e-6 => None,
        _ => Some(WallPoint { area: 0.5 * p.area, ..p }),
    };
    points.into_iter().filter_map(right).collect()
}

/// WA10: the particles of a wall on which a plate stands: each cell is cut by the plate's faces, and what is left of it on
/// either side is a particle of its own, so that each side's water finds its own wall up to the plate's face.
pub fn cut(points: Vec<WallPoint>, plate: &Plate) -> Vec<WallPoint> {
    let (line, half) = (plate.line(), 0.5 * plate.thickness);
    line.windows(2).fold(points, |points, side| points.into_iter().flat_map(|p| cut_one(p, side, half)).collect())
}

/// The parts of a cell left and right of a side with faces at distance `half` [m].
fn cut_one(p: WallPoint, side: &[[f64; 2]], half: f64) -> Vec<WallPoint> {
    let (out, r) = (normal(side[0], side[1]), [p.at[0] - side[0][0], p.at[1] - side[0][1]]);
    let (across, along) = (r[0] * out[0] + r[1] * out[1], r[1] * out[0] - r[0] * out[1]);
    let (width, length) = (p.spacing, (side[1][0] - side[0][0]).hypot(side[1][1] - side[0][1]));
    if along < 0.0 || along > length || across.abs() > half + 0.5 * width {
        return vec![p];
    }
    let part = |sign: f64| {
        let to = sign * across + 0.5 * width;
        let from = (to - width).max(half);
        let shift = sign * 0.5 * (from + to) - across;
        let at = [p.at[0] + shift * out[0], p.at[1] + shift * out[1]];
        (to - from > LEAST_SHARE * width).then(|| WallPoint { at, area: (to - from) / width * p.area, ..p })
    };
    [1.0, -1.0].into_iter().filter_map(part).collect()
}

/// A face between two sharp corners, wet on its right.
struct PlateFace {
    /// Its corners on the surface [m].
    face: Vec<[f64; 2]>,
    /// The first and the last of the middle line's corners that it belongs to.
    corners: [usize; 2],
    /// Which ends are convex corners.
    convex: [bool; 2],
}

/// The right face of a line, shifted by `half` [m], in faces without a sharp corner.
fn faces(line: &[[f64; 2]], half: f64) -> Vec<PlateFace> {
    let sides = line.len() - 1;
    let turn = |k: usize| match k {
        0 => 0.0,
        k if k == sides => 0.0,
        k => turn_of(normal(line[k - 1], line[k]), normal(line[k], line[k + 1])),
    };
    let sharpest = CORNER_DEG.to_radians();
    let ends: Vec<usize> = (0..=sides).filter(|&k| k == 0 || k == sides || turn(k).abs() > sharpest).collect();
    let part = |pair: &[usize]| PlateFace {
        face: (pair[0]..=pair[1]).map(|k| mitred(line, k, half)).collect(),
        corners: [pair[0], pair[1]],
        convex: [turn(pair[0]) > sharpest, turn(pair[1]) > sharpest],
    };
    ends.windows(2).map(part).collect()
}

/// The layer of a part at a depth [m] below a face at `half` [m]: it ends at the bisector of a convex corner.
fn layer_of(line: &[[f64; 2]], part: &PlateFace, half: f64, depth: f64) -> Vec<(f64, Station)> {
    let mut stations = offset(&part.face, depth);
    let last = stations.len() - 1;
    for (end, place) in [(0, 0), (1, last)] {
        if part.convex[end] {
            stations[place].1.0 = mitred(line, part.corners[end], half - depth);
        }
    }
    for k in 0..=last {
        let before = k.saturating_sub(1);
        let (from, to) = (stations[before].1.0, stations[k].1.0);
        stations[k].0 = stations[before].0 + (to[0] - from[0]).hypot(to[1] - from[1]);
    }
    stations
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::plate::too_tight;

    fn area(points: &[WallPoint], wanted: impl Fn(&WallPoint) -> bool) -> f64 {
        points.iter().filter(|p| wanted(p)).map(|p| p.area).sum()
    }

    /// Whatever the thickness: each face has three full layers, each end three layers as wide as the plate.
    #[test]
    fn every_face_has_its_full_layers() {
        for t in [0.002, 0.01, 0.013, 0.025, 0.05] {
            let points = sample(&Plate::new(&[[0.0, 0.0], [0.0, 1.0]], t), &WallRows::filled(0.01, 3));
            for sign in [1.0, -1.0] {
                assert!((area(&points, |p| sign * p.normal[0] > 0.5) - 0.03).abs() < 1e-12);
                assert!((area(&points, |p| sign * p.normal[1] > 0.5) - 0.03 * t).abs() < 1e-15);
            }
            for p in &points {
                let [x, y] = [0, 1].map(|c| p.at[c] + p.depth * p.normal[c]);
                let face = if p.normal[0] != 0.0 { x.abs() - 0.5 * t } else { (y - 0.5).abs() - 0.5 };
                assert!(face.abs() < 1e-14 && p.midline == Some(0), "{p:?}: its depth is to its own face");
            }
        }
    }

    /// A plate with a right angle: layers are mitred, so both faces' layers have the area of their strip; a convex corner has
    /// two halves of a particle on its bisector, a re-entrant one a fan.
    #[test]
    fn layers_follow_a_bend() {
        let middle = [[0.0, 0.3], [0.0, 0.0], [0.4, 0.0]];
        let (s, points) = (0.02_f64, sample(&Plate::new(&middle, 0.004), &WallRows::filled(0.02, 3)));
        let foot = |p: &WallPoint| [0, 1].map(|c| p.at[c] + p.depth * p.normal[c]);
        let end = |p: &WallPoint| foot(p)[0] > 0.399 || foot(p)[1] > 0.299;
        let below = |p: &WallPoint| foot(p)[0] < 0.0 || foot(p)[1] < 0.0;
        // strips of depth 3s: behind the face outside shorter by their depth, inside the bend with a quarter of a disc
        let strip = [3.0 * s * (0.704 - 3.0 * s), 3.0 * s * 0.696 + 0.25 * std::f64::consts::PI * (3.0 * s).powi(2)];
        let [outside, inside] = [area(&points, |p| !end(p) && below(p)), area(&points, |p| !end(p) && !below(p))];
        assert!(
            (outside / strip[0] - 1.0).abs() < 1e-9 && (inside / strip[1] - 1.0).abs() < 1e-9,
            "{outside} {inside}"
        );
        for p in &points {
            let ahead = [0, 1].map(|c| foot(p)[c] + 0.3 * s * p.normal[c]);
            let wet = ahead[0].min(ahead[1]) < -0.002 || ahead[0].min(ahead[1]) > 0.002 || end(p);
            assert!(wet, "{p:?} faces no water");
        }
        let upright = |p: &&WallPoint| p.normal[0].abs().max(p.normal[1].abs()) > 0.99;
        let on_bisector = |p: &&WallPoint| upright(p) && !end(p) && (p.at[0] - p.at[1]).abs() < 1e-12 && p.depth < s;
        assert_eq!(points.iter().filter(on_bisector).count(), 2);
        assert_eq!(too_tight(&middle, 0.06), None);
        assert_eq!(too_tight(&middle, 0.31), Some(0));
    }

    #[test]
    fn a_bent_plate_and_the_image_of_its_half_have_all_its_area() {
        let points = sample(&Plate::new(&[[-0.3, 0.1], [0.0, 0.0], [0.3, 0.1]], 0.01), &WallRows::filled(0.02, 3));
        let whole = area(&points, |_| true);
        assert!((2.0 * area(&right_half(points, 0.02), |_| true) / whole - 1.0).abs() < 1e-9);
    }

    /// Floor cells next to a plate that stands on it: what is left of them is the floor outside the plate, on each side.
    #[test]
    fn a_wall_ends_at_the_faces_of_a_plate_that_stands_on_it() {
        let cell = |k: i32| WallPoint {
            at: [0.01 * f64::from(k), -0.005],
            normal: [0.0, 1.0],
            area: 1e-4,
            spacing: 0.01,
            depth: 0.005,
            outline: Default::default(),
            midline: None,
        };
        for thickness in [0.002, 0.01, 0.024] {
            let plate = Plate { roots: [0.04, 0.0], ..Plate::new(&[[0.001, 0.0], [0.001, 0.3]], thickness) };
            let cells = cut((-5..=5).map(cell).collect(), &plate);
            for sign in [1.0, -1.0] {
                let side: Vec<&WallPoint> = cells.iter().filter(|p| sign * (p.at[0] - 0.001) > 0.0).collect();
                let (area, moment) = side.iter().fold((0.0, 0.0), |(a, m), p| (a + p.area, m + p.area * p.at[0]));
                let [from, to] = [0.001 + sign * 0.5 * thickness, sign * 0.055];
                assert!((area - 0.01 * (to - from).abs()).abs() < 1e-15, "thickness {thickness}, area {area}");
                assert!((moment / area - 0.5 * (from + to)).abs() < 1e-12, "thickness {thickness}");
            }
        }
    }

    #[test]
    fn a_plate_goes_on_straight_into_what_it_stands_on() {
        let plate = Plate { roots: [0.06, 0.0], ..Plate::new(&[[0.0, 0.0], [0.3, 0.4]], 0.01) };
        let [x, y] = plate.line()[0];
        assert!((x + 0.036).abs() < 1e-15 && (y + 0.048).abs() < 1e-15 && plate.line()[1] == [0.3, 0.4]);
        assert!(plate.is_thin(&WallRows::filled(0.01, 3)) && !plate.is_thin(&WallRows::filled(0.001, 3)));
    }
}
