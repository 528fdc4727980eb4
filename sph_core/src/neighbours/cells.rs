//! Cells for the neighbour search: points sorted by level of reach, then by cell row.
//!
//! Where resolution varies, one grid cannot serve: points are grouped into levels whose reaches differ
//! by less than a factor `LEVEL_RATIO`, each level has a dense grid over its own bounding box with
//! flat cells in proportion to its widest point, and a query asks every level whose box it touches. In each
//! level a neighbourhood is a few contiguous runs, and points that follow one another are near each other.

use std::ops::Range;

use crate::interactions::simd::LANES;
use crate::memory::of_vector;
use crate::neighbours::sorting::{Places, count_cells, place_points};
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
    pub(crate) fn farthest(&self) -> f64 {
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

/// The box of some points, and how far they reach.
#[derive(Clone, Copy)]
struct Extent {
    lo: [f64; 2],
    hi: [f64; 2],
    /// Longest reach without travel [m].
    reach: f64,
    /// Longest reach with travel [m].
    farthest: f64,
    /// Shortest reach with travel [m].
    nearest: f64,
    count: usize,
    travels: bool,
}

impl Extent {
    const NONE: Extent = Extent {
        lo: [f64::MAX; 2],
        hi: [f64::MIN; 2],
        reach: 0.0,
        farthest: 0.0,
        nearest: f64::MAX,
        count: 0,
        travels: false,
    };

    #[inline(always)]
    fn with(self, p: &Point) -> Extent {
        let Extent { lo, hi, reach, farthest, nearest, count, travels } = self;
        let far = p.farthest();
        Extent {
            lo: [lo[0].min(p.x), lo[1].min(p.y)],
            hi: [hi[0].max(p.x), hi[1].max(p.y)],
            reach: reach.max(p.reach),
            farthest: farthest.max(far),
            nearest: nearest.min(far),
            count: count + 1,
            travels: travels | (far != p.reach),
        }
    }

    fn and(self, other: &Extent) -> Extent {
        let (Extent { lo, hi, .. }, with) = (self, other);
        Extent {
            lo: [lo[0].min(with.lo[0]), lo[1].min(with.lo[1])],
            hi: [hi[0].max(with.hi[0]), hi[1].max(with.hi[1])],
            reach: self.reach.max(with.reach),
            farthest: self.farthest.max(with.farthest),
            nearest: self.nearest.min(with.nearest),
            count: self.count + with.count,
            travels: self.travels | with.travels,
        }
    }

    #[inline(always)]
    fn of(points: &[Point]) -> Extent {
        points.iter().fold(Extent::NONE, Extent::with)
    }
}

/// Reaches within one level differ by less than this factor.
const LEVEL_RATIO: f64 = 1.5;
/// Reaches beyond that many levels are in the last one.
const MOST_LEVELS: usize = 64;
/// Width and height of a cell in reaches without travel of a level's widest point: strips two rows of a usual fluid high, and fine
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
    /// Its first cell among those of all levels.
    first: usize,
}

/// Points sorted into cells; see the module's text.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    levels: Vec<Level>,
    points: Vec<Point>,
    /// Start of each cell of all levels in `points`, and their end.
    start: Vec<u32>,
    /// Some of them travel.
    travel: bool,
    places: Places,
}

impl Cells {
    /// Sort `points` into cells.
    pub fn build(points: &[Point]) -> Cells {
        let mut cells = Cells::default();
        cells.sort(points.len(), |k| points[k]);
        cells
    }

    /// Sort `n` points into these cells, in place of those that they hold (stable: equal input gives equal order).
    pub(crate) fn sort(&mut self, n: usize, point: impl Fn(usize) -> Point + Sync) {
        self.levels.clear();
        self.points.clear();
        self.start.clear();
        self.travel = false;
        self.add(n, point);
    }

    /// Sort `n` more points into levels of their own, after the others.
    pub(crate) fn add(&mut self, n: usize, point: impl Fn(usize) -> Point + Sync) {
        if n == 0 {
            return;
        }
        let (first_level, first_cell) = (self.levels.len(), self.start.len().saturating_sub(1));
        let bounds = LevelBounds::of(n, &point);
        let mut cells = first_cell;
        self.travel |= bounds.extents.iter().any(|extent| extent.travels);
        for extent in &bounds.extents {
            let level = Level::over(extent, cells);
            cells += level.columns * level.rows;
            self.levels.push(level);
        }
        let levels = &self.levels[first_level..];
        let cell_of = |k: usize| {
            let p = point(k);
            let level = &levels[bounds.level_of(&p)];
            level.first - first_cell + level.cell_of(&p)
        };
        let Cells { points, start, places, .. } = self;
        count_cells(n, cells - first_cell, cell_of, places);
        let base = points.len();
        points.resize(base + n, Point::at_rest([0.0; 2], 0.0, 0));
        start.resize(cells, 0);
        place_points(places, base as u32, &mut start[first_cell..], &mut points[base..], point);
        start.push((base + n) as u32);
    }

