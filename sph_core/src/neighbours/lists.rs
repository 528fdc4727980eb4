//! Neighbour lists with a skin that suits each particle's speed.
//!
//! A list made at one moment holds every pair that can meet until some particle has moved farther than
//! the skin it was given: its share of the smoothing length plus its speed times the time the list
//! should live. Jets move several times as fast as the spray root, so one skin for all would be wasted
//! on still water (findings of the prototypes, item 10).
//!
//! Targets are listed in clusters of [`LANES`] that follow one another, so that a cluster is summed side by side: an
//! entry is a neighbour of any of them, with a bit for each target that may meet it.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::interactions::simd::{self, LANES, SimdReal, Task};
use crate::memory::of_vector;
use crate::neighbours::cells::{Cells, Point};
use crate::neighbours::entries::{Entries, Entry, MOST_POINTS, Met, within_and_bits};
use crate::parallel::{self, CHUNK};
use crate::state_bytes::{StateError, expect_count};

/// What a sum over pairs reads of a neighbour, spread over the lanes of its targets.
pub(crate) trait Splat {
    /// The same for lanes.
    type Over<R: SimdReal>;
    /// The same for every lane.
    fn splat<R: SimdReal>(&self, zero: R) -> Self::Over<R>;
    /// As it is where a target's bit is set; without volume, so that nothing is felt of it, elsewhere.
    fn mask<R: SimdReal>(over: Self::Over<R>, bits: u32) -> Self::Over<R>;
}

/// Neighbours of many targets; stored by chunk so that chunks are filled independently.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Lists {
    chunks: Vec<ChunkList>,
    /// How many.
    targets: usize,
    /// Targets are points too, and stand in their own lists.
    among: bool,
    /// Some pairs within reach do not see each other (WA8).
    masked: bool,
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct ChunkList {
    entries: Entries,
    /// A bit for each cluster: one smoothing length.
    alike: u32,
}

const _: () = assert!(CHUNK / LANES <= u32::BITS as usize);

