//! The matrix of the pressure equation (THEORY PS1).

use crate::sweep;

use super::survey::Survey;

/// Row sums below this share of the diagonal are zero but for rounding [-].
const NO_EXCESS: f64 = 1e-10;

/// PS1: A, symmetric and positive (semi-)definite, a row for each particle; off-diagonals are zero or negative, row
/// sums zero or positive. Compressed rows without the diagonal. The unit is the caller's: solution times matrix is
/// right side.
#[derive(Clone, Debug, Default)]
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

/// PS1: an addition c g gᵀ, c > 0, with a g that is zero but for a few rows: the added mass of a free body.
#[derive(Clone, Debug, Default)]
pub struct RankOne {
    /// c.
    pub weight: f64,
    /// Rows where g is not zero, each once, and its value there.
    pub entries: Vec<(u32, f64)>,
}

impl Matrix {
    /// I6: the rows that a survey found, each with its excess on the diagonal.
    pub(super) fn assemble(&mut self, survey: &Survey, excess: &[f64]) {
        let n = excess.len();
        self.starts.resize(n + 1, 0);
        self.diagonal.resize(n, 0.0);
        let mut end = 0;
        for k in 0..n {
            self.starts[k] = end;
            end += survey.row(k).0.len();
        }
        self.starts[n] = end;
        self.columns.resize(end, 0);
        self.values.resize(end, 0.0);
        for k in 0..n {
            let (columns, values) = survey.row(k);
            self.columns[self.starts[k]..self.starts[k + 1]].copy_from_slice(columns);
            let mut sum = excess[k];
            for (out, value) in self.values[self.starts[k]..self.starts[k + 1]].iter_mut().zip(values) {
                *out = -value;
                sum += value;
            }
            self.diagonal[k] = sum;
        }
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
        sweep::update_chunks(sums, y, |rows, chunk| {
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
