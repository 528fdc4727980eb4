//! Cells for the neighbour search: points sorted by level of reach, then by cell row.
//!
//! Where resolution varies, one grid cannot serve: points are grouped into levels whose reaches differ
//! by less than a factor `LEVEL_RATIO`, each level has a dense grid over its own bounding box with
//! flat cells in proportion to its widest point, and a query asks every level whose box it touches. In each
//! level a neighbourhood is a few contiguous runs, and points that follow one another are near each other.

use std::ops::Range;

use crate::interactions::simd::LANES;
use crate::parallel;

/// A point and how far it reaches: a and b may meet if |r_ab| < reach_a + reach_b + |s_a − s_b| with their travels s.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Position [m].
    pub x: f64,
    /// Position [m].
    pub y: f64,
    /// Half the distance over which it may interact with its like [m].
    pub reach: f64,
    /// How far it may go from (x, y) at the velocity that it is expected to keep, to either side [m].
    pub travel: [f64; 2],
    /// Whose point this is.
    pub index: u32,
}

impl Point {
    /// A point that stays in place.
    pub fn at_rest([x, y]: [f64; 2], reach: f64, index: u32) -> Point {
        Point { x, y, reach, travel: [0.0; 2], index }
    }

    /// The farthest that it may reach from (x, y) [m].
    #[inline(always)]
    fn farthest(&self) -> f64 {
        self.reach + self.travel[0].abs() + self.travel[1].abs()
    }

    /// True if the two may meet.
    #[inline(always)]
    fn meets(&self, other: &Point) -> bool {
        let apart = (self.travel[0] - other.travel[0]).abs() + (self.travel[1] - other.travel[1]).abs();
        let (dx, dy, cut) = (self.x - other.x, self.y - other.y, self.reach + other.reach + apart);
        dx * dx + dy * dy < cut * cut
    }
}

/// The box of some points, and their longest reach.
struct Extent {
    lo: [f64; 2],
    hi: [f64; 2],
    reach: f64,
}

impl Extent {
    fn of(points: impl Iterator<Item = Point>) -> Extent {
        let none = Extent { lo: [f64::MAX; 2], hi: [f64::MIN; 2], reach: 0.0 };
        points.fold(none, |Extent { lo, hi, reach }, p| Extent {
            lo: [lo[0].min(p.x), lo[1].min(p.y)],
            hi: [hi[0].max(p.x), hi[1].max(p.y)],
            reach: reach.max(p.farthest()),
        })
    }
}

/// Reaches within one level differ by less than this factor.
const LEVEL_RATIO: f64 = 1.5;
/// Reaches beyond that many levels are in the last one.
const MOST_LEVELS: usize = 64;
/// Width and height of a cell in reaches of a level's widest point: strips two rows of a usual fluid high, and fine
/// columns in them, so that a few points that follow one another are near each other.
const CELL: [f64; 2] = [0.45, 1.25];
/// A level's grid is coarsened rather than exceed this many cells per point (plus a floor).
const CELLS_PER_POINT: usize = 16;

#[derive(Clone, Debug)]
struct Level {
    origin: [f64; 2],
    inverse: [f64; 2],
    columns: usize,
    rows: usize,
    widest: f64,
    /// Start of each cell in `Cells::points`; one more entry than cells.
    start: Vec<u32>,
}

/// Points sorted into cells; see the module's text.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    levels: Vec<Level>,
    points: Vec<Point>,
}

impl Cells {
    /// Sort `points` into cells (counting sort, stable: equal input gives equal order).
    pub fn build(points: &[Point]) -> Cells {
        let mut cells = Cells { levels: Vec::new(), points: Vec::with_capacity(points.len()) };
        let Some(least) = points.iter().map(Point::farthest).reduce(f64::min) else {
            return cells;
        };
        let ends: [f64; MOST_LEVELS - 1] = std::array::from_fn(|l| least * LEVEL_RATIO.powi(l as i32 + 1));
        let mut level = vec![0_u8; points.len()];
        parallel::gather_into(&mut level, |k| {
            let farthest = points[k].farthest();
            ends.iter().position(|&end| farthest < end).unwrap_or(MOST_LEVELS - 1) as u8
        });
        let mut members: Vec<Vec<u32>> = vec![Vec::new(); MOST_LEVELS];
        for (k, &level) in level.iter().enumerate() {
            members[usize::from(level)].push(k as u32);
        }
        for member in members.iter().filter(|m| !m.is_empty()) {
            cells.push_level(points, member);
        }
        cells
    }

