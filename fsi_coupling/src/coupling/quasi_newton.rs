//! From an interface residual to better unknowns by a quasi-Newton step (THEORY CO9; Degroote et al. 2009).

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

/// Relaxation of the part of a residual that the history does not span [-] (CO9).
const RELAXATION: f64 = 0.5;
/// A column is skipped where its part orthogonal to the newer ones is a smaller share of it (CO9).
const INDEPENDENT: f64 = 1e-3;
/// Columns of CO9 that are kept: per unknown, and at most.
const MEMORY: [usize; 2] = [2, 40];

/// The interface quasi-Newton method IQN-ILS: it finds the unknowns x of an interface for which the residual r(x), outcome minus x, is
/// zero. Its history is kept from step to step. A program that couples a host's structure with the water outside of both uses it as the
/// coupling scheme inside does.
///
/// ```
/// use fsi_coupling::QuasiNewton;
///
/// // outcome of the two programs, one after the other: repeating it diverges
/// let outcome = |x: f64| 2.0 - 3.0 * x;
/// let (mut method, mut x) = (QuasiNewton::default(), 0.0);
/// method.begin_step();
/// for _ in 0..5 {
///     x = method.next(&[x], &[outcome(x) - x])[0];
/// }
/// assert!((x - 0.5_f64).abs() < 1e-12);
/// ```
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct QuasiNewton {
    columns: VecDeque<Column>,
    /// Unknowns and residuals of the iteration before, in the same step.
    last: Option<[Vec<f64>; 2]>,
}

/// Differences between two iterations: of the residual, and of the outcome x + r.
#[derive(Clone, Serialize, Deserialize)]
struct Column {
    residual: Vec<f64>,
    outcome: Vec<f64>,
    /// Products of the residual with itself and with those of the older columns, the newest first.
    products: Vec<f64>,
}

impl QuasiNewton {
    /// Begin a step: no difference is taken across steps.
    pub fn begin_step(&mut self) {
        self.last = None;
    }

    /// Better unknowns than `x`, whose residual is `r`.
    pub fn next(&mut self, x: &[f64], r: &[f64]) -> Vec<f64> {
        if let Some([x_before, before]) = self.last.replace([x.to_vec(), r.to_vec()]) {
            let residual = difference(r, &before);
            let outcome = difference(x, &x_before).iter().zip(&residual).map(|(x, r)| x + r).collect();
            let older = self.columns.iter().map(|column| dot(&residual, &column.residual));
            let products = std::iter::once(dot(&residual, &residual)).chain(older).collect();
            self.columns.push_front(Column { residual, outcome, products });
            self.columns.truncate((MEMORY[0] * r.len()).min(MEMORY[1]));
        }
        quasi_newton(&self.columns, x, r)
    }
}

/// CO9: x + r + Σ c_i Δx̃_i, where Σ c_i Δr_i is the least-squares approximation of −r by the columns. The rest of r is relaxed.
fn quasi_newton(columns: &VecDeque<Column>, x: &[f64], r: &[f64]) -> Vec<f64> {
    let mut rest: Vec<f64> = r.iter().map(|r| -r).collect();
    let mut step = vec![0.0; x.len()];
    for (k, share) in least_squares(columns, &rest) {
        add(&mut rest, -share, &columns[k].residual);
        add(&mut step, share, &columns[k].outcome);
    }
    // r = −(spanned) − rest: the columns predict the outcome of the first part, the second is relaxed
    let spanned: Vec<f64> = r.iter().zip(&rest).map(|(r, rest)| r + rest).collect();
    (0..x.len()).map(|k| x[k] + spanned[k] + step[k] - RELAXATION * rest[k]).collect()
}

/// The columns that are independent of newer ones and the coefficients with which their residuals are nearest to `wanted`: normal equations by
/// Cholesky's factors, the newest column first.
fn least_squares(columns: &VecDeque<Column>, wanted: &[f64]) -> Vec<(usize, f64)> {
    let mut kept: Vec<usize> = Vec::new();
    let (mut rows, mut right): (Vec<Vec<f64>>, Vec<f64>) = (Vec::new(), Vec::new());
    for (k, column) in columns.iter().enumerate() {
        let mut row: Vec<f64> = Vec::with_capacity(kept.len() + 1);
        for (newer, of_newer) in kept.iter().zip(&rows) {
            let product = columns[*newer].products[k - newer] - dot(&row, of_newer);
            row.push(product / of_newer[row.len()]);
        }
        let own = column.products[0];
        let orthogonal = own - dot(&row, &row);
        if orthogonal <= INDEPENDENT * INDEPENDENT * own {
            continue;
        }
        let length = orthogonal.sqrt();
        right.push((dot(wanted, &column.residual) - dot(&row, &right)) / length);
        row.push(length);
        kept.push(k);
        rows.push(row);
    }
    for k in (0..kept.len()).rev() {
        right[k] /= rows[k][k];
        for earlier in 0..k {
            right[earlier] -= rows[k][earlier] * right[k];
        }
    }
    kept.into_iter().zip(right).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn add(sum: &mut [f64], scale: f64, term: &[f64]) {
    sum.iter_mut().zip(term).for_each(|(sum, term)| *sum += scale * term);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// r(x) = b − A x, as the accelerations of a light body with its added mass: A = 1 + M⁻¹ A.
    fn residual(x: &[f64]) -> Vec<f64> {
        let (a, b) = ([[6.0, 0.5, -0.2], [0.1, 11.0, 0.4], [0.3, -0.6, 2.0]], [3.0, -9.81, 1.2]);
        (0..3).map(|i| b[i] - dot(&a[i], x)).collect()
    }

    fn iterations(history: &mut QuasiNewton) -> usize {
        history.begin_step();
        let mut x = vec![0.0; 3];
        for n in 1..=100 {
            let r = residual(&x);
            if dot(&r, &r).sqrt() < 1e-9 {
                return n;
            }
            x = history.next(&x, &r);
        }
        panic!("no end after 100 iterations: {x:?}");
    }

    /// Three unknowns are found after three differences; in the next step at once.
    #[test]
    fn quasi_newton_is_exact_once_its_columns_span_the_unknowns() {
        let mut history = QuasiNewton::default();
        let first = iterations(&mut history);
        assert!(first <= 6, "{first}");
        let second = iterations(&mut history);
        assert!(second <= 3, "{second}");
    }

    #[test]
    fn plain_repetition_diverges_where_quasi_newton_converges() {
        let mut x = vec![0.0; 3];
        for _ in 0..20 {
            let r = residual(&x);
            add(&mut x, 1.0, &r);
        }
        assert!(dot(&x, &x) > 1e10, "plain repetition stays at {x:?}");
    }
}
