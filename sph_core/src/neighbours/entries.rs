//! What a neighbour list stores: two bytes a neighbour.
//!
//! The neighbours of a cluster lie in a few runs of indices, since particles are sorted by cell. Where the next ones are far
//! from those before, a cluster begins a new stretch: it keeps where that begins, and of each neighbour the way from
//! there, with a bit for each target that may meet it.

use serde::{Deserialize, Serialize};

use crate::interactions::simd::LANES;
use crate::memory::of_vector;

/// A neighbour of a cluster: its index, and above it a bit for each target.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry(u32);

/// Bits of an entry that are the index.
const INDEX_BITS: u32 = u32::BITS - LANES as u32;

/// Most points that lists can name.
pub const MOST_POINTS: usize = 1 << INDEX_BITS;

impl Entry {
    #[inline(always)]
    pub fn new(index: u32, bits: u32) -> Entry {
        Entry(index | bits << INDEX_BITS)
    }
    #[inline(always)]
    pub fn index(self) -> u32 {
        self.0 & (MOST_POINTS as u32 - 1)
    }
    #[inline(always)]
    pub fn bits(self) -> u32 {
        self.0 >> INDEX_BITS
    }
}

/// Bits of an index within its stretch: what two bytes have left.
const WITHIN_BITS: u32 = u16::BITS - LANES as u32;
/// Stretches begin at multiples of so many indices, as bits: they hold a few before the first one met.
const ALIGNMENT_BITS: u32 = 10;
/// Bits of a stretch that say where it begins; above them is how many entries it has.
const BEGIN_BITS: u32 = INDEX_BITS - ALIGNMENT_BITS;
/// Entries that a stretch may have.
const MOST_OF_STRETCH: u32 = (1 << (u32::BITS - BEGIN_BITS)) - 1;

/// Neighbours that lie near each other: where their indices begin, and how many there are.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Stretch(u32);

impl Stretch {
    fn at(index: u32) -> Stretch {
        Stretch(index >> ALIGNMENT_BITS)
    }
    #[inline(always)]
    fn begin(self) -> u32 {
        (self.0 & ((1 << BEGIN_BITS) - 1)) << ALIGNMENT_BITS
    }
    #[inline(always)]
    fn count(self) -> u32 {
        self.0 >> BEGIN_BITS
    }
    fn takes(self, index: u32) -> bool {
        index.wrapping_sub(self.begin()) < 1 << WITHIN_BITS && self.count() < MOST_OF_STRETCH
    }
    fn and_one_more(self) -> Stretch {
        Stretch(self.0 + (1 << BEGIN_BITS))
    }
}

/// Entries of the clusters of a chunk, with nothing to spare: they are most of the memory.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Entries {
    /// Where each cluster starts in `within` and in `stretches`, and their lengths.
    start: Vec<[u32; 2]>,
    stretches: Vec<Stretch>,
    /// The way from a stretch's begin, and above it a bit for each target.
    within: Vec<u16>,
}

impl Entries {
    /// Those `found`, cluster by cluster as `start` says.
    pub fn new(found: &[Entry], start: &[u32]) -> Entries {
        if found.is_empty() {
            return Entries::default();
        }
        let mut stretches: Vec<Stretch> = Vec::new();
        let (mut within, mut starts) = (Vec::with_capacity(found.len()), Vec::with_capacity(start.len()));
        starts.push([0; 2]);
        for cluster in start.windows(2) {
            let mut now: Option<Stretch> = None;
            for e in &found[cluster[0] as usize..cluster[1] as usize] {
                let stretch = match now.filter(|stretch| stretch.takes(e.index())) {
                    Some(stretch) => stretch,
                    None => {
                        stretches.extend(now);
                        Stretch::at(e.index())
                    }
                };
                within.push(((e.index() - stretch.begin()) | (e.bits() << WITHIN_BITS)) as u16);
                now = Some(stretch.and_one_more());
            }
            stretches.extend(now);
            starts.push([cluster[1], stretches.len() as u32]);
        }
        stretches.shrink_to_fit();
        Entries { start: starts, stretches, within }
    }

