//! Mean, first and second harmonic of a curve over whole periods (THEORY GE29).

use std::f64::consts::TAU;

use serde::Serialize;

/// Two-sided 95 % points of Student's distribution for 1 to 10 degrees of freedom.
const STUDENT: [f64; 10] = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228];

/// Periods of a half from which both halves are compared.
const HALF: usize = 3;

/// Mean and harmonics of a load or a motion over whole periods. Each `plus_minus` is the half width of the 95 % interval of the mean over the
/// periods, from their scatter: it says how regular the curve is, not how right.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Harmonics {
    /// Mean, less that before the waves.
    pub mean: f64,
    /// Its interval.
    pub mean_plus_minus: f64,
    /// Amplitude of the first harmonic.
    pub first: f64,
    /// Its interval.
    pub first_plus_minus: f64,
    /// Amplitude of the second harmonic.
    pub second: f64,
    /// Its interval.
    pub second_plus_minus: f64,
    /// Half width of the band of the mean: its interval, and what the spacing takes (THEORY GE29); absent where nothing was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_band: Option<f64>,
    /// Of the first harmonic.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_band: Option<f64>,
    /// Of the second harmonic.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second_band: Option<f64>,
    /// Over the amplitude a of the incident waves [m]; absent where it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub per_amplitude: Option<PerAmplitude>,
}

/// What the band of a mean is, beside its interval.
#[derive(Clone, Copy, Debug)]
pub(super) enum MeanBand {
    /// By the spacings in the draught.
    BySpacings,
    /// A force [N/m].
    Of(f64),
}

/// Mean and harmonics over powers of the incident amplitude a that they grow with in small waves [1/m², 1/m, 1/m²].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PerAmplitude {
    /// Mean over a².
    pub mean: f64,
    /// First harmonic over a.
    pub first: f64,
    /// Second harmonic over a².
    pub second: f64,
    /// First harmonic over a by linear potential theory (THEORY WA17); absent where it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_by_theory: Option<f64>,
    /// Mean over a² by the same.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_by_theory: Option<f64>,
}

/// Band of a mean force along x, and of first and second harmonics, times the spacings in the draught, shares of them: with 14 to 24 spacings first
/// harmonics of fixed and floating sections were 2 to 12 % off, second ones to 9 %, means to 29 % [-].
const AT_ONE_SPACING: [f64; 3] = [2.5, 2.0, 3.0];

impl Harmonics {
    /// The same with bands of the harmonics by the spacings in the draught of a body; of the mean with a band of its own, or by the spacings.
    pub(super) fn banded(self, spacings: f64, mean: Option<MeanBand>) -> Harmonics {
        let [of_mean, of_first, of_second] = AT_ONE_SPACING.map(|at_one| at_one / spacings);
        let mean = mean.map(|band| match band {
            MeanBand::BySpacings => of_mean * self.mean.abs(),
            MeanBand::Of(own) => own,
        });
        Harmonics {
            mean_band: mean.map(|band| self.mean_plus_minus + band),
            first_band: Some(self.first_plus_minus + of_first * self.first),
            second_band: Some(self.second_plus_minus + of_second * self.second),
            ..self
        }
    }

    /// The same with its response to waves of an amplitude [m], with first harmonic and mean by theory.
    pub(super) fn over(self, amplitude: Option<f64>, [first, mean]: [Option<f64>; 2]) -> Harmonics {
        let per_amplitude = amplitude.filter(|a| *a > 0.0).map(|a| PerAmplitude {
            mean: self.mean / (a * a),
            first: self.first / a,
            second: self.second / (a * a),
            first_by_theory: first,
            mean_by_theory: mean,
        });
        Harmonics { per_amplitude, ..self }
    }
}

/// 1/T ∫ f exp(−inωt) dt over a period T = 2π/ω from `from` of a curve (time, f) that is linear between its points, real and imaginary part, n = 0,
/// 1, 2, for n = 1, 2 twice and of f less its mean and a `drift` [per s]; `None` where the curve does not reach so far.
pub fn over_a_period(curve: &[[f64; 2]], omega: f64, from: f64, drift: f64) -> Option<[[f64; 2]; 3]> {
    let (period, points) = (TAU / omega, clipped(curve, from, from + TAU / omega)?);
    let integral = |f: &dyn Fn([f64; 2]) -> f64| {
        points.windows(2).map(|p| 0.5 * (p[1][0] - p[0][0]) * (f(p[0]) + f(p[1]))).sum::<f64>() / period
    };
    let mean = integral(&|[_, f]| f);
    let line = |t: f64| mean + drift * (t - from - 0.5 * period);
    let part = |n: f64| {
        let of = |wave: fn(f64) -> f64| 2.0 * integral(&|[t, f]| (f - line(t)) * wave(n * omega * t));
        [of(f64::cos), -of(f64::sin)]
    };
    Some([[mean, 0.0], part(1.0), part(2.0)])
}

/// The part of a curve between two times, with points at both.
fn clipped(curve: &[[f64; 2]], from: f64, to: f64) -> Option<Vec<[f64; 2]>> {
    let rounding = 1e-9 * (to - from);
    if curve.first()?[0] > from + rounding || curve.last()?[0] < to - rounding {
        return None;
    }
    let at = |time: f64| {
        let k = curve.partition_point(|p| p[0] <= time).clamp(1, curve.len() - 1);
        let ([t0, f0], [t1, f1]) = (curve[k - 1], curve[k]);
        [time, if t1 > t0 { f0 + (time - t0) / (t1 - t0) * (f1 - f0) } else { f0 }]
    };
    let inner = curve.iter().filter(|p| p[0] > from && p[0] < to).copied();
    Some(std::iter::once(at(from)).chain(inner).chain([at(to)]).collect())
}

