//! Walls that yield (THEORY C1–C4): the acceleration of a rigid owner, found together with the wall pressures that it
//! causes, so that the added mass which E9 carries is implicit.

use std::ops::Range;

use crate::fluid::Fluid;
use crate::kernel::{Shape, WithKernel};
use crate::neighbours::Lists;
use crate::pair::{Row, kernel_and_slope};
use crate::sweep;
use crate::wall_model::WallModel;
use crate::walls::Walls;

/// A rigid owner of walls that a force accelerates. Directions: x, y [m], angle [rad].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Yielding {
    /// Its particles.
    pub range: Range<usize>,
    /// Centre of mass at the end of the step [m].
    pub pole: [f64; 2],
    /// Mean velocity of the centre of mass over the step [m/s].
    pub velocity: [f64; 2],
    /// Acceleration that its particles' kinematics were written with [m/s², m/s², rad/s²].
    pub acceleration: [f64; 3],
    /// Inverse of mass and moment of inertia [m/kg, m/kg, 1/(kg m)]; 0 where it is held.
    pub mobility: [f64; 3],
    /// Acceleration without a fluid [m/s², m/s², rad/s²].
    pub free_fall: [f64; 3],
    /// True when the particles are the right half of an owner that is symmetric about x = 0.
    pub mirrored: bool,
    /// What the fluid added to `acceleration` so that it fits the force (C2); written by the fluid.
    pub change: [f64; 3],
}

impl Yielding {
    /// What `acceleration` lacks of that under a force and moment about the pole [N/m, N/m, N] (C2).
    pub fn lack(&self, force: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| match self.mobility[k] {
            0.0 => 0.0,
            mobility => mobility * force[k] + self.free_fall[k] - self.acceleration[k],
        })
    }

    /// The centre of mass `offset` [s] from the end of a step of `dt` [s]: back at constant acceleration.
    fn pole_at(&self, offset: f64, dt: f64) -> [f64; 2] {
        let bend = 0.5 * offset * (offset + dt);
        [0, 1].map(|k| self.pole[k] + offset * self.velocity[k] + bend * self.acceleration[k])
    }

    /// C2: δa of (1 + M⁻¹ A) δa = M⁻¹ F + g − a.
    fn answer(&self, force: [f64; 3], added: [[f64; 3]; 3]) -> [f64; 3] {
        let lack = self.lack(force);
        let row = |i: usize| {
            let own = |j: usize| if i == j { 1.0 } else { 0.0 };
            let [x, y, angle] = [0, 1, 2].map(|j| own(j) + self.mobility[i] * added[i][j]);
            [x, y, angle, lack[i]]
        };
        solve([row(0), row(1), row(2)])
    }
}

/// The solution of three linear equations, right side last (Gauss, with the largest pivot of each column).
fn solve(mut rows: [[f64; 4]; 3]) -> [f64; 3] {
    for c in 0..3 {
        let pivot = (c..3).max_by(|&i, &j| rows[i][c].abs().total_cmp(&rows[j][c].abs())).unwrap_or(c);
        rows.swap(c, pivot);
        for i in c + 1..3 {
            let factor = rows[i][c] / rows[c][c];
            for j in c..4 {
                rows[i][j] -= factor * rows[c][j];
            }
        }
    }
    let mut x = [0.0; 3];
    for c in (0..3).rev() {
        let known: f64 = (c + 1..3).map(|k| rows[c][k] * x[k]).sum();
        x[c] = (rows[c][3] - known) / rows[c][c];
    }
    x
}

/// C1: how pressure and force of a wall particle change with its acceleration.
#[derive(Clone, Copy, Debug, Default)]
struct Lever {
    /// Σ V_b W_wb r_wb/Σ V_b W_wb [m]: δp_w = −ρ₀ arm·δa_w.
    arm: [f64; 2],
    /// Σ V_b ∇W_wb [1/m]: δF_w = −V_w δp_w push.
    push: [f64; 2],
}

/// C1 for the particles of one owner, the first of which is wall particle `first`.
struct Levers<'a> {
    fluid: &'a [Row],
    walls: &'a [Row],
    lists: &'a Lists,
    first: usize,
    out: &'a mut [Lever],
}

impl WithKernel for Levers<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Levers { fluid, walls, lists, first, out } = self;
        sweep::gather_into(out, |k| {
            let near = lists.of(first + k).iter().map(|&j| &fluid[j as usize]);
            lever::<K>(&walls[first + k], near)
        });
    }
}

#[inline(always)]
fn lever<'r, K: Shape>(wall: &Row, fluid: impl Iterator<Item = &'r Row>) -> Lever {
    let (mut weight, mut sum) = (0.0, Lever::default());
    for b in fluid {
        let (dx, dy) = (wall.x - b.x, wall.y - b.y);
        let Some((w, slope)) = kernel_and_slope::<K>(dx, dy, 0.5 * (wall.h + b.h)) else {
            continue;
        };
        let share = b.volume * w;
        weight += share;
        sum.arm = [sum.arm[0] + share * dx, sum.arm[1] + share * dy];
        sum.push = [sum.push[0] + b.volume * slope * dx, sum.push[1] + b.volume * slope * dy];
    }
    if weight < 1e-9 {
        return Lever::default(); // as in E9: no pressure without a fluid in reach
    }
    Lever { arm: sum.arm.map(|a| a / weight), ..sum }
}

/// C3: the change of the wall pressures, as a force on every fluid particle [N/m]. `images` are the sources of listed walls
/// beyond the last.
struct Relief<'a> {
    fluid: &'a [Row],
    walls: &'a [Row],
    lists: &'a Lists,
    images: &'a [u32],
    pressure: &'a [f64],
    out: &'a mut [[f64; 2]],
}

