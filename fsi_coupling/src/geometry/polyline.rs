//! A line with its running length: the outline of a body, or the middle line of a thin wall.

/// An open or closed line of straight pieces.
#[derive(Clone, Debug)]
pub struct Polyline {
    /// Its points [m]; the first once more at the end where it is closed.
    points: Vec<[f64; 2]>,
    /// Running length at each point [m].
    lengths: Vec<f64>,
    closed: bool,
}

impl Polyline {
    /// A closed line through the corners [m].
    pub fn closed(corners: &[[f64; 2]]) -> Polyline {
        let points = corners.iter().chain(corners.first()).copied().collect();
        Polyline { closed: true, ..Polyline::open(points) }
    }

    /// An open line through the points [m].
    pub fn open(points: Vec<[f64; 2]>) -> Polyline {
        let mut lengths = vec![0.0];
        for (k, pair) in points.windows(2).enumerate() {
            lengths.push(lengths[k] + (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]));
        }
        Polyline { points, lengths, closed: false }
    }

    /// Its points [m]; the first once more at the end where it is closed.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Its length [m].
    pub fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// Running length of the place nearest to `at`, and the distance to it [m].
    pub fn nearest(&self, at: [f64; 2]) -> (f64, f64) {
        let mut best = (0.0, f64::INFINITY);
        for (pair, s) in self.points.windows(2).zip(&self.lengths) {
            let way = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
            let r = [at[0] - pair[0][0], at[1] - pair[0][1]];
            let length = way[0].hypot(way[1]);
            let t = ((r[0] * way[0] + r[1] * way[1]) / (length * length)).clamp(0.0, 1.0);
            let distance = (r[0] - t * way[0]).hypot(r[1] - t * way[1]);
            if distance < best.1 {
                best = (s + t * length, distance);
            }
        }
        best
    }

    /// The part between two running lengths [m], forwards; round the start where the line is closed and `to` ≤ `from`.
    pub fn part(&self, from: f64, to: f64) -> Polyline {
        let mut points = vec![self.at(from)];
        let turns = if self.closed && to <= from { 2 } else { 1 };
        for turn in 0..turns {
            let shift = f64::from(turn) * self.length();
            let end = to + f64::from(turns - 1) * self.length();
            let tolerance = 1e-9 * self.length();
            for (point, s) in self.points.iter().zip(&self.lengths).skip(usize::from(turn > 0)) {
                if s + shift > from + tolerance && s + shift < end - tolerance {
                    points.push(*point);
                }
            }
        }
        points.push(self.at(to));
        Polyline::open(points)
    }

    /// The place at a running length [m].
    pub fn at(&self, s: f64) -> [f64; 2] {
        let (k, t) = self.piece(s);
        let (a, b) = (self.points[k], self.points[k + 1]);
        [0, 1].map(|i| a[i] + t * (b[i] - a[i]))
    }

    /// The piece that a running length lies on, and the share of it that is passed [-].
    pub fn piece(&self, s: f64) -> (usize, f64) {
        let k = self.lengths.partition_point(|l| *l < s).clamp(1, self.lengths.len() - 1);
        let t = (s - self.lengths[k - 1]) / (self.lengths[k] - self.lengths[k - 1]);
        (k - 1, t.clamp(0.0, 1.0))
    }

    /// Unit normal to the left of the line at a running length [-]: at a bend the mean of both sides'.
    pub fn left(&self, s: f64) -> [f64; 2] {
        let tolerance = 1e-9 * self.length();
        let side = |s: f64| {
            let (k, _) = self.piece(s);
            let (a, b, length) = (self.points[k], self.points[k + 1], self.lengths[k + 1] - self.lengths[k]);
            [-(b[1] - a[1]) / length, (b[0] - a[0]) / length]
        };
        let (before, after) = (side(s - tolerance), side(s + tolerance));
        let sum = [before[0] + after[0], before[1] + after[1]];
        let size = sum[0].hypot(sum[1]);
        sum.map(|v| v / size)
    }

    /// True where it returns to its start.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// True where a running length lies between two others [m], forwards; see [`Polyline::part`].
    pub fn between(&self, s: f64, [from, to]: [f64; 2]) -> bool {
        let tolerance = 1e-9 * self.length();
        if from < to || !self.closed {
            return s >= from - tolerance && s <= to + tolerance;
        }
        s >= from - tolerance || s <= to + tolerance
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

    #[test]
    fn a_part_of_a_closed_line_may_pass_its_start() {
        let polyline = Polyline::closed(&SQUARE);
        let part = polyline.part(3.5, 0.25);
        assert_eq!(part.points, vec![[0.0, 0.5], [0.0, 0.0], [0.25, 0.0]]);
        assert!((part.length() - 0.75).abs() < 1e-15);
        assert!(
            polyline.between(3.9, [3.5, 0.25])
                && polyline.between(0.1, [3.5, 0.25])
                && !polyline.between(1.0, [3.5, 0.25])
        );
    }

    #[test]
    fn a_place_has_a_running_length_and_a_normal_to_the_left() {
        let polyline = Polyline::closed(&SQUARE);
        assert_eq!(polyline.nearest([1.2, 0.5]), (1.5, 0.19999999999999996));
        assert_eq!(polyline.at(2.5), [0.5, 1.0]);
        assert_eq!(polyline.left(0.5), [0.0, 1.0]);
        let corner = polyline.left(1.0);
        assert!((corner[0] + 0.5_f64.sqrt()).abs() < 1e-12 && (corner[1] - 0.5_f64.sqrt()).abs() < 1e-12);
    }
}
