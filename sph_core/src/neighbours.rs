//! Neighbour lists with a skin that suits each particle's speed.
//!
//! A list made at one moment holds every pair that can meet until some particle has moved farther than
//! the skin it was given: its share of the smoothing length plus its speed times the time the list
//! should live. Jets move several times as fast as the spray root, so one skin for all would be wasted
//! on still water (findings of the prototypes, item 10).
//!
//! Targets are listed in clusters of [`LANES`] that follow one another, so that a sweep sums a cluster side by side: an
//! entry is a neighbour of any of them, with a bit for each target that may meet it.

use std::ops::Range;

use crate::bytes::of_vector;
use crate::cells::{Cells, Point};
use crate::lanes::{self, LANES, Number, Task};
use crate::sweep::{self, CHUNK};

/// A neighbour of a cluster: its index, and above it a bit for each target.
#[derive(Clone, Copy, Debug)]
struct Entry(u32);

/// Bits of an entry that are the index.
const INDEX_BITS: u32 = u32::BITS - LANES as u32;

/// Most points that lists can name.
pub const MOST_POINTS: usize = 1 << INDEX_BITS;

impl Entry {
    #[inline(always)]
    fn new(index: u32, bits: u32) -> Entry {
        Entry(index | bits << INDEX_BITS)
    }
    #[inline(always)]
    fn index(self) -> u32 {
        self.0 & (MOST_POINTS as u32 - 1)
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0 >> INDEX_BITS
    }
}

/// What a sweep reads of a neighbour, spread over the lanes of its targets.
pub(crate) trait Spread {
    /// The same for lanes.
    type Over<R: Number>;
    /// The same for every lane.
    fn spread<R: Number>(&self, zero: R) -> Self::Over<R>;
    /// As it is where a target's bit is set; without volume, so that nothing is felt of it, elsewhere.
    fn only<R: Number>(over: Self::Over<R>, bits: u32) -> Self::Over<R>;
}

/// Neighbours of many targets; stored by chunk so that chunks are filled independently.
#[derive(Clone, Debug, Default)]
pub struct Lists {
    chunks: Vec<ChunkList>,
    /// How many.
    targets: usize,
    /// Targets are points too, and stand in their own lists.
    among: bool,
    /// Some pairs within reach do not see each other (T1).
    struck: bool,
}

#[derive(Clone, Debug, Default)]
struct ChunkList {
    start: Vec<u32>,
    entries: Vec<Entry>,
    alike: Vec<bool>,
}

/// Empty lists.
pub(crate) static NONE: Lists = Lists { chunks: Vec::new(), targets: 0, among: false, struck: false };

impl Lists {
    /// For each of `n` targets, everyone in `cells` within reach. `among`: target k is point k, and not its own neighbour.
    /// `size` gives the smoothing length [m] of target and of point.
    pub(crate) fn build(
        &mut self,
        n: usize,
        cells: &Cells,
        target: impl Fn(usize) -> Point + Sync,
        among: bool,
        size: (impl Fn(usize) -> f64 + Sync, impl Fn(u32) -> f64 + Sync),
    ) {
        assert!(cells.points().len() <= MOST_POINTS, "no more than {MOST_POINTS} particles");
        (self.targets, self.among, self.struck) = (n, among, false);
        self.chunks.resize(n.div_ceil(CHUNK), ChunkList::default());
        sweep::for_each_chunk(&mut self.chunks, n, |targets, list| {
            list.start.clear();
            list.entries.clear();
            list.alike.clear();
            list.start.push(0);
            let (mut runs, mut found) = (Vec::new(), Vec::new());
            for first in targets.clone().step_by(LANES) {
                let last = (first + LANES).min(targets.end);
                let mut at = [target(first); LANES];
                for k in first + 1..last {
                    at[k - first] = target(k);
                }
                runs.clear();
                let from = found.len();
                cells.for_each_run(&at[..last - first], |run| runs.push(run));
                let count = last - first;
                lanes::run(true, Meeting { points: cells.points(), runs: &runs, at, count, found: &mut found });
                list.start.push(found.len() as u32);
                let h = size.0(first);
                let alike = (first..last).all(|k| size.0(k) == h)
                    && found[from..].iter().all(|e: &Entry| size.1(e.index()) == h);
                list.alike.push(alike);
            }
            list.entries.reserve_exact(found.len()); // no more than is needed: lists are most of the memory
            list.entries.extend_from_slice(&found);
        });
    }

    /// Of the list of each target k, keep those j that `keep(k, j)` wants.
    pub(crate) fn retain(&mut self, keep: impl Fn(usize, u32) -> bool + Sync) {
        let (n, among) = (self.chunks.len() * CHUNK, self.among);
        self.struck = true;
        sweep::for_each_chunk(&mut self.chunks, n, |targets, list| {
            let (mut from, mut kept) = (0, 0);
            for i in 0..list.start.len().saturating_sub(1) {
                let (first, to) = (targets.start + i * LANES, list.start[i + 1] as usize);
                for read in from..to {
                    let (j, bits) = (list.entries[read].index(), list.entries[read].bits());
                    let wanted = |k: usize| (among && first + k == j as usize) || keep(first + k, j);
                    let left = (0..LANES).filter(|&k| bits >> k & 1 == 1 && wanted(k)).fold(0, |left, k| left | 1 << k);
                    if left != 0 {
                        list.entries[kept] = Entry::new(j, left);
                        kept += 1;
                    }
                }
                from = to;
                list.start[i + 1] = kept as u32;
            }
            list.entries.truncate(kept);
        });
    }

