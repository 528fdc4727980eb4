//! Values of keys with which a scene gives measured curves: a drop test and its model.
//!
//! Least squares by Levenberg and Marquardt ([`least_squares`]); intervals from the curves' own scatter.

pub mod data;
pub mod least_squares;
mod profile;

use std::collections::BTreeMap;

use rayon::prelude::*;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

pub use data::{Curve, DataError, read};
use least_squares::{Fit, minimise};

use crate::evaluate::{Answer, EvaluateError, Evaluator};

/// Relative steps of the differences by which the curves' change with a value is found, each with the scatter of the fit before it: peaks of
/// accelerations bend within the first.
const STEPS: [f64; 3] = [0.02, 0.005, 0.005];
/// Half of an interval over its value, from which the data cannot tell the value [-].
const UNKNOWN: f64 = 0.5;
/// Correlation of two values, from which the data cannot tell them apart [-].
const ALIKE: f64 = 0.98;
/// Correlation of neighbouring residuals, from which the model is off by more than noise [-].
const OFF: f64 = 0.3;
/// Name of the time of the scene's start in the data [s].
pub const SHIFT: &str = "shift";

/// Where the shift begins [s], of the key `shift` or `shift=5.2`; `None` of another key.
fn start_of_shift(key: &str) -> Option<f64> {
    let rest = key.strip_prefix(SHIFT)?;
    if rest.is_empty() {
        Some(0.0)
    } else {
        rest.strip_prefix('=')?.trim().parse().ok().filter(|at: &f64| at.is_finite())
    }
}

/// A value that was found.
#[derive(Clone, Debug, Serialize)]
pub struct Estimate {
    /// The key.
    pub key: String,
    /// Its value, in the unit of the key.
    pub value: f64,
    /// The interval in which it is at 95 %; infinite, `null` in JSON, where the data give no end.
    pub range: [f64; 2],
    /// How far the farther end is from the value.
    pub interval: f64,
    /// Where it began.
    pub start: f64,
}

/// What was found.
#[derive(Clone, Debug, Serialize)]
pub struct Fitted {
    /// The values.
    pub estimates: Vec<Estimate>,
    /// Standard deviation of the residuals, by curve, in its unit.
    pub residual: BTreeMap<String, f64>,
    /// The model that was run.
    pub model: String,
    /// Number of runs.
    pub runs: usize,
    /// Sentences that a reader must know.
    pub notes: Vec<String>,
    /// Rows for each curve: time [s], measured, fitted.
    #[serde(skip)]
    pub curves: BTreeMap<String, Vec<[f64; 3]>>,
}

/// A value on its way: positive and negative ones keep their sign.
#[derive(Clone, Debug)]
struct Unknown {
    key: String,
    start: f64,
    /// Unit of the shift of time [s]; `None` of a key, whose unit is e.
    linear: Option<f64>,
}

impl Unknown {
    fn value(&self, q: f64) -> f64 {
        match self.linear {
            Some(unit) => self.start + unit * q,
            None => self.start * q.exp(),
        }
    }
}

/// Find the values of `keys` with which the scene gives the curves.
///
/// # Errors
/// No curve of the scene's; a key that begins at 0; a run that fails at the start.
pub fn fit(evaluator: &Evaluator, keys: &[String], curves: &[Curve]) -> Result<Fitted, EvaluateError> {
    if let Some(twice) = keys.iter().enumerate().find_map(|(k, key)| keys[..k].contains(key).then_some(key)) {
        return Err(EvaluateError::Key(format!("{twice} stands twice: expected each key once")));
    }
    let given: usize = curves.iter().map(|curve| curve.points.len()).sum();
    let curves = &within_run(evaluator, keys, curves)?;
    let unknowns = unknowns(evaluator, keys, curves)?;
    let points: usize = curves.iter().map(|curve| curve.points.len()).sum();
    if points <= unknowns.len() + 1 {
        let expected = unknowns.len() + 2;
        return Err(EvaluateError::Key(format!("{points} points in the time of the run: expected {expected} or more")));
    }
    if let Some(flat) = curves.iter().find(|curve| curve.points.iter().all(|p| p[1] == curve.points[0][1])) {
        return Err(EvaluateError::Key(format!(
            "{}: all values are alike: expected a curve that changes",
            flat.column
        )));
    }
    let modelled = |q: &[f64]| modelled(evaluator, &unknowns, curves, q);
    let mut weights: Vec<f64> = curves.iter().map(|curve| 1.0 / (0.03 * curve.range())).collect();
    let mut fit = Fit { at: vec![0.0; unknowns.len()], residuals: Vec::new(), jacobian: Vec::new() };
    let weighed = |q: &[f64], weights: &[f64]| -> Option<Vec<f64>> {
        let found = modelled(q).ok()?;
        let pairs = curves.iter().zip(&found).zip(weights);
        Some(pairs.flat_map(|((c, found), w)| c.points.iter().zip(found).map(move |(p, f)| w * (f - p[1]))).collect())
    };
    let mut used = weights.clone();
    for step in STEPS {
        // the first run says what is wrong
        modelled(&fit.at)?;
        let residuals = |q: &[f64]| weighed(q, &weights);
        fit = minimise(&fit.at, residuals, |q| slopes(q, step, residuals))
            .ok_or_else(|| EvaluateError::Key("runs fail next to the values of the start".into()))?;
        used = scatter(curves, &fit, &weights, unknowns.len());
        std::mem::swap(&mut used, &mut weights);
    }
    let found = modelled(&fit.at)?;
    let correlation = neighbours(curves, &found);
    let residuals = |q: &[f64]| weighed(q, &used);
    let reach = |k: usize, of_line: [f64; 2]| {
        profile::reach(&fit, k, of_line, residuals, |q| slopes(q, STEPS[STEPS.len() - 1], residuals))
    };
    let estimates = estimates(&unknowns, &fit, points, correlation, reach);
    let model = evaluator.load(&[])?.scene.model.name().to_string();
    Ok(Fitted {
        notes: notes(&unknowns, &fit, &estimates, correlation, given - points),
        residual: curves.iter().zip(&weights).map(|(curve, weight)| (curve.column.clone(), 1.0 / weight)).collect(),
        curves: curves.iter().zip(&found).map(|(curve, found)| (curve.column.clone(), rows(curve, found))).collect(),
        model,
        runs: evaluator.count(),
        estimates,
    })
}

