//! Bias and scatter of a quantity (THEORY GE28).

use super::point::Point;

/// Least number of points from which a scatter is quoted.
pub const LEAST_POINTS: usize = 5;
/// Standard deviations below which 95 % of a normal distribution lie, on one side.
const ONE_SIDED_95: f64 = 1.644_853_6;
/// The same for a band that contains 95 %, on both sides.
const TWO_SIDED_95: f64 = 1.959_964;

/// GE28: how a model's numbers of a quantity lie about its references.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Number of points.
    pub points: usize,
    /// Number of cases.
    pub cases: usize,
    /// Bias δ: ours over theirs, geometric mean corrected for scatter [-].
    pub bias: f64,
    /// Geometric mean of ours over theirs [-].
    pub middle: f64,
    /// Relative standard deviation σ_M of the model [-]; `None` below [`LEAST_POINTS`].
    pub scatter: Option<f64>,
    /// Relative standard uncertainty σ_E of the references, root mean square of those that are known [-].
    pub reference: Option<f64>,
    /// Largest deviation, ours over theirs less 1 [-], and its place among the points.
    pub worst: (f64, usize),
}

impl Statistics {
    /// Of points with ratios above 0; `None` without any.
    pub fn of(points: &[&Point]) -> Option<Statistics> {
        let logs: Vec<f64> = points.iter().filter(|p| p.ratio > 0.0).map(|p| p.ratio.ln()).collect();
        let n = logs.len() as f64;
        if logs.is_empty() {
            return None;
        }
        let mean = logs.iter().sum::<f64>() / n;
        let total = (logs.iter().map(|log| (log - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0)).sqrt();
        let known: Vec<f64> = points.iter().filter_map(|p| p.reference.uncertainty).collect();
        let reference =
            (!known.is_empty()).then(|| (known.iter().map(|u| u * u).sum::<f64>() / known.len() as f64).sqrt());
        let of_reference = reference.unwrap_or(0.0).powi(2).min(0.5 * total.powi(2));
        let of_model = total.powi(2) - of_reference;
        let scatter = (logs.len() >= LEAST_POINTS).then_some(of_model.sqrt());
        let bias = (mean + scatter.map_or(0.0, |_| 0.5 * (of_model - of_reference))).exp();
        let deviation = |k: usize| (points[k].ratio - 1.0).abs();
        let worst = (0..points.len()).max_by(|a, b| deviation(*a).total_cmp(&deviation(*b)))?;
        let mut cases: Vec<&str> = points.iter().map(|p| p.case.as_str()).collect();
        cases.sort_unstable();
        cases.dedup();
        Some(Statistics {
            points: logs.len(),
            cases: cases.len(),
            bias,
            middle: mean.exp(),
            scatter,
            reference,
            worst: (points[worst].ratio - 1.0, worst),
        })
    }

    /// GE28: factor on a number of the model below which the true value lies with a probability of 95 % [-]; `band`: share of the number in its
    /// own band, which 95 % of the numerical errors are within, 0 for none.
    pub fn not_exceeded(&self, band: f64) -> Option<f64> {
        let scatter = self.scatter?.hypot(band / TWO_SIDED_95);
        let n = self.points as f64;
        Some((student(n - 1.0) * (1.0 + 1.0 / n).sqrt() * scatter).exp() / self.middle)
    }
}

/// One-sided 95 % point of Student's distribution, to 1 % from 4 degrees of freedom on (expansion of Cornish and Fisher).
fn student(freedom: f64) -> f64 {
    let z = ONE_SIDED_95;
    z + (z.powi(3) + z) / (4.0 * freedom) + (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / (96.0 * freedom.powi(2))
}

#[cfg(test)]
mod tests {
    use super::super::point::{Nature, Pedigree, Setup};
    use super::super::quantity::Quantity;
    use super::*;

    fn point(ratio: f64, uncertainty: Option<f64>) -> Point {
        let reference = Pedigree { nature: Nature::Experiment, uncertainty };
        let text = String::new;
        Point {
            quantity: Quantity::Force,
            case: text(),
            number: text(),
            model: text(),
            ratio,
            waveform: None,
            numerical: None,
            setup: Setup::default(),
            reference,
        }
    }

    /// 400 numbers of the model with bias 1.1 and scatter 5 % beside measurements with a scatter of 3 %, at the quantiles of both.
    #[test]
    fn bias_and_scatter_are_separated_from_the_scatter_of_the_references() {
        let normal = |share: f64| {
            // inverse of the normal distribution by bisection, the error function by its series; 20 quantiles have 0.96 of its deviation
            let below = |x: f64| {
                let (mut term, mut sum) = (x, x);
                for k in 1..60 {
                    term *= -x * x / (2.0 * f64::from(k));
                    sum += term / (2.0 * f64::from(k) + 1.0);
                }
                0.5 + sum / std::f64::consts::TAU.sqrt()
            };
            let (mut low, mut high) = (-4.0, 4.0);
            for _ in 0..60 {
                let middle: f64 = 0.5 * (low + high);
                if below(middle) < share { low = middle } else { high = middle }
            }
            0.5 * (low + high)
        };
        let quantile = |k: usize| normal((k as f64 + 0.5) / 20.0);
        let points: Vec<Point> = (0..400)
            .map(|k| {
                let [model, test] = [0.05 * quantile(k / 20), 0.03 * quantile(k % 20)];
                point(1.1 * (model - test).exp(), Some(0.03))
            })
            .collect();
        let all: Vec<&Point> = points.iter().collect();
        let found = Statistics::of(&all).expect("points");
        let scatter = found.scatter.expect("many");
        assert!((found.bias - 1.1).abs() < 2e-3 && (scatter - 0.05).abs() < 3e-3, "{found:?}");
        let factor = found.not_exceeded(0.0).expect("many");
        assert!(found.not_exceeded(0.1).expect("many") > factor + 0.03, "its own band counts");
        assert!((student(4.0) - 2.132).abs() < 0.02 && (student(1e6) - ONE_SIDED_95).abs() < 1e-5);
        let held = (0..400).filter(|k| factor * 1.1 * (0.05 * quantile(k / 20)).exp() >= 1.0).count();
        assert!((370..=390).contains(&held), "{held} of 400");
    }

    /// References that are said to scatter more than all errors do not make the model exact.
    #[test]
    fn the_model_scatters_at_least_as_much_as_its_references() {
        let points: Vec<Point> = (0..9).map(|k| point(1.0 + 0.01 * (f64::from(k) - 4.0), Some(0.05))).collect();
        let found = Statistics::of(&points.iter().collect::<Vec<_>>()).expect("points");
        let total = 0.01 * (60.0_f64 / 8.0).sqrt();
        assert!((found.scatter.expect("many") / (total * 0.5_f64.sqrt()) - 1.0).abs() < 1e-2, "{found:?}");
    }

    #[test]
    fn few_points_have_a_bias_and_no_scatter() {
        let points = [point(1.02, None), point(1.02, None)];
        let found = Statistics::of(&points.iter().collect::<Vec<_>>()).expect("points");
        assert!((found.bias - 1.02).abs() < 1e-12 && found.scatter.is_none() && found.not_exceeded(0.0).is_none());
        assert_eq!((found.points, found.cases, found.reference), (2, 1, None));
        assert_eq!(Statistics::of(&[]), None);
    }
}