    #[inline(always)]
    fn cluster(&self, k: usize) -> &[Entry] {
        let Some(list) = self.chunks.get(k / CHUNK) else { return &[] };
        let c = k % CHUNK / LANES;
        &list.entries[list.start[c] as usize..list.start[c + 1] as usize]
    }

    /// Neighbours of target `k`, itself not among them, in a fixed order.
    #[inline(always)]
    pub fn of(&self, k: usize) -> impl Iterator<Item = u32> + Clone {
        let own = if self.among { k as u32 } else { u32::MAX };
        let bit = 1 << (k % LANES);
        self.cluster(k).iter().filter(move |e| e.bits() & bit != 0 && e.index() != own).map(|e| e.index())
    }

    /// What the targets from `first` on, as many as an `R` is wide, read of all that any of them may meet. Targets that
    /// are points too meet themselves.
    #[inline(always)]
    pub(crate) fn around<'a, R: Number, T: Spread>(&'a self, first: usize, zero: R, rows: &'a [T]) -> Around<'a, R, T> {
        Around { entries: self.cluster(first).iter(), rows, lane: (first % LANES) as u32, struck: self.struck, zero }
    }

    /// True if the targets beside `k` and all that they may meet have one smoothing length.
    #[inline(always)]
    pub(crate) fn alike(&self, k: usize) -> bool {
        self.chunks[k / CHUNK].alike[k % CHUNK / LANES]
    }

    /// What the lists hold on to [bytes].
    pub(crate) fn bytes(&self) -> usize {
        of_vector(&self.chunks)
            + self
                .chunks
                .iter()
                .map(|c| of_vector(&c.start) + of_vector(&c.entries) + of_vector(&c.alike))
                .sum::<usize>()
    }

    /// Number of listed pairs.
    pub fn pairs(&self) -> usize {
        let met: u32 = self.chunks.iter().flat_map(|c| &c.entries).map(|e| e.bits().count_ones()).sum();
        met as usize - if self.among { self.targets } else { 0 } // a target's meeting itself
    }
}

/// See [`Lists::around`]. An iterator of its own, all of it to be inlined where lanes are known.
pub(crate) struct Around<'a, R, T> {
    entries: std::slice::Iter<'a, Entry>,
    rows: &'a [T],
    lane: u32,
    struck: bool,
    zero: R,
}

impl<R: Number, T: Spread> Iterator for Around<'_, R, T> {
    type Item = T::Over<R>;
    #[inline(always)]
    fn next(&mut self) -> Option<T::Over<R>> {
        loop {
            let e = self.entries.next()?;
            let bits = e.bits() >> self.lane;
            if R::WIDTH == 1 && bits & 1 == 0 {
                continue;
            }
            let row = self.rows[e.index() as usize].spread(self.zero);
            return Some(if self.struck { T::only(row, bits) } else { row });
        }
    }
}

/// Everyone in `runs` that one of `count` targets may meet.
struct Meeting<'a> {
    points: &'a [Point],
    runs: &'a [Range<usize>],
    at: [Point; LANES],
    count: usize,
    found: &'a mut Vec<Entry>,
}

impl Task for Meeting<'_> {
    type Out = ();
    #[inline(always)]
    fn run<R: Number>(self, zero: R) {
        let Meeting { points, runs, at, count, found } = self;
        let there = (1 << count) - 1;
        for run in runs {
            for q in &points[run.clone()] {
                let mut bits = 0;
                for first in (0..LANES).step_by(R::WIDTH) {
                    let dx = zero.each(|k| at[first + k].x) - zero.of(q.x);
                    let dy = zero.each(|k| at[first + k].y) - zero.of(q.y);
                    let cut = zero.each(|k| at[first + k].reach) + zero.of(q.reach);
                    bits |= (dx * dx + dy * dy).less(cut * cut) << first;
                }
                if bits & there != 0 {
                    found.push(Entry::new(q.index, bits & there));
                }
            }
        }
    }
}

/// Where particles were when the lists were made, and how far each may go before they must be remade.
#[derive(Clone, Debug, Default)]
pub struct Skin {
    x: Vec<f64>,
    y: Vec<f64>,
    allowance: Vec<f64>,
}

impl Skin {
    /// Note positions and allowances [m].
    pub fn reset(&mut self, x: &[f64], y: &[f64], allowance: Vec<f64>) {
        self.x.clear();
        self.x.extend_from_slice(x);
        self.y.clear();
        self.y.extend_from_slice(y);
        self.allowance = allowance;
    }

    /// What it holds on to [bytes].
    pub(crate) fn bytes(&self) -> usize {
        [&self.x, &self.y, &self.allowance].map(of_vector).iter().sum()
    }

    /// True if nobody has moved farther than its allowance.
    pub fn holds(&self, x: &[f64], y: &[f64]) -> bool {
        self.x.len() == x.len()
            && sweep::every(x.len(), |k| {
                let (dx, dy) = (x[k] - self.x[k], y[k] - self.y[k]);
                dx * dx + dy * dy <= self.allowance[k] * self.allowance[k]
            })
    }
}
