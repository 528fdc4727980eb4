//! Least squares by Levenberg (1944) and Marquardt (1963), with steps that Marquardt's λ damps.
//!
//! The crate `levenberg-marquardt` would bring a second nalgebra to compile, and asks for one column of the Jacobian after the other.

use nalgebra::{DMatrix, DVector};

/// First λ, and its change after a step that was taken or refused.
const DAMPING: f64 = 1e-3;
const LESS: f64 = 0.2;
const MORE: f64 = 8.0;
const MOST_DAMPING: f64 = 1e8;
/// Steps at most.
const STEPS: usize = 40;
/// Change of all values at which the search ends, and of the sum of squares [-].
const NEAR: f64 = 1e-5;
const FLAT: f64 = 1e-7;
/// Influence of a value on the residuals, squared and over the largest, below which there is none [-].
const WITHOUT: f64 = 1e-10;
/// Largest change of a value per step.
const LONGEST: f64 = 0.5;

/// Where the sum of squares is least.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The values.
    pub at: Vec<f64>,
    /// Residuals there.
    pub residuals: Vec<f64>,
    /// Their derivative by each value, shape (values, residuals).
    pub jacobian: Vec<Vec<f64>>,
}

impl Fit {
    /// Sum of the squares of the residuals.
    pub fn square(&self) -> f64 {
        self.residuals.iter().map(|r| r * r).sum()
    }

    /// (JᵀJ)⁻¹ of the values on which the residuals depend; infinite for the others.
    pub fn covariance(&self) -> Vec<Vec<f64>> {
        let (n, normal) = (self.at.len(), normal(&self.jacobian));
        let largest = normal.diagonal().max();
        let known: Vec<usize> = (0..n).filter(|k| normal[(*k, *k)] > WITHOUT * largest).collect();
        let inverse = normal.select_rows(&known).select_columns(&known).try_inverse();
        let mut found = vec![vec![0.0; n]; n];
        (0..n).for_each(|k| found[k][k] = f64::INFINITY);
        let Some(inverse) = inverse else { return found };
        for (i, row) in known.iter().enumerate() {
            for (j, column) in known.iter().enumerate() {
                found[*row][*column] = inverse[(i, j)];
            }
        }
        found
    }
}

/// JᵀJ.
fn normal(jacobian: &[Vec<f64>]) -> DMatrix<f64> {
    let n = jacobian.len();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    DMatrix::from_fn(n, n, |i, j| dot(&jacobian[i], &jacobian[j]))
}

/// The least sum of squares next to a start; `None` where residuals cannot be computed there. A step to values without residuals is refused.
pub fn minimise(
    start: &[f64],
    residuals: impl Fn(&[f64]) -> Option<Vec<f64>>,
    jacobian: impl Fn(&[f64]) -> Option<Vec<Vec<f64>>>,
) -> Option<Fit> {
    let mut fit = Fit { at: start.to_vec(), residuals: residuals(start)?, jacobian: jacobian(start)? };
    let mut damping = DAMPING;
    for _ in 0..STEPS {
        let Some(step) = step(&fit, damping) else { break };
        let at: Vec<f64> = fit.at.iter().zip(&step).map(|(q, dq)| q + dq).collect();
        let small = step.iter().all(|dq| dq.abs() < NEAR);
        let before = fit.square();
        let next = residuals(&at).filter(|r| r.iter().map(|r| r * r).sum::<f64>() < before);
        let slopes = next.as_ref().and_then(|_| jacobian(&at));
        match (next, slopes) {
            (Some(residuals), Some(jacobian)) => {
                fit = Fit { at, residuals, jacobian };
                damping *= LESS;
                if small || fit.square() > before * (1.0 - FLAT) {
                    break;
                }
            }
            _ => {
                damping *= MORE;
                if small || damping > MOST_DAMPING {
                    break;
                }
            }
        }
    }
    Some(fit)
}

/// The step of a damping λ: (JᵀJ + λ diag JᵀJ) δ = −Jᵀr.
fn step(fit: &Fit, damping: f64) -> Option<Vec<f64>> {
    let mut matrix = normal(&fit.jacobian);
    let largest = matrix.diagonal().max();
    for k in 0..matrix.nrows() {
        matrix[(k, k)] += damping * matrix[(k, k)].max(1e-12 * largest);
    }
    let gradient = |column: &Vec<f64>| -column.iter().zip(&fit.residuals).map(|(j, r)| j * r).sum::<f64>();
    let right = DVector::from_iterator(fit.jacobian.len(), fit.jacobian.iter().map(gradient));
    let step = matrix.cholesky()?.solve(&right);
    Some(step.iter().map(|dq| dq.clamp(-LONGEST, LONGEST)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The valley of Rosenbrock (1960), and the spread of a straight line.
    #[test]
    fn known_minima() {
        let residuals = |q: &[f64]| Some(vec![10.0 * (q[1] - q[0] * q[0]), 1.0 - q[0]]);
        let jacobian = |q: &[f64]| Some(vec![vec![-20.0 * q[0], -1.0], vec![10.0, 0.0]]);
        let found = minimise(&[-1.2, 1.0], residuals, jacobian).expect("a minimum");
        assert!(found.at.iter().all(|q| (q - 1.0).abs() < 1e-6), "{:?}", found.at);

        let x: Vec<f64> = (0..11).map(|k| 0.1 * k as f64).collect();
        let line = |q: &[f64]| Some(x.iter().map(|x| q[0] + q[1] * x - 2.0 + 3.0 * x).collect());
        let slopes = |_: &[f64]| Some(vec![vec![1.0; 11], x.clone()]);
        let found = minimise(&[0.0, 0.0], line, slopes).expect("a minimum");
        assert!((found.at[0] - 2.0).abs() < 1e-6 && (found.at[1] + 3.0).abs() < 1e-6);
        let spread = found.covariance();
        assert!((spread[1][1] - 1.0 / 1.1).abs() < 1e-9 && (spread[0][1] + 0.5 / 1.1).abs() < 1e-9, "{spread:?}");
        assert!(minimise(&[0.0], |_| None, |_| None).is_none());
    }
}
