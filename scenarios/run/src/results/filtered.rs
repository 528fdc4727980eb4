//! The largest acceleration through the filter of a channel frequency class (SAE J211-1).

use scene::vocabulary::Verdict;
use serde::Serialize;

use super::{RunningIntegral, STANDARD_GRAVITY};
use crate::observers::phaseless;

/// Bandwidth of each of the two passes over the class [-].
pub const PASS_OVER_CLASS: f64 = 2.0775;

/// The largest acceleration of the body's frame through a filter without delay.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct FilteredAcceleration {
    /// The channel frequency class [Hz]; the power is halved at 1.65 times it.
    pub cfc: f64,
    /// Largest magnitude, in units of 9.80665 m/s² [-].
    pub peak_g: f64,
    /// When [s].
    pub time_s: f64,
    /// What may be said of it: that of `results.peak_acceleration_g`.
    pub verdict: Verdict,
}

impl FilteredAcceleration {
    /// Of the accelerations of every step [m/s²]; `None` without any.
    pub(super) fn of(curve: &RunningIntegral<2>, cfc: f64, verdict: Verdict) -> Option<FilteredAcceleration> {
        let means = curve.step_means();
        let smooth = [0, 1].map(|axis| {
            let values: Vec<[f64; 2]> = means.iter().map(|(time, mean)| [*time, mean[axis]]).collect();
            phaseless(&values, PASS_OVER_CLASS * cfc)
        });
        let size = |k: usize| smooth[0][k][1].hypot(smooth[1][k][1]);
        let k = (0..means.len()).max_by(|a, b| size(*a).total_cmp(&size(*b)))?;
        Some(FilteredAcceleration { cfc, peak_g: size(k) / STANDARD_GRAVITY, time_s: means[k].0, verdict })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A half sine of 20 ms passes class 600; a spike of 0.1 ms does not.
    #[test]
    fn a_spike_is_filtered_and_a_pulse_is_not() {
        let mut curve = RunningIntegral::<2>::default();
        for k in 0..6_000 {
            let time = 1e-5 * f64::from(k);
            let pulse =
                if (0.02..0.04).contains(&time) { ((time - 0.02) / 0.02 * std::f64::consts::PI).sin() } else { 0.0 };
            let spike = if (0.01..0.0101).contains(&time) { 5.0 } else { 0.0 };
            curve.take(time, [0.0, STANDARD_GRAVITY * (10.0 * pulse + spike)]);
        }
        let found = FilteredAcceleration::of(&curve, 600.0, Verdict::Resolved).expect("a curve");
        assert!((found.peak_g - 10.0).abs() < 0.02 && (found.time_s - 0.03).abs() < 1e-4, "{found:?}");
        let slow = FilteredAcceleration::of(&curve, 5.0, Verdict::Resolved).expect("a curve");
        assert!(slow.peak_g < 6.0, "{slow:?}");
        // the first row is a spike of one step
        let mut hit = RunningIntegral::<2>::default();
        for k in 0..3_000 {
            let value = if k <= 1 { 60.0 } else { 1.0 };
            hit.take(1e-5 * f64::from(k), [0.0, STANDARD_GRAVITY * value]);
        }
        let found = FilteredAcceleration::of(&hit, 180.0, Verdict::Resolved).expect("a curve");
        assert!(found.peak_g < 2.0, "{found:?}");
    }
}
