//! The step of a projection, and its motion of the particles (THEORY PR14).

use crate::error::Breakdown;
use crate::parallel;
use crate::system::ParticleSystem;
use crate::walls::Walls;

/// Longest shift in a step, in smoothing lengths.
const LONGEST_SHIFT: f64 = 0.05;
/// Share of √(h/|g|) a step may take (Monaghan 1992).
pub(super) const FREE_FALL: f64 = 0.25;
/// Share of h²/ν a step may take (WC12; Morris et al. 1997).
const VISCOUS: f64 = 0.125;
/// A step is at most this multiple of the one before: pressures go with 1/Δt.
const GROWTH: f64 = 1.1;
/// A particle that needs a step this many times below the limit by known speeds and free fall means breakdown.
const COLLAPSE: f64 = 1e-3;

/// PR2: u' = u + Δt a, r' = r + Δt u' + δr (PR14: shifting of the given strength, along the surface near air).
pub(crate) fn move_particles(system: &mut ParticleSystem, strength: f64, indicator: &[f64], dt: f64) {
    let moments = &system.fields.moments;
    let p = &mut system.particles;
    let (ax, ay, h) = (&p.ax, &p.ay, &p.h);
    parallel::update_both(&mut p.u, &mut p.v, |k, u, v| {
        *u += dt * ax[k];
        *v += dt * ay[k];
    });
    let (u, v) = (&p.u, &p.v);
    parallel::update_both(&mut p.x, &mut p.y, |k, x, y| {
        let scale = -2.0 * strength * h[k] * dt * (u[k] * u[k] + v[k] * v[k]).sqrt();
        // −∇C is the surface's normal there: of the share at the surface no shift along ∇C is left
        let [a, b] = moments[k].concentration_gradient().map(|c| (1.0 - indicator[k]) * (scale * c));
        let limit = LONGEST_SHIFT * h[k];
        let shrink = limit / (a * a + b * b).sqrt().max(limit);
        *x += dt * u[k] + shrink * a;
        *y += dt * v[k] + shrink * b;
    });
}

/// PR14: what limits the step besides the state.
pub(crate) struct StepLimit {
    /// Courant number [-].
    pub cfl: f64,
    /// The last step [s]; 0 before the first.
    pub last_dt: f64,
}

impl StepLimit {
    /// PR14 without viscosity [s].
    pub fn dt(&self, system: &ParticleSystem, walls: &Walls) -> f64 {
        let (p, cfl, cap) = (&system.particles, self.cfl, self.cap(system));
        let limit = |h: f64, u: f64, v: f64| cfl * h / (u * u + v * v).sqrt();
        let of_fluid = |k: usize| limit(p.h[k], p.u[k], p.v[k]);
        let of_wall = |k: usize| limit(walls.h[k], walls.u[k], walls.v[k]);
        let now = parallel::least(p.len(), of_fluid).min(parallel::least(walls.len(), of_wall)).min(cap);
        if self.last_dt > 0.0 { now.min(GROWTH * self.last_dt) } else { now }
    }

    /// The largest stable step [s]; an error where a particle moves so fast that the flow has broken down.
    pub fn stable_dt(&self, system: &ParticleSystem, walls: &Walls) -> Result<f64, Breakdown> {
        let (p, dt, cap) = (&system.particles, self.dt(system, walls), self.cap(system));
        if cap.is_finite() && dt < COLLAPSE * cap {
            let of = |k: usize| self.cfl * p.h[k] / p.u[k].hypot(p.v[k]);
            let fastest = (0..p.len()).min_by(|&a, &b| of(a).total_cmp(&of(b)));
            if let Some(k) = fastest.filter(|&k| of(k) < COLLAPSE * cap) {
                return Err(system.collapsed(k, of(k)));
            }
        }
        let viscous = VISCOUS * system.least_smoothing_length().powi(2) / system.domain.fluid.kinematic_viscosity;
        Ok(dt.min(viscous))
    }

    /// The limit by the fastest known speed and by free fall [s].
    fn cap(&self, system: &ParticleSystem) -> f64 {
        let (h, domain) = (system.least_smoothing_length(), &system.domain);
        let g = domain.gravity[0].hypot(domain.gravity[1]);
        (self.cfl * h / domain.fastest_speed).min(FREE_FALL * (h / g).sqrt())
    }
}
