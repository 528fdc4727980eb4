//! Rows that stand together for one unknown of the next coarser level (THEORY LS6).

use serde::{Deserialize, Serialize};

use crate::projection::linear_solver::matrix::MatrixRows;

/// Not part of any aggregate.
pub(crate) const NO_ROW: u32 = u32::MAX;

/// Who belongs to whom.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Aggregates {
    /// The aggregate of each row, or [`NO_ROW`].
    pub of: Vec<u32>,
    /// Where each aggregate's members start; one more entry than aggregates.
    pub starts: Vec<u32>,
    /// Rows, sorted by aggregate.
    pub members: Vec<u32>,
}

impl Aggregates {
    /// Number of aggregates.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Rows of aggregate `c`.
    #[inline(always)]
    pub fn of_aggregate(&self, c: usize) -> &[u32] {
        &self.members[self.starts[c] as usize..self.starts[c + 1] as usize]
    }

    /// LS6: a row and all rows strongly coupled to it, where none of them is taken; a row that is left joins the one
    /// to whom it is coupled most. Strong is at least `share` of the row's largest coupling. Rows without couplings
    /// stay out.
    pub fn find(&mut self, a: &impl MatrixRows, share: f64) {
        let (n, of) = (a.rows(), &mut self.of);
        of.clear();
        of.resize(n, NO_ROW);
        let mut count = 0;
        for i in 0..n {
            if of[i] != NO_ROW {
                continue;
            }
            let strong = share * a.row(i).fold(0.0, |least: f64, (_, v)| if v < least { v } else { least });
            if strong == 0.0 || a.row(i).any(|(j, v)| v <= strong && of[j] != NO_ROW) {
                continue;
            }
            of[i] = count;
            for (j, _) in a.row(i).filter(|&(_, v)| v <= strong) {
                of[j] = count;
            }
            count += 1;
        }
        self.join(a, count);
        self.list(count as usize);
    }

    /// A row that is left joins the aggregate whose member it is coupled to most.
    fn join(&mut self, a: &impl MatrixRows, count: u32) {
        /// Marks a row that has joined in this pass, so that chains do not form.
        const JOINED: u32 = 1 << 31;
        for i in 0..a.rows() {
            if self.of[i] != NO_ROW {
                continue;
            }
            let (mut most, mut to) = (0.0, NO_ROW);
            for (j, v) in a.row(i) {
                if v < most && self.of[j] < count {
                    (most, to) = (v, self.of[j]);
                }
            }
            if to != NO_ROW {
                self.of[i] = to | JOINED;
            }
        }
        for of in &mut self.of {
            *of = if *of == NO_ROW { NO_ROW } else { *of & !JOINED };
        }
    }

    /// Rows have other places: row k is the one that was row `from[k]`.
    pub fn rename(&mut self, from: impl Iterator<Item = u32>) {
        let renamed: Vec<u32> = from.map(|k| self.of[k as usize]).collect();
        self.of = renamed;
        self.list(self.len());
    }

    /// Sort the rows by aggregate.
    fn list(&mut self, count: usize) {
        let Aggregates { of, starts, members } = self;
        starts.clear();
        starts.resize(count + 1, 0);
        for &c in of.iter().filter(|&&c| c != NO_ROW) {
            starts[c as usize + 1] += 1;
        }
        for c in 0..count {
            starts[c + 1] += starts[c];
        }
        members.clear();
        members.resize(starts[count] as usize, 0);
        for (i, &c) in of.iter().enumerate().rev() {
            if c != NO_ROW {
                starts[c as usize + 1] -= 1;
                members[starts[c as usize + 1] as usize] = i as u32;
            }
        }
        // every start has moved to its own aggregate's end less its members: shift back
        starts.remove(0);
        starts.push(members.len() as u32);
    }
}
