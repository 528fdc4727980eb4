//! The faces of a body that look down: how flat they are, and where they are round (THEORY GE25).

use super::polygon::edges;

/// Largest turn from one side of a round line to the next [deg].
const LARGEST_TURN: f64 = 15.0;
/// Sides this near to the horizontal belong to a round bottom [deg].
const REACH: f64 = 30.0;
/// A round bottom turns to this slope on both sides [deg].
const LEAST_SLOPE: f64 = 20.0;
/// Largest ratio of the radii at the corners of a round line [-].
const UNIFORM: f64 = 4.0;
/// Relative rounding of angles [-].
const ROUNDING: f64 = 1e-9;

/// A face that looks down: counter-clockwise, an edge that runs towards +x.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Face {
    from: [f64; 2],
    to: [f64; 2],
}

impl Face {
    /// Slope, positive where it rises towards +x [rad].
    fn slope(&self) -> f64 {
        (self.to[1] - self.from[1]).atan2(self.to[0] - self.from[0])
    }

    fn length(&self) -> f64 {
        (self.to[0] - self.from[0]).hypot(self.to[1] - self.from[1])
    }
}

/// In the order of the outline.
fn faces(outline: &[[f64; 2]]) -> Vec<Face> {
    edges(outline).filter(|(a, b)| b[0] > a[0]).map(|(from, to)| Face { from, to }).collect()
}

/// Middle of the lowest corners [m].
fn keel(outline: &[[f64; 2]]) -> f64 {
    let lowest = outline.iter().map(|at| at[1]).fold(f64::INFINITY, f64::min);
    let across = outline.iter().filter(|at| at[1] == lowest).map(|at| at[0]);
    let [low, high] = across.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)]);
    0.5 * (low + high)
}

/// Slope to the horizontal of the flattest face that looks down [rad], and half the width of the blunt part about the lowest point
/// [m] that was left out: the flattest faces there, one after the other, as long as all are at most 2 `half_width` [m] wide. π/2
/// where no face is left.
pub fn flattest_face_beyond(outline: &[[f64; 2]], half_width: f64) -> (f64, f64) {
    let mut sides = faces(outline);
    sides.sort_by(|a, b| a.from[0].total_cmp(&b.from[0]));
    let keel = keel(outline);
    let middle = sides.iter().position(|side| side.to[0] > keel).unwrap_or(sides.len());
    let flatness = |k: usize| sides.get(k).map_or(f64::INFINITY, |side| side.slope().abs());
    let width = |k: usize| sides[k].to[0] - sides[k].from[0];
    // sides first..end are left out
    let (mut first, mut end, mut blunt) = (middle, middle, 0.0);
    loop {
        let left = first.checked_sub(1).map_or(f64::INFINITY, flatness);
        let next = if left < flatness(end) { first.checked_sub(1) } else { Some(end) };
        let fits = |k: &usize| *k < sides.len() && blunt + width(*k) <= 2.0 * half_width * (1.0 + ROUNDING);
        match next.filter(fits) {
            Some(k) if k < first => (first, blunt) = (k, blunt + width(k)),
            Some(k) => (end, blunt) = (k + 1, blunt + width(k)),
            None => break,
        }
    }
    let beyond = (0..first).chain(end..sides.len()).map(flatness);
    (beyond.fold(std::f64::consts::FRAC_PI_2, f64::min), 0.5 * blunt)
}

/// Width of the faces that look down and slope no more than `largest_slope` [rad] to the horizontal [m].
pub fn flat_width(outline: &[[f64; 2]], largest_slope: f64) -> f64 {
    let flat = faces(outline).into_iter().filter(|face| face.slope().abs() <= largest_slope);
    flat.map(|face| face.to[0] - face.from[0]).sum()
}

/// Radius at the corner of two sides: their mean length over the turn [m].
fn corner_radius(pair: &[Face]) -> f64 {
    0.5 * (pair[0].length() + pair[1].length()) / (pair[1].slope() - pair[0].slope()).max(f64::MIN_POSITIVE)
}

