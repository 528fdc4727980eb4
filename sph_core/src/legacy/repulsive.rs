//! Repulsive walls (THEORY LE15): a row of points, half a spacing below the surface, that push along their normals.

use crate::forces::Forces;
use crate::interactions::packed_particle::{PackedParticle, PackedWall};
use crate::parallel;
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;

/// Least ψ/2h at which the law is taken: it is singular at the points themselves.
const NEAREST: f64 = 0.01;
/// Push of a wall above the still water, as a share of that at the floor.
const ABOVE_WATER: f64 = 0.02;
/// Approach speed over c₀ at which the push is as strong as at the floor, inverted.
const APPROACH: f64 = 20.0;

/// Numbers of the law.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Repulsion {
    /// Reference density [kg/m³].
    pub rho0: f64,
    /// Sound speed [m/s].
    pub c0: f64,
    /// Smoothing length over spacing [-].
    pub ratio: f64,
    /// Depth of the still water below y = 0 [m].
    pub water_depth: f64,
    /// There is gravity, so walls carry weight at rest.
    pub heavy: bool,
}

impl Repulsion {
    /// LE15: force [N/m] of wall point w on fluid particle a, along the wall's normal.
    #[inline(always)]
    fn push(&self, a: &PackedParticle, w: &PackedWall) -> f64 {
        let (dx, dy) = (a.x - w.x, a.y - w.y);
        let (above, along) = (dx * w.nx + dy * w.ny, dy * w.nx - dx * w.ny);
        let gap = w.h / self.ratio;
        if along.abs() >= gap || above < -0.5 * gap {
            return 0.0;
        }
        let h = 0.5 * (a.h + w.h);
        let q = (above / (2.0 * h)).max(NEAREST);
        if q >= 1.0 {
            return 0.0;
        }
        let law = 0.01 * self.c0 * self.c0 / h * (1.0 - q) / q.sqrt();
        let approach = (w.vn - a.u * w.nx - a.v * w.ny).max(0.0);
        let strength = self.at_height(a.y) + (APPROACH * approach / self.c0).min(1.0);
        self.rho0 * a.raw_volume * law * evenness(along, gap) * strength
    }

    /// ε(z) [-] of a particle at height z [m] above still water.
    fn at_height(&self, z: f64) -> f64 {
        if !self.heavy {
            return 0.0;
        }
        if z >= 0.0 { ABOVE_WATER } else { (ABOVE_WATER - z / self.water_depth).min(1.0) }
    }
}

/// P(ξ) = ½(1 + cos(2πξ/Δ)), |ξ| < Δ/2, Δ = 2 × the points' distance: neighbours' shares add up to 1 anywhere.
#[inline(always)]
fn evenness(along: f64, gap: f64) -> f64 {
    0.5 * (1.0 + (std::f64::consts::PI * along / gap).cos())
}

/// True where a fluid particle and a wall point may meet.
#[inline(always)]
fn meet(a: &PackedParticle, w: &PackedWall) -> bool {
    let (dx, dy, reach) = (a.x - w.x, a.y - w.y, a.h + w.h);
    dx * dx + dy * dy < reach * reach
}

/// LE15: the push of repulsive walls on the fluid, and its reaction on the wall points: the same pairs with the sign turned.
pub(crate) fn repel(system: &mut ParticleSystem, law: Repulsion, walls: &mut Walls, forces: &mut Forces) {
    system.timers.begin(Phase::Walls);
    let (fluid, points, search) = (&system.packed.fluid, &system.packed.packed_walls, &system.neighbours);
    let mut on_fluid = vec![[0.0; 2]; system.particles.len()];
    parallel::gather_into(&mut on_fluid, |k| {
        let near = search.walls_of_fluid.of(k).map(|j| &points[j as usize]).filter(|w| meet(&fluid[k], w));
        near.fold([0.0; 2], |sum, w| {
            let push = law.push(&fluid[k], w);
            [sum[0] + push * w.nx, sum[1] + push * w.ny]
        })
    });
    forces.add(&on_fluid);
    parallel::update_both(&mut walls.fx, &mut walls.fy, |k, fx, fy| {
        let (near, w) = (search.fluid_of_wall.of(k).map(|j| &fluid[j as usize]), &points[k]);
        let total: f64 = near.filter(|a| meet(a, w)).map(|a| law.push(a, w)).sum();
        (*fx, *fy) = (-total * w.nx, -total * w.ny);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Monaghan's P makes the push of a row even along it: at any ξ the two nearest points' shares add up to 1.
    #[test]
    fn a_row_of_points_pushes_evenly() {
        for k in 0..20 {
            let xi = 0.05 * k as f64;
            assert!((evenness(xi, 1.0) + evenness(xi - 1.0, 1.0) - 1.0).abs() < 1e-12, "at {xi}");
        }
    }

    #[test]
    fn the_push_grows_towards_the_surface_with_depth_and_with_approach() {
        let law = Repulsion { rho0: 1000.0, c0: 40.0, ratio: 1.5, water_depth: 1.0, heavy: true };
        let face = PackedWall { nx: 0.0, ny: 1.0, h: 0.15, ..PackedWall::default() };
        let at = |y: f64, v: f64| PackedParticle { y, v, raw_volume: 0.01, h: 0.15, ..PackedParticle::default() };
        let below = |y: f64| law.push(&PackedParticle { y: y - 0.5, ..at(0.0, 0.0) }, &PackedWall { y: -0.5, ..face });
        assert!(law.push(&at(0.05, 0.0), &face) > law.push(&at(0.1, 0.0), &face));
        assert!(below(0.1) > 10.0 * law.push(&at(0.1, 0.0), &face));
        assert!(law.push(&at(0.1, -1.0), &face) > 10.0 * law.push(&at(0.1, 1.0), &face));
        assert_eq!(law.push(&at(0.31, 0.0), &face), 0.0);
    }
}
