//! The ideal gas: equation of state (THEORY LE11) and the energy equation that goes with it (LE12).

use serde::{Deserialize, Serialize};

use crate::forces::PairTerms;
use crate::interactions::dissipation::{PairDissipation, WithPairs, with_pairs};
use crate::interactions::geometry::{PairConstants, pair_geometry};
use crate::interactions::pair;
use crate::kernel::Shape;
use crate::legacy::fluid_pairs;
use crate::parallel;
use crate::system::ParticleSystem;

/// Molar gas constant R [J/(mol K)] (exact in the SI of 2019).
pub(crate) const GAS_CONSTANT: f64 = 8.314_462_618_153_24;

/// LE11: p = ρ R T/M − p₀, with T = (γ − 1) M e/R and p₀ = ρ₀ R T₀/M: the pressure over that of the gas at rest, so that a
/// free surface is one of the pressure p₀. (M. Pilorget 2010, eq. 15, has the absolute pressure.)
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct IdealGas {
    /// Density at rest ρ₀ [kg/m³].
    pub rho0: f64,
    /// Ratio of specific heats γ [-], above 1.
    pub gamma: f64,
    /// Temperature at rest T₀ [K].
    pub temperature: f64,
    /// Molar mass M [kg/mol].
    pub molar_mass: f64,
}

impl IdealGas {
    /// Specific internal energy e₀ = R T₀/((γ − 1) M) of the gas at rest [J/kg].
    pub fn energy_at_rest(&self) -> f64 {
        GAS_CONSTANT * self.temperature / ((self.gamma - 1.0) * self.molar_mass)
    }

    /// Absolute pressure p₀ of the gas at rest [Pa].
    pub fn ambient(&self) -> f64 {
        self.rho0 * GAS_CONSTANT * self.temperature / self.molar_mass
    }

    /// Pressure over p₀ [Pa] at density [kg/m³] and specific internal energy [J/kg].
    #[inline]
    pub fn pressure(&self, rho: f64, energy: f64) -> f64 {
        (self.gamma - 1.0) * rho * energy - self.ambient()
    }

    /// Density [kg/m³] of a pressure over p₀ [Pa] at specific internal energy [J/kg]; the inverse of [`IdealGas::pressure`].
    pub fn density(&self, pressure: f64, energy: f64) -> f64 {
        (pressure + self.ambient()) / ((self.gamma - 1.0) * energy)
    }

    /// e − e₀ + p₀/ρ − p₀/ρ₀ [J/kg]: what the gas holds over its state at rest, under the pressure p₀ around it.
    pub(crate) fn energy_over_rest(&self, rho: f64, energy: f64) -> f64 {
        energy - self.energy_at_rest() + self.ambient() * (1.0 / rho - 1.0 / self.rho0)
    }

    /// Factor on the density [-], at least 1, that brings gas thinner than p₀ allows back to p₀ along its isentrope.
    fn isentropic_relief(&self, rho: f64, energy: f64) -> f64 {
        let absolute = (self.gamma - 1.0) * rho * energy;
        (self.ambient() / absolute).powf(1.0 / self.gamma).max(1.0)
    }

    /// Speed of sound √(γ (γ − 1) e) [m/s]; √(γ R T₀/M) at rest.
    pub fn sound_speed(&self, energy: f64) -> f64 {
        (self.gamma * (self.gamma - 1.0) * energy.max(0.0)).sqrt()
    }

    /// Speed of sound at rest [m/s].
    pub fn sound_speed_at_rest(&self) -> f64 {
        self.sound_speed(self.energy_at_rest())
    }
}

/// LE12 for every fluid particle.
struct Heating<'a> {
    system: &'a ParticleSystem,
    constants: PairConstants,
    ambient: f64,
    out: &'a mut [Heat],
}

impl WithPairs for Heating<'_> {
    fn with<K: Shape, D: PairDissipation>(self) {
        let Heating { system, constants, ambient, out } = self;
        parallel::gather_into(out, |k| heating::<K, D>(system, k, &constants, ambient));
    }
}

/// What LE12 gathers.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Heat {
    /// Work of pressures and viscosity that stays in the particle [W/m].
    power: f64,
    /// −∇·v [1/s], as the continuity equation has it (WC3, WA4).
    compression: f64,
}

