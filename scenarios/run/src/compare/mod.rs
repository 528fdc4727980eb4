//! Our curves against reference curves and exact numbers.

mod waveform;

use scene::reference::{ReferenceError, Table, WedgeSimilarity};
use scene::{Compare, Norm, Scene, Shape, Similarity};
use serde::Serialize;
use settings::significant;

pub use self::waveform::Waveform;
use crate::observers::{Series, SimilarityResult};

/// One line of `summary.json`'s `comparison[]`.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// The reference's name.
    pub reference: String,
    /// What is compared.
    pub quantity: String,
    /// Our value: the number compared, or for a curve its mean over the reference's points.
    pub ours: f64,
    /// Theirs, likewise.
    pub theirs: f64,
    /// The error, in the measure of the scene's `norm`; relative for single numbers.
    pub error: f64,
    /// Largest error that passes; `null` where the curve is drawn and not judged.
    pub tolerance: Option<f64>,
    /// Scores of the curve; absent for single numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub waveform: Option<Waveform>,
}

impl Comparison {
    /// False where the error is beyond its tolerance.
    pub fn passes(&self) -> bool {
        self.tolerance.is_none_or(|t| self.error.abs() <= t)
    }
}

/// A reference curve in our units: times [s] and values [SI].
#[derive(Clone, Debug)]
pub struct ReferenceCurve {
    /// Times [s].
    pub t: Vec<f64>,
    /// Values in the unit of our column.
    pub y: Vec<f64>,
}

/// Read the curve that a scene names.
pub fn curve(compare: &Compare) -> Result<ReferenceCurve, ReferenceError> {
    let table = Table::load(&compare.reference)?;
    let scaled = |column: &str, by: f64| -> Result<Vec<f64>, ReferenceError> {
        Ok(table.column(&compare.reference, column)?.into_iter().map(|v| v * by).collect())
    };
    Ok(ReferenceCurve { t: scaled(&compare.x, compare.x_scale)?, y: scaled(&compare.y, compare.y_scale)? })
}

/// Compare a run with the curves that its scene names and with the similarity solution: the comparisons, and of those that cannot be made, why.
pub fn against_all(
    scene: &Scene,
    references: &[ReferenceCurve],
    series: &Series,
    similarity: Option<&SimilarityResult>,
) -> (Vec<Comparison>, Vec<String>) {
    let (mut made, mut missing) = against_curves(&scene.compare, references, series);
    let Some(ours) = similarity else { return (made, missing) };
    match wet_chines(scene, ours.draught_m) {
        Some(why) => missing.push(why),
        None => made.extend(against_similarity(scene, ours)),
    }
    (made, missing)
}

/// Why a wedge at a draught [m] has no similar flow: by Wagner's wetted breadth (THEORY EN3) its chines are wet.
pub(crate) fn wet_chines(scene: &Scene, draught: f64) -> Option<String> {
    let section = fsi_coupling::section_of(&scene.body.as_ref()?.shape)
        .ok()
        .filter(|section| section.deadrise_deg().is_some())?;
    let wet = section.wagner_draught(section.half_breadth());
    (draught > wet).then(|| {
        format!(
            "similarity solution: the chines are wet at a draught of {} m; the numbers are of a draught of {} m",
            significant(wet),
            significant(draught)
        )
    })
}

/// Compare a sampled column with the curves that a scene names: the comparisons, and of those that cannot be made, why.
fn against_curves(
    compares: &[Compare],
    references: &[ReferenceCurve],
    series: &Series,
) -> (Vec<Comparison>, Vec<String>) {
    let (mut made, mut missing) = (Vec::new(), Vec::new());
    for (compare, reference) in compares.iter().zip(references) {
        match against_curve(compare, reference, series) {
            Some(comparison) => made.push(comparison),
            None => missing.push(why_not(compare, series)),
        }
    }
    (made, missing)
}

/// Why a comparison is missing.
fn why_not(compare: &Compare, series: &Series) -> String {
    let Compare { quantity, reference, window: [from, to], .. } = compare;
    let end = series.times().last().copied().unwrap_or(0.0);
    format!(
        "{quantity} against {reference}: the run, which ends at {end:.6} s, has too little in the times compared, {from} to {to} s"
    )
}

