//! Levels of reach: points whose reaches differ by less than a factor, and the grid over each such group.

use std::ops::Range;

use crate::neighbours::point::Point;
use crate::parallel;

/// The box of some points, and how far they reach.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    pub lo: [f64; 2],
    pub hi: [f64; 2],
    /// Longest reach without travel [m].
    pub reach: f64,
    /// Longest reach with travel [m].
    pub farthest: f64,
    /// Shortest reach with travel [m].
    pub nearest: f64,
    pub count: usize,
    pub travels: bool,
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
    fn at(p: &Point) -> Extent {
        let (at, farthest) = ([p.x, p.y], p.farthest());
        let travels = farthest != p.reach;
        Extent { lo: at, hi: at, reach: p.reach, farthest, nearest: farthest, count: 1, travels }
    }

    #[inline(always)]
    pub fn with(self, p: &Point) -> Extent {
        self.and(&Extent::at(p))
    }

    #[inline(always)]
    pub fn and(self, other: &Extent) -> Extent {
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
    pub fn of<'a>(points: impl IntoIterator<Item = &'a Point>) -> Extent {
        points.into_iter().fold(Extent::NONE, Extent::with)
    }

    /// True if a point is within `cut` of the box along both axes.
    #[inline(always)]
    pub fn is_near(&self, p: &Point, cut: f64) -> bool {
        let within = |k: usize, place: f64| place + cut >= self.lo[k] && place - cut <= self.hi[k];
        within(0, p.x) && within(1, p.y)
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
pub(super) struct Level {
    origin: [f64; 2],
    inverse: [f64; 2],
    pub columns: usize,
    pub rows: usize,
    pub widest: f64,
    /// Its first cell among those of all levels.
    pub first: usize,
}

/// The extents of the levels that some points need.
pub(super) struct LevelBounds {
    /// Where the levels but the last end [m].
    ends: Vec<f64>,
    /// Of the levels that have points.
    pub extents: Vec<Extent>,
    /// Which extent each level has.
    place: Vec<usize>,
}

impl LevelBounds {
    pub fn of(n: usize, point: &(impl Fn(usize) -> Point + Sync)) -> LevelBounds {
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
    pub fn level_of(&self, p: &Point) -> usize {
        if self.ends.is_empty() {
            return 0;
        }
        let farthest = p.farthest();
        self.place[self.ends.iter().position(|&end| farthest < end).unwrap_or(MOST_LEVELS - 1)]
    }
}

impl Level {
    /// The grid over points of an extent, whose first cell is cell `first` of all.
    pub fn over(of: &Extent, first: usize) -> Level {
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
    pub fn cell_of(&self, p: &Point) -> usize {
        let column = (((p.x - self.origin[0]) * self.inverse[0]) as usize).min(self.columns - 1);
        let row = (((p.y - self.origin[1]) * self.inverse[1]) as usize).min(self.rows - 1);
        row * self.columns + column
    }

    /// Points of the cells from `c0` to `c1` of a row.
    #[inline(always)]
    pub fn run(&self, start: &[u32], row: usize, [c0, c1]: [usize; 2]) -> Range<usize> {
        let of = |column: usize| start[self.first + row * self.columns + column] as usize;
        of(c0)..of(c1 + 1)
    }

    /// Points of each row that may be within `cut` of a box: cells as far to its sides as the row's distance from the box leaves. Rows
    /// without points there are left out.
    #[inline(always)]
    pub fn runs_within(
        &self,
        start: &[u32],
        x: [f64; 2],
        y: [f64; 2],
        cut: f64,
    ) -> Option<impl Iterator<Item = Range<usize>>> {
        let columns = self.span(0, x[0], x[1], cut)?;
        let [r0, r1] = self.span(1, y[0], y[1], cut)?;
        let height = 1.0 / self.inverse[1];
        let rows = (r0..=r1).filter(move |row| !self.run(start, *row, columns).is_empty());
        Some(rows.filter_map(move |row| {
            let below = self.origin[1] + row as f64 * height;
            let off = (below - y[1]).max(y[0] - (below + height)).max(0.0);
            let beside = (cut * cut - off * off).max(0.0).sqrt();
            self.span(0, x[0], x[1], beside).map(|columns| self.run(start, row, columns))
        }))
    }

    /// Cells of one axis that [from − cut, to + cut] touches: columns (0) or rows (1).
    #[inline(always)]
    pub fn span(&self, axis: usize, from: f64, to: f64, cut: f64) -> Option<[usize; 2]> {
        let (origin, cells) = (self.origin[axis], [self.columns, self.rows][axis]);
        let (lo, hi) = ((from - origin - cut) * self.inverse[axis], (to - origin + cut) * self.inverse[axis]);
        if hi < 0.0 || lo >= cells as f64 {
            return None;
        }
        Some([lo.max(0.0) as usize, (hi as usize).min(cells - 1)])
    }
}