    /// The points in sorted order.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Name the points from the one at `from` on by their place in the sorted order, `first` the first of them.
    pub(crate) fn name_by_order(&mut self, from: usize, first: u32) {
        parallel::update(&mut self.points[from..], |k, p| p.index = first + k as u32);
    }

    /// The farthest that any point may reach [m].
    pub(crate) fn farthest(&self) -> f64 {
        self.levels.iter().map(|level| level.widest).fold(0.0, f64::max)
    }

    /// True if any point travels.
    #[inline(always)]
    pub(crate) fn travel(&self) -> bool {
        self.travel
    }

    /// True if `at` may meet any point.
    pub fn any_meets(&self, at: &Point) -> bool {
        self.levels.iter().any(|level| {
            let cut = at.farthest() + level.widest;
            let rows = level.span(1, at.y, at.y, cut);
            rows.is_some_and(|[r0, r1]| {
                let meets = |row| {
                    let run = level.run_within(&self.start, row, [at.x; 2], [at.y; 2], cut);
                    self.points[run].iter().any(|p| at.meets(p))
                };
                (r0..=r1).any(meets)
            })
        })
    }

    /// Call `found` with every point within `reach` + its own reach of (x, y), in sorted order. For points at rest.
    #[inline]
    pub fn for_each_within(&self, x: f64, y: f64, reach: f64, mut found: impl FnMut(&Point)) {
        let at = Point::at_rest([x, y], reach, u32::MAX);
        self.for_each_run(&[at], |run| self.points[run].iter().filter(|p| at.meets(p)).for_each(&mut found));
    }

    /// Call `found` with runs of [`Cells::points`], in order and none twice: among them are all that any point of `at` (at
    /// most [`LANES`]) may meet.
    #[inline(always)]
    pub fn for_each_run(&self, at: &[Point], mut found: impl FnMut(Range<usize>)) {
        let all = Extent::of(at);
        for level in &self.levels {
            let cut = all.farthest + level.widest;
            let Some([r0, r1]) = level.span(1, all.lo[1], all.hi[1], cut) else { continue };
            if all.hi[0] - all.lo[0] > cut {
                self.for_each_joined_run(level, at, &mut found);
                continue;
            }
            for row in r0..=r1 {
                found(level.run_within(&self.start, row, [all.lo[0], all.hi[0]], [all.lo[1], all.hi[1]], cut));
            }
        }
    }

    /// The same of a level for points that are far from each other.
    #[cold]
    fn for_each_joined_run(&self, level: &Level, at: &[Point], found: &mut impl FnMut(Range<usize>)) {
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
                        found(level.run(&self.start, row, apart));
                        [c0, c1]
                    }
                    None => [c0, c1],
                });
            }
            if let Some(columns) = joined {
                found(level.run(&self.start, row, columns));
            }
        }
    }

    /// What they hold on to [bytes].
    pub(crate) fn bytes(&self) -> usize {
        of_vector(&self.points) + of_vector(&self.start) + self.places.bytes()
    }
}

/// The extents of the levels that some points need.
struct LevelBounds {
    /// Where the levels but the last end [m].
    ends: Vec<f64>,
    /// Of the levels that have points.
    extents: Vec<Extent>,
    /// Which extent each level has.
    place: Vec<usize>,
}

