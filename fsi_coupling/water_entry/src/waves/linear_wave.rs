//! Progressive waves of small height (THEORY WA13).

use std::f64::consts::TAU;

/// Height over length of the highest wave on deep water (Michell 1893; Miche 1944) [-].
pub const STEEPEST: f64 = 0.142;
/// Newton steps of the dispersion relation; four give rounding.
const STEPS: usize = 12;

/// A regular wave of small height over a flat floor: ω² = g k tanh(k d) (Airy 1845; Dean & Dalrymple 1991).
///
/// ```
/// use water_entry::waves::linear_wave::LinearWave;
/// let wave = LinearWave::of_length(3.0, 0.5, 9.81);
/// assert!((LinearWave::of_period(wave.period(), 0.5, 9.81).length() - 3.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearWave {
    /// Depth d of the water [m].
    pub depth: f64,
    /// Angular frequency ω [rad/s].
    pub angular_frequency: f64,
    /// Wave number k [rad/m].
    pub wave_number: f64,
}

impl LinearWave {
    /// WA13: the wave of a period [s] on water of a depth [m] under gravity [m/s²], all above 0. The dispersion relation is solved to
    /// rounding by Newton's method, from Eckart's (1952) estimate.
    pub fn of_period(period: f64, depth: f64, gravity: f64) -> LinearWave {
        let angular_frequency = TAU / period;
        let deep = angular_frequency * angular_frequency * depth / gravity;
        let mut kd = deep / deep.tanh().sqrt();
        for _ in 0..STEPS {
            let t = kd.tanh();
            kd -= (kd * t - deep) / (t + kd * (1.0 - t * t));
        }
        LinearWave { depth, angular_frequency, wave_number: kd / depth }
    }

    /// WA13: the wave of a length [m] on water of a depth [m] under gravity [m/s²], all above 0.
    pub fn of_length(length: f64, depth: f64, gravity: f64) -> LinearWave {
        let wave_number = TAU / length;
        let angular_frequency = (gravity * wave_number * (wave_number * depth).tanh()).sqrt();
        LinearWave { depth, angular_frequency, wave_number }
    }

    /// k d [-].
    pub fn kd(&self) -> f64 {
        self.wave_number * self.depth
    }

    /// Period [s].
    pub fn period(&self) -> f64 {
        TAU / self.angular_frequency
    }

    /// Length [m].
    pub fn length(&self) -> f64 {
        TAU / self.wave_number
    }

    /// Speed of the crests ω/k [m/s].
    pub fn phase_speed(&self) -> f64 {
        self.angular_frequency / self.wave_number
    }

    /// Speed of the energy, ½ (ω/k)(1 + 2kd/sinh 2kd) [m/s].
    pub fn group_speed(&self) -> f64 {
        0.5 * self.phase_speed() * (1.0 + self.shallowness())
    }

    /// 2kd/sinh 2kd [-]: 1 in shallow water, 0 in deep water.
    pub(crate) fn shallowness(&self) -> f64 {
        let twice = 2.0 * self.kd();
        twice / twice.sinh()
    }

    /// WA14: height of the wave over the stroke of the piston that makes it [-], 2 (cosh 2kd − 1)/(sinh 2kd + 2kd) (Havelock 1929;
    /// Ursell, Dean & Yu 1960 measured it within 4 % for H/L below 0.03).
    pub fn height_over_stroke(&self) -> f64 {
        2.0 * self.kd().tanh() / (1.0 + self.shallowness())
    }

    /// Largest height of a wave of this length [m], [`STEEPEST`] L tanh kd (Miche 1944).
    pub fn breaking_height(&self) -> f64 {
        STEEPEST * self.length() * self.kd().tanh()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// From shallow to deep water the relation holds to rounding, and period and length give each other back.
        #[test]
        fn dispersion_is_solved_to_rounding(log_length in -2.0..3.0f64, depth in 0.01..50.0f64) {
            let length = depth * 10f64.powf(log_length);
            let wave = LinearWave::of_length(length, depth, 9.81);
            let back = LinearWave::of_period(wave.period(), depth, 9.81);
            prop_assert!((back.length() / length - 1.0).abs() < 1e-12, "{} m for {length} m", back.length());
            let k = back.wave_number;
            let rest = back.angular_frequency.powi(2) / (9.81 * k * (k * depth).tanh()) - 1.0;
            prop_assert!(rest.abs() < 1e-12, "{rest}");
        }
    }

    /// Limits: a piston in shallow water moves kd half as far as the wave is high, in deep water H = 2S; speeds √(g d), and half of
    /// the phase speed.
    #[test]
    fn limits_of_shallow_and_deep_water() {
        let shallow = LinearWave::of_length(1000.0, 1.0, 9.81);
        assert!((shallow.height_over_stroke() / shallow.kd() - 1.0).abs() < 1e-4);
        assert!((shallow.phase_speed() / 9.81_f64.sqrt() - 1.0).abs() < 1e-4);
        assert!((shallow.group_speed() / shallow.phase_speed() - 1.0).abs() < 1e-4);
        let deep = LinearWave::of_length(1.0, 400.0, 9.81);
        assert!((deep.height_over_stroke() - 2.0).abs() < 1e-12 && deep.kd() > 2500.0);
        assert!((deep.group_speed() / deep.phase_speed() - 0.5).abs() < 1e-12);
    }

    /// The formula as it is printed, at kd = 1.5.
    #[test]
    fn the_stroke_is_that_of_the_printed_formula() {
        let wave = LinearWave::of_length(TAU / 1.5, 1.0, 9.81);
        let printed = 2.0 * (3.0_f64.cosh() - 1.0) / (3.0_f64.sinh() + 3.0);
        assert!((wave.height_over_stroke() / printed - 1.0).abs() < 1e-14);
    }
}
