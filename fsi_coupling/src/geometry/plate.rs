//! Thin plates: a middle line and a thickness (THEORY WA8, WA10).

use crate::geometry::polygon::normal;
use crate::geometry::rows::WallRows;

/// A plate: its middle line [m] and its thickness [m].
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Corners of the middle line [m].
    pub middle: Vec<[f64; 2]>,
    /// Thickness, half of it on each side of the line [m].
    pub thickness: f64,
    /// How far the plate goes on straight beyond the line's first and last corner, inside other walls that it stands on [m].
    pub roots: [f64; 2],
}

impl Plate {
    /// A plate without roots.
    pub fn new(middle: &[[f64; 2]], thickness: f64) -> Plate {
        Plate { middle: middle.to_vec(), thickness, roots: [0.0; 2] }
    }

    /// The middle line with its roots [m].
    pub fn line(&self) -> Vec<[f64; 2]> {
        let mut line = self.middle.clone();
        let n = line.len();
        let [first, last] = self.roots;
        line[0] = beyond(self.middle[1], self.middle[0], first);
        line[n - 1] = beyond(self.middle[n - 2], self.middle[n - 1], last);
        line
    }

    /// True where the layers of both faces do not fit between them: then each side of the plate has its own water (THEORY WA9).
    pub fn is_thin(&self, rows: &WallRows) -> bool {
        self.thickness < 2.0 * rows.reach()
    }
}

/// A point `length` [m] farther on than b from a [m].
fn beyond(a: [f64; 2], b: [f64; 2], length: f64) -> [f64; 2] {
    let way = [b[0] - a[0], b[1] - a[1]];
    let size = way[0].hypot(way[1]);
    [0, 1].map(|k| b[k] + length * way[k] / size)
}

/// Index of a side of the middle line that is too short at a bend: the layers of its outer face would turn inside out; `reach` [m] is
/// the distance of the deepest layer from the line.
pub fn too_tight(middle: &[[f64; 2]], reach: f64) -> Option<usize> {
    [1.0, -1.0].into_iter().find_map(|side| {
        let shifted: Vec<[f64; 2]> = (0..middle.len()).map(|k| mitred(middle, k, side * reach)).collect();
        (0..middle.len() - 1).find(|&k| !forward(middle, &shifted, k))
    })
}

/// True where side k of a shifted line still runs the way it ran.
fn forward(line: &[[f64; 2]], shifted: &[[f64; 2]], k: usize) -> bool {
    let way = |p: &[[f64; 2]]| [p[k + 1][0] - p[k][0], p[k + 1][1] - p[k][1]];
    let (a, b) = (way(line), way(shifted));
    a[0] * b[0] + a[1] * b[1] > 0.0
}

/// Corner k of the line, shifted to the right by `offset` [m] and mitred.
pub(crate) fn mitred(line: &[[f64; 2]], k: usize, offset: f64) -> [f64; 2] {
    let of = |side: usize| normal(line[side], line[side + 1]);
    let (a, b) = (of(k.saturating_sub(1)), of(k.min(line.len() - 2)));
    let stretch = offset / (1.0 + a[0] * b[0] + a[1] * b[1]);
    [line[k][0] + stretch * (a[0] + b[0]), line[k][1] + stretch * (a[1] + b[1])]
}
