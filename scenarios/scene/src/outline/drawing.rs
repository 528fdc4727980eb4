//! Lines of a drawing, joined end to end to one line.

use crate::data_file::Fault;

/// Largest gap between ends that are joined, over the drawing's size [-].
const JOINED: f64 = 1e-6;
/// Angle between the points of an arc of a drawing, and largest turn of another curve between its points [deg].
const ARC_STEP_DEG: f64 = 2.0;
/// Most times that a curve is split in two, which ends where it has a cusp.
const MOST_SPLITS: u32 = 12;
/// Most points of an outline.
pub(super) const MOST_POINTS: usize = 10_000;

/// A point and the line of the file where it stands.
pub(super) type Placed = (usize, [f64; 2]);

/// A drawing: lines through points in its own unit.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Drawing {
    pub pieces: Vec<Vec<Placed>>,
    /// Length of its unit [m], where the file says it.
    pub unit: Option<f64>,
    /// Line of the header of a table that says it.
    pub unit_line: Option<usize>,
    /// Format, in words.
    pub format: &'static str,
    /// Lines that are hidden in it, and are left out.
    pub hidden: usize,
    /// Lines that stand in definitions, such as symbols, and are left out.
    pub defined: usize,
    /// Names of the layers of lines that are read, each once.
    pub layers: Vec<String>,
}

impl Drawing {
    /// Keeps the name of a layer of a line that is read.
    pub fn add_layer(&mut self, name: &str) {
        if !self.layers.iter().any(|known| known == name) {
            self.layers.push(name.to_string());
        }
    }

    /// What was left out, or may be one line too many, in sentences.
    pub fn notes(&self) -> Vec<String> {
        let hidden = (self.hidden > 0).then(|| format!("{} hidden lines are left out", self.hidden));
        let defined = (self.defined > 0)
            .then(|| format!("{} lines in definitions (defs, symbol, clipPath, ...) are left out", self.defined));
        let several = (self.layers.len() > 1).then(|| {
            format!(
                "lines of the layers {} are read as one outline: body.outline_layer chooses one",
                self.layers.join(", ")
            )
        });
        hidden.into_iter().chain(defined).chain(several).collect()
    }
}

impl Drawing {
    /// One line through all points.
    pub fn joined(mut self) -> Result<Vec<Placed>, Fault> {
        self.pieces.retain(|piece| piece.len() > 1);
        let count: usize = self.pieces.iter().map(Vec::len).sum();
        let first = self.pieces.first().and_then(|piece| piece.first()).map_or(1, |(line, _)| *line);
        if count > MOST_POINTS {
            return Err(Fault::new(first, format!("{count} points"), format!("at most {MOST_POINTS} points")));
        }
        let points = self.pieces.iter().flatten().map(|(_, point)| *point);
        let [low, high] = points.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], [x, y]| {
            [[low[0].min(x), low[1].min(y)], [high[0].max(x), high[1].max(y)]]
        });
        let near = JOINED * (high[0] - low[0]).hypot(high[1] - low[1]);
        let meet = |a: &Placed, b: &Placed| (a.1[0] - b.1[0]).hypot(a.1[1] - b.1[1]) <= near;
        let mut pieces = self.pieces.into_iter();
        let Some(mut line) = pieces.next() else {
            return Err(Fault::new(1, "no line", "an outline: lines through points"));
        };
        let mut rest: Vec<Vec<Placed>> = pieces.collect();
        while !rest.is_empty() {
            let (start, end) = (line[0], line[line.len() - 1]);
            let at_end = rest.iter().position(|piece| meet(&piece[0], &end) || meet(&piece[piece.len() - 1], &end));
            let at_start =
                || rest.iter().position(|piece| meet(&piece[0], &start) || meet(&piece[piece.len() - 1], &start));
            if at_end.is_none() {
                line.reverse();
            }
            let Some(found) = at_end.or_else(at_start) else {
                let (place, [x, y]) = rest[0][0];
                let given = format!("a line at [{x}, {y}] that does not meet the others");
                return Err(Fault::new(place, given, "lines that join end to end to one outline"));
            };
            let mut piece = rest.swap_remove(found);
            if !meet(&piece[0], &line[line.len() - 1]) {
                piece.reverse();
            }
            line.extend(piece.into_iter().skip(1));
        }
        Ok(line)
    }
}

/// Points of an arc about a centre, between two angles [deg], counter-clockwise where the second is larger.
pub(super) fn arc(line: usize, centre: [f64; 2], radius: f64, from_deg: f64, to_deg: f64) -> Vec<Placed> {
    let pieces = ((to_deg - from_deg).abs() / ARC_STEP_DEG).ceil().clamp(1.0, 180.0) as u32;
    let at = |k: u32| {
        let angle = (from_deg + (to_deg - from_deg) * f64::from(k) / f64::from(pieces)).to_radians();
        (line, [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()])
    };
    (0..=pieces).map(at).collect()
}

