//! The largest stable step (THEORY WC12).

use crate::error::Breakdown;
use crate::neighbours::SKIN;
use crate::parallel;
use crate::system::ParticleSystem;
use crate::walls::Walls;

/// Share of √(h/|a|) a step may take (WC12; Monaghan 1992).
const FORCE: f64 = 0.25;
/// Share of h²/ν a step may take (WC12; Morris et al. 1997).
const VISCOUS: f64 = 0.125;
/// Acoustic steps that a neighbour list is made to last.
const LIST_LIFE: f64 = 10.0;
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

    /// The step [s] (WC12).
    fn dt(self, nu: f64) -> f64 {
        self.acoustic.min(FORCE * self.force.sqrt()).min(VISCOUS * self.h * self.h / nu)
    }
}

/// Rebuild the lists, to last some steps of Δt = C h/(c + |v|) [s] of all particles; `sound_speed` of each [m/s].
pub(crate) fn rebuild_lists(
    system: &mut ParticleSystem,
    walls: &Walls,
    cfl: f64,
    sound_speed: impl Fn(&ParticleSystem, usize) -> f64 + Sync,
) {
    let p = &system.particles;
    let speed = |k: usize| (p.u[k] * p.u[k] + p.v[k] * p.v[k]).sqrt();
    let dt = cfl * parallel::least(p.len(), |k| p.h[k] / (sound_speed(system, k) + speed(k)));
    system.rebuild_lists(walls, LIST_LIFE * dt, SKIN);
}

/// What limits the step besides the state.
#[derive(Clone, Copy)]
pub(crate) struct StepLimit {
    /// Courant number [-].
    pub cfl: f64,
    /// Speed of sound at rest [m/s].
    pub c0: f64,
}

impl StepLimit {
    /// The step limit [s]: acoustic, force and viscous, over the fluid and the walls beside it.
    pub fn stable_dt(
        &self,
        system: &ParticleSystem,
        walls: &Walls,
        sound_speed: impl Fn(usize) -> f64 + Sync,
    ) -> Result<f64, Breakdown> {
        let (StepLimit { cfl, c0 }, nu) = (*self, system.domain.fluid.kinematic_viscosity);
        let (p, w) = (&system.particles, walls);
        let of_fluid = |k: usize| Bounds::of(cfl, sound_speed(k), p.h[k], [p.u[k], p.v[k]], [p.ax[k], p.ay[k]]);
        let of_wall = |k: usize| Bounds::of(cfl, c0, w.h[k], [w.u[k], w.v[k]], [w.ax[k], w.ay[k]]);
        let (fluid, wall) = (Bounds::least(p.len(), of_fluid), Bounds::least(walls.len(), of_wall));
        let dt = fluid.dt(nu).min(wall.dt(nu));
        if p.is_empty() || dt > COLLAPSE * (cfl * fluid.h / c0) {
            return Ok(dt);
        }
        let of = |k: usize| of_fluid(k).dt(nu);
        let k = (0..p.len()).min_by(|&a, &b| of(a).total_cmp(&of(b))).unwrap_or(0);
        Err(system.collapsed(k, dt))
    }
}
