//! What a spread of inputs makes of the results: quantiles with the model's own band in them, and which input matters.

pub mod chaos;
mod distribution;
mod file;
pub mod quantiles;

use std::collections::BTreeMap;

use rayon::prelude::*;
use scene::vocabulary::{Status, Verdict};
use serde::{Deserialize, Serialize};
use statrs::distribution::ContinuousCDF;

pub use chaos::Indices;
pub use distribution::Distribution;
pub use file::{Correlation, ScatterFile, schema};
pub use quantiles::Quantile;

use crate::evaluate::{EvaluateError, Evaluator};
use crate::latin_hypercube::latin_hypercube;
use crate::numbers::Number;

/// Samples between two calls of `done`.
const CHUNK: usize = 32;

/// What a sample gave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Values of the inputs, in the order of [`ScatterFile::inputs`].
    pub inputs: Vec<f64>,
    /// Results by name; none of a run that failed.
    pub numbers: BTreeMap<String, Number>,
    /// Why there are none.
    pub failed: Option<String>,
}

/// The scatter of a result.
#[derive(Clone, Debug, Serialize)]
pub struct Scattered {
    /// Its mean.
    pub mean: f64,
    /// Its standard deviation, without the model's own error.
    pub standard_deviation: f64,
    /// Quantiles, with it.
    pub quantiles: Vec<Quantile>,
    /// Share of the samples that do not have it, because they failed or the result does not occur in them [-]; the mean and the quantiles are of the
    /// others.
    pub missing: f64,
    /// Share of the samples whose number has no band [-].
    pub without_band: f64,
    /// Share of the samples whose number is not resolved [-].
    pub not_resolved: f64,
    /// Which input matters, in their order; absent where inputs are correlated or no polynomial explains the result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub indices: Option<Indices>,
}

/// What was found.
#[derive(Clone, Debug, Serialize)]
pub struct Found {
    /// The inputs.
    pub inputs: BTreeMap<String, Distribution>,
    /// Number of samples.
    pub samples: usize,
    /// Number of them that failed.
    pub failed: usize,
    /// The first failure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_failure: Option<String>,
    /// By result.
    pub results: BTreeMap<String, Scattered>,
}

/// The samples in the unit cube, shape (samples, inputs).
pub fn shares(file: &ScatterFile) -> Vec<Vec<f64>> {
    let plain = latin_hypercube(file.samples, file.inputs.len(), u64::from(file.seed));
    if file.correlations.is_empty() {
        return plain;
    }
    let Some(factor) = file.correlation_matrix().cholesky() else { return plain }; // refused where the file was read
    let (lower, normal) = (factor.l(), distribution::standard());
    let correlated = |sample: Vec<f64>| {
        let z: Vec<f64> = sample.iter().map(|share| normal.inverse_cdf(*share)).collect();
        (0..z.len()).map(|i| normal.cdf((0..=i).map(|j| lower[(i, j)] * z[j]).sum())).collect()
    };
    plain.into_iter().map(correlated).collect()
}

/// Run the samples from number `known.len()` on; `done` is called with each that follows, in order.
///
/// # Errors
/// A key that the scene does not have.
pub fn run(
    file: &ScatterFile,
    evaluator: &Evaluator,
    known: Vec<Sample>,
    mut done: impl FnMut(&Sample) -> Result<(), EvaluateError>,
) -> Result<Vec<Sample>, EvaluateError> {
    let keys = file.inputs.keys().map(|key| evaluator.key(key)).collect::<Result<Vec<String>, _>>()?;
    let shares = shares(file);
    let mut samples = known;
    while samples.len() < shares.len() {
        let to = (samples.len() + CHUNK).min(shares.len());
        let next = shares[samples.len()..to].par_iter().map(|shares| sample(file, evaluator, &keys, shares));
        for sample in next.collect::<Vec<_>>() {
            done(&sample)?;
            samples.push(sample);
        }
    }
    Ok(samples)
}

fn sample(file: &ScatterFile, evaluator: &Evaluator, keys: &[String], shares: &[f64]) -> Sample {
    let inputs: Vec<f64> = file.inputs.values().zip(shares).map(|(of, share)| of.quantile(*share)).collect();
    let values: Vec<(&str, f64)> = keys.iter().map(String::as_str).zip(inputs.iter().copied()).collect();
    match evaluator.evaluate_once(&values) {
        Ok(answer) if answer.status != Status::Failed => Sample { inputs, numbers: answer.numbers, failed: None },
        Ok(answer) => Sample { inputs, numbers: BTreeMap::new(), failed: Some(answer.message.unwrap_or_default()) },
        Err(error) => Sample { inputs, numbers: BTreeMap::new(), failed: Some(error.to_string()) },
    }
}

