//! Neighbour lists with a skin that suits each particle's speed.
//!
//! A list made at one moment holds every pair that can meet while each particle keeps its velocity, until some particle
//! has gone farther astray than the skin it was given: its share of the smoothing length and of its way. Neighbours move
//! almost alike, so that lists are little longer than what meets at one moment.
//!
//! Targets are listed in clusters of [`LANES`] that follow one another, so that a cluster is summed side by side: an
//! entry is a neighbour of any of them, with a bit for each target that may meet it.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::memory::of_vector;
use crate::neighbours::cells::{Cells, Point};
use crate::neighbours::entries::{Entries, Entry, MOST_POINTS};
use crate::parallel::{self, CHUNK};
use crate::simd::{self, LANES, SimdReal, Task};
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

/// What [`Lists::around`] gives: to be inlined as a whole, so that it is compiled for the processor found.
pub(crate) struct Around<'a, R, T> {
    entries: std::slice::Iter<'a, Entry>,
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
            let entry = self.entries.next()?;
            let bits = entry.bits() >> self.lane;
            if R::WIDTH > 1 || bits & 1 == 1 {
                let row = self.rows[entry.index() as usize].splat(self.zero);
                return Some(if self.masked { T::mask(row, bits) } else { row });
            }
        }
    }
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
    /// A bit for each cluster: one smoothing length, and no pair masked.
    alike: u32,
}

const _: () = assert!(CHUNK / LANES <= u32::BITS as usize);

/// Empty lists.
pub(crate) static NONE: Lists = Lists { chunks: Vec::new(), targets: 0, among: false, masked: false };

impl Lists {
    /// For each of `n` targets, everyone in `cells` within reach. `among`: target k is point k, and not its own neighbour.
    /// `alike`: do these targets, and all that they may meet, have one smoothing length?
    pub(crate) fn build(
        &mut self,
        n: usize,
        cells: &Cells,
        target: impl Fn(usize) -> Point + Sync,
        among: bool,
        alike: impl Fn(Range<usize>, &[Entry]) -> bool + Sync,
    ) {
        assert!(cells.points().len() <= MOST_POINTS, "no more than {MOST_POINTS} particles");
        (self.targets, self.among, self.masked) = (n, among, false);
        self.chunks.resize_with(n.div_ceil(CHUNK), ChunkList::default);
        parallel::for_each_chunk_with(&mut self.chunks, n, &|found: &mut Found, targets, list| {
            simd::run(true, ListChunk { cells, targets, target: &target, alike: &alike, found, list });
        });
    }

    /// Of the list of each target k, keep those j that `keep(k, j)` wants.
    pub(crate) fn retain(&mut self, keep: impl Fn(usize, u32) -> bool + Sync) {
        let (n, among) = (self.chunks.len() * CHUNK, self.among);
        self.masked = true;
        parallel::for_each_chunk_with(&mut self.chunks, n, &|found: &mut Found, targets, list| {
            let (start, kept) = (&mut found.start, &mut found.entries);
            start.clear();
            start.push(0);
            kept.clear();
            for c in 0..list.entries.clusters() {
                let first = targets.start + c * LANES;
                for (j, bits) in list.entries.of(c).iter().map(|e| (e.index(), e.bits())) {
                    let wanted = |k: usize| (among && first + k == j as usize) || keep(first + k, j);
                    let left = (0..LANES).filter(|&k| bits >> k & 1 == 1 && wanted(k)).fold(0, |left, k| left | 1 << k);
                    list.alike &= !(u32::from(left != bits) << c);
                    if left != 0 {
                        kept.push(Entry::new(j, left));
                    }
                }
                start.push(kept.len() as u32);
            }
            list.entries.take(start, kept);
        });
    }

    /// Neighbours of the targets beside target `k`, with a bit for each target; targets that are points are among them.
    #[inline(always)]
    pub(crate) fn cluster(&self, k: usize) -> &[Entry] {
        self.chunks.get(k / CHUNK).map_or(&[], |list| list.entries.of(k % CHUNK / LANES))
    }

    /// True if any target of the chunk that begins with `first` has a neighbour.
    pub(crate) fn any_of_chunk(&self, first: usize) -> bool {
        self.chunks.get(first / CHUNK).is_some_and(|list| !list.entries.found.is_empty())
    }

    /// Neighbours of target `k`, itself not among them, in a fixed order.
    #[inline(always)]
    pub fn of(&self, k: usize) -> impl Iterator<Item = u32> + Clone {
        let own = if self.among { k as u32 } else { u32::MAX };
        let bit = 1 << (k % LANES);
        self.cluster(k).iter().filter(move |e| e.bits() & bit != 0 && e.index() != own).map(|e| e.index())
    }