/// Derivatives of residuals by each value, by differences over `step` to both sides.
fn slopes(q: &[f64], step: f64, residuals: impl Fn(&[f64]) -> Option<Vec<f64>> + Sync) -> Option<Vec<Vec<f64>>> {
    let moved = |j: usize| {
        let mut moved = q.to_vec();
        moved[j / 2] += if j.is_multiple_of(2) { step } else { -step };
        residuals(&moved)
    };
    let columns = (0..q.len() * 2).into_par_iter().map(moved).collect::<Option<Vec<_>>>()?;
    let slope = |pair: &[Vec<f64>]| pair[0].iter().zip(&pair[1]).map(|(a, b)| (a - b) / (2.0 * step)).collect();
    Some(columns.chunks(2).map(slope).collect())
}

/// The points in the time of the scene's run; with a shift, half of that to either side.
fn within_run(evaluator: &Evaluator, keys: &[String], curves: &[Curve]) -> Result<Vec<Curve>, EvaluateError> {
    let answer = evaluator.evaluate(&[])?;
    let [first, last] = [answer.rows.first(), answer.rows.last()].map(|row| row.map_or(0.0, |row| row[0]));
    if let Some(unknown) = curves.iter().find(|curve| !answer.columns[1..].contains(&curve.column)) {
        return Err(no_column(&unknown.column, &answer));
    }
    let shift = keys.iter().find_map(|key| start_of_shift(key));
    let slack = if shift.is_some() { 0.5 * (last - first) } else { 1e-9 * last };
    let [first, last] = [first, last].map(|time| time + shift.unwrap_or(0.0));
    let mut kept = curves.to_vec();
    for curve in &mut kept {
        curve.points.retain(|[time, _]| (first - slack..=last + slack).contains(time));
    }
    kept.retain(|curve| !curve.points.is_empty());
    if kept.is_empty() {
        let other = "(of data with another start, `--for shift=TIME` gives the time of the scene's start in the data)";
        let text = format!("no point of the data is in the time of the run, {first} to {last} s {other}");
        return Err(EvaluateError::Key(text));
    }
    Ok(kept)
}

fn rows(curve: &Curve, found: &[f64]) -> Vec<[f64; 3]> {
    curve.points.iter().zip(found).map(|([time, measured], found)| [*time, *measured, *found]).collect()
}

fn unknowns(evaluator: &Evaluator, keys: &[String], curves: &[Curve]) -> Result<Vec<Unknown>, EvaluateError> {
    let last = curves.iter().flat_map(|curve| curve.points.iter().map(|p| p[0])).fold(0.0, f64::max);
    keys.iter()
        .map(|given| {
            if let Some(start) = start_of_shift(given) {
                return Ok(Unknown { key: SHIFT.into(), start, linear: Some(0.1 * (last - start)) });
            }
            let key = evaluator.key(given)?;
            let start = evaluator.value(&key)?;
            if start == 0.0 {
                return Err(EvaluateError::Key(format!("{given}: 0 in the scene: expected a start that is not 0")));
            }
            Ok(Unknown { key, start, linear: None })
        })
        .collect()
}

