//! How long a projection's step is, and where particles are put besides where they flow (THEORY I13, I14).

use crate::fluid::Fluid;
use crate::parallel;
use crate::walls::Walls;

/// Longest shift in a step, in smoothing lengths.
const LONGEST_SHIFT: f64 = 0.05;
/// Share of √(h/|g|) a step may take (Monaghan 1992).
const FALL: f64 = 0.25;
/// A step is at most so many times the one before: pressures go with 1/Δt.
const GROWTH: f64 = 1.1;

impl Fluid {
    /// I1: u' = u + Δt a, r' = r + Δt u' + δr (I13: shifting, along the surface near air).
    pub(crate) fn advance(&mut self, dt: f64) {
        let strength = if self.parameters.shifting { self.parameters.projecting.shift } else { 0.0 };
        let (surroundings, exposure) = (&self.derived.surroundings, &self.projection.air.exposure);
        let p = &mut self.particles;
        let (ax, ay, h) = (&p.ax, &p.ay, &p.h);
        parallel::update_both(&mut p.u, &mut p.v, |k, u, v| {
            *u += dt * ax[k];
            *v += dt * ay[k];
        });
        let (u, v) = (&p.u, &p.v);
        parallel::update_both(&mut p.x, &mut p.y, |k, x, y| {
            let scale = -2.0 * strength * h[k] * dt * (u[k] * u[k] + v[k] * v[k]).sqrt();
            // −∇C is the surface's normal there: what is left of a shift along ∇C is nothing of its exposed share
            let [a, b] = surroundings[k].crowding().map(|c| (1.0 - exposure[k]) * (scale * c));
            let limit = LONGEST_SHIFT * h[k];
            let shrink = limit / (a * a + b * b).sqrt().max(limit);
            *x += dt * u[k] + shrink * a;
            *y += dt * v[k] + shrink * b;
        });
    }

    /// Smallest smoothing length [m].
    pub(crate) fn least_length(&self) -> f64 {
        parallel::least(self.particles.len(), |k| self.particles.h[k])
    }

    /// I14: the step of a projection [s].
    pub(crate) fn projection_dt(&self, walls: &Walls) -> f64 {
        let (p, q, cfl) = (&self.particles, &self.parameters, self.courant());
        let limit = |h: f64, u: f64, v: f64| cfl * h / (u * u + v * v).sqrt();
        let of_fluid = |k: usize| limit(p.h[k], p.u[k], p.v[k]);
        let of_wall = |k: usize| limit(walls.h[k], walls.u[k], walls.v[k]);
        let h = self.least_length();
        let g = q.gravity[0].hypot(q.gravity[1]);
        let cap = (cfl * h / q.speed).min(FALL * (h / g).sqrt());
        let now = parallel::least(p.len(), of_fluid).min(parallel::least(walls.len(), of_wall)).min(cap);
        if self.projection.last_dt > 0.0 { now.min(GROWTH * self.projection.last_dt) } else { now }
    }
}
