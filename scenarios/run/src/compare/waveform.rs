//! How alike two curves are, by size, by phase and in all (THEORY GE27).

use serde::Serialize;

/// GE27: scores of a curve against a reference (Sprague & Geers 2004), all 0 for the same curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Waveform {
    /// Size: M = √(∫c² dt/∫m² dt) − 1, positive where our curve c is larger than the reference m [-].
    pub magnitude: f64,
    /// Phase: P = arccos(∫c m dt/√(∫c² dt ∫m² dt))/π, 0 to 1 [-].
    pub phase: f64,
    /// Both: C = √(M² + P²) [-].
    pub combined: f64,
}

impl Waveform {
    /// Of curves at the same times: shape (n) each; integrals by trapezoids. `None` with fewer than three points, or where a curve is 0.
    pub fn of(times: &[f64], ours: &[f64], theirs: &[f64]) -> Option<Waveform> {
        let integral = |a: &[f64], b: &[f64]| -> f64 {
            let product = |k: usize| a[k] * b[k];
            (1..times.len()).map(|k| 0.5 * (times[k] - times[k - 1]) * (product(k - 1) + product(k))).sum()
        };
        let [cc, mm, cm] = [integral(ours, ours), integral(theirs, theirs), integral(ours, theirs)];
        if times.len() < 3 || cc <= 0.0 || mm <= 0.0 {
            return None;
        }
        let magnitude = (cc / mm).sqrt() - 1.0;
        let phase = (cm / (cc * mm).sqrt()).clamp(-1.0, 1.0).acos() / std::f64::consts::PI;
        Some(Waveform { magnitude, phase, combined: magnitude.hypot(phase) })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn a_larger_sine_has_a_magnitude_and_a_late_one_a_phase() {
        let times: Vec<f64> = (0..=1000).map(|k| 0.001 * f64::from(k)).collect();
        let sine =
            |size: f64, late: f64| -> Vec<f64> { times.iter().map(|t| size * (TAU * (t - late)).sin()).collect() };
        let of = |size, late| Waveform::of(&times, &sine(size, late), &sine(1.0, 0.0)).expect("curves");
        let larger = of(1.2, 0.0);
        assert!((larger.magnitude - 0.2).abs() < 1e-12 && larger.phase < 1e-7);
        let late = of(1.0, 0.1); // 36 of 180 degrees
        assert!(
            late.magnitude.abs() < 1e-12 && (late.phase - 0.2).abs() < 1e-12 && (late.combined - 0.2).abs() < 1e-12
        );
        assert_eq!(Waveform::of(&times, &sine(0.0, 0.0), &sine(1.0, 0.0)), None);
        assert_eq!(Waveform::of(&times[..2], &[1.0, 1.0], &[1.0, 1.0]), None);
    }
}