/// LE12: half of the power that the pair's absolute pressures and viscosity take from its motion; all of what a wall gives.
#[inline(always)]
fn heating<K: Shape, D: PairDissipation>(system: &ParticleSystem, k: usize, c: &PairConstants, ambient: f64) -> Heat {
    let (a, mut heat) = (&system.packed.fluid[k], Heat::default());
    for (_, b, ab) in fluid_pairs::<K>(system, k) {
        let (du, dv) = (a.u - b.u, a.v - b.v);
        let [normal, shear] = pair::force::<f64, D>(a, b, &ab, c, c.nu).map(|part| a.volume * part);
        let f = [normal * ab.dx + shear * du, normal * ab.dy + shear * dv];
        let approach = (du * ab.dx + dv * ab.dy) * ab.grad_factor;
        heat.compression += b.volume * approach;
        heat.power += a.volume * b.volume * ambient * approach - 0.5 * (f[0] * du + f[1] * dv);
    }
    for j in system.neighbours.walls_of_fluid.of(k) {
        let (w, face) = (&system.packed.walls[j as usize], &system.packed.packed_walls[j as usize]);
        let Some(aw) = pair_geometry::<K>(a.x, a.y, a.h, w.x, w.y, w.h) else { continue };
        let approach = a.u * face.nx + a.v * face.ny - face.vn;
        let approach = approach * (aw.dx * face.nx + aw.dy * face.ny) * aw.grad_factor;
        heat.compression += 2.0 * w.volume * approach;
        heat.power += a.volume * w.volume * (a.p + w.p + 2.0 * ambient) * approach;
    }
    heat
}

/// LE12: de/dt with the packed particles and the density rate of this moment.
pub(crate) fn heating_rates(
    system: &ParticleSystem,
    terms: &PairTerms,
    gas: IdealGas,
    density_rate: &[f64],
    out: &mut Vec<f64>,
) {
    let mut heat = vec![Heat::default(); system.particles.len()];
    let sum = Heating { system, constants: terms.constants, ambient: gas.ambient(), out: &mut heat };
    with_pairs(system.domain.fluid.kernel, terms.dissipation, sum);
    let p = &system.particles;
    out.resize(p.len(), 0.0);
    for (k, heat) in heat.iter().enumerate() {
        let diffused = density_rate[k] - p.rho[k] * heat.compression; // WC4, along the isentrope
        let along = (gas.gamma - 1.0) * p.energy[k] / p.rho[k];
        out[k] = heat.power / p.mass[k] + along * diffused;
    }
}

/// LE11: pressures from densities and energies. Tensionless fluid is compressed along its isentrope to p₀, or it would lose p₀ times the
/// volume each time and grow ever colder.
pub(crate) fn gas_state(system: &mut ParticleSystem, gas: IdealGas, ventilation: bool) {
    let (p, fields) = (&mut system.particles, &mut system.fields);
    for k in 0..p.x.len() {
        if fields.moments[k].tensionless(fields.near_surface[k], ventilation) {
            let relief = gas.isentropic_relief(p.rho[k], p.energy[k]);
            p.rho[k] *= relief;
            p.energy[k] *= relief.powf(gas.gamma - 1.0);
        }
        fields.pressure[k] = gas.pressure(p.rho[k], p.energy[k]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AIR: IdealGas = IdealGas { rho0: 1.225, gamma: 1.4, temperature: 288.15, molar_mass: 0.028_964_4 };

    #[test]
    fn air_at_rest_has_the_standard_atmosphere_s_pressure_and_sound() {
        assert!((AIR.ambient() - 101_325.0).abs() < 10.0, "{} Pa", AIR.ambient());
        assert!((AIR.sound_speed_at_rest() - 340.29).abs() < 0.02, "{} m/s", AIR.sound_speed_at_rest());
        assert!(AIR.pressure(AIR.rho0, AIR.energy_at_rest()).abs() < 1e-9);
    }

    #[test]
    fn density_and_pressure_are_inverse() {
        for (pressure, energy) in [(0.0, 2e5), (-3e4, 1e5), (5e5, 4e5)] {
            let again = AIR.pressure(AIR.density(pressure, energy), energy);
            assert!((again - pressure).abs() < 1e-6, "{pressure}: {again}");
        }
    }
}