impl LevelBounds {
    fn of(n: usize, point: &(impl Fn(usize) -> Point + Sync)) -> LevelBounds {
        let all = |targets: Range<usize>| targets.fold(Extent::NONE, |extent, k| extent.with(&point(k)));
        let all = parallel::by_piece(n, all).iter().fold(Extent::NONE, Extent::and);
        let mut bounds = LevelBounds { ends: Vec::new(), extents: vec![all], place: vec![0] };
        if all.farthest < LEVEL_RATIO * all.nearest {
            return bounds;
        }
        bounds.ends = (1..MOST_LEVELS as i32).map(|l| all.nearest * LEVEL_RATIO.powi(l)).collect();
        bounds.place = (0..MOST_LEVELS).collect();
        let by_level = |targets: Range<usize>| {
            let mut found = [Extent::NONE; MOST_LEVELS];
            for p in targets.map(point) {
                let level = bounds.level_of(&p);
                found[level] = found[level].with(&p);
            }
            found
        };
        let add = |mut sum: [Extent; MOST_LEVELS], part: &[Extent; MOST_LEVELS]| {
            sum.iter_mut().zip(part).for_each(|(sum, part)| *sum = sum.and(part));
            sum
        };
        let levels = parallel::by_piece(n, by_level).iter().fold([Extent::NONE; MOST_LEVELS], add);
        bounds.extents.clear();
        for (place, extent) in bounds.place.iter_mut().zip(&levels) {
            *place = bounds.extents.len();
            bounds.extents.extend((extent.count > 0).then_some(*extent));
        }
        bounds
    }

    /// The place of a point's level among those that have points.
    #[inline(always)]
    fn level_of(&self, p: &Point) -> usize {
        if self.ends.is_empty() {
            return 0;
        }
        let farthest = p.farthest();
        self.place[self.ends.iter().position(|&end| farthest < end).unwrap_or(MOST_LEVELS - 1)]
    }
}

impl Level {
    /// The grid over points of an extent, whose first cell is cell `first` of all.
    fn over(of: &Extent, first: usize) -> Level {
        let mut cell = CELL.map(|share| share * of.reach);
        let extent = [of.hi[0] - of.lo[0], of.hi[1] - of.lo[1]];
        let most = (CELLS_PER_POINT * of.count + 4096) as f64;
        // also for points on a line, of which the other extent is 0
        while (extent[0] / cell[0]).max(1.0) * (extent[1] / cell[1]).max(1.0) > most {
            cell = cell.map(|side| 1.5 * side);
        }
        let [columns, rows] = [0, 1].map(|k| (extent[k] / cell[k]) as usize + 1);
        Level { origin: of.lo, inverse: cell.map(|side| 1.0 / side), columns, rows, widest: of.farthest, first }
    }

    #[inline(always)]
    fn cell_of(&self, p: &Point) -> usize {
        let column = (((p.x - self.origin[0]) * self.inverse[0]) as usize).min(self.columns - 1);
        let row = (((p.y - self.origin[1]) * self.inverse[1]) as usize).min(self.rows - 1);
        row * self.columns + column
    }

    /// Points of the cells from `c0` to `c1` of a row.
    #[inline(always)]
    fn run(&self, start: &[u32], row: usize, [c0, c1]: [usize; 2]) -> Range<usize> {
        let of = |column: usize| start[self.first + row * self.columns + column] as usize;
        of(c0)..of(c1 + 1)
    }

    /// Points of a row that may be within `cut` of a box: cells as far to its sides as the row's distance from the box leaves.
    #[inline(always)]
    fn run_within(&self, start: &[u32], row: usize, x: [f64; 2], y: [f64; 2], cut: f64) -> Range<usize> {
        let height = 1.0 / self.inverse[1];
        let below = self.origin[1] + row as f64 * height;
        let off = (below - y[1]).max(y[0] - (below + height)).max(0.0);
        let beside = (cut * cut - off * off).max(0.0).sqrt();
        self.span(0, x[0], x[1], beside).map_or(0..0, |columns| self.run(start, row, columns))
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
            let total = cells.start.len();
            assert!(total < 10_000, "{total} cells");
            let mut found = 0;
            cells.for_each_within(stray[0], stray[1], 0.001, |_| found += 1);
            assert_eq!(found, 1, "{stray:?}");
        }
    }

    /// Points added later are found too, and cells that are used again forget what they held.
    #[test]
    fn points_may_be_added_and_replaced() {
        let at = |k: usize| Point::at_rest([0.01 * (k % 40) as f64, 0.01 * (k / 40) as f64], 0.01, k as u32);
        let (n, more) = (600, 300);
        let all: Vec<Point> = (0..n + more).map(at).collect();
        let mut cells = Cells::build(&all[..17]);
        cells.sort(n, at);
        cells.add(more, |k| at(n + k));
        for p in &all {
            let mut found = Vec::new();
            cells.for_each_within(p.x, p.y, p.reach, |q| found.push(q.index));
            found.sort_unstable();
            assert_eq!(found, brute(&all, p));
            assert!(cells.any_meets(p));
        }
    }
}