/// Compare a sampled column with a curve; `None` where run or reference have too little in the window for the norm.
pub fn against_curve(compare: &Compare, reference: &ReferenceCurve, series: &Series) -> Option<Comparison> {
    let (times, values) = (series.times(), series.column(&compare.quantity)?);
    let end = times.last().copied()?;
    let [from, to] = [compare.window[0], compare.window[1].min(end)];
    let inside = |t: f64| t >= from && t <= to;
    let at: Vec<(f64, f64)> =
        reference.t.iter().copied().zip(reference.y.iter().copied()).filter(|(t, _)| inside(*t)).collect();
    let pairs: Vec<(f64, f64)> =
        at.iter().map(|(t, theirs)| (compare.scale * interpolate(&times, &values, *t), *theirs)).collect();
    let first = pairs.first()?.1.abs();
    let n = pairs.len() as f64;
    let rms = (pairs.iter().map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / n).sqrt();
    let largest = |pick: fn(&(f64, f64)) -> f64| pairs.iter().map(|p| pick(p).abs()).fold(0.0, f64::max);
    let peak_theirs = largest(|p| p.1);
    // our peak may fall between the reference's points: take it from our own samples
    let peak_ours = times
        .iter()
        .zip(&values)
        .filter(|(t, _)| inside(**t))
        .map(|(_, v)| (compare.scale * v).abs())
        .fold(0.0, f64::max);
    let mean = |pick: fn(&(f64, f64)) -> f64| pairs.iter().map(pick).sum::<f64>() / n;
    let common = [from.max(reference.t[0]), to.min(reference.t[reference.t.len() - 1])];
    let arrival = |t: &[f64], y: &[f64]| first_above(t, y, compare.threshold, [from, to]);
    let (ours, theirs, error) = match compare.norm {
        Norm::Arrival => {
            let (ours, theirs) = (arrival(&times, &values)?, arrival(&reference.t, &reference.y)?);
            (ours, theirs, ours / theirs - 1.0)
        }
        Norm::Impulse => {
            let ours = compare.scale.abs() * impulse(&times, &values, common);
            let theirs = impulse(&reference.t, &reference.y, common);
            (ours, theirs, ours / theirs - 1.0)
        }
        Norm::Period => {
            let ours = period(&times, &values, [from, to])?;
            let theirs = period(&reference.t, &reference.y, [from, to])?;
            (ours, theirs, ours / theirs - 1.0)
        }
        Norm::Rms => (mean(|p| p.0), mean(|p| p.1), rms),
        Norm::RmsOverFirst => (mean(|p| p.0), mean(|p| p.1), rms / first),
        Norm::RmsOverPeak => (mean(|p| p.0), mean(|p| p.1), rms / peak_theirs),
        Norm::Max => (mean(|p| p.0), mean(|p| p.1), largest(|p| p.0 - p.1)),
        Norm::Peak => (peak_ours, peak_theirs, (peak_ours - peak_theirs).abs() / peak_theirs),
    };
    let (reference, tolerance) = (compare.reference.clone(), compare.tolerance);
    let quantity = match compare.norm {
        Norm::Arrival => format!("{}, arrival [s]", compare.quantity),
        Norm::Impulse => format!("{}, impulse", compare.quantity),
        Norm::Peak => format!("{}, peak", compare.quantity),
        Norm::Period => format!("{}, period [s]", compare.quantity),
        _ => compare.quantity.clone(),
    };
    let [t, our_curve, their_curve] = [
        at.iter().map(|p| p.0).collect(),
        pairs.iter().map(|p| p.0).collect(),
        pairs.iter().map(|p| p.1).collect::<Vec<_>>(),
    ];
    let is_curve = !matches!(compare.norm, Norm::Arrival | Norm::Period);
    let waveform = Waveform::of(&t, &our_curve, &their_curve).filter(|_| is_curve);
    Some(Comparison { reference, quantity, ours, theirs, error, tolerance, waveform })
}

/// Compare the similarity numbers with the exact solution, where there is one.
fn against_similarity(scene: &Scene, ours: &SimilarityResult) -> Vec<Comparison> {
    let Some(exact) = similarity_of(scene) else {
        return Vec::new();
    };
    let line = |quantity: &str, ours: f64, theirs: f64, tolerance: f64| Comparison {
        reference: exact.source.into(),
        quantity: quantity.into(),
        ours,
        theirs,
        error: ours / theirs - 1.0,
        tolerance: Some(tolerance),
        waveform: None,
    };
    let mut lines = vec![line("similarity.force_coefficient", ours.force_coefficient, exact.force_coefficient, 0.02)];
    if ours.cp_max.is_finite() {
        let judged = line("similarity.cp_max", ours.cp_max, exact.cp_max, 0.05);
        lines.push(Comparison { tolerance: judged.tolerance.filter(|_| ours.cp_max_unresolved.is_none()), ..judged });
    }
    lines
}

/// The exact solution of a scene that has one.
pub fn similarity_of(scene: &Scene) -> Option<WedgeSimilarity> {
    match (scene.similarity, &scene.body.as_ref()?.shape) {
        (Some(Similarity::Wedge), Shape::Wedge { deadrise_deg, .. }) => WedgeSimilarity::at(*deadrise_deg),
        _ => None,
    }
}

/// Share of its peak that a curve must reach on both sides of a zero: less is noise.
const SWING: f64 = 0.25;