    fn push_level(&mut self, points: &[Point], member: &[u32]) {
        let of = |k: &u32| points[*k as usize];
        let Extent { lo, hi, reach: widest } = Extent::of(member.iter().map(of));
        let mut cell = CELL.map(|share| share * widest);
        let extent = [hi[0] - lo[0], hi[1] - lo[1]];
        let most = (CELLS_PER_POINT * member.len() + 4096) as f64;
        // also for points on a line, of which the other extent is 0
        while (extent[0] / cell[0]).max(1.0) * (extent[1] / cell[1]).max(1.0) > most {
            cell = cell.map(|side| 1.5 * side);
        }
        let [columns, rows] = [0, 1].map(|k| (extent[k] / cell[k]) as usize + 1);
        let start = vec![0; columns * rows + 1];
        let mut level = Level { origin: lo, inverse: cell.map(|side| 1.0 / side), columns, rows, widest, start };
        let mut cell = vec![0_u32; member.len()];
        parallel::gather_into(&mut cell, |k| level.cell_of(&of(&member[k])) as u32);
        for &c in &cell {
            level.start[c as usize + 1] += 1;
        }
        let base = self.points.len() as u32;
        level.start[0] = base;
        for c in 0..columns * rows {
            level.start[c + 1] += level.start[c];
        }
        let mut next = level.start.clone();
        let blank = Point::at_rest([0.0; 2], 0.0, 0);
        self.points.resize(base as usize + member.len(), blank);
        for (k, &c) in member.iter().zip(&cell) {
            self.points[next[c as usize] as usize] = of(k);
            next[c as usize] += 1;
        }
        self.levels.push(level);
    }

    /// The farthest that any point may reach [m].
    pub(crate) fn farthest(&self) -> f64 {
        self.levels.iter().map(|level| level.widest).fold(0.0, f64::max)
    }

    /// The points in sorted order.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Name every point by its place in the sorted order, after its owner was sorted likewise.
    pub fn name_by_order(&mut self) {
        for (k, p) in self.points.iter_mut().enumerate() {
            p.index = k as u32;
        }
    }

    /// True if `at` may meet any point.
    pub fn any_meets(&self, at: &Point) -> bool {
        let mut any = false;
        self.for_each_run(&[*at], |run| any = any || self.points[run].iter().any(|p| at.meets(p)));
        any
    }

    /// Call `found` with every point within `reach` + its own reach of (x, y), in sorted order. For points at rest.
    #[inline]
    pub fn for_each_within(&self, x: f64, y: f64, reach: f64, mut found: impl FnMut(&Point)) {
        let at = Point::at_rest([x, y], reach, u32::MAX);
        self.for_each_run(&[at], |run| self.points[run].iter().filter(|p| at.meets(p)).for_each(&mut found));
    }

