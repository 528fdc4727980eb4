//! The largest stable step (THEORY WC12).

use std::ops::Range;

use crate::error::Breakdown;
use crate::neighbours::SKIN;
use crate::parallel;
use crate::simd::{self, SimdReal, Task};
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

    fn of([acoustic, force, h]: [f64; 3]) -> Bounds {
        Bounds { acoustic, force, h }
    }

    #[inline(always)]
    fn and(self, other: Bounds) -> Bounds {
        let less = |a: f64, b: f64| if b < a { b } else { a };
        let (acoustic, force) = (less(self.acoustic, other.acoustic), less(self.force, other.force));
        Bounds { acoustic, force, h: less(self.h, other.h) }
    }

    /// The step [s] (WC12).
    fn dt(self, nu: f64) -> f64 {
        self.acoustic.min(FORCE * self.force.sqrt()).min(VISCOUS * self.h * self.h / nu)
    }
}

/// What moves: smoothing length [m], velocity [m/s], acceleration [m/s²] of each.
#[derive(Clone, Copy)]
struct Moving<'a>([&'a [f64]; 5]);

impl Moving<'_> {
    /// The least bounds of all, where the speed of sound is `c` [m/s].
    fn least(self, cfl: f64, c: impl Fn(usize) -> f64 + Sync) -> Bounds {
        let of_chunk = |at: Range<usize>| simd::run(true, LeastOf { of: self, at, cfl, c: &c });
        parallel::by_chunk(self.0[0].len(), of_chunk).into_iter().fold(Bounds::NONE, Bounds::and)
    }

    /// What bounds the step of those from `first` on that an `R` holds.
    #[inline(always)]
    fn bounds<R: SimdReal>(self, zero: R, cfl: f64, c: impl Fn(usize) -> f64, first: usize) -> [R; 3] {
        let [h, u, v, ax, ay] = self.0.map(|of| zero.each(|k| of[first + k]));
        let (speed, acceleration) = ((u * u + v * v).sqrt(), (ax * ax + ay * ay).sqrt());
        [zero.of(cfl) * h / (zero.each(|k| c(first + k)) + speed), h / acceleration, h]
    }
}

/// The least bounds of a chunk.
struct LeastOf<'a, C> {
    of: Moving<'a>,
    at: Range<usize>,
    cfl: f64,
    c: &'a C,
}

impl<C: Fn(usize) -> f64> Task for LeastOf<'_, C> {
    type Out = Bounds;
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) -> Bounds {
        let LeastOf { of, at, cfl, c } = self;
        let (mut least, whole) = ([zero.of(f64::INFINITY); 3], at.start + at.len() / R::WIDTH * R::WIDTH);
        for first in (at.start..whole).step_by(R::WIDTH) {
            let [acoustic, force, h] = of.bounds(zero, cfl, c, first);
            least = [acoustic.min(least[0]), force.min(least[1]), h.min(least[2])]; // the second of two where one is no number
        }
        let [acoustic, force, h] = least.map(|of| of.lanes());
        let lanes = (0..R::WIDTH).map(|l| Bounds { acoustic: acoustic[l], force: force[l], h: h[l] });
        let rest = (whole..at.end).map(|k| Bounds::of(of.bounds(0.0, cfl, c, k)));
        lanes.chain(rest).fold(Bounds::NONE, Bounds::and)
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
        let particles = Moving([&p.h, &p.u, &p.v, &p.ax, &p.ay]);
        let fluid = particles.least(cfl, &sound_speed);
        let wall = Moving([&w.h, &w.u, &w.v, &w.ax, &w.ay]).least(cfl, |_| c0);
        let dt = fluid.dt(nu).min(wall.dt(nu));
        if p.is_empty() || dt > COLLAPSE * (cfl * fluid.h / c0) {
            return Ok(dt);
        }
        let of = |k: usize| Bounds::of(particles.bounds(0.0, cfl, &sound_speed, k)).dt(nu);
        let k = (0..p.len()).min_by(|&a, &b| of(a).total_cmp(&of(b))).unwrap_or(0);
        Err(system.collapsed(k, dt))
    }
}