impl WithKernel for Relief<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Relief { fluid, walls, lists, images, pressure, out } = self;
        let n = pressure.len();
        let source = |j: usize| if j < n { j } else { images[j - n] as usize };
        sweep::gather_into(out, |k| {
            let (a, mut force) = (&fluid[k], [0.0; 2]);
            for &j in lists.of(k) {
                let (w, change) = (&walls[j as usize], pressure[source(j as usize)]);
                let (dx, dy) = (a.x - w.x, a.y - w.y);
                if let Some((_, slope)) = kernel_and_slope::<K>(dx, dy, 0.5 * (a.h + w.h)) {
                    let push = a.volume * w.volume * slope * change;
                    force = [force[0] - push * dx, force[1] - push * dy];
                }
            }
            force
        });
    }
}

impl Fluid {
    /// C1–C3: the accelerations of the walls' owners that fit the forces they cause; pressures and forces of these walls
    /// and of the fluid beside them are corrected by the same terms. Walls taken `offset` seconds from the step's end.
    pub(crate) fn yield_walls(&mut self, walls: &mut Walls, offset: f64) {
        if walls.yielding.is_empty() || self.parameters.walls.model != WallModel::Extrapolated {
            return;
        }
        let (kernel, rho0) = (self.parameters.kernel, self.parameters.eos.rho0);
        let (fluid, rows, search) = (&self.rows.fluid, &self.rows.walls, &self.search);
        let mut levers = vec![Lever::default(); walls.len()];
        let mut relief = vec![0.0; walls.len()];
        let mut owners = std::mem::take(&mut walls.yielding);
        for owner in &mut owners {
            let range = owner.range.clone();
            let (first, out) = (range.start, &mut levers[range.clone()]);
            kernel.run(Levers { fluid, walls: rows, lists: &search.fluid_of_wall, first, out });
            let pole = owner.pole_at(offset, walls.dt);
            let arm = |k: usize| [rows[k].x - pole[0], rows[k].y - pole[1]];
            let (mut force, mut added) = ([0.0; 3], [[0.0; 3]; 3]);
            for k in range.clone() {
                let (r, l) = (arm(k), levers[k]);
                accumulate(&mut force, [walls.fx[k], walls.fy[k]], r, 1.0);
                // row i of A: force in direction i of unit accelerations, with its sign changed
                let mass = -rho0 * walls.volume[k];
                let along = [l.arm[0], l.arm[1], r[0] * l.arm[1] - r[1] * l.arm[0]];
                for (column, share) in along.iter().enumerate() {
                    let mut unit = [0.0; 3];
                    accumulate(&mut unit, l.push, r, mass * share);
                    (0..3).for_each(|i| added[i][column] += unit[i]);
                }
            }
            if owner.mirrored {
                (force, added) = both_halves(force, added);
            }
            owner.change = owner.answer(force, added);
            let [x, y, turn] = owner.change;
            for k in range {
                let (r, l) = (arm(k), levers[k]);
                relief[k] = -rho0 * (l.arm[0] * (x - turn * r[1]) + l.arm[1] * (y + turn * r[0]));
            }
        }
        walls.yielding = owners;
        for (k, change) in relief.iter().enumerate() {
            let push = walls.volume[k] * change;
            walls.fx[k] -= push * levers[k].push[0];
            walls.fy[k] -= push * levers[k].push[1];
            walls.pressure[k] += change;
        }
        let mut on_fluid = vec![[0.0; 2]; self.particles.len()];
        let (lists, images) = (&search.walls_of_fluid, &search.wall_images[..]);
        kernel.run(Relief { fluid, walls: rows, lists, images, pressure: &relief, out: &mut on_fluid });
        for (sum, change) in self.gathered.iter_mut().zip(&on_fluid) {
            sum.force = [sum.force[0] + change[0], sum.force[1] + change[1]];
        }
    }
}

/// Add `scale` times a force at an arm to a force and moment.
fn accumulate(sum: &mut [f64; 3], force: [f64; 2], arm: [f64; 2], scale: f64) {
    sum[0] += scale * force[0];
    sum[1] += scale * force[1];
    sum[2] += scale * (arm[0] * force[1] - arm[1] * force[0]);
}

/// Of an owner whose left half is the image of the right: what is left of force and added mass acts along y.
fn both_halves(force: [f64; 3], added: [[f64; 3]; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
    let mut vertical = [[0.0; 3]; 3];
    vertical[1][1] = 2.0 * added[1][1];
    ([0.0, 2.0 * force[1], 0.0], vertical)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_equations_are_solved_whatever_their_order() {
        let exact = [1.5, -2.0, 0.25];
        let matrix = [[0.0, 2.0, 1.0], [3.0, -1.0, 0.5], [1e-9, 4.0, -7.0]];
        let found = solve([0, 1, 2].map(|i| {
            let [a, b, c]: [f64; 3] = matrix[i];
            [a, b, c, a * exact[0] + b * exact[1] + c * exact[2]]
        }));
        (0..3).for_each(|k| assert!((found[k] - exact[k]).abs() < 1e-13, "{found:?}"));
    }

    #[test]
    fn what_is_held_does_not_yield() {
        let owner = Yielding { mobility: [0.0, 0.5, 0.0], free_fall: [0.0, -9.81, 0.0], ..Yielding::default() };
        let added = [[7.0, 1.0, 2.0], [1.0, 6.0, 0.3], [0.1, 0.2, 0.9]];
        let found = owner.answer([11.0, 30.0, -4.0], added);
        // (m + A) a = F + m g, with m = 2
        assert_eq!([found[0], found[2]], [0.0; 2]);
        assert!((found[1] - (30.0 - 2.0 * 9.81) / (2.0 + 6.0)).abs() < 1e-14, "{found:?}");
    }
}
