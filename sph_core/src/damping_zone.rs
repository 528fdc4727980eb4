//! A zone at an end of the water in which its motion is damped: a beach that absorbs waves (THEORY WA15), or a relaxation zone that leads
//! the water to a wave that is known (THEORY WA16).

use serde::{Deserialize, Serialize};

use crate::fluid::Fluid;
use crate::parallel;

/// v ← v exp(−γ(x) Δt), γ = γ₁ s², s = (x − x₀)/L from 0 at the start of the zone to 1 at its end and behind; L < 0: the zone is left of
/// x₀.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DampingZone {
    /// Where it starts x₀ [m].
    pub from: f64,
    /// Its length L [m], not 0.
    pub length: f64,
    /// Rate γ₁ at its end [1/s], not below 0.
    pub rate: f64,
}

/// What a damping zone took from the water.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Damped {
    /// Impulse on the water [N s/m]; with a mirror plane, of both halves.
    pub impulse: [f64; 2],
    /// Kinetic energy lost by the water [J/m]; with a mirror plane, of both halves.
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
        self.relax(zone, |_| [0.0; 2], dt)
    }

    /// WA16: damp what the velocity in the zone differs by from `target` [m/s], a function of the place [m], over `dt` [s], after a step;
    /// what was taken from the water.
    pub fn relax(&mut self, zone: &DampingZone, target: impl Fn([f64; 2]) -> [f64; 2] + Sync, dt: f64) -> Damped {
        let p = self.particles();
        let relaxed = |x: f64, y: f64, u: f64, v: f64| {
            let kept = zone.factor(x, dt);
            if kept == 1.0 {
                return [u, v];
            }
            let [tu, tv] = target([x, y]);
            [tu + kept * (u - tu), tv + kept * (v - tv)]
        };
        let of = |k: usize| {
            let (m, u, v) = (p.mass[k], p.u[k], p.v[k]);
            let [to_u, to_v] = relaxed(p.x[k], p.y[k], u, v);
            [m * (to_u - u), m * (to_v - v), 0.5 * m * (u * u + v * v - to_u * to_u - to_v * to_v)]
        };
        let [ju, jv, energy] = parallel::sum(p.len(), of);
        let halves = if self.domain().mirror.is_some() { 2.0 } else { 1.0 };
        let p = self.particles_mut();
        let (x, y) = (&p.x, &p.y);
        parallel::update_both(&mut p.u, &mut p.v, |k, u, v| [*u, *v] = relaxed(x[k], y[k], *u, *v));
        let along = if halves > 1.0 { 0.0 } else { ju };
        Damped { impulse: [along, halves * jv], energy: halves * energy }
    }
}
