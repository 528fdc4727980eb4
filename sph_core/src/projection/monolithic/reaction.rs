//! What walls and pressures are to each other in a projection (THEORY CO19, CO20): the force of pressures on wall particles,
//! and the flow that accelerations of walls make.

use crate::interactions::geometry::pair_geometry;
use crate::interactions::kernel::{Shape, WithKernel};
use crate::interactions::packed_particle::PackedParticle;
use crate::neighbours::Neighbours;
use crate::parallel;

/// CO19: force on the wall particles from `first` on under any pressures, one a fluid particle; the same sums as WA3 and WC5.
pub(crate) struct Reaction<'a> {
    pub fluid: &'a [PackedParticle],
    pub walls: &'a [PackedParticle],
    pub neighbours: &'a Neighbours,
    /// The first of these wall particles.
    pub first: usize,
    /// Pressures [Pa].
    pub pressure: &'a [f64],
    /// ρ₀(g − a_w) of each of these wall particles [N/m³].
    pub field: &'a [[f64; 2]],
    /// 1/κ (PR4) [-].
    pub inverse: f64,
    /// Forces [N/m].
    pub out: &'a mut [[f64; 2]],
}

impl WithKernel for Reaction<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Reaction { fluid, walls, neighbours, first, pressure, field, inverse, out } = self;
        let n = pressure.len();
        parallel::gather_into(out, |k| {
            let wall = &walls[first + k];
            let (mut weight, mut mean, mut arm) = (0.0, 0.0, [0.0; 2]);
            let (mut slopes, mut push) = ([0.0; 2], [0.0; 2]);
            for j in neighbours.fluid_of_wall.of(first + k) {
                let b = &fluid[j as usize];
                let Some(wb) = pair_geometry::<K>(wall.x, wall.y, wall.h, b.x, b.y, b.h) else { continue };
                let (p, share, pull) =
                    (pressure[neighbours.source(j, n)], b.volume * wb.w::<K>(), b.volume * wb.grad_factor);
                weight += share;
                mean += share * p;
                arm = [arm[0] + share * wb.dx, arm[1] + share * wb.dy];
                slopes = [slopes[0] + pull * wb.dx, slopes[1] + pull * wb.dy];
                push = [push[0] + p * pull * wb.dx, push[1] + p * pull * wb.dy];
            }
            // as in WA3: no pressure without a fluid in reach
            let own = if weight < 1e-9 { 0.0 } else { (mean + field[k][0] * arm[0] + field[k][1] * arm[1]) / weight };
            [0, 1].map(|i| -inverse * wall.volume * (push[i] + own * slopes[i]))
        });
    }
}

/// CO20: what accelerations of walls add to the right side of the pressure equation, V_i Σ_w 2V_w a_w·∇W_iw with its sign changed.
pub(crate) struct Inflow<'a> {
    pub fluid: &'a [PackedParticle],
    pub walls: &'a [PackedParticle],
    pub neighbours: &'a Neighbours,
    /// Accelerations of all wall particles [m/s²]; images follow theirs.
    pub accelerations: &'a [[f64; 2]],
    /// Sign of an image's acceleration along x: −1 where images reflect.
    pub side: f64,
    /// Additions [m²/s²].
    pub out: &'a mut [f64],
}

impl WithKernel for Inflow<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Inflow { fluid, walls, neighbours, accelerations, side, out } = self;
        let n = accelerations.len();
        parallel::gather_into(out, |k| {
            let (a, mut sum) = (&fluid[k], 0.0);
            for j in neighbours.walls_of_fluid.of(k) {
                let j = j as usize;
                let (source, side) = if j < n { (j, 1.0) } else { (neighbours.wall_images[j - n] as usize, side) };
                let [ax, ay] = accelerations[source];
                if ax == 0.0 && ay == 0.0 {
                    continue;
                }
                let w = &walls[j];
                let Some(aw) = pair_geometry::<K>(a.x, a.y, a.h, w.x, w.y, w.h) else { continue };
                sum -= 2.0 * w.volume * aw.grad_factor * (side * ax * aw.dx + ay * aw.dy);
            }
            a.raw_volume * sum
        });
    }
}
