//! How long a projection's step is, and where particles are put besides where they flow (THEORY I13, I14).

use crate::fluid::Fluid;
use crate::sweep;
use crate::walls::Walls;

/// Longest shift in a step, in smoothing lengths.
const LONGEST_SHIFT: f64 = 0.05;
/// Share of √(h/|g|) a step may take (Monaghan 1992).
const FALL: f64 = 0.25;
/// A step is at most so many times the one before: pressures go with 1/Δt.
const GROWTH: f64 = 1.1;

impl Fluid {
    /// I13: shifting, along the surface near air.
    pub(super) fn rearrange(&mut self, dt: f64) {
        if !self.parameters.shifting {
            return;
        }
        let strength = self.parameters.projecting.shift;
        let p = &mut self.particles;
        for k in 0..p.x.len() {
            let crowding = self.derived.surroundings[k].crowding;
            let scale = -2.0 * strength * p.h[k] * dt * p.u[k].hypot(p.v[k]);
            let mut shift = crowding.map(|c| scale * c);
            let exposed = self.projection.air.exposure[k];
            if exposed > 0.0 {
                // −∇C is the surface's normal there: what is left of a shift along ∇C is nothing of its exposed share
                shift = shift.map(|s| (1.0 - exposed) * s);
            }
            let limit = LONGEST_SHIFT * p.h[k];
            let shrink = limit / shift[0].hypot(shift[1]).max(limit);
            p.x[k] += shrink * shift[0];
            p.y[k] += shrink * shift[1];
        }
    }

    /// Smallest smoothing length [m].
    pub(crate) fn least_length(&self) -> f64 {
        sweep::least(self.particles.len(), |k| self.particles.h[k])
    }

    /// I14: the step of a projection [s].
    pub(crate) fn projection_dt(&self, walls: &Walls) -> f64 {
        let (p, q, cfl) = (&self.particles, &self.parameters, self.courant());
        let limit = |h: f64, u: f64, v: f64| cfl * h / u.hypot(v);
        let of_fluid = |k: usize| limit(p.h[k], p.u[k], p.v[k]);
        let of_wall = |k: usize| limit(walls.h[k], walls.u[k], walls.v[k]);
        let h = self.least_length();
        let g = q.gravity[0].hypot(q.gravity[1]);
        let cap = (cfl * h / q.speed).min(FALL * (h / g).sqrt());
        let now = sweep::least(p.len(), of_fluid).min(sweep::least(walls.len(), of_wall)).min(cap);
        if self.projection.last_dt > 0.0 { now.min(GROWTH * self.projection.last_dt) } else { now }
    }
}
