//! The largest stable step (THEORY E17).

use crate::error::Breakdown;
use crate::fluid::Fluid;
use crate::parallel;
use crate::solver::Solver;
use crate::walls::Walls;

/// Share of √(h/|a|) a step may take (E17; Monaghan 1992).
const FORCE: f64 = 0.25;
/// Share of h²/ν a step may take (E17; Morris et al. 1997).
const VISCOUS: f64 = 0.125;
/// A step this many times smaller than the acoustic limit of water at rest means breakdown.
const COLLAPSE: f64 = 1e-4;

/// What bounds the step: roots and products that grow with these are left until the least is known, which rounds the same.
#[derive(Clone, Copy)]
struct Bounds {
    /// C h/(c + |v|) [s].
    acoustic: f64,
    /// h/|a| [s²].
    force: f64,
    /// h [m].
    h: f64,
}

impl Bounds {
    const NONE: Bounds = Bounds { acoustic: f64::INFINITY, force: f64::INFINITY, h: f64::INFINITY };

    #[inline(always)]
    fn of(cfl: f64, c: f64, h: f64, [u, v]: [f64; 2], [ax, ay]: [f64; 2]) -> Bounds {
        let (speed, acceleration) = ((u * u + v * v).sqrt(), (ax * ax + ay * ay).sqrt());
        Bounds { acoustic: cfl * h / (c + speed), force: h / acceleration, h }
    }

    #[inline(always)]
    fn min(self, other: Bounds) -> Bounds {
        let (acoustic, force) = (self.acoustic.min(other.acoustic), self.force.min(other.force));
        Bounds { acoustic, force, h: self.h.min(other.h) }
    }

    /// The least of `n`.
    fn least(n: usize, of: impl Fn(usize) -> Bounds + Sync) -> Bounds {
        let chunks = parallel::by_chunk(n, |targets| targets.map(&of).fold(Bounds::NONE, Bounds::min));
        chunks.into_iter().fold(Bounds::NONE, Bounds::min)
    }

    /// The step [s] (E17).
    fn dt(self, nu: f64) -> f64 {
        self.acoustic.min(FORCE * self.force.sqrt()).min(VISCOUS * self.h * self.h / nu)
    }
}

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
        self.parameters.cfl * parallel::least(p.len(), |k| p.h[k] / (self.sound_speed(k) + speed(k)))
    }

    /// The step limit [s]: acoustic, force and viscous, over the fluid and the walls beside it.
    pub fn stable_dt(&self, walls: &Walls) -> Result<f64, Breakdown> {
        if self.parameters.solver == Solver::IncompressibleThesis {
            return parallel::within_pool(|| self.thesis_dt(walls));
        }
        if self.parameters.solver.is_incompressible() {
            let viscous = VISCOUS * self.least_length().powi(2) / self.parameters.nu;
            return Ok(parallel::within_pool(|| self.projection_dt(walls)).min(viscous));
        }
        let (p, q) = (&self.particles, &self.parameters);
        let c0 = q.eos.c0;
        let of_fluid = |k: usize| Bounds::of(q.cfl, self.sound_speed(k), p.h[k], [p.u[k], p.v[k]], [p.ax[k], p.ay[k]]);
        let w = walls;
        let of_wall = |k: usize| Bounds::of(q.cfl, c0, w.h[k], [w.u[k], w.v[k]], [w.ax[k], w.ay[k]]);
        let (fluid, wall) =
            parallel::within_pool(|| (Bounds::least(p.len(), of_fluid), Bounds::least(walls.len(), of_wall)));
        let dt = fluid.dt(q.nu).min(wall.dt(q.nu));
        if p.is_empty() || dt > COLLAPSE * (q.cfl * fluid.h / c0) {
            return Ok(dt);
        }
        let of = |k: usize| of_fluid(k).dt(q.nu);
        let k = (0..p.len()).min_by(|&a, &b| of(a).total_cmp(&of(b))).unwrap_or(0);
        Err(self.collapsed(k, dt))
    }

    /// The step fell to `dt` [s] because of particle `k`.
    pub(crate) fn collapsed(&self, k: usize, dt: f64) -> Breakdown {
        let p = &self.particles;
        let (speed, acceleration) = (p.u[k].hypot(p.v[k]), p.ax[k].hypot(p.ay[k]));
        Breakdown::Step { dt, id: p.id[k], x: p.x[k], y: p.y[k], speed, acceleration, time: self.time }
    }
}