/// The scatter of every result.
pub fn found(file: &ScatterFile, samples: &[Sample]) -> Found {
    let shares = shares(file);
    let names: Vec<String> = {
        let mut names: Vec<String> = samples.iter().flat_map(|sample| sample.numbers.keys().cloned()).collect();
        names.sort();
        names.dedup();
        names
    };
    let of = |name: &String| {
        let with = || samples.iter().enumerate().filter_map(|(k, sample)| Some((k, sample.numbers.get(name)?)));
        let values: Vec<[f64; 2]> = with().map(|(_, number)| [number.value, number.band.unwrap_or(0.0)]).collect();
        let n = values.len() as f64;
        let mean = values.iter().map(|v| v[0]).sum::<f64>() / n;
        let square = values.iter().map(|v| (v[0] - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
        let share = |is: &dyn Fn(&Number) -> bool| with().filter(|(_, number)| is(number)).count() as f64 / n;
        let independent = file.correlations.is_empty();
        let indices = independent.then(|| {
            let at: Vec<Vec<f64>> = with().map(|(k, _)| shares[k].clone()).collect();
            chaos::indices(&at, &values.iter().map(|v| v[0]).collect::<Vec<_>>())
        });
        Scattered {
            mean,
            standard_deviation: square.sqrt(),
            quantiles: quantiles::quantiles(&values, samples.len() - values.len()),
            missing: 1.0 - n / samples.len() as f64,
            without_band: share(&|number| number.band.is_none()),
            not_resolved: share(&|number| number.verdict == Some(Verdict::NotResolved)),
            indices: indices.flatten(),
        }
    };
    let failures = || samples.iter().filter_map(|sample| sample.failed.clone());
    Found {
        inputs: file.inputs.clone(),
        samples: samples.len(),
        failed: failures().count(),
        first_failure: failures().next(),
        results: names.iter().map(|name| (name.clone(), of(name))).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<ScatterFile, String> {
        ScatterFile::parse("s.toml", text).map_err(|error| error.to_string())
    }

    #[test]
    fn correlated_inputs_keep_their_own_distributions() {
        let text = "scene = \"wedge\"\nsamples = 2000\n[inputs]\na = { normal = [1, 2] }\nb = { uniform = [0, 1] }\n\
                    [[correlations]]\nkeys = [\"a\", \"b\"]\nvalue = 0.8";
        let file = parse(text).expect("a file");
        let shares = shares(&file);
        let mean = |k: usize| shares.iter().map(|s| s[k]).sum::<f64>() / 2000.0;
        assert!((mean(0) - 0.5).abs() < 0.01 && (mean(1) - 0.5).abs() < 0.01);
        let both = shares.iter().map(|s| (s[0] - 0.5) * (s[1] - 0.5)).sum::<f64>() / 2000.0;
        // Spearman's correlation of a normal copula, (6/π) arcsin(r/2)
        let exact = 6.0 / std::f64::consts::PI * 0.4_f64.asin();
        assert!((12.0 * both - exact).abs() < 0.02, "{} {exact}", 12.0 * both);
    }

    #[test]
    fn wrong_files_are_refused() {
        for (text, said) in [
            ("scene = \"wedge\"", "inputs"),
            ("scene = \"wedge\"\n[inputs]\na = { normal = [1, 0] }", "standard deviation above 0"),
            ("scene = \"wedge\"\n[inputs]\na = { gamma = [1, 0] }", "gamma"),
            (
                "scene = \"wedge\"\n[inputs]\na = { uniform = [1, 2] }\nb = { uniform = [1, 2] }\nc = { uniform = [1, 2] }\n\
                 [[correlations]]\nkeys = [\"a\", \"b\"]\nvalue = 0.9\n[[correlations]]\nkeys = [\"b\", \"c\"]\nvalue = 0.9\n\
                 [[correlations]]\nkeys = [\"a\", \"c\"]\nvalue = -0.9",
                "possible together",
            ),
            ("scene = \"wedge\"\nsamples = 3\n[inputs]\na = { uniform = [1, 2] }", "samples"),
            (
                "scene = \"wedge\"\n[inputs]\na = { uniform = [1, 2] }\n[[correlations]]\nkeys = [\"a\", \"c\"]\nvalue = 0.2",
                "two of a",
            ),
        ] {
            let why = parse(text).expect_err(text);
            assert!(why.contains(said), "{text}: {why}");
        }
    }
}