/// Empty lists.
pub(crate) static NONE: Lists = Lists { chunks: Vec::new(), targets: 0, among: false, masked: false };

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
        (self.targets, self.among, self.masked) = (n, among, false);
        self.chunks.resize(n.div_ceil(CHUNK), ChunkList::default());
        parallel::for_each_chunk(&mut self.chunks, n, |targets, list| {
            let (mut start, mut alike) = (vec![0], 0);
            let (mut runs, mut found) = (Vec::new(), Vec::new());
            for (c, first) in targets.clone().step_by(LANES).enumerate() {
                let last = (first + LANES).min(targets.end);
                let mut at = [target(first); LANES];
                for k in first + 1..last {
                    at[k - first] = target(k);
                }
                runs.clear();
                let from = found.len();
                cells.for_each_run(&at[..last - first], |run| runs.push(run));
                let count = last - first;
                simd::run(true, MonolithicSolve { points: cells.points(), runs: &runs, at, count, found: &mut found });
                start.push(found.len() as u32);
                let h = size.0(first);
                let same = (first..last).all(|k| size.0(k) == h)
                    && found[from..].iter().all(|e: &Entry| size.1(e.index()) == h);
                alike |= u32::from(same) << c;
            }
            *list = ChunkList { entries: Entries::new(&found, &start), alike };
        });
    }

    /// Of the list of each target k, keep those j that `keep(k, j)` wants.
    pub(crate) fn retain(&mut self, keep: impl Fn(usize, u32) -> bool + Sync) {
        let (n, among) = (self.chunks.len() * CHUNK, self.among);
        self.masked = true;
        parallel::for_each_chunk(&mut self.chunks, n, |targets, list| {
            let (mut start, mut kept) = (vec![0], Vec::new());
            for c in 0..list.entries.clusters() {
                let first = targets.start + c * LANES;
                for (j, bits) in list.entries.of(c) {
                    let wanted = |k: usize| (among && first + k == j as usize) || keep(first + k, j);
                    let left = (0..LANES).filter(|&k| bits >> k & 1 == 1 && wanted(k)).fold(0, |left, k| left | 1 << k);
                    if left != 0 {
                        kept.push(Entry::new(j, left));
                    }
                }
                start.push(kept.len() as u32);
            }
            list.entries = Entries::new(&kept, &start);
        });
    }

    /// Neighbours of the targets beside target `k`, with a bit for each target; targets that are points are among them.
    #[inline(always)]
    pub(crate) fn cluster(&self, k: usize) -> Met<'_> {
        self.chunks.get(k / CHUNK).map_or_else(Met::default, |list| list.entries.of(k % CHUNK / LANES))
    }

    /// Neighbours of target `k`, itself not among them, in a fixed order.
    #[inline(always)]
    pub fn of(&self, k: usize) -> impl Iterator<Item = u32> + Clone {
        let own = if self.among { k as u32 } else { u32::MAX };
        let bit = 1 << (k % LANES);
        self.cluster(k).filter(move |&(j, bits)| bits & bit != 0 && j != own).map(|(j, _)| j)
    }

    /// What the targets from `first` on, as many as an `R` is simd, read of all that any of them may meet. Targets that
    /// are points too meet themselves.
    #[inline(always)]
    pub(crate) fn around<'a, R: SimdReal, T: Splat>(
        &'a self,
        first: usize,
        zero: R,
        rows: &'a [T],
    ) -> Around<'a, R, T> {
        let (met, lane) = (self.cluster(first), (first % LANES) as u32);
        Around { met, here: [].iter(), rows, near: rows, lane, masked: self.masked, zero }
    }

    /// How many targets.
    pub(crate) fn targets(&self) -> usize {
        self.targets
    }

    /// An error unless these are lists of so many targets, among so many points.
    pub(crate) fn check(&self, targets: usize, points: usize) -> Result<(), StateError> {
        expect_count("targets of lists", self.targets, targets)?;
        expect_count("chunks of lists", self.chunks.len(), targets.div_ceil(CHUNK))?;
        let sound = self.chunks.iter().filter(|chunk| chunk.entries.are_of(points)).count();
        expect_count("chunks of sound lists", sound, self.chunks.len())
    }

    /// True if the targets beside `k` and all that they may meet have one smoothing length.
    #[inline(always)]
    pub(crate) fn alike(&self, k: usize) -> bool {
        self.chunks[k / CHUNK].alike >> (k % CHUNK / LANES) & 1 == 1
    }

    /// What the lists hold on to [bytes].
    pub(crate) fn bytes(&self) -> usize {
        of_vector(&self.chunks) + self.chunks.iter().map(|c| c.entries.bytes()).sum::<usize>()
    }

    /// Number of listed pairs.
    pub fn pairs(&self) -> usize {
        let entries = |chunk: &ChunkList| -> u32 {
            (0..chunk.entries.clusters()).flat_map(|c| chunk.entries.of(c)).map(|(_, bits)| bits.count_ones()).sum()
        };
        let met: u32 = self.chunks.iter().map(entries).sum();
        met as usize - if self.among { self.targets } else { 0 } // a target's meeting itself
    }
}

/// See [`Lists::around`]. An iterator of its own, all of it to be inlined where lanes are known.
pub(crate) struct Around<'a, R, T> {
    met: Met<'a>,
    /// Entries of the present stretch, and the rows from its begin on.
    here: std::slice::Iter<'a, u16>,
    near: &'a [T],
    rows: &'a [T],
    lane: u32,
    masked: bool,
    zero: R,
}

impl<R: SimdReal, T: Splat> Iterator for Around<'_, R, T> {
    type Item = T::Over<R>;
    #[inline(always)]
    fn next(&mut self) -> Option<T::Over<R>> {
        loop {
            let Some(&e) = self.here.next() else {
                let (begin, here) = self.met.stretch()?;
                (self.near, self.here) = (&self.rows[begin as usize..], here.iter());
                continue;
            };
            let (within, bits) = within_and_bits(e);
            let bits = bits >> self.lane;
            if R::WIDTH == 1 && bits & 1 == 0 {
                continue;
            }
            let row = self.near[within].splat(self.zero);
            return Some(if self.masked { T::mask(row, bits) } else { row });
        }
    }
}

/// Everyone in `runs` that one of `count` targets may meet.
struct MonolithicSolve<'a> {
    points: &'a [Point],
    runs: &'a [Range<usize>],
    at: [Point; LANES],
    count: usize,
    found: &'a mut Vec<Entry>,
}

impl Task for MonolithicSolve<'_> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let MonolithicSolve { points, runs, at, count, found } = self;
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
