//! Quantiles of a result with the model's own band in them.

use serde::Serialize;
use statrs::distribution::ContinuousCDF;

use super::distribution::{quantile, standard};

/// Shares of all cases.
pub const SHARES: [f64; 3] = [0.5, 0.95, 0.99];
/// Half of a band over the standard deviation of the model's error [-].
const BAND: f64 = 2.0;
/// Repetitions of the search for a quantile.
const BISECTIONS: usize = 60;

/// A quantile.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Quantile {
    /// Share of all cases that are below it [-].
    pub share: f64,
    /// Its value; the model's own error is in it where the result has a band.
    pub value: f64,
    /// Ends of its 95 % interval, by the number of samples and whatever the missing ones would have given; absent where the samples are too few.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
    /// The same by the first half of the samples: how far it has settled.
    pub of_half: f64,
}

/// Quantiles of values with half bands, in the order in which they were drawn; `missing` more have no value.
pub fn quantiles(values: &[[f64; 2]], missing: usize) -> Vec<Quantile> {
    let of = |share: f64| Quantile {
        share,
        value: mixed(values, share),
        interval: interval(values.len(), missing, share).map(|ends| ends.map(|share| mixed(values, share))),
        of_half: mixed(&values[..values.len().div_ceil(2)], share),
    };
    SHARES.map(of).to_vec()
}

/// The value below which a share of all cases is: Σ Φ((x − v)/σ) = share n, σ half a band over 2.
fn mixed(values: &[[f64; 2]], share: f64) -> f64 {
    let normal = standard();
    let below = |x: f64| {
        let of = |[value, band]: &[f64; 2]| match band / BAND {
            sigma if sigma > 0.0 => normal.cdf((x - value) / sigma),
            _ => f64::from(u8::from(*value <= x)),
        };
        values.iter().map(of).sum::<f64>() / values.len() as f64
    };
    if values.iter().all(|[_, band]| *band <= 0.0) {
        let mut sorted: Vec<f64> = values.iter().map(|v| v[0]).collect();
        sorted.sort_by(f64::total_cmp);
        return quantile(&sorted, share);
    }
    let ends = |sign: f64| values.iter().map(move |[value, band]| value + sign * 3.0 * band);
    let (mut low, mut high) = (ends(-1.0).fold(f64::INFINITY, f64::min), ends(1.0).fold(f64::NEG_INFINITY, f64::max));
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if below(middle) < share { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Shares of the known values between which a quantile of all is, at 95 % (normal approximation of the binomial distribution): all missing ones may
/// be above it, or below.
fn interval(known: usize, missing: usize, share: f64) -> Option<[f64; 2]> {
    let [known, all] = [known as f64, (known + missing) as f64];
    let half = 1.96 * (all * share * (1.0 - share)).sqrt();
    let [low, high] = [(all * share - half - missing as f64) / known, (all * share + half) / known];
    (low > 0.0 && high <= 1.0 - 1.0 / known).then_some([low, high])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latin_hypercube::latin_hypercube;
    use crate::scatter::Distribution;

    /// A band is a second scatter: √(3² + 4²) = 5.
    #[test]
    fn a_band_widens_quantiles_as_a_second_scatter() {
        let input = Distribution::Normal([10.0, 3.0]);
        let samples = latin_hypercube(4000, 1, 1);
        let with = |band: f64| samples.iter().map(|u| [input.quantile(u[0]), band]).collect::<Vec<_>>();
        for (band, sd) in [(0.0, 3.0), (8.0, 5.0)] {
            let found = quantiles(&with(band), 0);
            for Quantile { share, value, of_half, .. } in &found {
                let exact = Distribution::Normal([10.0, sd]).quantile(*share);
                assert!((value - exact).abs() < 0.03 * sd && (of_half - exact).abs() < 0.25 * sd, "{found:?}");
            }
            for Quantile { value, interval, .. } in &found {
                let [low, high] = interval.expect("enough samples");
                assert!(low < *value && *value < high, "{found:?}");
            }
        }
        assert!(quantiles(&with(0.0)[..20], 0)[2].interval.is_none());
    }

    /// The largest tenth failed: the interval of the 80 % value holds it, that of the 95 % value has no end.
    #[test]
    fn missing_samples_widen_intervals() {
        let all = latin_hypercube(4000, 1, 1);
        let known: Vec<[f64; 2]> = all.iter().map(|u| [u[0], 0.0]).filter(|v| v[0] < 0.9).collect();
        let missing = all.len() - known.len();
        assert!(quantiles(&known, missing)[1].interval.is_none());
        let [low, high] = interval(known.len(), missing, 0.8).expect("an interval").map(|share| mixed(&known, share));
        assert!(low < 0.7 && (0.8..0.82).contains(&high), "{low} {high}");
    }
}