    /// How many clusters; none where there are no pairs.
    pub fn clusters(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// Entries of cluster `c`.
    #[inline(always)]
    pub fn of(&self, c: usize) -> Met<'_> {
        let Some(&[[from, first], [to, last]]) = self.start.get(c..).and_then(|s| s.first_chunk()) else {
            return Met::default();
        };
        let stretches = self.stretches[first as usize..last as usize].iter();
        Met { begin: 0, here: [].iter(), later: &self.within[from as usize..to as usize], stretches }
    }

    /// True of entries that name `points` only, whose clusters and stretches have as many as they say.
    pub fn are_of(&self, points: usize) -> bool {
        let cluster = |ends: &[[u32; 2]]| {
            let ([from, first], [to, last]) = (ends[0], ends[1]);
            let stretches = self.stretches.get(first as usize..last as usize);
            let known = stretches.map(|stretches| stretches.iter().map(|s| u64::from(s.count())).sum::<u64>());
            from <= to && known == Some(u64::from(to - from))
        };
        let end = self.start.last().map_or(0, |[end, _]| *end as usize);
        end == self.within.len()
            && self.start.windows(2).all(cluster)
            && (0..self.clusters()).flat_map(|c| self.of(c)).all(|(index, _)| (index as usize) < points)
    }

    /// What they hold on to [bytes].
    pub fn bytes(&self) -> usize {
        of_vector(&self.start) + of_vector(&self.stretches) + of_vector(&self.within)
    }
}

/// The entries of a cluster, in order.
#[derive(Clone, Default)]
pub(crate) struct Met<'a> {
    begin: u32,
    here: std::slice::Iter<'a, u16>,
    later: &'a [u16],
    stretches: std::slice::Iter<'a, Stretch>,
}

/// The way of an entry from its stretch's begin, and a bit for each target.
#[inline(always)]
pub(crate) fn within_and_bits(e: u16) -> (usize, u32) {
    (usize::from(e) & ((1 << WITHIN_BITS) - 1), u32::from(e) >> WITHIN_BITS)
}

impl<'a> Met<'a> {
    /// How many, before the first is taken.
    #[inline(always)]
    pub fn len(&self) -> usize {
        self.later.len()
    }

    /// The next stretch: where it begins, and its entries. For who takes entries by stretches, none by [`Met::next`].
    #[inline(always)]
    pub fn stretch(&mut self) -> Option<(u32, &'a [u16])> {
        let stretch = self.stretches.next()?;
        let (here, later) = self.later.split_at(stretch.count() as usize);
        self.later = later;
        Some((stretch.begin(), here))
    }
}

impl Iterator for Met<'_> {
    /// Index, and a bit for each target.
    type Item = (u32, u32);
    #[inline(always)]
    fn next(&mut self) -> Option<(u32, u32)> {
        loop {
            if let Some(&e) = self.here.next() {
                let (within, bits) = within_and_bits(e);
                return Some((self.begin + within as u32, bits));
            }
            let (begin, here) = self.stretch()?;
            (self.begin, self.here) = (begin, here.iter());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(indices: &[u32]) -> Vec<(u32, u32)> {
        let found: Vec<Entry> = indices.iter().map(|&j| Entry::new(j, j % 15 + 1)).collect();
        let half = (found.len() / 2) as u32;
        let entries = Entries::new(&found, &[0, half, half, found.len() as u32]);
        assert_eq!((entries.clusters(), entries.of(1).count()), (if found.is_empty() { 0 } else { 3 }, 0));
        (0..3).flat_map(|c| entries.of(c)).collect()
    }

    #[test]
    fn entries_come_back_in_their_order() {
        let runs: Vec<u32> = (0..12).flat_map(|run| (0..30).map(move |k| 1_000_003 * run + 7 * k)).collect();
        let scattered: Vec<u32> = (0..200).map(|k| 999_331 * k % MOST_POINTS as u32).collect();
        let many: Vec<u32> = (0..40_000).map(|k| k / 100).collect();
        let backwards: Vec<u32> = (0..9000).rev().collect();
        for indices in [runs, scattered, many, backwards, vec![], vec![MOST_POINTS as u32 - 1]] {
            let expected: Vec<(u32, u32)> = indices.iter().map(|&j| (j, j % 15 + 1)).collect();
            assert_eq!(kept(&indices), expected);
        }
    }
}
