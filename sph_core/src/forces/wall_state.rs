//! State of the wall particles, found from the fluid (THEORY WA3, WA5).

use crate::domain::Slip;
use crate::interactions::gather::{PairSums, WallState};
use crate::interactions::pair::Extrapolated;
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;

/// WA3: pressures of the walls extrapolated from the fluid.
pub(crate) fn extrapolate_to_walls(system: &mut ParticleSystem, walls: &mut Walls) {
    system.timers.begin(Phase::Walls);
    system.wall_state.resize(walls.len(), Extrapolated::default());
    let gather = WallState {
        fluid: &system.packed.fluid,
        walls: &system.packed.walls,
        acceleration: (&walls.ax, &walls.ay),
        neighbours: &system.neighbours,
        constants: system.constants(),
    };
    PairSums::of(&system.domain).run_without_dissipation(&gather, &mut system.wall_state[..]);
    set_wall_state(system, walls);
}

/// The packed walls take the state found, and their owners the pressure.
pub(crate) fn set_wall_state(system: &mut ParticleSystem, walls: &mut Walls) {
    let image_side = if system.domain.periodic.is_some() { 1.0 } else { -1.0 };
    let no_slip = system.domain.fluid.wall_slip == Slip::None;
    system.packed.set_wall_state(&system.wall_state, &system.neighbours.wall_images, image_side, no_slip);
    for (pressure, found) in walls.pressure.iter_mut().zip(&system.wall_state) {
        *pressure = found.pressure;
    }
}
