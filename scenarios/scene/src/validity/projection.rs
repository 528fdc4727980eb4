//! Limits and warnings of scenes with an incompressible solver (THEORY PR2–PR14, LE18–LE28).

use settings::{Problem, require, significant};
use sph_core::Solver;

use super::wet_period::unresolved_panels;
use crate::impact::Entry;
use crate::keys::{Body, CouplingScheme, Scene, SolverSettings};

/// Share of its smoothing length that a particle may move in a step, where the scene does not say.
const CFL: f64 = 0.4;

/// Largest share of it that makes sense: farther, and its neighbours are not those that its pressure was found with.
const LARGEST_CFL: f64 = 1.0;

/// Largest share that was found steady: at 0.6 forces are as good as with shorter steps, at 1 they are twice as unsteady, and
/// falls of water on water gain energy.
const STEADY_CFL: f64 = 0.6;

/// Largest ratio of successive rows at which forces were right.
const LARGEST_GROWTH: f64 = 1.17;

/// Draughts to the tank's walls and floor from which an impact does not feel them: water that carries no sound answers at
/// once, which took 18 % of a wedge's force at 5 draughts and 6 % at 10.
const REACH: f64 = 15.0;

/// Refuses steps in which water moves farther than its neighbours reach.
pub(crate) fn check_projection_step(scene: &Scene) -> Result<(), Problem> {
    let (cfl, name) = (scene.courant_number(), scene.solver.name());
    let expected = format_args!(
        "a number above 0 and up to {LARGEST_CFL} with solver = {name:?}: the share of its smoothing length that a particle moves \
         in a step"
    );
    require(cfl <= LARGEST_CFL, "fluid.cfl", cfl, expected)?;
    let growth = scene.resolution.growth;
    let expected = format_args!(
        "at most {LARGEST_GROWTH} with solver = {name:?}: from 1.19 on pressures were several times those of finer grading"
    );
    require(
        growth <= LARGEST_GROWTH || scene.solver.kind() == Solver::IncompressibleThesis,
        "resolution.growth",
        growth,
        expected,
    )
}

/// Warnings about a scene with an incompressible solver: its step, its walls, and what does nothing.
pub(crate) fn projection_warnings(scene: &Scene) -> Vec<String> {
    let (cfl, mut warnings) = (scene.courant_number(), Vec::new());
    if cfl > STEADY_CFL {
        warnings.push(format!(
            "fluid.cfl = {cfl}: up to {STEADY_CFL} forces are as good as with shorter steps; at 1 they are twice as unsteady, \
             and falling water has gained energy"
        ));
    }
    let passing = scene.water().smoothing_ratio * scene.resolution.spacing / scene.projection_speed();
    if let Some(step) = scene.time.step.filter(|step| *step > LARGEST_CFL * passing) {
        warnings.push(format!(
            "time.step = {step} s: at the fastest known speed a particle moves {} smoothing lengths in it, and beyond 1 its \
             neighbours are others; {} s would do",
            significant(step / passing),
            significant(CFL * passing)
        ));
    }
    warnings.extend(unresolved_panels(scene));
    warnings.extend(near_walls(scene));
    warnings.extend(round_sides(scene));
    warnings.extend(one_exchange(scene));
    warnings
}

/// A body that moves with the water and exchanges once per step.
fn one_exchange(scene: &Scene) -> Option<String> {
    let moved = scene.all_bodies().any(|body| body.bends() || body.is_free());
    let (name, holds) = match scene.solver.kind() {
        Solver::Incompressible => ("incompressible", "\"added_mass\" holds at any mass"),
        solver => (solver.name(), "\"iqn_ils\" repeats the step until both agree"),
    };
    (moved && scene.coupling.scheme == CouplingScheme::Weak).then(|| {
        format!(
            "coupling.scheme = \"weak\" with solver = \"{name}\": explicit coupling holds where the body is heavier than the \
             water that moves with it, however short the step; {holds}"
        )
    })
}

/// The sides of a round bottom, which water leaves.
fn round_sides(scene: &Scene) -> Option<String> {
    let SolverSettings::Incompressible { fluid, .. } = &scene.solver else { return None };
    let entries = scene.entries();
    let round = entries.iter().filter(|(_, entry)| entry.leaves_its_sides());
    let deep = round.map(|(_, entry)| entry.final_draught).reduce(f64::max)?;
    (!fluid.scheme.ventilation).then(|| {
        format!(
            "the round bottom comes to a draught of {} m; deeper than 0.15 radii water leaves its sides, and clings to them here: the force \
             was low by 7 % at 0.28 radii and by 30 % at 0.4; fluid.ventilation = true lets the air in, the weakly compressible solver does \
             so by itself",
            significant(deep)
        )
    })
}

/// Share of the force that the tank's walls take at 10 draughts [-], and its power of the draughts over their distance: 18 % at 5.
const OF_WALLS: [f64; 2] = [0.06, 1.585];

/// Distance of the nearest wall or floor and the draught at the end, where an impact of incompressible water feels it [m].
fn felt_walls(scene: &Scene) -> Option<(f64, f64)> {
    if !scene.solver.is_incompressible() {
        return None;
    }
    let entries = scene.entries();
    let near = |(body, entry): &(&Body, Entry)| {
        let reach = (0.5 * scene.tank.width - body.middle().abs()).min(scene.tank.depth);
        (reach, entry.final_draught)
    };
    let felt = entries.iter().map(near).filter(|(reach, draught)| *draught > 0.0 && *reach < REACH * draught);
    felt.max_by(|a, b| (a.1 / a.0).total_cmp(&(b.1 / b.0)))
}

/// Share of a force that walls take which incompressible water feels; 0 where they are far [-].
pub fn share_of_walls(scene: &Scene) -> f64 {
    felt_walls(scene).map_or(0.0, |(reach, draught)| OF_WALLS[0] * (10.0 * draught / reach).powf(OF_WALLS[1]))
}

/// Walls that an impact feels.
fn near_walls(scene: &Scene) -> Option<String> {
    felt_walls(scene).map(|(reach, draught)| {
        format!(
            "the tank's walls are {} draughts away at the end: incompressible water answers at once, which took 6 % of a \
             wedge's force at 10 draughts and 18 % at 5; {} m would keep it out",
            significant(reach / draught),
            significant(REACH * draught)
        )
    })
}