    /// Call `found` with runs of [`Cells::points`], in order and none twice: among them are all that any point of `at` (at
    /// most [`LANES`]) may meet.
    #[inline]
    pub fn for_each_run(&self, at: &[Point], mut found: impl FnMut(Range<usize>)) {
        let all = Extent::of(at.iter().copied());
        for level in &self.levels {
            let cut = all.reach + level.widest;
            let columns = level.span(0, all.lo[0], all.hi[0], cut);
            let (Some([c0, c1]), Some([r0, r1])) = (columns, level.span(1, all.lo[1], all.hi[1], cut)) else {
                continue;
            };
            if all.hi[0] - all.lo[0] <= cut {
                (r0..=r1).for_each(|row| found(level.run(row, [c0, c1]))); // near each other: one box for all
                continue;
            }
            let mut boxes = [[0; 4]; LANES];
            let mut touching = 0;
            for p in at {
                let cut = p.farthest() + level.widest;
                if let (Some([c0, c1]), Some([r0, r1])) = (level.span(0, p.x, p.x, cut), level.span(1, p.y, p.y, cut)) {
                    boxes[touching] = [c0, c1, r0, r1];
                    touching += 1;
                }
            }
            let boxes = &mut boxes[..touching];
            boxes.sort_unstable(); // by their first column
            let lowest = boxes.iter().map(|b| b[2]).min().unwrap_or(1);
            let highest = boxes.iter().map(|b| b[3]).max().unwrap_or(0);
            for row in lowest..=highest {
                let mut joined: Option<[usize; 2]> = None;
                for &[c0, c1, _, _] in boxes.iter().filter(|b| b[2] <= row && row <= b[3]) {
                    joined = Some(match joined {
                        Some([from, to]) if c0 <= to + 1 => [from, to.max(c1)],
                        Some(apart) => {
                            found(level.run(row, apart));
                            [c0, c1]
                        }
                        None => [c0, c1],
                    });
                }
                if let Some(columns) = joined {
                    found(level.run(row, columns));
                }
            }
        }
    }
}

impl Level {
    fn cell_of(&self, p: &Point) -> usize {
        let column = (((p.x - self.origin[0]) * self.inverse[0]) as usize).min(self.columns - 1);
        let row = (((p.y - self.origin[1]) * self.inverse[1]) as usize).min(self.rows - 1);
        row * self.columns + column
    }

    /// Points of the cells from `c0` to `c1` of a row.
    fn run(&self, row: usize, [c0, c1]: [usize; 2]) -> Range<usize> {
        let of = |column: usize| self.start[row * self.columns + column] as usize;
        of(c0)..of(c1 + 1)
    }

    /// Cells of one axis that [from − cut, to + cut] touches: columns (0) or rows (1).
    #[inline(always)]
    fn span(&self, axis: usize, from: f64, to: f64, cut: f64) -> Option<[usize; 2]> {
        let (origin, cells) = (self.origin[axis], [self.columns, self.rows][axis]);
        let (lo, hi) = ((from - origin - cut) * self.inverse[axis], (to - origin + cut) * self.inverse[axis]);
        if hi < 0.0 || lo >= cells as f64 {
            return None;
        }
        Some([lo.max(0.0) as usize, (hi as usize).min(cells - 1)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn brute(points: &[Point], at: &Point) -> Vec<u32> {
        let near = |p: &&Point| {
            let (dx, dy, cut) = (at.x - p.x, at.y - p.y, at.reach + p.reach);
            dx * dx + dy * dy < cut * cut
        };
        points.iter().filter(near).map(|p| p.index).collect()
    }

    proptest! {
        /// Cells find exactly what testing every pair finds, over three decades of reach.
        #[test]
        fn cells_find_every_pair(raw in prop::collection::vec((0.0..1.0f64, 0.0..1.0f64, -3.0..-0.5f64), 1..200)) {
            let points: Vec<Point> = raw.iter().enumerate()
                .map(|(k, &(x, y, e))| Point::at_rest([x, y], 10f64.powf(e), k as u32)).collect();
            let cells = Cells::build(&points);
            for p in &points {
                let mut found = Vec::new();
                cells.for_each_within(p.x, p.y, p.reach, |q| found.push(q.index));
                found.sort_unstable();
                prop_assert_eq!(found, brute(&points, p));
            }
        }
    }

    #[test]
    fn a_stray_point_does_not_cost_a_grid_of_empty_cells() {
        for stray in [[1e6, 1e6], [1e30, 0.0], [0.0, -1e300]] {
            let mut points: Vec<Point> = (0..100).map(|k| Point::at_rest([0.001 * k as f64, 0.0], 0.001, k)).collect();
            points.push(Point::at_rest(stray, 0.001, 100));
            let cells = Cells::build(&points);
            let total: usize = cells.levels.iter().map(|l| l.start.len()).sum();
            assert!(total < 10_000, "{total} cells");
            let mut found = 0;
            cells.for_each_within(stray[0], stray[1], 0.001, |_| found += 1);
            assert_eq!(found, 1, "{stray:?}");
        }
    }
}
