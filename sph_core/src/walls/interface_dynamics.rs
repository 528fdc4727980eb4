//! Walls that yield (THEORY C1–C4): the acceleration of their owners, found together with the wall pressures that it
//! causes, so that the added mass which E9 carries is implicit.

use crate::fluid::Fluid;
use crate::interactions::kernel::{Shape, WithKernel};
use crate::interactions::pair::{Row, kernel_and_slope};
use crate::legacy::wall_model::WallModel;
use crate::neighbours::lists::Lists;
use crate::parallel;
use crate::timers::Phase;
use crate::walls::Walls;
use crate::walls::interface::{Encounter, Touch};

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
        parallel::gather_into(out, |k| {
            let near = lists.of(first + k).map(|j| &fluid[j as usize]);
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
        parallel::gather_into(out, |k| {
            let (a, mut force) = (&fluid[k], [0.0; 2]);
            for j in lists.of(k) {
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
        if self.yielding.is_empty() || self.parameters.walls.model != WallModel::Extrapolated {
            return;
        }
        self.phases.begin(Phase::Coupling);
        let (kernel, rho0) = (self.parameters.kernel, self.parameters.eos.rho0);
        let (fluid, rows, search) = (&self.rows.fluid, &self.rows.walls, &self.search);
        let mut levers = vec![Lever::default(); walls.len()];
        let mut relief = vec![0.0; walls.len()];
        for member in &mut self.yielding {
            let range = member.range.clone();
            let (first, out) = (range.start, &mut levers[range.clone()]);
            kernel.run(Levers { fluid, walls: rows, lists: &search.fluid_of_wall, first, out });
            let touch = |k: usize| Touch {
                at: [rows[k].x, rows[k].y],
                force: [walls.fx[k], walls.fy[k]],
                push: levers[k].push.map(|push| rho0 * walls.volume[k] * push),
                arm: levers[k].arm,
            };
            let touches: Vec<Touch> = range.clone().map(touch).collect();
            let mut change = vec![[0.0; 2]; range.len()];
            let encounter = Encounter { touches: &touches, offset, mirrored: member.mirrored };
            member.owner.answer(&encounter, &mut change);
            for (k, [x, y]) in range.zip(change) {
                relief[k] = -rho0 * (levers[k].arm[0] * x + levers[k].arm[1] * y);
            }
        }
        for (k, change) in relief.iter().enumerate() {
            let push = walls.volume[k] * change;
            walls.fx[k] -= push * levers[k].push[0];
            walls.fy[k] -= push * levers[k].push[1];
            walls.pressure[k] += change;
        }
        let mut on_fluid = vec![[0.0; 2]; self.particles.len()];
        let (lists, images) = (&search.walls_of_fluid, &search.wall_images[..]);
        kernel.run(Relief { fluid, walls: rows, lists, images, pressure: &relief, out: &mut on_fluid });
        self.add_forces(&on_fluid);
    }
}
