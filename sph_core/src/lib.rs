//! Two-dimensional smoothed particle hydrodynamics for free-surface impact, f64.
//!
//! The crate knows a fluid and *walls*: particles that somebody else moves and that carry back the
//! fluid's force. Who moves them, and why, is not its business.
//!
//! Read in this order: [`fluid`] (the step), [`pair`] (the physics of two particles), [`kernel`],
//! [`walls`], then the machinery: [`cells`], [`neighbours`], [`search`], [`sweep`].
//!
//! Units are SI, per metre of span; equations are numbered in `THEORY.md`.

mod added_mass;
pub mod audit;
mod bytes;
pub mod cells;
pub mod density_filter;
pub mod dissipation;
mod dynamic_walls;
mod entries;
pub mod eos;
pub mod error;
pub mod fluid;
pub mod ideal_gas;
pub mod images;
pub mod integrator;
pub mod kernel;
pub mod lanes;
mod mirror_point;
mod multistep;
mod nearest;
pub mod neighbours;
pub mod pair;
pub mod parameters;
pub mod particles;
pub mod phases;
pub mod probe;
pub mod projection;
mod repulsive;
pub mod resolution;
mod restart;
mod rows;
pub mod screen;
pub mod search;
mod sight;
mod skin;
pub mod solver;
pub mod step_limit;
pub mod summation;
pub mod sweep;
mod sweeps;
pub mod thesis;
pub mod turbulence;
mod verbs;
pub mod wall_model;
mod wall_sweeps;
pub mod walls;
mod xsph;
pub mod yielding;

pub use density_filter::DensityFilter;
pub use dissipation::Dissipation;
pub use error::Breakdown;
pub use fluid::Fluid;
pub use ideal_gas::IdealGas;
pub use integrator::Integrator;
pub use kernel::Kernel;
pub use parameters::{Parameters, Slip};
pub use particles::{Particles, Seed};
pub use phases::{Phase, Phases};
pub use projection::Projecting;
pub use resolution::FineZone;
pub use screen::{Passage, Screen};
pub use solver::Solver;
pub use summation::DensityEvolution;
pub use thesis::ThesisSettings;
pub use turbulence::Turbulence;
pub use wall_model::{WallModel, WallTreatment};
pub use walls::{WallForces, WallPoint, Walls, WallsMut};
pub use yielding::{Yielding, Yields};
