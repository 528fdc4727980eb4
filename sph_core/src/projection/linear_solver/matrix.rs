//! The matrix of the pressure equation (THEORY LS2).

use serde::{Deserialize, Serialize};

use crate::parallel;

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
    /// No rows; the memory stays.
    pub fn clear(&mut self) {
        self.starts.clear();
        self.starts.push(0);
        self.columns.clear();
        self.values.clear();
        self.diagonal.clear();
    }
}

/// A matrix as the solver reads it.
pub trait MatrixRows: Sync {
    /// Diagonals.
    fn diagonal(&self) -> &[f64];
    /// Off-diagonals of row `i`: column and value.
    fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_;
    /// (A x)_i.
    fn times(&self, i: usize, x: &[f64]) -> f64;
    /// y ← A x in the rows that `active(i)` names, 0 in the others; returns x·y, with `sums` for its parts.
    fn multiply(&self, x: &[f64], active: impl Fn(usize) -> bool + Sync, y: &mut [f64], sums: &mut [f64]) -> f64;
    /// Number of rows.
    fn rows(&self) -> usize {
        self.diagonal().len()
    }
    /// Whether row `i` tells a level of pressure: its sum is more than rounding.
    fn has_excess(&self, i: usize) -> bool {
        let off: f64 = self.row(i).map(|(_, v)| v).sum();
        let own = self.diagonal()[i];
        own + off > NO_EXCESS * own
    }
}

impl MatrixRows for Matrix {
    fn diagonal(&self) -> &[f64] {
        &self.diagonal
    }

    #[inline(always)]
    fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let run = self.starts[i]..self.starts[i + 1];
        self.columns[run.clone()].iter().map(|&j| j as usize).zip(self.values[run].iter().copied())
    }

    #[inline(always)]
    fn times(&self, i: usize, x: &[f64]) -> f64 {
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

    fn multiply(&self, x: &[f64], active: impl Fn(usize) -> bool + Sync, y: &mut [f64], sums: &mut [f64]) -> f64 {
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

impl RankOne {
    /// g·x.
    pub fn dot(&self, x: &[f64]) -> f64 {
        self.entries.iter().map(|&(i, g)| g * x[i as usize]).sum()
    }
}
