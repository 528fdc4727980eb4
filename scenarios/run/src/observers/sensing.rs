//! The face of a gauge: points and weights along an outline (THEORY GE3).

/// Sides that turn by less than this belong to one face [rad]: the chords of an arc do, corners do not.
const SMOOTH: f64 = 15.0 * std::f64::consts::PI / 180.0;

/// Nodes in [−1, 1] and weights of Gauss's rule with three points.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.774_596_669_241_483_4, 5.0 / 18.0)];

/// Places on a face and their weights, whose sum is 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensing {
    /// Places [m], each with its weight [-].
    pub points: Vec<([f64; 2], f64)>,
    /// Length they cover [m]: that asked for, less what a corner cuts off.
    pub length: f64,
}

/// The gauge of `length` [m] about the place of a closed outline nearest to `at` [m]: half of it to each side, round
/// smooth bends, ending at corners; three Gauss points on each piece of at most `panel` [m]. Length 0 is `at` itself.
///
/// At a corner the gauge lies on the side that follows it.
pub fn sensing(corners: &[[f64; 2]], at: [f64; 2], length: f64, panel: f64) -> Sensing {
    if length <= 0.0 {
        return Sensing { points: vec![(at, 1.0)], length: 0.0 };
    }
    let around: f64 = (0..corners.len()).map(|k| Side::of(corners, k).length).sum();
    let half = 0.5 * length.min(around);
    let (side, along) = nearest_side(corners, at);
    let mut pieces = walk(corners, side, along, half, true);
    pieces.extend(walk(corners, side, along, half, false));
    let covered: f64 = pieces.iter().map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1])).sum();
    let mut points = Vec::new();
    for (a, b) in pieces {
        let long = (b[0] - a[0]).hypot(b[1] - a[1]);
        let panels = (long / panel).ceil().max(1.0);
        for k in 0..panels as usize {
            for (node, weight) in GAUSS {
                let share = (k as f64 + 0.5 + 0.5 * node) / panels;
                let place = [0, 1].map(|c| a[c] + share * (b[c] - a[c]));
                points.push((place, weight * long / panels / covered));
            }
        }
    }
    Sensing { points, length: covered }
}

/// A side of the outline: its start, direction and length.
struct Side {
    from: [f64; 2],
    way: [f64; 2],
    length: f64,
}

impl Side {
    fn of(corners: &[[f64; 2]], k: usize) -> Side {
        let (from, to) = (corners[k], corners[(k + 1) % corners.len()]);
        let way = [to[0] - from[0], to[1] - from[1]];
        let length = way[0].hypot(way[1]);
        Side { from, way: way.map(|w| w / length), length }
    }

    fn at(&self, along: f64) -> [f64; 2] {
        [0, 1].map(|c| self.from[c] + along * self.way[c])
    }

    /// Angle between this side's direction and another's [rad].
    fn turn(&self, other: &Side) -> f64 {
        let cross = self.way[0] * other.way[1] - self.way[1] * other.way[0];
        let dot = self.way[0] * other.way[0] + self.way[1] * other.way[1];
        cross.atan2(dot).abs()
    }
}

/// The side nearest to `at`, and how far along it [m]; of two equally near ones, met at a corner, the one that starts there.
fn nearest_side(corners: &[[f64; 2]], at: [f64; 2]) -> (usize, f64) {
    let mut best = (0, 0.0);
    let mut least = [f64::INFINITY; 2];
    for k in 0..corners.len() {
        let side = Side::of(corners, k);
        let r = [at[0] - side.from[0], at[1] - side.from[1]];
        let along = (r[0] * side.way[0] + r[1] * side.way[1]).clamp(0.0, side.length);
        let foot = side.at(along);
        let key = [(at[0] - foot[0]).hypot(at[1] - foot[1]), along];
        if key[0] < least[0] - 1e-9 * side.length || (key[0] <= least[0] + 1e-9 * side.length && key[1] < least[1]) {
            (best, least) = ((k, along), key);
        }
    }
    best
}

/// Straight pieces of the face over `distance` [m] from a place on side `k`, onwards or backwards, up to a corner.
fn walk(corners: &[[f64; 2]], k: usize, along: f64, distance: f64, onwards: bool) -> Vec<([f64; 2], [f64; 2])> {
    let n = corners.len();
    let (mut k, mut start, mut left) = (k, along, distance);
    let mut pieces = Vec::new();
    loop {
        let side = Side::of(corners, k);
        let room = if onwards { side.length - start } else { start };
        let step = left.min(room);
        let end = if onwards { start + step } else { start - step };
        if step > 0.0 {
            pieces.push((side.at(start), side.at(end)));
        }
        left -= step;
        let next = if onwards { (k + 1) % n } else { (k + n - 1) % n };
        let beyond = Side::of(corners, next);
        if left <= 0.0 || side.turn(&beyond) > SMOOTH {
            return pieces;
        }
        (k, start) = (next, if onwards { 0.0 } else { beyond.length });
    }
}

#[cfg(test)]
mod tests {
    use scene::Shape;

    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

    fn mean(s: &Sensing, of: impl Fn([f64; 2]) -> f64) -> f64 {
        s.points.iter().map(|(at, weight)| weight * of(*at)).sum()
    }

    #[test]
    fn gauss_points_average_a_polynomial_of_the_fifth_degree_exactly() {
        let s = sensing(&SQUARE, [0.4, 0.0], 0.6, 10.0);
        assert_eq!(s.points.len(), 6, "three on each side of the gauge");
        let exact = (0.7_f64.powi(6) - 0.1_f64.powi(6)) / 6.0 / 0.6;
        assert!((mean(&s, |p| p[0].powi(5)) - exact).abs() < 1e-14);
        assert!((mean(&s, |_| 1.0) - 1.0).abs() < 1e-14);
        assert!((s.length - 0.6).abs() < 1e-14);
    }

    #[test]
    fn a_corner_ends_the_face_and_length_zero_is_a_point() {
        let s = sensing(&SQUARE, [0.9, 0.0], 0.6, 0.05);
        assert!((s.length - 0.4).abs() < 1e-14, "0.3 to the left, 0.1 to the corner: {}", s.length);
        assert!(s.points.iter().all(|(at, _)| at[1] == 0.0 && at[0] > 0.6 && at[0] < 1.0));
        let corner = sensing(&SQUARE, [1.0, 0.0], 0.5, 0.05);
        assert!((corner.length - 0.25).abs() < 1e-14);
        assert!(corner.points.iter().all(|(at, _)| at[0] == 1.0), "the side that follows the corner");
        let point = sensing(&SQUARE, [0.3, 0.01], 0.0, 0.05);
        assert_eq!(point, Sensing { points: vec![([0.3, 0.01], 1.0)], length: 0.0 });
    }

    #[test]
    fn an_arc_is_one_face_up_to_its_chines() {
        let arc = Shape::Arc { radius: 1.0, breadth: 1.2, side_height: 0.3 }.outline();
        let s = sensing(&arc, [0.0, 0.0], 0.4, 0.1);
        assert!((s.length - 0.4).abs() < 1e-12);
        // mean height of an arc of half angle 0.2: 1 − sin 0.2/0.2, to the chords' sag
        assert!((mean(&s, |p| p[1]) - (1.0 - 0.2_f64.sin() / 0.2)).abs() < 5e-5);
        assert!(mean(&s, |p| p[0]).abs() < 1e-12);
        let all = sensing(&arc, [0.0, 0.0], 5.0, 0.1);
        assert!((all.length - 2.0 * 0.6_f64.asin()).abs() < 1e-4, "cut at the chines: {}", all.length);
    }
}
