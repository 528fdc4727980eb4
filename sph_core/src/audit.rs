//! What the fluid holds: momentum, energy, volume (THEORY E21, E22). Sums run in the particles' order,
//! on one thread, so that their bits do not depend on threads.

use crate::fluid::Fluid;

/// Energies of the fluid per metre of span [J/m].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FluidEnergy {
    /// Σ ½ m v².
    pub kinetic: f64,
    /// −Σ m g·r.
    pub potential: f64,
    /// Σ m ∫ p/ρ² dρ (E22); of a gas Σ m (e − e₀ + p₀/ρ − p₀/ρ₀), heat included (L10).
    pub elastic: f64,
}

impl FluidEnergy {
    /// All of it [J/m].
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential + self.elastic
    }
}

impl Fluid {
    /// Σ m v [N s/m]; with a mirror plane, of both halves.
    pub fn momentum(&self) -> [f64; 2] {
        let p = &self.particles;
        let sum = |v: &[f64]| p.mass.iter().zip(v).map(|(m, v)| m * v).sum::<f64>();
        match self.parameters.mirror {
            Some(_) => [0.0, 2.0 * sum(&p.v)],
            None => [sum(&p.u), sum(&p.v)],
        }
    }

    /// Σ m [kg/m]; with a mirror plane, of both halves.
    pub fn mass(&self) -> f64 {
        self.halves() * self.particles.mass.iter().sum::<f64>()
    }

    /// Σ m/ρ [m²]; with a mirror plane, of both halves.
    pub fn volume(&self) -> f64 {
        let p = &self.particles;
        self.halves() * p.mass.iter().zip(&p.rho).map(|(m, rho)| m / rho).sum::<f64>()
    }

    /// Energies [J/m]; with a mirror plane, of both halves.
    pub fn energy(&self) -> FluidEnergy {
        let (p, g, eos) = (&self.particles, self.parameters.gravity, self.parameters.eos);
        let mut e = FluidEnergy::default();
        let b = eos.rho0 * eos.c0 * eos.c0 / eos.gamma;
        for k in 0..p.len() {
            let s = p.rho[k] / eos.rho0;
            let growth = if eos.gamma == 1.0 { s.ln() } else { (s.powf(eos.gamma - 1.0) - 1.0) / (eos.gamma - 1.0) };
            e.kinetic += 0.5 * p.mass[k] * (p.u[k] * p.u[k] + p.v[k] * p.v[k]);
            e.potential -= p.mass[k] * (g[0] * p.x[k] + g[1] * p.y[k]);
            e.elastic += match self.parameters.gas {
                None => p.mass[k] * b / eos.rho0 * (growth + 1.0 / s - 1.0),
                Some(gas) => p.mass[k] * gas.energy_over_rest(p.rho[k], p.energy[k]),
            };
        }
        let halves = self.halves();
        FluidEnergy { kinetic: halves * e.kinetic, potential: halves * e.potential, elastic: halves * e.elastic }
    }

    /// Fastest particle [m/s].
    pub fn top_speed(&self) -> f64 {
        let p = &self.particles;
        -crate::sweep::least(p.len(), |k| -p.u[k].hypot(p.v[k]))
    }

    fn halves(&self) -> f64 {
        if self.parameters.mirror.is_some() { 2.0 } else { 1.0 }
    }
}
