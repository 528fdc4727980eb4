//! The cost of a run, before it is run: an order of magnitude.

use sph_core::Solver;

use super::estimate::particle_estimate;
use super::keys::Scene;
use super::validity::springs::longest_spring_step;
use super::validity::wet_period::longest_step;

/// Cost of a particle and step on one core, search and walls included [s]; an order of magnitude.
const COST: f64 = 0.7e-6;

/// The same of a projection [s].
const PROJECTION_COST: f64 = 2.5e-6;

/// The same of the thesis's projection, with some 500 iterations per step [s].
const THESIS_COST: f64 = 1e-4;

/// Estimated cost of a scene's particles [core-seconds].
pub fn core_seconds(scene: &Scene) -> f64 {
    let (particles, _) = particle_estimate(scene);
    cost_of_step(scene) * particles as f64 * estimated_steps(scene)
}

/// Steps of a projection in an entry over those at the speed that is known before: the spray is faster. 1.3 to 2.8 on random drops [-].
const STEPS_IN_SPRAY: f64 = 1.8;

/// Estimated number of steps.
pub fn estimated_steps(scene: &Scene) -> f64 {
    let sprays = scene.solver.is_incompressible() && scene.time.step.is_none() && !scene.entries().is_empty();
    let more = if sprays { STEPS_IN_SPRAY } else { 1.0 };
    (more * (scene.time.end - scene.time.start) / step_at_start(scene)).ceil()
}

/// Cost of a projection step without an impact over that with one: its pressure is near that of the step before [-].
const CALM: f64 = 0.3;
/// Cost of an acoustic step on held geometry, over that of a whole step [-]: with [`MADE`], wedges took 0.78 of whole steps
/// with 4 acoustic steps per geometry, 0.57 with 8, 0.50 with 12 and 0.47 with 16.
const HELD: f64 = 0.36;
/// Cost of making a geometry that is held, over that of a whole step [-].
const MADE: f64 = 1.67;

/// Cost of a particle and step [s], with geometry that is held for the fluid's acoustic steps.
pub fn cost_of_step(scene: &Scene) -> f64 {
    let steps = scene.solver.weakly_compressible().map_or(1, |fluid| fluid.scheme.acoustic_steps());
    match scene.solver.kind() {
        Solver::WeaklyCompressible => COST * (HELD + MADE / f64::from(steps)).min(1.0),
        Solver::Incompressible | Solver::IncompressibleExplicit if scene.entries().is_empty() => CALM * PROJECTION_COST,
        Solver::Incompressible | Solver::IncompressibleExplicit => PROJECTION_COST,
        Solver::IncompressibleThesis => THESIS_COST,
    }
}

/// Step at the start [s].
pub fn step_at_start(scene: &Scene) -> f64 {
    let h = scene.water().smoothing_ratio * scene.resolution.spacing;
    let fastest = match scene.solver.is_incompressible() {
        true => scene.projection_speed(),
        false => scene.sound_speed() + scene.fastest_speed(),
    };
    let automatic = || (scene.courant_number() * h / fastest).min(longest_step(scene)).min(longest_spring_step(scene));
    scene.time.step.unwrap_or_else(automatic).min(scene.time.end)
}
