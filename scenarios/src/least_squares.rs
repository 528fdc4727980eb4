//! Linear least squares.

use faer::linalg::solvers::SolveLstsq;
use faer::{Col, Mat};

/// Coefficients x that minimise Σ_i (Σ_k x_k a_k[i] − b[i])² for the columns a_k, by Householder's QR. `None` where the columns
/// are not independent, or are more than their rows.
pub(crate) fn least_squares(columns: &[Vec<f64>], b: &[f64]) -> Option<Vec<f64>> {
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
}
