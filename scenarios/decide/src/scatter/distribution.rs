//! How an input scatters.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};

/// A distribution of a key's values, in its unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Distribution {
    /// Mean and standard deviation.
    Normal([f64; 2]),
    /// Both ends.
    Uniform([f64; 2]),
    /// Scale λ and shape k of P = 1 − exp(−(x/λ)ᵏ), as of wave heights and winds.
    Weibull([f64; 2]),
    /// Values that were measured, each as likely as the others; linear between neighbours.
    Table(Vec<f64>),
}

/// The standard normal distribution.
pub(super) fn standard() -> Normal {
    Normal::standard()
}

impl Distribution {
    /// What is wrong with its numbers.
    pub fn wrong(&self) -> Option<&'static str> {
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        match self {
            Distribution::Normal([mean, sd]) if !(finite(&[*mean, *sd]) && *sd > 0.0) => {
                Some("a mean and a standard deviation above 0")
            }
            Distribution::Uniform([from, to]) if !(finite(&[*from, *to]) && from < to) => {
                Some("a smaller and a larger end")
            }
            Distribution::Weibull([scale, shape]) if !(finite(&[*scale, *shape]) && *scale > 0.0 && *shape > 0.0) => {
                Some("a scale and a shape above 0")
            }
            Distribution::Table(values) if values.len() < 2 || !finite(values) => Some("two values or more"),
            _ => None,
        }
    }

    /// The value below which a share of all values is, 0 < share < 1.
    pub fn quantile(&self, share: f64) -> f64 {
        match self {
            Distribution::Normal([mean, sd]) => mean + sd * standard().inverse_cdf(share),
            Distribution::Uniform([from, to]) => from + share * (to - from),
            Distribution::Weibull([scale, shape]) => scale * (-(-share).ln_1p()).powf(1.0 / shape),
            Distribution::Table(values) => {
                let mut sorted = values.clone();
                sorted.sort_by(f64::total_cmp);
                quantile(&sorted, share)
            }
        }
    }
}

/// Quantile of sorted values, at the places (k + ½)/n; linear between them.
pub(super) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let n = sorted.len();
    let at = (share * n as f64 - 0.5).clamp(0.0, n as f64 - 1.0);
    let k = (at as usize).min(n.saturating_sub(2));
    let next = sorted[(k + 1).min(n - 1)];
    sorted[k] + (at - k as f64) * (next - sorted[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_books() {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * b.abs().max(1.0);
        assert!(near(Distribution::Normal([3.0, 2.0]).quantile(0.975), 3.0 + 2.0 * 1.959963985));
        assert!(near(Distribution::Uniform([-1.0, 3.0]).quantile(0.25), 0.0));
        assert!(near(Distribution::Weibull([2.0, 1.5]).quantile(1.0 - (-1.0_f64).exp()), 2.0));
        let table = Distribution::Table(vec![3.0, 1.0, 2.0, 4.0]);
        assert!(near(table.quantile(0.5), 2.5) && near(table.quantile(0.001), 1.0) && near(table.quantile(0.999), 4.0));
        assert!(Distribution::Normal([1.0, 0.0]).wrong().is_some() && Distribution::Table(vec![1.0]).wrong().is_some());
        assert!(Distribution::Uniform([2.0, 1.0]).wrong().is_some() && table.wrong().is_none());
    }
}
