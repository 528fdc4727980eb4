//! What a neighbour list stores: four bytes a neighbour.

use serde::{Deserialize, Serialize};

use crate::memory::of_vector;
use crate::simd::LANES;

/// A neighbour of a cluster: its index, and above it a bit for each target that may meet it.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
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

/// A list may hold on to this part more than it needs.
const SPARE: usize = 8;

/// Entries of the clusters of a chunk, with little to spare: they are much of the memory.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Entries {
    /// Where each cluster starts in `found`, and the end of the last.
    pub start: Vec<u32>,
    /// Neighbours of the clusters, in order.
    pub found: Vec<Entry>,
}

impl Entries {
    /// Take these entries, in the memory at hand where that suits.
    pub fn take(&mut self, start: &[u32], found: &[Entry]) {
        self.start.clear();
        self.start.extend_from_slice(start);
        self.found.clear();
        if self.found.capacity() < found.len() || self.found.capacity() > found.len() + found.len() / SPARE {
            self.found.shrink_to(found.len() + found.len() / (2 * SPARE));
            self.found.reserve_exact(found.len() + found.len() / (2 * SPARE));
        }
        self.found.extend_from_slice(found);
    }

    /// How many clusters.
    pub fn clusters(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// Entries of cluster `c`.
    #[inline(always)]
    pub fn of(&self, c: usize) -> &[Entry] {
        match self.start.get(c..).and_then(|s| s.first_chunk()) {
            Some(&[from, to]) => &self.found[from as usize..to as usize],
            None => &[],
        }
    }

    /// True of entries that name `points` only, whose clusters follow one another.
    pub fn are_of(&self, points: usize) -> bool {
        let end = self.start.last().map_or(0, |&end| end as usize);
        end == self.found.len()
            && self.start.windows(2).all(|ends| ends[0] <= ends[1])
            && self.found.iter().all(|e| (e.index() as usize) < points)
    }

    /// What they hold on to [bytes].
    pub fn bytes(&self) -> usize {
        of_vector(&self.start) + of_vector(&self.found)
    }
}