/// Radius of sides that follow each other on a round line: length over turn; each side turns by half of the corners at its ends.
fn radius_of(sides: &[Face]) -> f64 {
    let turn = sides[sides.len() - 1].slope() - sides[0].slope();
    let length: f64 = sides.iter().map(Face::length).sum();
    length * (sides.len() - 1) as f64 / (turn * sides.len() as f64)
}

/// True for sides whose corners turn little, by radii that are alike.
fn is_round(sides: &[Face]) -> bool {
    let turn = LARGEST_TURN.to_radians() * (1.0 + ROUNDING);
    let smooth = sides.windows(2).all(|pair| pair[1].slope() - pair[0].slope() <= turn);
    let radii = sides.windows(2).map(corner_radius);
    let [least, most] = radii.fold([f64::INFINITY, 0.0], |[least, most], r: f64| [least.min(r), most.max(r)]);
    sides.len() > 1 && smooth && most <= UNIFORM * least
}

/// Radius of a bottom that straight sides make round [m]: of the sides within 30° of the horizontal. `None` where they do not reach
/// 20° on both sides, or one turns by more than 15° from the last, or the radii at the corners differ by more than a factor of four.
pub fn radius_of_bottom(outline: &[[f64; 2]]) -> Option<f64> {
    let [reach, far] = [REACH, LEAST_SLOPE].map(|degrees| degrees.to_radians() * (1.0 + ROUNDING));
    let mut sides: Vec<Face> = faces(outline).into_iter().filter(|side| side.slope().abs() <= reach).collect();
    sides.sort_by(|a, b| a.slope().total_cmp(&b.slope()));
    let (first, last) = (sides.first()?.slope(), sides.last()?.slope());
    (is_round(&sides) && first <= -far && last >= far).then(|| radius_of(&sides))
}

/// A keel that straight sides make round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundKeel {
    /// Its radius [m].
    pub radius: f64,
    /// Half its width [m].
    pub half_width: f64,
}