/// The curves of the scene at the data's times.
fn modelled(
    evaluator: &Evaluator,
    unknowns: &[Unknown],
    curves: &[Curve],
    q: &[f64],
) -> Result<Vec<Vec<f64>>, EvaluateError> {
    let pairs = || unknowns.iter().zip(q);
    let keys = pairs().filter(|(unknown, _)| unknown.linear.is_none());
    let values: Vec<(&str, f64)> = keys.map(|(unknown, q)| (unknown.key.as_str(), unknown.value(*q))).collect();
    let shift: f64 = pairs().filter(|(u, _)| u.linear.is_some()).map(|(unknown, q)| unknown.value(*q)).sum();
    let answer = evaluator.evaluate(&values)?;
    if let Some(why) = &answer.message {
        return Err(EvaluateError::Key(why.clone()));
    }
    let of = |curve: &Curve| {
        let Some(at) = answer.curve(&curve.column) else { return Err(no_column(&curve.column, &answer)) };
        Ok(curve.points.iter().map(|[time, _]| at(time - shift)).collect())
    };
    curves.iter().map(of).collect()
}

fn no_column(column: &str, answer: &Answer) -> EvaluateError {
    let known = answer.columns[1..].join(", ");
    EvaluateError::Key(format!("no column `{column}`: expected one of: {known}"))
}

/// Weights of the curves from their residuals: 1 over the standard deviation.
fn scatter(curves: &[Curve], fit: &Fit, weights: &[f64], unknowns: usize) -> Vec<f64> {
    let points: usize = curves.iter().map(|curve| curve.points.len()).sum();
    let free = (points - unknowns) as f64 / points as f64;
    let mut rest = &fit.residuals[..];
    let of = |(curve, weight): (&Curve, &f64)| {
        let (own, others) = rest.split_at(curve.points.len());
        rest = others;
        let square = own.iter().map(|r| r * r).sum::<f64>() / (own.len() as f64 * free);
        weight / square.sqrt().max(1e-9)
    };
    curves.iter().zip(weights).map(of).collect()
}

/// Correlation of neighbouring residuals, over all curves [-].
fn neighbours(curves: &[Curve], found: &[Vec<f64>]) -> f64 {
    let mut sums = [0.0; 2];
    for (curve, found) in curves.iter().zip(found) {
        let scale = curve.range();
        let r: Vec<f64> = curve.points.iter().zip(found).map(|(p, f)| (f - p[1]) / scale).collect();
        sums[0] += r.windows(2).map(|r| r[0] * r[1]).sum::<f64>();
        sums[1] += r.iter().map(|r| r * r).sum::<f64>();
    }
    if sums[1] > 0.0 { sums[0] / sums[1] } else { 0.0 }
}

/// Intervals of Student's distribution; residuals that are alike count as fewer. `reach` gives the distances to the ends of an interval
/// where a linear fit has them, with its growth of the sum of squares.
fn estimates(
    unknowns: &[Unknown],
    fit: &Fit,
    points: usize,
    correlation: f64,
    reach: impl Fn(usize, [f64; 2]) -> [f64; 2],
) -> Vec<Estimate> {
    let spread = fit.covariance();
    let alike = correlation.clamp(0.0, 0.99);
    let wider = ((1.0 + alike) / (1.0 - alike)).sqrt();
    let free = ((points as f64 / (wider * wider)) - unknowns.len() as f64).max(1.0);
    let quantile = StudentsT::new(0.0, 1.0, free).map_or(1.96, |t| t.inverse_cdf(0.975));
    let scale = (fit.square() / (points - unknowns.len()) as f64).sqrt();
    let of = |(k, unknown): (usize, &Unknown)| {
        let deviation = quantile * wider * scale;
        let [below, above] = reach(k, [deviation * spread[k][k].sqrt(), deviation * deviation]);
        let value = unknown.value(fit.at[k]);
        let mut range = [-below, above].map(|way| unknown.value(fit.at[k] + way));
        range.sort_by(f64::total_cmp);
        let interval = range.iter().map(|end| (end - value).abs()).fold(0.0, f64::max);
        Estimate { key: unknown.key.clone(), value, range, interval, start: unknown.start }
    };
    unknowns.iter().enumerate().map(of).collect()
}

fn notes(unknowns: &[Unknown], fit: &Fit, estimates: &[Estimate], correlation: f64, outside: usize) -> Vec<String> {
    let mut notes = Vec::new();
    if outside > 0 {
        notes.push(format!("{outside} points are outside the time of the run and are left out"));
    }
    for Estimate { key, value, interval, .. } in estimates {
        let is_shift = key == SHIFT;
        let is_known = if is_shift { interval.is_finite() } else { *interval < UNKNOWN * value.abs() };
        if !is_known {
            let how = if is_shift { "has no end" } else { "is wider than half its value" };
            notes.push(format!("{key}: these data do not determine it: its interval {how}"));
        }
    }
    let spread = fit.covariance();
    for i in 0..spread.len() {
        for j in 0..i {
            let alike = spread[i][j] / (spread[i][i] * spread[j][j]).sqrt();
            if alike.abs() > ALIKE {
                let (a, b) = (&unknowns[j].key, &unknowns[i].key);
                notes.push(format!(
                    "{a} and {b}: these data cannot tell them apart (correlation {alike:.3}): fix one of them"
                ));
            }
        }
    }
    if correlation > OFF {
        notes.push(format!(
            "neighbouring residuals are alike (correlation {correlation:.2}): the model is off by more than noise; intervals are widened by it"
        ));
    }
    notes
}
