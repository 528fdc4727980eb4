//! Equation of state (THEORY WC2).

use serde::{Deserialize, Serialize};

/// Exponent γ of water (Cole 1948) [-].
pub const WATER_EXPONENT: f64 = 7.0;

/// Tait's law p = B[(ρ/ρ₀)^γ − 1], B = ρ₀c₀²/γ (Cole 1948; γ = 1 is the linear law).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tait {
    /// Reference density ρ₀ [kg/m³].
    pub rho0: f64,
    /// Sound speed at ρ₀, c₀ [m/s].
    pub c0: f64,
    /// Exponent γ [-].
    pub gamma: f64,
}

impl Tait {
    /// Pressure [Pa] of a density [kg/m³].
    #[inline]
    pub fn pressure(&self, rho: f64) -> f64 {
        let compression = rho / self.rho0;
        let b = self.rho0 * self.c0 * self.c0 / self.gamma;
        if self.gamma == WATER_EXPONENT {
            let c2 = compression * compression;
            b * (c2 * c2 * c2 * compression - 1.0)
        } else if self.gamma == 1.0 {
            b * (compression - 1.0)
        } else {
            b * (compression.powf(self.gamma) - 1.0)
        }
    }

    /// Elastic energy over that at ρ₀ [J/kg] (THEORY CO28): ∫ p/ρ² dρ.
    #[inline]
    pub fn energy(&self, rho: f64) -> f64 {
        let s = rho / self.rho0;
        let growth = if self.gamma == WATER_EXPONENT {
            let s2 = s * s;
            (s2 * s2 * s2 - 1.0) / 6.0
        } else if self.gamma == 1.0 {
            s.ln()
        } else {
            (s.powf(self.gamma - 1.0) - 1.0) / (self.gamma - 1.0)
        };
        self.c0 * self.c0 / self.gamma * (growth + 1.0 / s - 1.0)
    }

    /// Density [kg/m³] of a pressure [Pa]; the inverse of [`Tait::pressure`], valid for p > −B.
    pub fn density(&self, pressure: f64) -> f64 {
        let b = self.rho0 * self.c0 * self.c0 / self.gamma;
        self.rho0 * (1.0 + pressure / b).max(0.0).powf(1.0 / self.gamma)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn density_and_pressure_are_inverse_for_every_exponent() {
        for gamma in [1.0, 1.4, 7.0] {
            let law = Tait { rho0: 1000.0, c0: 60.0, gamma };
            for p in [-2e4, 0.0, 1e3, 4e5] {
                assert!((law.pressure(law.density(p)) - p).abs() < 1e-6 * p.abs().max(1.0), "gamma {gamma}, p {p}");
            }
        }
    }

    /// CO28: the slope of the energy over ρ is p/ρ².
    #[test]
    fn elastic_energy_is_the_work_of_the_pressure() {
        for gamma in [1.0, 1.4, 7.0] {
            let law = Tait { rho0: 1000.0, c0: 60.0, gamma };
            assert_eq!(law.energy(1000.0), 0.0);
            for rho in [960.0, 1010.0, 1100.0] {
                let slope = (law.energy(rho + 0.01) - law.energy(rho - 0.01)) / 0.02;
                let work = law.pressure(rho) / (rho * rho);
                assert!((slope / work - 1.0).abs() < 1e-6, "gamma {gamma}, rho {rho}: {slope}, {work}");
            }
        }
    }

    #[test]
    fn the_slope_at_rest_is_the_sound_speed_squared() {
        for gamma in [1.0, 1.4, 7.0] {
            let law = Tait { rho0: 1000.0, c0: 60.0, gamma };
            let slope = (law.pressure(1000.001) - law.pressure(999.999)) / 0.002;
            assert!((slope / 3600.0 - 1.0).abs() < 1e-6);
        }
    }
}
