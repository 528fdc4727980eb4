//! Updates that only the steps of 2010 need apart, one line per equation.

use crate::parallel;
use crate::system::ParticleSystem;
use crate::timers::Phase;

/// x ← x + Δt v.
pub(super) fn drift(system: &mut ParticleSystem, dt: f64) {
    let p = &mut system.particles;
    parallel::each([&mut p.x, &mut p.y], |at, [x, y]| {
        let (u, v) = (&p.u[at.clone()], &p.v[at]);
        for k in 0..u.len() {
            x[k] += dt * u[k];
            y[k] += dt * v[k];
        }
    });
}

/// ρ ← ρ (2 + ε)/(2 − ε), ε = Δt (dρ/dt)/ρ with the rate at the step's middle: of second order.
pub(super) fn advance_density_midpoint(system: &mut ParticleSystem, density_rate: &[f64], dt: f64) {
    system.timers.begin(Phase::Integration);
    parallel::each([&mut system.particles.rho], |at, [rho]| {
        let rate = &density_rate[at];
        for k in 0..rate.len() {
            let (twice, change) = (2.0 * rho[k], dt * rate[k]); // ε = change/ρ
            rho[k] *= (twice + change) / (twice - change);
        }
    });
}
