//! Quadratic response surfaces: y = c₀ + Σ cᵢ uᵢ + Σ cᵢⱼ uᵢ uⱼ by least squares, uᵢ from −1 to 1 over the points.

use run::power_law::least_squares;

/// A response surface.
#[derive(Clone, Debug)]
pub(super) struct Response {
    /// Least and largest value of each axis.
    ends: Vec<[f64; 2]>,
    /// Axes with a square: those with three values or more.
    squares: Vec<bool>,
    coefficients: Vec<f64>,
    /// Root mean square of the residuals, with the degrees of freedom that are left.
    pub residual: f64,
    /// Largest residual.
    pub largest: f64,
    /// Largest value less the smallest.
    pub span: f64,
}

impl Response {
    /// Through points, shape (points, axes), and their values; `None` where the points do not outnumber and determine the
    /// coefficients.
    pub fn fit(points: &[Vec<f64>], values: &[f64]) -> Option<Response> {
        let axes = points.first()?.len();
        let ends: Vec<[f64; 2]> = (0..axes).map(|k| extent(points.iter().map(|point| point[k]))).collect();
        let squares = (0..axes).map(|k| distinct(points.iter().map(|point| point[k])) > 2).collect();
        let mut surface = Response { ends, squares, coefficients: Vec::new(), residual: 0.0, largest: 0.0, span: 0.0 };
        let rows: Vec<Vec<f64>> = points.iter().map(|point| surface.terms(point)).collect();
        let free = values.len().checked_sub(rows[0].len()).filter(|free| *free > 0)?;
        let columns: Vec<Vec<f64>> = (0..rows[0].len()).map(|k| rows.iter().map(|row| row[k]).collect()).collect();
        surface.coefficients = least_squares(&columns, values)?;
        let residuals = points.iter().zip(values).map(|(point, value)| value - surface.at(point));
        let residuals: Vec<f64> = residuals.collect();
        surface.residual = (residuals.iter().map(|r| r * r).sum::<f64>() / free as f64).sqrt();
        surface.largest = residuals.iter().fold(0.0, |most, r| r.abs().max(most));
        let [low, high] = extent(values.iter().copied());
        surface.span = high - low;
        Some(surface)
    }

    /// The number of coefficients.
    pub fn coefficients(&self) -> usize {
        self.coefficients.len()
    }

    /// Least and largest value of an axis.
    pub fn ends(&self, axis: usize) -> [f64; 2] {
        self.ends[axis]
    }

    /// The middle of each axis.
    pub fn middle(&self) -> Vec<f64> {
        self.ends.iter().map(|[low, high]| 0.5 * (low + high)).collect()
    }

    /// A place of an axis, −1 to 1 over the points [-].
    pub fn unit(&self, axis: usize, value: f64) -> f64 {
        let [low, high] = self.ends[axis];
        if high > low { (2.0 * value - low - high) / (high - low) } else { 0.0 }
    }

    /// The surface at a place.
    pub fn at(&self, place: &[f64]) -> f64 {
        self.terms(place).iter().zip(&self.coefficients).map(|(term, c)| term * c).sum()
    }

    fn terms(&self, place: &[f64]) -> Vec<f64> {
        let u: Vec<f64> = place.iter().enumerate().map(|(axis, value)| self.unit(axis, *value)).collect();
        let mut terms = vec![1.0];
        for i in 0..u.len() {
            terms.push(u[i]);
            terms.extend((i..u.len()).filter(|&j| j != i || self.squares[i]).map(|j| u[i] * u[j]));
        }
        terms
    }
}

/// Least and largest of some numbers.
pub(super) fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
}

fn distinct(values: impl Iterator<Item = f64>) -> usize {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadratic_is_found_again_and_a_cubic_leaves_a_residual() {
        let places: Vec<Vec<f64>> =
            (0..4).flat_map(|i| (0..4).map(move |j| vec![f64::from(i), 10.0 * f64::from(j)])).collect();
        let quadratic = |p: &[f64]| 3.0 - 2.0 * p[0] + 0.1 * p[1] * p[0] + 0.01 * p[1] * p[1];
        let values: Vec<f64> = places.iter().map(|p| quadratic(p)).collect();
        let surface = Response::fit(&places, &values).expect("16 points for 6 coefficients");
        assert!(surface.residual < 1e-12 && (surface.at(&[1.5, 12.0]) - quadratic(&[1.5, 12.0])).abs() < 1e-12);
        let cubic: Vec<f64> = places.iter().map(|p| p[0].powi(3)).collect();
        assert!(Response::fit(&places, &cubic).expect("a surface").residual > 0.1);
        assert!(Response::fit(&places[..5], &values[..5]).is_none(), "no residual is left");
        let two_values: Vec<Vec<f64>> = places.iter().filter(|p| p[0] < 2.0).cloned().collect();
        let values: Vec<f64> = two_values.iter().map(|p| quadratic(p)).collect();
        assert_eq!(Response::fit(&two_values, &values).expect("no square of the first axis").coefficients(), 5);
    }
}
