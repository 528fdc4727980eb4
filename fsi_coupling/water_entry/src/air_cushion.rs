//! Air that a flat bottom traps when it meets water (THEORY WC27).

use std::f64::consts::PI;

/// Largest pressure over the speed at contact [Pa s/m]: 4.5 psi per ft/s (Chuang 1967).
const PRESSURE_PER_SPEED: f64 = 4.5 * 6894.757 / 0.3048;
/// Speed of sound in air [m/s].
const SOUND_IN_AIR: f64 = 340.3;
/// Decay of the pulse over its duration [-].
const DECAY: f64 = 1.4;

/// Largest slope of a bottom that traps air over all of its breadth [deg].
pub const LARGEST_SLOPE_DEG: f64 = 1.0;

/// The cushion of air between a flat bottom and calm water (S. L. Chuang, Experiments on flat-bottom slamming, J. Ship Research 10, 1966,
/// 10–17; T of Chuang's two-dimensional theory).
///
/// Measured with a steel plate 0.51 m broad; the mass of the body does not appear, as the plate was much heavier than its added mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AirCushion {
    /// Half of the flat breadth b [m].
    pub half_breadth: f64,
    /// Downward speed at contact V [m/s].
    pub speed: f64,
}

impl AirCushion {
    /// Largest pressure [Pa].
    pub fn largest_pressure(&self) -> f64 {
        PRESSURE_PER_SPEED * self.speed
    }

    /// Duration of the pulse T = 4 b/c_air [s].
    pub fn duration(&self) -> f64 {
        4.0 * self.half_breadth / SOUND_IN_AIR
    }

    /// Pressure [Pa] at time t after contact [s]: 2 p_max e^(−1.4 t/T) sin(π t/T), 0 outside the pulse.
    pub fn pressure(&self, time: f64) -> f64 {
        let s = time / self.duration();
        let within = (0.0..=1.0).contains(&s);
        if within { 2.0 * self.largest_pressure() * (-DECAY * s).exp() * (PI * s).sin() } else { 0.0 }
    }

    /// Integral of the pressure over the pulse [Pa s].
    pub fn impulse(&self) -> f64 {
        let shape = PI * (1.0 + (-DECAY).exp()) / (PI * PI + DECAY * DECAY);
        2.0 * self.largest_pressure() * self.duration() * shape
    }

    /// Speed of sound c [m/s] of water of density ρ [kg/m³] whose pressure at contact, ρ V (c + 2 V) with Tait's exponent 7, is the
    /// largest pressure of the cushion.
    pub fn equivalent_sound_speed(&self, density: f64) -> f64 {
        PRESSURE_PER_SPEED / density - 2.0 * self.speed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CUSHION: AirCushion = AirCushion { half_breadth: 0.25, speed: 3.0 };

    /// A heavy flat bottom gives the water the momentum of its added mass, (π/2) ρ b² V, whatever is between (von Karman 1929).
    #[test]
    fn the_impulse_is_that_of_the_added_mass() {
        let b = CUSHION.half_breadth;
        let impulse = 2.0 * b * CUSHION.impulse() / (0.5 * PI * 1000.0 * b * b * CUSHION.speed);
        assert!((impulse - 1.0).abs() < 0.02, "{impulse}");
    }

    #[test]
    fn water_that_is_as_soft_has_the_largest_pressure() {
        let sound = CUSHION.equivalent_sound_speed(1000.0);
        let hammer = 1000.0 * 3.0 * (sound + 2.0 * 3.0);
        assert!((hammer / CUSHION.largest_pressure() - 1.0).abs() < 1e-12 && (95.0..96.0).contains(&sound), "{sound}");
    }

    #[test]
    fn the_pulse_reaches_its_largest_pressure_and_has_its_impulse() {
        let dt = CUSHION.duration() / 1000.0;
        let pressures: Vec<f64> = (0..=1100).map(|k| CUSHION.pressure(f64::from(k) * dt)).collect();
        let largest = pressures.iter().copied().fold(0.0, f64::max) / CUSHION.largest_pressure();
        assert!((1.0..1.1).contains(&largest), "{largest}");
        let sum = pressures.iter().sum::<f64>() * dt / CUSHION.impulse();
        assert!((sum - 1.0).abs() < 1e-3, "{sum}");
        assert_eq!(pressures[1100], 0.0);
    }
}
