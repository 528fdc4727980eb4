//! Which input matters: a polynomial chaos of the samples and Sobol's indices of it.
//!
//! ```text
//! y ≈ Σ c_a Π P_{a_i}(2 u_i − 1),   S_i = Σ_{a: only a_i > 0} c_a² / D,   T_i = Σ_{a_i > 0} c_a² / D,   D = Σ_{a ≠ 0} c_a²
//! ```
//! P_n orthonormal Legendre polynomials, u_i the share of an input's values below the sample's; c by least squares of the samples, with the degree
//! whose leave-one-out error is least (Sudret 2008; Blatman & Sudret 2010). No further runs are needed. Inputs are independent.

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

/// Largest degree that is tried, and samples per term at least.
const HIGHEST: usize = 12;
const SAMPLES_PER_TERM: usize = 2;
/// Share of the variance that the polynomial must explain, by its leave-one-out error, for indices.
const LEAST: f64 = 0.9;

/// Sobol's indices of a result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Indices {
    /// Share of the variance due to each input alone [-].
    pub first: Vec<f64>,
    /// The same with all its interactions [-].
    pub total: Vec<f64>,
    /// Share of the variance that the polynomial explains in samples that it has not seen [-].
    pub explained: f64,
    /// Its degree.
    pub degree: usize,
}

/// A polynomial of the samples.
struct Polynomial {
    degree: usize,
    /// Exponents of its terms, the constant first.
    terms: Vec<Vec<usize>>,
    coefficients: DVector<f64>,
    /// Mean square of its leave-one-out errors.
    error: f64,
}

/// Orthonormal Legendre polynomials of degrees 0 to `highest` at a share in (0, 1).
fn legendre(share: f64, highest: usize) -> Vec<f64> {
    let x = 2.0 * share - 1.0;
    let mut p = vec![1.0, x];
    for n in 1..highest {
        let n_ = n as f64;
        p.push(((2.0 * n_ + 1.0) * x * p[n] - n_ * p[n - 1]) / (n_ + 1.0));
    }
    p.iter().take(highest + 1).enumerate().map(|(n, p)| p * (2.0 * n as f64 + 1.0).sqrt()).collect()
}

/// All exponents of `inputs` variables up to a total degree, the constant first.
fn exponents(inputs: usize, degree: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for _ in 0..inputs {
        let longer = |a: &Vec<usize>| {
            let left = degree - a.iter().sum::<usize>();
            (0..=left).map(|n| [a.as_slice(), &[n]].concat()).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(longer).collect();
    }
    all.sort_by_key(|a| a.iter().sum::<usize>());
    all
}

/// The indices of values at samples in the unit cube, shape (samples, inputs); `None` where no polynomial explains them.
pub fn indices(samples: &[Vec<f64>], values: &[f64]) -> Option<Indices> {
    let inputs = samples.first()?.len();
    let n = values.len();
    let mean = values.iter().sum::<f64>() / n as f64;
    let variance = values.iter().map(|y| (y - mean).powi(2)).sum::<f64>() / n as f64;
    if variance <= 1e-24 * mean * mean {
        return None;
    }
    let mut best: Option<Polynomial> = None;
    for degree in 1..=HIGHEST {
        let terms = exponents(inputs, degree);
        if SAMPLES_PER_TERM * terms.len() > n {
            break;
        }
        let Some((coefficients, error)) = fitted(samples, values, &terms, degree) else { break };
        if best.as_ref().is_none_or(|best| error < best.error) {
            best = Some(Polynomial { degree, terms, coefficients, error });
        }
    }
    let Polynomial { degree, terms, coefficients: c, error } = best?;
    let explained = 1.0 - error / variance;
    if explained < LEAST {
        return None;
    }
    let squares = || terms.iter().zip(c.iter()).skip(1).map(|(a, c)| (a, c * c));
    let whole: f64 = squares().map(|(_, square)| square).sum();
    let share = |is_in: &dyn Fn(&[usize]) -> bool| {
        squares().filter(|(a, _)| is_in(a)).map(|(_, square)| square).sum::<f64>() / whole
    };
    let alone = |i: usize| move |a: &[usize]| a[i] > 0 && a.iter().enumerate().all(|(j, n)| j == i || *n == 0);
    Some(Indices {
        first: (0..inputs).map(|i| share(&alone(i))).collect(),
        total: (0..inputs).map(|i| share(&|a: &[usize]| a[i] > 0)).collect(),
        explained,
        degree,
    })
}

/// Coefficients, and the mean square of the leave-one-out errors.
fn fitted(samples: &[Vec<f64>], values: &[f64], terms: &[Vec<usize>], degree: usize) -> Option<(DVector<f64>, f64)> {
    let (n, m) = (values.len(), terms.len());
    let mut matrix = DMatrix::zeros(n, m);
    for (row, sample) in samples.iter().enumerate() {
        let p: Vec<Vec<f64>> = sample.iter().map(|share| legendre(*share, degree)).collect();
        for (column, a) in terms.iter().enumerate() {
            matrix[(row, column)] = a.iter().zip(&p).map(|(n, p)| p[*n]).product();
        }
    }
    let right = DVector::from_column_slice(values);
    let factor = (matrix.transpose() * &matrix).cholesky()?;
    let coefficients = factor.solve(&(matrix.transpose() * &right));
    let residual = &right - &matrix * &coefficients;
    let solved = factor.solve(&matrix.transpose());
    let leverage = |row: usize| (0..m).map(|k| matrix[(row, k)] * solved[(k, row)]).sum::<f64>();
    let error = (0..n).map(|row| (residual[row] / (1.0 - leverage(row)).max(1e-6)).powi(2)).sum::<f64>() / n as f64;
    Some((coefficients, error))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::latin_hypercube::latin_hypercube;

    /// The function of Ishigami and Homma (1990), a = 7, b = 0.1: known indices, strong interaction.
    #[test]
    fn indices_of_a_known_function() {
        let samples = latin_hypercube(1000, 3, 3);
        let at = |u: f64| PI * (2.0 * u - 1.0);
        let value = |s: &Vec<f64>| {
            let [x, y, z] = [at(s[0]), at(s[1]), at(s[2])];
            x.sin() + 7.0 * y.sin().powi(2) + 0.1 * z.powi(4) * x.sin()
        };
        let values: Vec<f64> = samples.iter().map(value).collect();
        let found = indices(&samples, &values).expect("a polynomial");
        let (first, total) = ([0.3139, 0.4424, 0.0], [0.5576, 0.4424, 0.2437]);
        for i in 0..3 {
            assert!((found.first[i] - first[i]).abs() < 0.01 && (found.total[i] - total[i]).abs() < 0.01, "{found:?}");
        }
        assert_eq!(indices(&samples, &vec![2.0; 1000]), None);
    }
}
