//! Updates of the particles in a step that ask each particle only about itself, one line per equation.

use crate::parallel;
use crate::system::ParticleSystem;
use crate::timers::Phase;

/// v ← v + Δt a.
pub(crate) fn kick(system: &mut ParticleSystem, dt: f64) {
    system.timers.begin(Phase::Integration);
    let p = &mut system.particles;
    parallel::each([&mut p.u, &mut p.v], |at, [u, v]| {
        let (ax, ay) = (&p.ax[at.clone()], &p.ay[at]);
        for k in 0..ax.len() {
            u[k] += dt * ax[k];
            v[k] += dt * ay[k];
        }
    });
}

/// v ← v + ½Δt a, then x ← x + ½Δt v, in one pass.
pub(crate) fn kick_and_drift(system: &mut ParticleSystem, half: f64) {
    system.timers.begin(Phase::Integration);
    let p = &mut system.particles;
    parallel::each([&mut p.x, &mut p.y, &mut p.u, &mut p.v], |at, [x, y, u, v]| {
        let (ax, ay) = (&p.ax[at.clone()], &p.ay[at]);
        for k in 0..ax.len() {
            u[k] += half * ax[k];
            v[k] += half * ay[k];
            x[k] += half * u[k];
            y[k] += half * v[k];
        }
    });
}

/// ρ ← ρ (2 + ε)/(2 − ε), ε = Δt (dρ/dt)/ρ with the rate at the step's middle, of second order; and x ← x + ½Δt v, in one pass.
pub(crate) fn advance_density_and_drift(system: &mut ParticleSystem, density_rate: &[f64], dt: f64) {
    system.timers.begin(Phase::Integration);
    let (p, half) = (&mut system.particles, 0.5 * dt);
    parallel::each([&mut p.x, &mut p.y, &mut p.rho], |at, [x, y, rho]| {
        let (u, v, rate) = (&p.u[at.clone()], &p.v[at.clone()], &density_rate[at]);
        for k in 0..rate.len() {
            let (twice, change) = (2.0 * rho[k], dt * rate[k]); // ε = change/ρ
            rho[k] *= (twice + change) / (twice - change);
            x[k] += half * u[k];
            y[k] += half * v[k];
        }
    });
}