/// Points from one to another on the arc of a bulge, tan of a quarter of its angle, counter-clockwise above 0; without the first.
pub(super) fn bulged(line: usize, from: [f64; 2], to: [f64; 2], bulge: f64) -> Vec<Placed> {
    let chord = [to[0] - from[0], to[1] - from[1]];
    let length = chord[0].hypot(chord[1]);
    if bulge == 0.0 || length == 0.0 {
        return vec![(line, to)];
    }
    // from the chord's middle to the centre, to the left
    let offset = (1.0 - bulge * bulge) / (4.0 * bulge);
    let centre = [0.5 * (from[0] + to[0]) - offset * chord[1], 0.5 * (from[1] + to[1]) + offset * chord[0]];
    let radius = (from[0] - centre[0]).hypot(from[1] - centre[1]);
    let start = (from[1] - centre[1]).atan2(from[0] - centre[0]).to_degrees();
    let mut points = arc(line, centre, radius, start, start + 4.0 * bulge.atan().to_degrees());
    let last = points.len() - 1;
    points[last].1 = to;
    points.split_off(1)
}

/// Points of a cubic Bézier curve without the first. It is halved until its control polygon, which turns at least as much as the curve
/// does, turns by at most that of [`ARC_STEP_DEG`].
pub(super) fn curve(line: usize, controls: [[f64; 2]; 4]) -> Vec<Placed> {
    let (mut points, mut waiting) = (Vec::new(), vec![(controls, 0)]);
    while let Some((controls, splits)) = waiting.pop() {
        if splits == MOST_SPLITS || turn_deg(controls) <= ARC_STEP_DEG {
            points.push((line, controls[3]));
            continue;
        }
        let middle = |u: [f64; 2], v: [f64; 2]| [0.5 * (u[0] + v[0]), 0.5 * (u[1] + v[1])];
        let [a, b, c, d] = controls;
        let (ab, bc, cd) = (middle(a, b), middle(b, c), middle(c, d));
        let (abc, bcd) = (middle(ab, bc), middle(bc, cd));
        let half = middle(abc, bcd);
        waiting.extend([([half, bcd, cd, d], splits + 1), ([a, ab, abc, half], splits + 1)]);
    }
    points
}

/// Sum of the angles between the sides of a control polygon [deg].
fn turn_deg(controls: [[f64; 2]; 4]) -> f64 {
    let sides = controls.windows(2).map(|ends| [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]]);
    let sides: Vec<[f64; 2]> = sides.filter(|side| *side != [0.0; 2]).collect();
    let angle = |[u, v]: [[f64; 2]; 2]| (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]).abs().to_degrees();
    sides.windows(2).map(|pair| angle([pair[0], pair[1]])).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_join_whichever_way_they_run() {
        let piece = |points: &[[f64; 2]]| points.iter().map(|p| (1, *p)).collect::<Vec<_>>();
        let pieces = vec![
            piece(&[[0.0, 0.0], [1.0, 0.0]]),
            piece(&[[0.0, 1.0], [0.0, 0.0]]),
            piece(&[[0.0, 1.0], [1.0, 1.0]]),
            piece(&[[1.0, 1.0], [1.0, 0.0]]),
        ];
        let line = Drawing { pieces: pieces.clone(), ..Drawing::default() }.joined().expect("one line");
        assert_eq!(line.len(), 5);
        assert_eq!(line[0], line[4]);
        let apart = vec![pieces[0].clone(), piece(&[[5.0, 5.0], [6.0, 5.0]])];
        assert!(Drawing { pieces: apart, ..Drawing::default() }.joined().is_err());
    }

    /// The points are on the curve, they turn by at most twice `ARC_STEP_DEG` from side to side, and a cusp ends.
    #[test]
    fn a_curve_turns_little_between_its_points() {
        let points = curve(1, [[0.0, 0.0], [0.0, 4.0], [1.0, 4.0], [1.0, 0.0]]);
        let sides: Vec<f64> =
            points.windows(2).map(|p| (p[1].1[1] - p[0].1[1]).atan2(p[1].1[0] - p[0].1[0]).to_degrees()).collect();
        assert!(sides.windows(2).all(|pair| (pair[1] - pair[0]).abs() <= 2.0 * ARC_STEP_DEG), "{sides:?}");
        assert!(points.iter().any(|(_, at)| *at == [0.5, 3.0]) && points.len() < 300, "{}", points.len());
        let cusp = curve(1, [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]]);
        assert!((40..400).contains(&cusp.len()), "{}", cusp.len());
        assert_eq!(curve(1, [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]), [(1, [3.0, 0.0])]);
    }

    #[test]
    fn a_bulge_of_one_is_half_a_circle() {
        let points = bulged(1, [0.0, 0.0], [2.0, 0.0], 1.0);
        assert!(points.iter().all(|(_, [x, y])| ((x - 1.0).hypot(*y) - 1.0).abs() < 1e-12 && *y <= 1e-12));
        assert!(points.iter().any(|(_, [_, y])| *y < -0.999));
    }
}