/// The round line about the lowest point, of three sides at least; `None` where the keel is sharp or flat.
pub fn round_keel(outline: &[[f64; 2]]) -> Option<RoundKeel> {
    let mut sides = faces(outline);
    sides.sort_by(|a, b| a.from[0].total_cmp(&b.from[0]));
    let keel = keel(outline);
    // the side over the lowest point, or that to its right
    let middle = sides.iter().position(|side| side.to[0] > keel)?;
    let (mut first, mut end) = (middle, middle + 1);
    // the sides that keep the line round, one after the other to both sides
    loop {
        let before = (first, end);
        if end < sides.len() && is_round(&sides[first..=end]) {
            end += 1;
        }
        if first > 0 && is_round(&sides[first - 1..end]) {
            first -= 1;
        }
        if before == (first, end) {
            break;
        }
    }
    let arc = &sides[first..end];
    let half_width = 0.5 * (arc[arc.len() - 1].to[0] - arc[0].from[0]);
    (arc.len() >= 3).then(|| RoundKeel { radius: radius_of(arc), half_width })
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECTANGLE: [[f64; 2]; 4] = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [0.0, 1.0]];

    /// A bottom of straight sides at `slope` [deg] from a keel of `radius` [m], drawn by a number of `chords` to each side.
    fn hull(radius: f64, slope: f64, chords: u32) -> Vec<[f64; 2]> {
        let slope = slope.to_radians();
        let arc = |k: u32| {
            let angle = slope * f64::from(k) / f64::from(chords);
            [radius * angle.sin(), radius * (1.0 - angle.cos())]
        };
        let tangent = arc(chords);
        let side = |x: f64| [x, tangent[1] + (x - tangent[0]) * slope.tan()];
        let right: Vec<[f64; 2]> = (0..=chords).map(arc).chain([0.2, 0.4, 0.6].map(side)).chain([[0.6, 0.7]]).collect();
        let left = right[1..].iter().rev().map(|[x, y]| [-x, *y]);
        right.iter().copied().chain(left).collect()
    }

    #[test]
    fn a_tilted_plate_has_its_slope() {
        let a = 30.0_f64.to_radians();
        let tilted = RECTANGLE.map(|[x, y]| [x * a.cos() - y * a.sin(), x * a.sin() + y * a.cos()]);
        assert!((flattest_face_beyond(&tilted, 0.0).0 - a).abs() < 1e-14);
        assert_eq!(flattest_face_beyond(&RECTANGLE, 1.9), (0.0, 0.0));
    }

    #[test]
    fn a_polygon_of_many_sides_has_a_round_bottom_and_a_wedge_has_not() {
        let circle = |sides: u32, roll: f64| -> Vec<[f64; 2]> {
            let angle = |k| roll + std::f64::consts::TAU * f64::from(k) / f64::from(sides);
            (0..sides).map(|k| [0.3 * angle(k).cos(), 0.3 * angle(k).sin()]).collect()
        };
        for (sides, roll) in [(24, 0.0), (32, 0.1), (64, 0.02)] {
            let radius = radius_of_bottom(&circle(sides, roll)).expect("round");
            assert!((radius / 0.3 - 1.0).abs() < 0.01, "{sides}: {radius}");
            let keel = round_keel(&circle(sides, roll)).expect("round");
            assert!((keel.radius / 0.3 - 1.0).abs() < 0.05 && keel.half_width > 0.25, "{sides}: {keel:?}");
        }
        assert_eq!(radius_of_bottom(&circle(12, 0.0)), None);
        for sharp in [&RECTANGLE[..], &[[0.0, 0.0], [1.0, 0.2], [1.0, 1.0], [-1.0, 1.0], [-1.0, 0.2]]] {
            assert_eq!((radius_of_bottom(sharp), round_keel(sharp)), (None, None));
        }
    }

    /// A plate under the keel is as wide when the body is rolled by less than its sides' slope.
    #[test]
    fn a_roll_does_not_widen_a_keel_plate() {
        let tan = 20.0_f64.to_radians().tan();
        let upright = [[0.018, 0.0], [0.3, 0.282 * tan], [0.3, 0.4], [-0.3, 0.4], [-0.3, 0.282 * tan], [-0.018, 0.0]];
        for roll in [0.0_f64, 1.0, -2.0, 5.0] {
            let (sin, cos) = roll.to_radians().sin_cos();
            let outline: Vec<[f64; 2]> = upright.iter().map(|[x, y]| [x * cos - y * sin, x * sin + y * cos]).collect();
            let (slope, blunt) = flattest_face_beyond(&outline, 0.0181);
            assert!((slope.to_degrees() - 20.0 + roll.abs()).abs() < 1e-9, "{roll} deg: {}", slope.to_degrees());
            assert!((blunt / 0.018 - cos).abs() < 1e-9, "{roll} deg: {blunt}");
        }
    }

    /// The bottom next to a rounded keel does not depend on the number of its chords.
    #[test]
    fn a_rounded_keel_is_distinguished_from_the_straight_sides_next_to_it() {
        for slope in [18.0, 25.0] {
            for chords in [2, 3, 4, 8, 16] {
                let outline = hull(0.08, slope, chords);
                assert_eq!(radius_of_bottom(&outline), None, "{slope} deg, {chords} chords");
                let keel = round_keel(&outline).expect("round");
                let end = 0.08 * slope.to_radians().sin();
                assert!((keel.radius / 0.08 - 1.0).abs() < 0.4, "{slope} deg, {chords} chords: {keel:?}");
                assert!((keel.half_width / end - 1.0).abs() < 1e-9, "{slope} deg, {chords} chords: {keel:?}");
                let (beyond, blunt) = flattest_face_beyond(&outline, 1.001 * end);
                assert!((beyond.to_degrees() - slope).abs() < 1e-9 && (blunt / end - 1.0).abs() < 1e-9);
                assert!(flattest_face_beyond(&outline, 0.0).0.to_degrees() < 0.6 * slope);
            }
        }
    }
}