/// GE29: over `periods` whole periods that end at `to` [s]; `rest`: the mean before the waves; `drifts`: the curve is one of a displacement, which may
/// drift at the rate by which the means of the periods differ. `None` with fewer than two periods.
pub fn harmonics(
    curve: &[[f64; 2]],
    omega: f64,
    to: f64,
    periods: usize,
    rest: f64,
    drifts: bool,
) -> Option<Harmonics> {
    let period = TAU / omega;
    let all = |drift: f64| -> Option<Vec<[[f64; 2]; 3]>> {
        (0..periods).map(|k| over_a_period(curve, omega, to - (k + 1) as f64 * period, drift)).collect()
    };
    let still = all(0.0)?;
    // the last period comes first
    let rate = |k: usize| {
        let (late, early) = (k.saturating_sub(1), (k + 1).min(periods - 1));
        (still[late][0][0] - still[early][0][0]) / ((early - late) as f64 * period)
    };
    let each: Vec<[[f64; 2]; 3]> = if drifts && periods >= 2 {
        let of = |k: usize| over_a_period(curve, omega, to - (k + 1) as f64 * period, rate(k));
        (0..periods).map(of).collect::<Option<_>>()?
    } else {
        still
    };
    (periods >= 2).then_some(())?;
    let [mean, first, second] = [0, 1, 2].map(|n| middle(&each, n));
    Some(Harmonics {
        mean: mean[0] - rest,
        mean_plus_minus: mean[1],
        first: first[0],
        first_plus_minus: first[1],
        second: second[0],
        second_plus_minus: second[1],
        mean_band: None,
        first_band: None,
        second_band: None,
        per_amplitude: None,
    })
}

/// Magnitude of the mean of the n-th amplitudes of the periods (n = 0: the mean itself), and its 95 % interval along it; at least what the means of
/// both halves of the periods differ by, since a tank swings slowly.
fn middle(each: &[[[f64; 2]; 3]], n: usize) -> [f64; 2] {
    let count = each.len() as f64;
    let mean = [0, 1].map(|part| each.iter().map(|of| of[n][part]).sum::<f64>() / count);
    let size = mean[0].hypot(mean[1]);
    let along = |of: &[f64; 2]| if size > 0.0 { (of[0] * mean[0] + of[1] * mean[1]) / size } else { 0.0 };
    let scatter = each.iter().map(|of| (along(&of[n]) - size).powi(2)).sum::<f64>() / (count - 1.0);
    let value = if n == 0 { mean[0] } else { size };
    let student = STUDENT.get(each.len() - 2).copied().unwrap_or(2.0 + 2.4 / count);
    let half = each.len() / 2;
    let of_half = |part: &[[[f64; 2]; 3]]| part.iter().map(|of| along(&of[n])).sum::<f64>() / part.len() as f64;
    let swing = if half >= HALF { (of_half(&each[..half]) - of_half(&each[half..])).abs() } else { 0.0 };
    [value, (student * (scatter / count).sqrt()).max(swing)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(f: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        (0..=2000).map(|k| [0.01 * f64::from(k), f(0.01 * f64::from(k))]).collect()
    }

    /// A mean, two harmonics and a phase are found, to the squared step of the samples.
    #[test]
    fn mean_and_harmonics_are_found() {
        let omega = 3.0;
        let of = |t: f64| 0.3 + 0.02 * (omega * t - 1.0).cos() + 0.005 * (2.0 * omega * t + 0.2).sin();
        let found = harmonics(&curve(of), omega, 20.0, 6, 0.1, true).expect("nine periods");
        let near = |a: f64, b: f64| (a - b).abs() < 1e-5;
        assert!(near(found.mean, 0.2) && near(found.first, 0.02) && near(found.second, 0.005), "{found:?}");
        assert!(found.mean_plus_minus < 1e-6 && found.first_plus_minus < 1e-5, "{found:?}");
        assert_eq!(harmonics(&curve(of), omega, 20.0, 10, 0.0, false), None);
        assert_eq!(harmonics(&curve(of), omega, 20.0, 1, 0.0, true), None);
    }

    /// A mean that is 0 in the first four periods and 1 in the last four is not known to better than 1.
    #[test]
    fn a_slow_swing_is_within_the_interval_of_the_mean() {
        let of = |t: f64| if t < 16.0 { 0.0 } else { 1.0 };
        let found = harmonics(&curve(of), TAU, 20.0, 8, 0.0, false).expect("periods");
        assert!(found.mean_plus_minus > 0.99, "{found:?}");
    }

    /// A drift is no harmonic.
    #[test]
    fn a_drift_is_no_harmonic() {
        let found = harmonics(&curve(|t| 0.1 * t), 3.0, 20.0, 6, 0.0, true).expect("periods");
        assert!(found.first < 1e-12 && found.second < 1e-12, "{found:?}");
    }

    /// An amplitude that goes up and down from period to period, by 10 %: four of them are known to ±18 % (3.182 · 2/√3 · 0.1/√4).
    #[test]
    fn scatter_from_period_to_period_is_the_interval() {
        let omega = TAU;
        let of = |t: f64| (1.0 + if (t.floor() as i64) % 2 == 0 { 0.1 } else { -0.1 }) * (omega * t).sin();
        let found = harmonics(&curve(of), omega, 20.0, 4, 0.0, false).expect("periods");
        let exact = 3.182 * 0.1 * (4.0_f64 / 3.0).sqrt() / 2.0;
        assert!((found.first - 1.0).abs() < 2e-3 && (found.first_plus_minus / exact - 1.0).abs() < 0.02, "{found:?}");
    }
}
