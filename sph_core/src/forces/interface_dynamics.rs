//! The accelerations of walls' owners found together with the wall pressures that they cause, so that the added mass in WA3 is
//! implicit (THEORY CO4–CO7).

use serde::{Deserialize, Serialize};

use crate::forces::still_pressure::StillPressure;
use crate::forces::wall_state::extrapolate_to_walls;
use crate::forces::{Forces, PairTerms, gather_fluid_forces, gather_wall_forces};
use crate::interactions::geometry::kernel_and_gradient;
use crate::interactions::pair::TOUCHED;
use crate::kernel::{Shape, TargetSum};
use crate::scheme::Flow;
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;
use crate::walls::interface::{InterfaceLoad, ParticleLoad, WallInterface};

/// CO4: how pressure and force of a wall particle change with its acceleration.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct PressureSensitivity {
    /// Σ V_b W_wb r_wb/Σ V_b W_wb [m]: δp_w = −ρ₀ arm·δa_w.
    pub arm: [f64; 2],
    /// Σ V_b ∇W_wb [1/m]: δF_w = −V_w δp_w push.
    pub push: [f64; 2],
}

/// CO4 for the particles of one owner, the first of which is wall particle `first`.
struct PressureSensitivities<'a> {
    system: &'a ParticleSystem,
    first: usize,
}

impl TargetSum for PressureSensitivities<'_> {
    type Sum = PressureSensitivity;
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> PressureSensitivity {
        let (packed, w) = (&self.system.packed, self.first + k);
        let (wall, mut weight, mut sum) = (&packed.walls[w], 0.0, PressureSensitivity::default());
        for b in self.system.neighbours.fluid_of_wall.of(w).map(|j| &packed.fluid[j as usize]) {
            let (dx, dy) = (wall.x - b.x, wall.y - b.y);
            let Some((w, slope)) = kernel_and_gradient::<K>(dx, dy, 0.5 * (wall.h + b.h)) else { continue };
            let share = b.volume * w;
            weight += share;
            sum.arm = [sum.arm[0] + share * dx, sum.arm[1] + share * dy];
            sum.push = [sum.push[0] + b.volume * slope * dx, sum.push[1] + b.volume * slope * dy];
        }
        if weight < TOUCHED {
            return PressureSensitivity::default(); // as in WA3: no pressure without a fluid in reach
        }
        PressureSensitivity { arm: sum.arm.map(|a| a / weight), ..sum }
    }
}

/// CO6: the change of the wall pressures, as a force on every fluid particle [N/m].
struct PressureCorrection<'a> {
    system: &'a ParticleSystem,
    pressure: &'a [f64],
}

impl TargetSum for PressureCorrection<'_> {
    type Sum = [f64; 2];
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> [f64; 2] {
        let ParticleSystem { packed, neighbours, .. } = self.system;
        let (a, mut force) = (&packed.fluid[k], [0.0; 2]);
        for j in neighbours.walls_of_fluid.of(k) {
            let w = &packed.walls[j as usize];
            let change = self.pressure[neighbours.wall_source(j as usize, self.pressure.len())];
            let (dx, dy) = (a.x - w.x, a.y - w.y);
            if let Some((_, slope)) = kernel_and_gradient::<K>(dx, dy, 0.5 * (a.h + w.h)) {
                let push = a.volume * w.volume * slope * change;
                force = [force[0] - push * dx, force[1] - push * dy];
            }
        }
        force
    }
}

/// WA3, WC5–WC7: wall pressures, accelerations of the fluid and forces on the walls, under the packed pressures; walls taken
/// `offset` seconds from the step's end. `still` acts by itself and not by the pairs.
pub(crate) fn accelerate_by_pairs(flow: &mut Flow<'_>, terms: &PairTerms, still: Option<StillPressure>, offset: f64) {
    let Flow { system, walls, interfaces } = flow;
    extrapolate_to_walls(system, walls);
    if let Some(still) = still {
        still.take_off(system); // p' = p − P
    }
    let mut forces = Forces::in_place_of_accelerations(&mut system.particles);
    gather_fluid_forces(system, terms, true, &mut forces);
    gather_wall_forces(system, terms, walls);
    system.force_of_tank = [0.0; 2];
    if let Some(still) = still {
        still.act(system, walls, &mut forces); // −m ∇P/ρ₀, −∫P n ds
    }
    if !interfaces.is_empty() {
        solve_interfaces(system, walls, interfaces, &mut forces, offset); // CO4–CO6
    }
    forces.accelerate(system);
}

/// CO4–CO6: the accelerations of the walls' owners that satisfy their equations of motion under the forces which these
/// accelerations cause; pressures and forces of these walls and of the fluid beside them are corrected by the same terms. Walls taken
/// `offset` seconds from the step's end. For extrapolated walls.
pub(crate) fn solve_interfaces(
    system: &mut ParticleSystem,
    walls: &mut Walls,
    interfaces: &mut [WallInterface],
    forces: &mut Forces,
    offset: f64,
) {
    system.timers.begin(Phase::Coupling);
    let (kernel, rho0) = (system.domain.fluid.kernel, system.domain.fluid.density);
    let packed_walls = &system.packed.walls;
    let mut sensitivities = vec![PressureSensitivity::default(); walls.len()];
    for WallInterface { range, .. } in interfaces.iter() {
        kernel.gather(&PressureSensitivities { system, first: range.start }, &mut sensitivities[range.clone()]);
    }
    let at = |k: usize| [packed_walls[k].x, packed_walls[k].y];
    let correction = solve_owners(walls, interfaces, &sensitivities, at, rho0, offset);
    let mut on_fluid = vec![[0.0; 2]; system.particles.len()];
    kernel.gather(&PressureCorrection { system, pressure: &correction }, &mut on_fluid);
    forces.add(&on_fluid);
}

/// CO4, CO5: the accelerations of the owners, and what they change of the pressures of the walls, which is returned [Pa], and of the
/// forces on them. Wall particle k lies `at(k)` [m], `offset` seconds from the step's end.
pub(crate) fn solve_owners(
    walls: &mut Walls,
    interfaces: &mut [WallInterface],
    sensitivities: &[PressureSensitivity],
    at: impl Fn(usize) -> [f64; 2],
    rho0: f64,
    offset: f64,
) -> Vec<f64> {
    let mut correction = vec![0.0; walls.len()];
    for member in interfaces {
        let range = member.range.clone();
        let load = |k: usize| ParticleLoad {
            at: at(k),
            force: [walls.fx[k], walls.fy[k]],
            push: sensitivities[k].push.map(|push| rho0 * walls.volume[k] * push),
            arm: sensitivities[k].arm,
        };
        let particles: Vec<ParticleLoad> = range.clone().map(load).collect();
        let mut change = vec![[0.0; 2]; range.len()];
        let load = InterfaceLoad { particles: &particles, offset, mirrored: member.mirrored };
        member.owner.solve_acceleration(&load, &mut change);
        for (k, [x, y]) in range.zip(change) {
            correction[k] = -rho0 * (sensitivities[k].arm[0] * x + sensitivities[k].arm[1] * y);
        }
    }
    for (k, change) in correction.iter().enumerate() {
        let push = walls.volume[k] * change;
        walls.fx[k] -= push * sensitivities[k].push[0];
        walls.fy[k] -= push * sensitivities[k].push[1];
        walls.pressure[k] += change;
    }
    correction
}
