//! Mass, momentum, energy and volume of the fluid (THEORY CO27, CO28). Sums are taken by chunks, in order, so that their bits do
//! not depend on the number of threads.

use crate::domain::Domain;
use crate::parallel;
use crate::particles::Particles;

/// Energies of the fluid per metre of span [J/m].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FluidEnergy {
    /// Σ ½ m v².
    pub kinetic: f64,
    /// −Σ m g·r.
    pub potential: f64,
    /// Σ m ∫ p/ρ² dρ (CO28); of a gas Σ m (e − e₀ + p₀/ρ − p₀/ρ₀), heat included (LE12).
    pub elastic: f64,
}

impl FluidEnergy {
    /// Sum of all three [J/m].
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential + self.elastic
    }
}

/// Totals of the fluid at one time, per metre of span; with a mirror plane, of both halves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals {
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

/// Mass, momentum, energy and volume of the particles, in one pass. `internal` gives the internal energy of a particle [J/kg].
pub(crate) fn totals(p: &Particles, domain: &Domain, internal: impl Fn(usize) -> f64 + Sync) -> Totals {
    let of = |k: usize| {
        let (m, u, v) = (p.mass[k], p.u[k], p.v[k]);
        [m, m * u, m * v, 0.5 * m * (u * u + v * v), m * p.x[k], m * p.y[k], m * internal(k), m / p.rho[k]]
    };
    let ([mass, mu, mv, kinetic, mx, my, elastic, volume], top_speed) =
        parallel::within_pool(|| (parallel::sum(p.len(), of), top_speed(p)));
    let (halves, g) = (halves(domain), domain.gravity);
    let potential = -(g[0] * mx + g[1] * my);
    Totals {
        mass: halves * mass,
        momentum: of_both_halves(domain, [mu, mv]),
        energy: FluidEnergy { kinetic: halves * kinetic, potential: halves * potential, elastic: halves * elastic },
        volume: halves * volume,
        height: my / mass,
        top_speed,
    }
}

/// Σ m v and Σ m |v| [N s/m]; with a mirror plane, the first of both halves, the second of one.
pub(crate) fn momentum_and_its_scale(p: &Particles, domain: &Domain) -> ([f64; 2], f64) {
    let [mu, mv, held] = parallel::sum(p.len(), |k| {
        let (m, u, v) = (p.mass[k], p.u[k], p.v[k]);
        [m * u, m * v, m * (u * u + v * v).sqrt()]
    });
    (of_both_halves(domain, [mu, mv]), held)
}

/// Speed of the fastest particle [m/s].
pub(crate) fn top_speed(p: &Particles) -> f64 {
    (-parallel::least(p.len(), |k| -(p.u[k] * p.u[k] + p.v[k] * p.v[k]))).sqrt()
}

/// Copies of the simulated water: 2 with a mirror plane.
pub(crate) fn halves(domain: &Domain) -> f64 {
    if domain.mirror.is_some() { 2.0 } else { 1.0 }
}

fn of_both_halves(domain: &Domain, momentum: [f64; 2]) -> [f64; 2] {
    if domain.mirror.is_some() { [0.0, 2.0 * momentum[1]] } else { momentum }
}
