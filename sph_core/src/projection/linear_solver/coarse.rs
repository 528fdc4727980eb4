//! Matrices of coarser levels (THEORY LS6, LS7).

use serde::{Deserialize, Serialize};

use crate::parallel::{self, CHUNK};
use crate::projection::linear_solver::aggregates::{Aggregates, NO_ROW};
use crate::projection::linear_solver::matrix::{Matrix, MatrixRows};

/// Row sums below this share of the diagonals behind them are zero but for rounding [-].
const NO_EXCESS: f64 = 1e-10;

/// A rectangular matrix in compressed rows.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Sparse {
    pub starts: Vec<usize>,
    pub columns: Vec<u32>,
    pub values: Vec<f64>,
}

impl Sparse {
    fn clear(&mut self) {
        self.starts.clear();
        self.starts.push(0);
        self.columns.clear();
        self.values.clear();
    }

    #[inline(always)]
    pub fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let run = self.starts[i]..self.starts[i + 1];
        self.columns[run.clone()].iter().map(|&j| j as usize).zip(self.values[run].iter().copied())
    }

    #[inline(always)]
    pub fn times(&self, i: usize, x: &[f64]) -> f64 {
        self.row(i).map(|(j, v)| v * x[j]).sum()
    }

    /// self ← `of`ᵀ, which has `columns` columns.
    pub fn transpose(&mut self, of: &Sparse, columns: usize) {
        self.starts.clear();
        self.starts.resize(columns + 2, 0);
        for &j in &of.columns {
            self.starts[j as usize + 2] += 1;
        }
        for c in 0..columns {
            self.starts[c + 2] += self.starts[c + 1];
        }
        self.columns.resize(of.columns.len(), 0);
        self.values.resize(of.columns.len(), 0.0);
        for i in 0..of.starts.len() - 1 {
            for (j, v) in of.row(i) {
                let slot = &mut self.starts[j + 1];
                (self.columns[*slot], self.values[*slot]) = (i as u32, v);
                *slot += 1;
            }
        }
        self.starts.pop();
    }
}

/// Sums up one row at a time: a value for each column that was met, in the order of meeting. A small hash table with
/// open addresses, so that many columns cost no memory.
#[derive(Clone, Debug)]
pub(crate) struct RowSum {
    /// Place in `columns`, by column; a power of two long and at most half full.
    table: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl Default for RowSum {
    fn default() -> RowSum {
        RowSum { table: vec![NO_ROW; 64], columns: Vec::new(), values: Vec::new() }
    }
}

impl RowSum {
    fn begin(&mut self) {
        self.table.fill(NO_ROW);
        self.columns.clear();
        self.values.clear();
    }

    #[inline(always)]
    fn add(&mut self, column: u32, value: f64) {
        let mask = self.table.len() - 1;
        let mut slot = column as usize & mask;
        loop {
            let place = self.table[slot] as usize;
            if let Some(&met) = self.columns.get(place) {
                if met == column {
                    self.values[place] += value;
                    return;
                }
            } else {
                return self.push(slot, column, value);
            }
            slot = (slot + 1) & mask;
        }
    }

    fn push(&mut self, slot: usize, column: u32, value: f64) {
        self.table[slot] = self.columns.len() as u32;
        self.columns.push(column);
        self.values.push(value);
        if 2 * self.columns.len() > self.table.len() {
            let mask = 2 * self.table.len() - 1;
            self.table.clear();
            self.table.resize(mask + 1, NO_ROW);
            for (place, &c) in self.columns.iter().enumerate() {
                let mut slot = c as usize & mask;
                while self.table[slot] != NO_ROW {
                    slot = (slot + 1) & mask;
                }
                self.table[slot] = place as u32;
            }
        }
    }
}

/// Rows of a coarse matrix as a chunk of aggregates collects them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Collected {
    lengths: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f64>,
    diagonal: Vec<f64>,
    sum: RowSum,
}

