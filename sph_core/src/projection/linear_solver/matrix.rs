//! The matrix of the pressure equation (THEORY LS2).

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::neighbours::Neighbours;
use crate::parallel::{self, CHUNK};

use crate::projection::operators::{ChunkPairs, Operators};

/// Row sums below this share of the diagonal are zero but for rounding [-].
const NO_EXCESS: f64 = 1e-10;

/// LS2: A, symmetric and positive (semi-)definite, a row for each particle; off-diagonals are zero or negative, row
/// sums zero or positive. Compressed rows without the diagonal. The unit is the caller's: solution times matrix is
/// right side.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Matrix {
    /// Where each row starts in `columns` and `values`; one more entry than rows.
    pub starts: Vec<usize>,
    /// Columns of the off-diagonals.
    pub columns: Vec<u32>,
    /// Off-diagonals a_ij ≤ 0.
    pub values: Vec<f64>,
    /// Diagonals a_ii ≥ −Σ_j a_ij; 0 for a particle without neighbours.
    pub diagonal: Vec<f64>,
}

/// LS2: an addition c g gᵀ, c > 0, with a g that is zero but for a few rows: the added mass of a free body.
#[derive(Clone, Debug, Default)]
pub struct RankOne {
    /// c.
    pub weight: f64,
    /// Rows where g is not zero, each once, and its value there.
    pub entries: Vec<(u32, f64)>,
}

impl Matrix {
    /// PR6: the rows of the assembled operators, each with its excess on the diagonal.
    pub(crate) fn assemble(&mut self, operators: &Operators, excess: &[f64], search: &Neighbours) {
        let n = excess.len();
        self.starts.resize(n + 1, 0);
        self.diagonal.resize(n, 0.0);
        let ends = operators.chunks().iter().scan(0, |end, found| {
            *end += found.pairs() - found.own_images;
            Some(*end)
        });
        let ends: Vec<usize> = ends.collect();
        let pairs = ends.last().copied().unwrap_or(0);
        self.starts[n] = pairs;
        self.columns.resize(pairs, 0);
        self.values.resize(pairs, 0.0);
        let (mut columns, mut values) = (&mut self.columns[..], &mut self.values[..]);
        let mut pieces = Vec::with_capacity(ends.len());
        let mut first = 0;
        for ((starts, diagonal), &end) in
            self.starts[..n].chunks_mut(CHUNK).zip(self.diagonal.chunks_mut(CHUNK)).zip(&ends)
        {
            let (own_columns, rest) = columns.split_at_mut(end - first);
            let (own_values, rest_of_values) = values.split_at_mut(end - first);
            (columns, values) = (rest, rest_of_values);
            pieces.push(Piece { first, starts, columns: own_columns, values: own_values, diagonal });
            first = end;
        }
        let found = operators.chunks();
        parallel::for_each_chunk(&mut pieces, n, |rows, piece| {
            piece.fill(&found[rows.start / CHUNK], rows, excess, search)
        });
    }

    /// No rows; the memory stays.
    pub fn clear(&mut self) {
        self.starts.clear();
        self.starts.push(0);
        self.columns.clear();
        self.values.clear();
        self.diagonal.clear();
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.diagonal.len()
    }

    /// Off-diagonals of row `i`: column and value.
    #[inline(always)]
    pub fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let run = self.starts[i]..self.starts[i + 1];
        self.columns[run.clone()].iter().map(|&j| j as usize).zip(self.values[run].iter().copied())
    }

    /// (A x)_i.
    #[inline(always)]
    pub fn times(&self, i: usize, x: &[f64]) -> f64 {
        let run = self.starts[i]..self.starts[i + 1];
        let (columns, values) = (&self.columns[run.clone()], &self.values[run]);
        let (four, rest) = columns.as_chunks::<4>();
        let (value_four, value_rest) = values.as_chunks::<4>();
        let mut sum = [self.diagonal[i] * x[i], 0.0, 0.0, 0.0];
        for (j, v) in four.iter().zip(value_four) {
            for lane in 0..4 {
                sum[lane] += v[lane] * x[j[lane] as usize];
            }
        }
        for (lane, (j, v)) in rest.iter().zip(value_rest).enumerate() {
            sum[lane] += v * x[*j as usize];
        }
        (sum[0] + sum[1]) + (sum[2] + sum[3])
    }

    /// Whether row `i` tells a level of pressure: its sum is more than rounding.
    pub fn has_excess(&self, i: usize) -> bool {
        let off: f64 = self.values[self.starts[i]..self.starts[i + 1]].iter().sum();
        self.diagonal[i] + off > NO_EXCESS * self.diagonal[i]
    }

    /// y ← A x in the rows that `active(i)` names, 0 in the others; returns x·y.
    pub(crate) fn multiply(
        &self,
        x: &[f64],
        active: impl Fn(usize) -> bool + Sync,
        y: &mut [f64],
        sums: &mut [f64],
    ) -> f64 {
        parallel::update_chunks(sums, y, |rows, chunk| {
            let mut sum = 0.0;
            for (i, slot) in rows.zip(chunk) {
                *slot = if active(i) { self.times(i, x) } else { 0.0 };
                sum += x[i] * *slot;
            }
            sum
        });
        sums.iter().sum()
    }
}

/// The rows of a chunk, to be written.
struct Piece<'a> {
    first: usize,
    starts: &'a mut [usize],
    columns: &'a mut [u32],
    values: &'a mut [f64],
    diagonal: &'a mut [f64],
}

impl Piece<'_> {
    /// The rows as found; an image stands for its source, and a row's own images are left out.
    fn fill(&mut self, found: &ChunkPairs, rows: Range<usize>, excess: &[f64], search: &Neighbours) {
        let n = excess.len();
        let mut end = 0;
        for (slot, k) in rows.enumerate() {
            self.starts[slot] = self.first + end;
            let (near, values) = found.row(slot);
            let mut sum = excess[k];
            if search.fluid_images.is_empty() {
                let run = end..end + near.len();
                self.columns[run.clone()].copy_from_slice(near);
                for (out, value) in self.values[run].iter_mut().zip(values) {
                    *out = -value;
                }
                sum += sum_of(values);
                end += near.len();
            } else {
                for (&j, value) in near.iter().zip(values) {
                    let source = search.source(j, n);
                    if source != k {
                        (self.columns[end], self.values[end]) = (source as u32, -value);
                        sum += value;
                        end += 1;
                    }
                }
            }
            self.diagonal[slot] = sum;
        }
    }
}

/// Σ values, in four sums of every fourth.
fn sum_of(values: &[f64]) -> f64 {
    let (four, rest) = values.as_chunks::<4>();
    let mut sum = [0.0; 4];
    for values in four {
        (0..4).for_each(|lane| sum[lane] += values[lane]);
    }
    (sum[0] + sum[1]) + (sum[2] + sum[3]) + rest.iter().sum::<f64>()
}

impl RankOne {
    /// g·x.
    pub fn dot(&self, x: &[f64]) -> f64 {
        self.entries.iter().map(|&(i, g)| g * x[i as usize]).sum()
    }
}
