//! A zone at the right end of the water in which its motion is damped: a beach that absorbs waves (THEORY WA15).

use serde::{Deserialize, Serialize};

use crate::fluid::Fluid;
use crate::parallel;

/// v ← v exp(−γ(x) Δt), γ = γ₁ s², s = (x − x₀)/L from 0 at the start of the zone to 1 at its end and behind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DampingZone {
    /// Where it starts x₀ [m].
    pub from: f64,
    /// Its length L [m], above 0.
    pub length: f64,
    /// Rate γ₁ at its end [1/s], not below 0.
    pub rate: f64,
}

/// What a damping zone took from the water.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Damped {
    /// Impulse on the water [N s/m]; with a mirror plane, of both halves.
    pub impulse: [f64; 2],
    /// Kinetic energy lost by the water, not below 0 [J/m]; with a mirror plane, of both halves.
    pub energy: f64,
}

impl DampingZone {
    /// Factor of the velocity at x [m] in a step of `dt` [s] [-].
    fn factor(&self, x: f64, dt: f64) -> f64 {
        let s = ((x - self.from) / self.length).clamp(0.0, 1.0);
        if s > 0.0 { (-self.rate * s * s * dt).exp() } else { 1.0 }
    }
}

impl Fluid {
    /// WA15: damp the water in the zone over `dt` [s], after a step; what was taken from it.
    pub fn damp(&mut self, zone: &DampingZone, dt: f64) -> Damped {
        let p = self.particles();
        let of = |k: usize| {
            let (m, u, v, kept) = (p.mass[k], p.u[k], p.v[k], zone.factor(p.x[k], dt));
            [m * u * (kept - 1.0), m * v * (kept - 1.0), 0.5 * m * (u * u + v * v) * (1.0 - kept * kept)]
        };
        let [ju, jv, energy] = parallel::sum(p.len(), of);
        let halves = if self.domain().mirror.is_some() { 2.0 } else { 1.0 };
        let p = self.particles_mut();
        let x = &p.x;
        parallel::update_both(&mut p.u, &mut p.v, |k, u, v| {
            let kept = zone.factor(x[k], dt);
            (*u, *v) = (kept * *u, kept * *v);
        });
        let along = if halves > 1.0 { 0.0 } else { ju };
        Damped { impulse: [along, halves * jv], energy: halves * energy }
    }
}
