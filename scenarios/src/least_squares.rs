//! Linear least squares by orthogonal columns.

/// Coefficients x that make Σ_i (Σ_k x_k a_k[i] − b[i])² least, for the columns a_k; modified Gram–Schmidt (Björck 1967).
/// `None` where the columns are not independent.
pub(crate) fn least_squares(columns: &[Vec<f64>], b: &[f64]) -> Option<Vec<f64>> {
    let n = columns.len();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut q = columns.to_vec();
    let mut r = vec![vec![0.0; n]; n];
    let mut rest = b.to_vec();
    let mut projected = vec![0.0; n];
    for k in 0..n {
        let whole = dot(&columns[k], &columns[k]).sqrt();
        r[k][k] = dot(&q[k], &q[k]).sqrt();
        if r[k][k] <= 1e-10 * whole || whole == 0.0 {
            return None;
        }
        let length = r[k][k];
        q[k].iter_mut().for_each(|v| *v /= length);
        let unit = q[k].clone();
        for j in k + 1..n {
            r[k][j] = dot(&unit, &q[j]);
            let share = r[k][j];
            q[j].iter_mut().zip(&unit).for_each(|(v, u)| *v -= share * u);
        }
        projected[k] = dot(&unit, &rest);
        let share = projected[k];
        rest.iter_mut().zip(&unit).for_each(|(v, u)| *v -= share * u);
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| r[k][j] * x[j]).sum();
        x[k] = (projected[k] - known) / r[k][k];
    }
    Some(x)
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
    }
}
