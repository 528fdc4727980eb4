//! What the fluid holds: momentum, energy, volume (THEORY E21, E22). Sums are taken by chunks, in order, so that their
//! bits do not depend on threads.

use crate::fluid::Fluid;
use crate::parallel;

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

/// What the fluid holds at a moment, per metre of span; with a mirror plane, in both halves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Holdings {
    /// Σ m [kg/m].
    pub mass: f64,
    /// Σ m v [N s/m].
    pub momentum: [f64; 2],
    /// Energies [J/m].
    pub energy: FluidEnergy,
    /// Σ m/ρ [m²].
    pub volume: f64,
    /// Σ m y/Σ m [m].
    pub height: f64,
    /// Fastest particle [m/s].
    pub top_speed: f64,
}

impl Fluid {
    /// All that the fluid holds, in one pass.
    pub fn holdings(&self) -> Holdings {
        let (p, g, eos) = (&self.particles, self.parameters.gravity, self.parameters.eos);
        let elastic = |k: usize| match self.parameters.gas {
            None => eos.energy(p.rho[k]),
            Some(gas) => gas.energy_over_rest(p.rho[k], p.energy[k]),
        };
        let of = |k: usize| {
            let (m, u, v) = (p.mass[k], p.u[k], p.v[k]);
            [m, m * u, m * v, 0.5 * m * (u * u + v * v), m * p.x[k], m * p.y[k], m * elastic(k), m / p.rho[k]]
        };
        let ([mass, mu, mv, kinetic, mx, my, elastic, volume], top_speed) =
            parallel::within_pool(|| (parallel::sum(p.len(), of), self.top_speed()));
        let halves = self.halves();
        let potential = -(g[0] * mx + g[1] * my);
        Holdings {
            mass: halves * mass,
            momentum: self.of_both_halves([mu, mv]),
            energy: FluidEnergy { kinetic: halves * kinetic, potential: halves * potential, elastic: halves * elastic },
            volume: halves * volume,
            height: my / mass,
            top_speed,
        }
    }

    /// Σ m v and Σ m |v| [N s/m]; with a mirror plane, the first of both halves, the second of one.
    pub fn momentum_and_its_scale(&self) -> ([f64; 2], f64) {
        let p = &self.particles;
        let [mu, mv, held] = parallel::sum(p.len(), |k| {
            let (m, u, v) = (p.mass[k], p.u[k], p.v[k]);
            [m * u, m * v, m * (u * u + v * v).sqrt()]
        });
        (self.of_both_halves([mu, mv]), held)
    }

    /// Σ m v [N s/m]; with a mirror plane, of both halves.
    pub fn momentum(&self) -> [f64; 2] {
        self.momentum_and_its_scale().0
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
        self.holdings().energy
    }

    /// Fastest particle [m/s].
    pub fn top_speed(&self) -> f64 {
        let p = &self.particles;
        (-parallel::least(p.len(), |k| -(p.u[k] * p.u[k] + p.v[k] * p.v[k]))).sqrt()
    }

    fn halves(&self) -> f64 {
        if self.parameters.mirror.is_some() { 2.0 } else { 1.0 }
    }

    fn of_both_halves(&self, momentum: [f64; 2]) -> [f64; 2] {
        if self.parameters.mirror.is_some() { [0.0, 2.0 * momentum[1]] } else { momentum }
    }
}