/// LS6: the matrix of piecewise constant pressures, couplings divided by `softening`.
pub(crate) fn collapse(
    a: &impl MatrixRows,
    aggregates: &Aggregates,
    softening: f64,
    collected: &mut Vec<Collected>,
    coarse: &mut Matrix,
) {
    let n = aggregates.len();
    collected.resize(n.div_ceil(CHUNK), Collected::default());
    parallel::for_each_chunk(collected, n, |rows, out| {
        let Collected { lengths, columns, values, diagonal, sum } = out;
        lengths.clear();
        columns.clear();
        values.clear();
        diagonal.clear();
        for row in rows {
            sum.begin();
            let (mut excess, mut own) = (0.0, 0.0);
            for &i in aggregates.of_aggregate(row) {
                let i = i as usize;
                own += a.diagonal()[i];
                let mut tied = 0.0;
                for (j, v) in a.row(i) {
                    let to = aggregates.of[j];
                    tied += v;
                    if to as usize != row && to != NO_ROW {
                        sum.add(to, v);
                    }
                }
                excess += a.diagonal()[i] + tied;
            }
            if excess < NO_EXCESS * own {
                excess = 0.0;
            }
            let mut total = 0.0;
            for (&c, &v) in sum.columns.iter().zip(&sum.values) {
                columns.push(c);
                values.push(v / softening);
                total -= v / softening;
            }
            lengths.push(sum.columns.len() as u32);
            diagonal.push(total + excess);
        }
    });
    coarse.clear();
    for part in &*collected {
        for &length in &part.lengths {
            coarse.starts.push(coarse.starts.last().copied().unwrap_or(0) + length as usize);
        }
        coarse.columns.extend_from_slice(&part.columns);
        coarse.values.extend_from_slice(&part.values);
        coarse.diagonal.extend_from_slice(&part.diagonal);
    }
}

/// LS7: P = (1 − ω D⁻¹ A) P₀, P₀ one for the members of each aggregate.
pub(crate) fn smoothed(a: &Matrix, aggregates: &Aggregates, omega: f64, sum: &mut RowSum, p: &mut Sparse) {
    p.clear();
    for i in 0..a.rows() {
        sum.begin();
        if a.diagonal[i] > 0.0 {
            let step = omega / a.diagonal[i];
            if aggregates.of[i] != NO_ROW {
                sum.add(aggregates.of[i], 1.0 - omega);
            }
            for (j, v) in a.row(i) {
                if aggregates.of[j] != NO_ROW {
                    sum.add(aggregates.of[j], -step * v);
                }
            }
        }
        p.columns.extend_from_slice(&sum.columns);
        p.values.extend_from_slice(&sum.values);
        p.starts.push(p.columns.len());
    }
}

/// LS7: `coarse` ← Pᵀ A P, with Pᵀ given as well.
pub(crate) fn triple(a: &Matrix, p: &Sparse, pt: &Sparse, sum: &mut RowSum, ap: &mut Sparse, coarse: &mut Matrix) {
    let n = pt.starts.len() - 1;
    ap.clear();
    for i in 0..a.rows() {
        sum.begin();
        for (k, v) in p.row(i) {
            sum.add(k as u32, a.diagonal[i] * v);
        }
        for (j, w) in a.row(i) {
            for (k, v) in p.row(j) {
                sum.add(k as u32, w * v);
            }
        }
        ap.columns.extend_from_slice(&sum.columns);
        ap.values.extend_from_slice(&sum.values);
        ap.starts.push(ap.columns.len());
    }
    coarse.clear();
    for row in 0..n {
        sum.begin();
        let mut own = 0.0;
        for (i, v) in pt.row(row) {
            own += v * v * a.diagonal[i];
            for (k, w) in ap.row(i) {
                sum.add(k as u32, v * w);
            }
        }
        let mut diagonal = 0.0;
        for (&c, &v) in sum.columns.iter().zip(&sum.values) {
            if c as usize == row {
                diagonal = v;
            } else {
                coarse.columns.push(c);
                coarse.values.push(v);
            }
        }
        coarse.starts.push(coarse.columns.len());
        // what floats as a whole has nothing left but rounding
        coarse.diagonal.push(if diagonal < NO_EXCESS * own { 0.0 } else { diagonal });
    }
}