    /// The neighbours of the targets that an `R` holds, beginning with `first`. Targets that are points too meet themselves.
    #[inline(always)]
    pub(crate) fn around<'a, R: SimdReal, T: Splat>(
        &'a self,
        first: usize,
        zero: R,
        rows: &'a [T],
    ) -> Around<'a, R, T> {
        Around { entries: self.cluster(first).iter(), rows, lane: (first % LANES) as u32, masked: self.masked, zero }
    }

    /// The same of targets that are [`Lists::alike`]: side by side, and no pair is masked.
    #[inline(always)]
    pub(crate) fn around_alike<'a, R: SimdReal, T: Splat>(
        &'a self,
        first: usize,
        zero: R,
        rows: &'a [T],
    ) -> Around<'a, R, T> {
        Around { entries: self.cluster(first).iter(), rows, lane: 0, masked: false, zero }
    }

    /// `any[k]` ← whether target k meets a point that is `marked`. Targets that are points too meet themselves.
    pub(crate) fn meet_any(&self, marked: &[bool], any: &mut [bool]) {
        parallel::update_pieces(any, CHUNK, |c, any| {
            for (cluster, any) in any.chunks_mut(LANES).enumerate() {
                let bits = |e: &Entry| if marked[e.index() as usize] { e.bits() } else { 0 };
                let met = self.chunks[c].entries.of(cluster).iter().fold(0, |met, e| met | bits(e));
                any.iter_mut().enumerate().for_each(|(k, any)| *any = met >> k & 1 == 1);
            }
        });
    }

    /// How many targets.
    pub(crate) fn targets(&self) -> usize {
        self.targets
    }

    /// An error unless these are lists of this number of targets, among this number of points.
    pub(crate) fn check(&self, targets: usize, points: usize) -> Result<(), StateError> {
        expect_count("targets of lists", self.targets, targets)?;
        expect_count("chunks of lists", self.chunks.len(), targets.div_ceil(CHUNK))?;
        let sound = self.chunks.iter().filter(|chunk| chunk.entries.are_of(points)).count();
        expect_count("chunks of sound lists", sound, self.chunks.len())
    }

    /// True if the targets beside `k` and all that they may meet have one smoothing length, and no pair is masked.
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
        let entries = |chunk: &ChunkList| -> u32 { chunk.entries.found.iter().map(|e| e.bits().count_ones()).sum() };
        let met: u32 = self.chunks.iter().map(entries).sum();
        met as usize - if self.among { self.targets } else { 0 } // a target's meeting itself
    }
}

/// What is found for a chunk, before its size is known.
#[derive(Default)]
struct Found {
    runs: Vec<Range<usize>>,
    start: Vec<u32>,
    entries: Vec<Entry>,
}

/// Lists of the targets of a chunk.
struct ListChunk<'a, T, A> {
    cells: &'a Cells,
    targets: Range<usize>,
    target: &'a T,
    alike: &'a A,
    found: &'a mut Found,
    list: &'a mut ChunkList,
}

impl<T: Fn(usize) -> Point, A: Fn(Range<usize>, &[Entry]) -> bool> Task for ListChunk<'_, T, A> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let ListChunk { cells, targets, target, alike, found: Found { runs, start, entries }, list } = self;
        start.clear();
        start.push(0);
        entries.clear();
        list.alike = 0;
        for (c, first) in targets.clone().step_by(LANES).enumerate() {
            let last = (first + LANES).min(targets.end);
            let mut at = [target(first); LANES];
            for k in first + 1..last {
                at[k - first] = target(k);
            }
            runs.clear();
            cells.for_each_run(&at[..last - first], |run| runs.push(run));
            let from = entries.len();
            let candidates = Candidates { points: cells.points(), runs, at, count: last - first };
            match candidates.at.iter().all(|p| p.travel == [0.0; 2]) && !cells.travel() {
                true => candidates.test::<R, false>(zero, entries),
                false => candidates.test::<R, true>(zero, entries),
            }
            start.push(entries.len() as u32);
            list.alike |= u32::from(alike(first..last, &entries[from..])) << c;
        }
        list.entries.take(start, entries);
    }
}

/// Everyone in `runs` that one of `count` targets may meet.
struct Candidates<'a> {
    points: &'a [Point],
    runs: &'a [Range<usize>],
    at: [Point; LANES],
    count: usize,
}

impl Candidates<'_> {
    /// Append those that they may meet to `found`. Points that do not `TRAVEL` stay where they are.
    #[inline(always)]
    fn test<R: SimdReal, const TRAVEL: bool>(&self, zero: R, found: &mut Vec<Entry>) {
        let Candidates { points, runs, at, count } = self;
        let there = (1 << count) - 1;
        let most: usize = runs.iter().map(Range::len).sum();
        let mut kept = found.len();
        found.resize(kept + most, Entry::new(0, 0));
        for run in *runs {
            for q in &points[run.clone()] {
                let mut bits = 0;
                for first in (0..LANES).step_by(R::WIDTH) {
                    let dx = zero.each(|k| at[first + k].x) - zero.of(q.x);
                    let dy = zero.each(|k| at[first + k].y) - zero.of(q.y);
                    let mut cut = zero.each(|k| at[first + k].reach) + zero.of(q.reach);
                    if TRAVEL {
                        let du = zero.each(|k| at[first + k].travel[0]) - zero.of(q.travel[0]);
                        let dv = zero.each(|k| at[first + k].travel[1]) - zero.of(q.travel[1]);
                        cut = cut + du.max(zero - du) + dv.max(zero - dv);
                    }
                    bits |= dx.mul_add(dx, dy * dy).less(cut * cut) << first;
                }
                bits &= there;
                found[kept] = Entry::new(q.index, bits);
                kept += usize::from(bits != 0);
            }
        }
        found.truncate(kept);
    }
}
