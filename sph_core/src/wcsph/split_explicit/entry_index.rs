//! Entries of a block by the index of the neighbour.

/// Which entry of a block each index has (open addressing); emptied for each block.
pub(super) struct EntryIndex {
    slots: Vec<[u32; 2]>,
    count: u32,
}

/// A slot without an index.
const FREE: [u32; 2] = [u32::MAX; 2];

impl Default for EntryIndex {
    fn default() -> EntryIndex {
        EntryIndex { slots: vec![FREE; 256], count: 0 }
    }
}

impl EntryIndex {
    /// Forget all.
    pub fn clear(&mut self) {
        self.slots.fill(FREE);
        self.count = 0;
    }

    /// Entry of index `j`, in the order in which they came.
    #[inline(always)]
    pub fn entry(&mut self, j: u32) -> u32 {
        let mask = self.slots.len() - 1;
        let mut at = (j.wrapping_mul(0x9E37_79B1) >> 16) as usize & mask;
        while self.slots[at] != FREE {
            if self.slots[at][0] == j {
                return self.slots[at][1];
            }
            at = (at + 1) & mask;
        }
        self.slots[at] = [j, self.count];
        self.count += 1;
        if 2 * self.count as usize > self.slots.len() {
            self.grow();
        }
        self.count - 1
    }

    fn grow(&mut self) {
        let before = std::mem::take(&mut self.slots);
        self.slots = vec![FREE; 2 * before.len()];
        let mut indices: Vec<[u32; 2]> = before.into_iter().filter(|&slot| slot != FREE).collect();
        indices.sort_unstable_by_key(|slot| slot[1]);
        self.count = 0;
        for [j, _] in indices {
            self.entry(j);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_numbered_as_they_come() {
        let mut index = EntryIndex::default();
        for round in 0..2 {
            for repeat in 0..3 {
                for k in 0..500 {
                    assert_eq!(index.entry(7919 * k + round), k, "round {round}, repeat {repeat}");
                }
            }
            index.clear();
        }
    }
}
