//! The largest stable step (THEORY E17).

use crate::error::Breakdown;
use crate::fluid::Fluid;
use crate::solver::Solver;
use crate::sweep;
use crate::walls::Walls;

/// Share of √(h/|a|) a step may take (E17; Monaghan 1992).
const FORCE: f64 = 0.25;
/// Share of h²/ν a step may take (E17; Morris et al. 1997).
const VISCOUS: f64 = 0.125;
/// A step this many times smaller than the acoustic limit of water at rest means breakdown.
const COLLAPSE: f64 = 1e-4;

impl Fluid {
    /// Speed of sound at particle `k` [m/s]: c₀, and in a gas hotter than at rest more.
    fn sound_speed(&self, k: usize) -> f64 {
        let c0 = self.parameters.eos.c0;
        self.parameters.gas.map_or(c0, |gas| gas.sound_speed(self.particles.energy[k]).max(c0))
    }

    /// Δt ≤ C h/(c + |v|) [s] over all particles.
    pub fn acoustic_limit(&self) -> f64 {
        let p = &self.particles;
        let speed = |k: usize| (p.u[k] * p.u[k] + p.v[k] * p.v[k]).sqrt();
        self.parameters.cfl * sweep::least(p.len(), |k| p.h[k] / (self.sound_speed(k) + speed(k)))
    }

    /// The step limit [s]: acoustic, force and viscous, over the fluid and the walls beside it.
    pub fn stable_dt(&self, walls: &Walls) -> Result<f64, Breakdown> {
        if self.parameters.solver == Solver::IncompressibleThesis {
            return sweep::within_pool(|| self.thesis_dt(walls));
        }
        if self.parameters.solver.is_incompressible() {
            let viscous = VISCOUS * self.least_length().powi(2) / self.parameters.nu;
            return Ok(sweep::within_pool(|| self.projection_dt(walls)).min(viscous));
        }
        let (p, q) = (&self.particles, &self.parameters);
        let c0 = q.eos.c0;
        let limit = |c: f64, h: f64, u: f64, v: f64, ax: f64, ay: f64| {
            let (speed, acceleration) = ((u * u + v * v).sqrt(), (ax * ax + ay * ay).sqrt());
            (q.cfl * h / (c + speed)).min(FORCE * (h / acceleration).sqrt()).min(VISCOUS * h * h / q.nu)
        };
        let of_fluid = |k: usize| limit(self.sound_speed(k), p.h[k], p.u[k], p.v[k], p.ax[k], p.ay[k]);
        let of_wall = |k: usize| limit(c0, walls.h[k], walls.u[k], walls.v[k], walls.ax[k], walls.ay[k]);
        let (dt, at_rest) = sweep::within_pool(|| {
            let dt = sweep::least(p.len(), of_fluid).min(sweep::least(walls.len(), of_wall));
            (dt, q.cfl * sweep::least(p.len(), |k| p.h[k]) / c0)
        });
        if p.is_empty() || dt > COLLAPSE * at_rest {
            return Ok(dt);
        }
        let k = (0..p.len()).min_by(|&a, &b| of_fluid(a).total_cmp(&of_fluid(b))).unwrap_or(0);
        Err(self.collapsed(k, dt))
    }

    /// The step fell to `dt` [s] because of particle `k`.
    pub(crate) fn collapsed(&self, k: usize, dt: f64) -> Breakdown {
        let p = &self.particles;
        let (speed, acceleration) = (p.u[k].hypot(p.v[k]), p.ax[k].hypot(p.ay[k]));
        Breakdown::Step { dt, id: p.id[k], x: p.x[k], y: p.y[k], speed, acceleration, time: self.time }
    }
}