/// GE12: period of a curve about its mean in the window [s]: that of its zeros on the way up, and of those on the way down, in the
/// mean. `None` with fewer than two of either.
fn period(t: &[f64], y: &[f64], window: [f64; 2]) -> Option<f64> {
    let inside = |t: f64| (window[0]..=window[1]).contains(&t);
    let curve: Vec<[f64; 2]> = t.iter().zip(y).filter(|(t, _)| inside(**t)).map(|(t, y)| [*t, *y]).collect();
    let mean = curve.iter().map(|p| p[1]).sum::<f64>() / curve.len() as f64;
    let about_mean = |sign: f64| curve.iter().map(|p| [p[0], sign * (p[1] - mean)]).collect::<Vec<_>>();
    let distance = |zeros: Vec<f64>| {
        let intervals = zeros.len().checked_sub(1).filter(|n| *n > 0)?;
        Some((zeros[intervals] - zeros[0]) / intervals as f64)
    };
    Some(0.5 * (distance(zeros_up(&about_mean(1.0)))? + distance(zeros_up(&about_mean(-1.0)))?))
}

/// Times at which a curve comes from below −`SWING` of its peak to above +`SWING` [s]: its last zero on the way, interpolated
/// linearly.
fn zeros_up(curve: &[[f64; 2]]) -> Vec<f64> {
    let swing = SWING * curve.iter().map(|p| p[1].abs()).fold(0.0, f64::max);
    let (mut zeros, mut zero, mut below) = (Vec::new(), None, false);
    for pair in curve.windows(2) {
        let ([t0, y0], [t1, y1]) = (pair[0], pair[1]);
        below |= y0 < -swing;
        if below && y0 < 0.0 && y1 >= 0.0 {
            zero = Some(t0 + (t1 - t0) * y0 / (y0 - y1));
        }
        if below && y1 > swing {
            zeros.extend(zero.take());
            below = false;
        }
    }
    zeros
}

/// GE12: when |y| first exceeds a share of its largest value inside the window, interpolated linearly [s].
fn first_above(t: &[f64], y: &[f64], share: f64, window: [f64; 2]) -> Option<f64> {
    let inside: Vec<[f64; 2]> =
        t.iter().zip(y).filter(|(t, _)| (window[0]..=window[1]).contains(*t)).map(|(t, y)| [*t, y.abs()]).collect();
    let level = share * inside.iter().map(|p| p[1]).fold(0.0, f64::max);
    let k = inside.iter().position(|p| p[1] > level)?;
    let Some([t0, y0]) = k.checked_sub(1).map(|k| inside[k]) else { return Some(inside[k][0]) };
    let [t1, y1] = inside[k];
    Some(t0 + (t1 - t0) * (level - y0) / (y1 - y0))
}

/// GE12: ∫ y dt over a window by trapezoids between the curve's own points; cut linearly at the window's ends.
fn impulse(t: &[f64], y: &[f64], window: [f64; 2]) -> f64 {
    let ends = window.map(|at| [at, interpolate(t, y, at)]);
    let inside = t.iter().zip(y).filter(|(t, _)| **t > window[0] && **t < window[1]).map(|(t, y)| [*t, *y]);
    let points: Vec<[f64; 2]> = std::iter::once(ends[0]).chain(inside).chain([ends[1]]).collect();
    points.windows(2).map(|p| 0.5 * (p[0][1] + p[1][1]) * (p[1][0] - p[0][0])).sum()
}

/// Linear interpolation of y(t) at `at`, constant beyond the ends.
fn interpolate(t: &[f64], y: &[f64], at: f64) -> f64 {
    let k = t.partition_point(|x| *x < at);
    if k == 0 {
        return y[0];
    }
    if k == t.len() {
        return y[k - 1];
    }
    let share = (at - t[k - 1]) / (t[k] - t[k - 1]);
    y[k - 1] + share * (y[k] - y[k - 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_arrives_at_half_its_height_and_its_impulse_is_its_area() {
        let (t, y) = ([0.0, 1.0, 3.0, 4.0], [0.0, 0.0, 8.0, 2.0]);
        assert_eq!(first_above(&t, &y, 0.5, [0.0, 4.0]), Some(2.0));
        assert_eq!(first_above(&t, &y, 0.5, [3.5, 3.9]), None);
        assert!((impulse(&t, &y, [0.0, 4.0]) - 13.0).abs() < 1e-12);
        assert!((impulse(&t, &y, [2.0, 3.5]) - (6.0 + 3.25)).abs() < 1e-12);
    }

    #[test]
    fn the_period_of_a_noisy_offset_sine_is_its_own() {
        let t: Vec<f64> = (0..600).map(|k| 0.01 * f64::from(k)).collect();
        let y: Vec<f64> = t.iter().map(|t| 0.2 + (5.0 * t + 1.0).sin() + 0.1 * (91.0 * t).sin()).collect();
        let found = period(&t, &y, [0.0, 6.0]).expect("five periods");
        assert!((found * 5.0 / std::f64::consts::TAU - 1.0).abs() < 0.01, "{found}");
        assert_eq!(period(&t, &y, [0.0, 1.5]), None, "one zero on the way up has no period");
    }

    #[test]
    fn interpolation_is_linear_and_constant_outside() {
        let (t, y) = ([0.0, 1.0, 2.0], [0.0, 10.0, 0.0]);
        assert_eq!([-1.0, 0.25, 1.5, 3.0].map(|at| interpolate(&t, &y, at)), [0.0, 2.5, 5.0, 0.0]);
    }
}
