//! The incompressible solver: a projection a step (THEORY I1–I16).
//!
//! Read in this order: `step`, `survey` (what the pairs give), `lattice` (what a flat surface lacks), `air` (where
//! the air is), `poisson` (the pressure).

mod explicit;
mod forces;
mod free_surface;
pub mod linear_solver;
mod monolithic;
mod motion;
mod operators;
mod pair_batch;
mod poisson;
mod settings;
#[cfg(test)]
mod tests;

pub(crate) use free_surface::lattice::Lattice;
pub use linear_solver::{Matrix, NotConverged, Preconditioner, PressureSolver, RankOne, Solved, Stop, cg, matrix};
pub use settings::{FlowSettings, Method, Settings};

use serde::{Deserialize, Serialize};

use crate::error::Breakdown;
use crate::fluid::Fluid;
use crate::solver::Solver;
use crate::timers::Phase;
use crate::walls::Walls;

use forces::Push;
use free_surface::detection::Air;
use monolithic::solve::Bodies;
use operators::Survey;

/// What a projection does not change during a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Projecting {
    /// Residual that ends the iteration, over the largest right-hand side [-].
    pub tolerance: f64,
    /// Iterations after which a solve has failed.
    pub most_iterations: usize,
    /// Time in which an error of density relaxes, over h/U (I9) [-].
    pub relaxation: f64,
    /// Viscosity over h √(|g| h) (I12) [-].
    pub calming: f64,
    /// Shift over the distance moved in a step, times 2h∇C [-].
    pub shift: f64,
}

impl Default for Projecting {
    fn default() -> Projecting {
        Projecting { tolerance: 3e-4, most_iterations: 2000, relaxation: 3.0, calming: 0.15, shift: 1.0 }
    }
}

/// What a step of the projection computes anew, and what it counts.
#[derive(Clone, Debug, Default)]
pub struct Projection {
    pub(crate) survey: Survey,
    pub(crate) lattice: Option<Lattice>,
    pub(crate) air: Air,
    /// Excess of each row's diagonal: the free surface (I7).
    pub(crate) excess: Vec<f64>,
    pub(crate) pushes: Vec<Push>,
    pub(crate) wet: Vec<f64>,
    /// Normals of the surface (I16).
    pub(crate) normals: Vec<[f64; 2]>,
    pub(crate) pinned: Vec<bool>,
    /// Rows that bear no tension (I8).
    slack: Vec<bool>,
    pub(crate) source: Vec<f64>,
    pub(crate) scale: Vec<f64>,
    pub(crate) matrix: Matrix,
    pub(crate) solver: PressureSolver,
    /// Iterations of all solves.
    pub iterations: u64,
    /// Solves.
    pub solves: u64,
    /// Rows pinned by the unilateral condition, in the last step.
    pub pins: usize,
    /// What bodies need from step to step (PB2).
    pub bodies: Bodies,
    last_dt: f64,
    head: f64,
    /// The last step's pressures [Pa].
    pub(crate) before: Vec<f64>,
    /// For how many steps each particle has been pinned, by identity (I8).
    kept: Vec<u8>,
}

/// One step (THEORY I1). Before: the walls' kinematics are those of the step's end.
pub(crate) fn step(fluid: &mut Fluid, walls: &mut Walls, dt: f64) -> Result<(), Breakdown> {
    fluid.pack(walls, -dt); //           who is near whom at r
    fluid.phases.begin(Phase::Density);
    fluid.find_air(walls); //       holes between particles (I5)
    fluid.dry_walls(walls); //      walls that no water meets (I5)
    fluid.survey(walls, dt); //          C, ∇C, ∇·u*, A
    fluid.expose(); //               who feels air (I5)
    fluid.close_surface(); //            s
    fluid.phases.begin(Phase::Pressure);
    match fluid.parameters.solver {
        Solver::IncompressibleExplicit => fluid.sweep_pressure(dt), // the same, one sweep (EX3)
        _ => fluid.solve_pressure(walls, dt)?, // (A + s) p = −V ∇·u*/Δt + V (C − 1)/(τ Δt); a_w with it (PB3)
    }
    fluid.push(walls, dt); //            a = g − ∇p/ρ, F
    fluid.advance(dt); //                u' = u + Δt a, r' = r + Δt u' + δr
    fluid.projection.last_dt = dt;
    Ok(())
}
