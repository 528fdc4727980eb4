//! Cells for the neighbour search: points sorted by level of reach, then by cell row.
//!
//! Where resolution varies, one grid cannot serve: points are grouped into levels whose reaches differ
//! by less than a factor `LEVEL_RATIO`, each level has a dense grid over its own bounding box with
//! flat cells in proportion to its widest point, and a query asks every level whose box it touches. In each
//! level a neighbourhood is a few contiguous runs, and points that follow one another are near each other.

use std::ops::Range;

use crate::memory::of_vector;
use crate::neighbours::levels::{Extent, Level, LevelBounds};
pub use crate::neighbours::point::Point;
use crate::neighbours::sorting::{Places, count_cells, place_points};
use crate::parallel;
use crate::simd::LANES;

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
    pub(crate) fn points(&self) -> &[Point] {
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

    /// Of each level with points beside a plane of symmetry at `plane` [m], how far it reaches [m] and the box of those points: no point that
    /// reaches `farthest` [m] at most meets others from behind the plane.
    pub(super) fn beside(&self, plane: f64, farthest: f64) -> Vec<(f64, Extent)> {
        let of_level = |level: &Level| {
            let [first, end] =
                [level.first, level.first + level.columns * level.rows].map(|cell| self.start[cell] as usize);
            let near = |p: &&Point| p.x - plane < farthest + level.widest;
            (level.widest, Extent::of(self.points[first..end].iter().filter(near)))
        };
        self.levels.iter().map(of_level).filter(|(_, extent)| extent.count > 0).collect()
    }

    /// True if `at` may meet any point.
    pub(crate) fn any_meets(&self, at: &Point) -> bool {
        self.levels.iter().any(|level| {
            let cut = at.farthest() + level.widest;
            let near = level.runs_within(&self.start, [at.x; 2], [at.y; 2], cut);
            near.into_iter().flatten().any(|run| self.points[run].iter().any(|p| at.meets(p)))
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
    pub(crate) fn for_each_run(&self, at: &[Point], mut found: impl FnMut(Range<usize>)) {
        let all = Extent::of(at);
        for level in &self.levels {
            let cut = all.farthest + level.widest;
            if all.hi[0] - all.lo[0] > cut {
                self.for_each_joined_run(level, at, &mut found);
                continue;
            }
            let near = level.runs_within(&self.start, [all.lo[0], all.hi[0]], [all.lo[1], all.hi[1]], cut);
            near.into_iter().flatten().for_each(&mut found);
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

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
