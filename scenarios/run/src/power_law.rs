//! Linear least squares, and power laws through points on logarithmic axes.

use faer::linalg::solvers::SolveLstsq;
use faer::{Col, Mat};
use serde::{Deserialize, Serialize};

/// Coefficients x that minimise Σ_i (Σ_k x_k a_k[i] − b[i])² for the columns a_k, by Householder's QR. `None` where the columns
/// are not independent, or are more than their rows.
pub fn least_squares(columns: &[Vec<f64>], b: &[f64]) -> Option<Vec<f64>> {
    if columns.len() > b.len() {
        return None;
    }
    let a = Mat::from_fn(b.len(), columns.len(), |i, k| columns[k][i]);
    let qr = a.qr();
    let r = qr.thin_R();
    let independent = |k: usize| r[(k, k)].abs() > 1e-10 * a.col(k).norm_l2();
    let x = (0..columns.len()).all(independent).then(|| qr.solve_lstsq(Col::from_fn(b.len(), |i| b[i]).as_mat()))?;
    Some((0..columns.len()).map(|k| x[(k, 0)]).collect())
}

/// y = a xᵇ, fitted to logarithms.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct PowerLaw {
    /// a, in the unit of y at x = 1.
    pub factor: f64,
    /// b [-].
    pub exponent: f64,
    /// Standard error of b [-].
    pub exponent_error: f64,
    /// Standard deviation of ln y about the law [-].
    pub scatter: f64,
}

impl PowerLaw {
    /// Through three points [x, y] or more; those not above zero have no place. `None` with fewer, or at one x.
    pub fn fit(points: impl Iterator<Item = [f64; 2]>) -> Option<PowerLaw> {
        let logs: Vec<[f64; 2]> = points.filter(|p| p.iter().all(|v| *v > 0.0)).map(|p| p.map(f64::ln)).collect();
        let spare = logs.len().checked_sub(2).filter(|n| *n > 0)? as f64;
        let (x, y): (Vec<f64>, Vec<f64>) = logs.iter().map(|p| (p[0], p[1])).unzip();
        let terms = least_squares(&[vec![1.0; x.len()], x.clone()], &y)?;
        let squares: f64 = logs.iter().map(|p| (p[1] - terms[0] - terms[1] * p[0]).powi(2)).sum();
        let mean = x.iter().sum::<f64>() / x.len() as f64;
        let spread = x.iter().map(|x| (x - mean).powi(2)).sum::<f64>().sqrt();
        let scatter = (squares / spare).sqrt();
        Some(PowerLaw { factor: terms[0].exp(), exponent: terms[1], exponent_error: scatter / spread, scatter })
    }

    /// y at x.
    pub fn at(&self, x: f64) -> f64 {
        self.factor * x.powf(self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_scattered_points_is_the_textbook_s() {
        // y = 0, 1, 1, 3 at x = 0, 1, 2, 3: slope 0.9, intercept −0.1
        let x = least_squares(&[vec![1.0; 4], vec![0.0, 1.0, 2.0, 3.0]], &[0.0, 1.0, 1.0, 3.0]).expect("two columns");
        assert!((x[0] + 0.1).abs() < 1e-14 && (x[1] - 0.9).abs() < 1e-14, "{x:?}");
        assert_eq!(least_squares(&[vec![1.0; 3], vec![2.0; 3]], &[1.0, 2.0, 3.0]), None);
        assert_eq!(least_squares(&[vec![1.0], vec![2.0]], &[1.0]), None);
    }

    #[test]
    fn a_known_law_and_its_scatter_come_back() {
        let exact = |x: f64| 0.3 * x.powf(-0.7);
        let law = PowerLaw::fit([1.0, 3.0, 10.0].map(|x| [x, exact(x)]).into_iter()).expect("three points");
        assert!((law.factor - 0.3).abs() < 1e-12 && (law.exponent + 0.7).abs() < 1e-12 && law.scatter < 1e-12);
        // ln y = 0, 1, 1, 3 at ln x = 0, 1, 2, 3: slope 0.9, residuals 0.1, 0.2, −0.7, 0.4
        let points = [[0.0, 0.0], [1.0, 1.0], [2.0, 1.0], [3.0, 3.0]].map(|p: [f64; 2]| p.map(f64::exp));
        let law = PowerLaw::fit(points.into_iter()).expect("four points");
        assert!((law.exponent - 0.9).abs() < 1e-12 && (law.scatter - 0.35_f64.sqrt()).abs() < 1e-12, "{law:?}");
        assert!((law.exponent_error - 0.07_f64.sqrt()).abs() < 1e-12, "{law:?}");
        assert_eq!(PowerLaw::fit([[1.0, 0.0], [1.0, 1.0], [2.0, 1.0]].into_iter()), None, "two are above zero");
    }
}
