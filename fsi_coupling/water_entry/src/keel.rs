//! Pressure at the keel of a wedge, read from the face next to it (THEORY GE21).
//!
//! The flow of a corner between a face of deadrise β and the plane of symmetry has p = p₀ − C rᵐ along the face,
//! m = 2(π/(π/2 + β) − 1): below 1, above 30°, the pressure has a cusp at the keel, and a kernel's mean of it is low.

use std::f64::consts::{FRAC_PI_2, PI};

use serde::{Deserialize, Serialize};

/// The fit starts where the kernel no longer reaches the water beyond the keel, at 2h/sin 2β along the face, times this [-].
const FROM: f64 = 1.7;
/// It ends at this share of the face below the still water [-].
const TO: f64 = 0.4;
/// The least ratio of its end to its start [-].
const LEAST_RANGE: f64 = 1.6;
/// Points of the fit.
const POINTS: usize = 64;
/// Largest share of the keel's pressure that the law may add to the pressure where the fit starts [-]: 0.31 to 0.33 gave an error of
/// 2 %, 0.38 to 0.41 of 6 %, 0.45 and more of 4 to 20 %.
pub const LARGEST_SHARE: f64 = 0.35;

/// Exponent m of the pressure's fall along the face from the keel, for a deadrise β [rad]; 1 at π/6, 0 at π/2.
pub fn exponent(deadrise: f64) -> f64 {
    2.0 * (PI / (FRAC_PI_2 + deadrise) - 1.0)
}

/// The law of the keel of one wedge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeelLaw {
    exponent: f64,
    /// Start of the fit along the face [m].
    pub from: f64,
    sin: f64,
}

/// The law, fitted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeelPressure {
    /// Pressure at the keel p₀, in the unit of the points.
    pub pressure: f64,
    /// C, in that unit over m^`exponent`.
    fall: f64,
    exponent: f64,
    /// Share of `pressure` that the law adds to the pressure where the fit starts [-].
    pub share: f64,
}

impl KeelLaw {
    /// For a deadrise [rad] and a kernel's support 2h [m]; `None` where the pressure at the keel has no cusp.
    pub fn new(deadrise: f64, support: f64) -> Option<KeelLaw> {
        let exponent = exponent(deadrise);
        let from = FROM * support / (2.0 * deadrise).sin();
        (exponent < 1.0 && exponent > 0.0).then(|| KeelLaw { exponent, from, sin: deadrise.sin() })
    }

    /// Fit p₀ and C to pressures along the face, read at distances from the keel [m], at a draught [m]; `None` where the face below
    /// the still water is too short.
    pub fn fit(&self, draught: f64, pressure: impl Fn(f64) -> f64) -> Option<KeelPressure> {
        let face = draught / self.sin;
        let to = (TO * face).max(LEAST_RANGE * self.from);
        if to > face {
            return None;
        }
        let at = |k: usize| self.from + (to - self.from) * (k as f64 + 0.5) / POINTS as f64;
        let points: Vec<[f64; 2]> = (0..POINTS).map(|k| [at(k).powf(self.exponent), pressure(at(k))]).collect();
        let n = POINTS as f64;
        let [x, y] = [0, 1].map(|c| points.iter().map(|p| p[c]).sum::<f64>() / n);
        let (xy, xx) = points.iter().fold((0.0, 0.0), |(xy, xx), p| {
            let d = p[0] - x;
            (xy + d * (p[1] - y), xx + d * d)
        });
        let fall = -xy / xx;
        let pressure = y + fall * x;
        let share = fall * self.from.powf(self.exponent) / pressure;
        Some(KeelPressure { pressure, fall, exponent: self.exponent, share })
    }
}

impl KeelPressure {
    /// The law at a distance from the keel [m].
    pub fn at(&self, distance: f64) -> f64 {
        self.pressure - self.fall * distance.powf(self.exponent)
    }

    /// True where the law adds so little to what was read that the pressure at the keel is known to some 2 %.
    pub fn is_resolved(&self) -> bool {
        (0.0..=LARGEST_SHARE).contains(&self.share) && self.pressure > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cusp_is_read_at_its_apex_and_a_long_reach_is_refused() {
        let deadrise = 60_f64.to_radians();
        assert!((exponent(deadrise) - 0.4).abs() < 1e-12);
        let (fine, coarse) = (KeelLaw::new(deadrise, 0.05).unwrap(), KeelLaw::new(deadrise, 0.25).unwrap());
        let cusp = |r: f64| 2.0 - r.powf(0.4);
        let found = fine.fit(1.0, cusp).expect("a face");
        assert!((found.pressure - 2.0).abs() < 1e-12 && (found.at(0.3) - cusp(0.3)).abs() < 1e-12);
        assert!(found.is_resolved() && (found.share - 0.5 * fine.from.powf(0.4)).abs() < 1e-12);
        assert!(!coarse.fit(1.0, cusp).expect("a face").is_resolved());
        assert_eq!(coarse.fit(0.5, cusp), None, "a face of 2.3 supports");
        assert!(!fine.fit(1.0, |r| 1.0 + r).expect("a face").is_resolved(), "a pressure that rises");
        assert_eq!(KeelLaw::new(30_f64.to_radians() - 1e-9, 0.05), None);
    }
}
