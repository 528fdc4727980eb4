//! Who may meet whom while lists last.

use super::entry_index::EntryIndex;
use crate::memory::of_vector;
use crate::neighbours::lists::Lists;
use crate::simd::LANES;

/// Targets of a block.
pub(super) const BLOCK: usize = 8;

/// Everyone whom the targets of each block of a chunk may meet.
#[derive(Clone, Debug, Default)]
pub(super) struct Candidates {
    pub start: Vec<u32>,
    /// Index, and a bit for each target that may meet it.
    pub found: Vec<(u32, u8)>,
    /// True for a block in which all that meet have one smoothing length.
    pub alike: Vec<bool>,
}

impl Candidates {
    /// Of the `count` targets from `first` on, of smoothing length `h` [m].
    pub fn of(lists: &Lists, first: usize, count: usize, h: impl Fn(usize) -> f64) -> Candidates {
        let (mut start, mut found, mut alike) = (vec![0], Vec::new(), Vec::new());
        let mut seen = EntryIndex::default();
        for block in (first..first + count).step_by(BLOCK) {
            seen.clear();
            let from = found.len();
            for cluster in (block..(block + BLOCK).min(first + count)).step_by(LANES) {
                for (j, bits) in lists.cluster(cluster).iter().map(|e| (e.index(), e.bits())) {
                    let e = from + seen.entry(j) as usize;
                    if e == found.len() {
                        found.push((j, 0));
                    }
                    found[e].1 |= (bits << (cluster - block)) as u8;
                }
            }
            for (j, meets) in &mut found[from..] {
                let own = (*j as usize).wrapping_sub(block);
                *meets &= !(if own < BLOCK { 1_u8 << own } else { 0 }); // no target is its own neighbour
            }
            start.push(found.len() as u32);
            let mut clusters = (block..(block + BLOCK).min(first + count)).step_by(LANES);
            alike.push(h(block) == h((block + LANES).min(first + count - 1)) && clusters.all(|k| lists.alike(k)));
        }
        Candidates { start, found, alike }
    }

    /// What they hold on to [bytes].
    pub fn bytes(&self) -> usize {
        of_vector(&self.start) + of_vector(&self.found) + of_vector(&self.alike)
    }
}
