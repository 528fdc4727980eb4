//! Two-dimensional smoothed particle hydrodynamics for free-surface impact, f64.
//!
//! The crate knows a fluid and *walls*: particles that somebody else moves and that carry back the
//! fluid's force. Who moves them, and why, is not its business.
//!
//! Read in this order: [`fluid`] (the step), [`interactions`] (the physics of two particles), [`walls`], then the machinery:
//! [`neighbours`], [`parallel`].
//!
//! Units are SI, per metre of span; equations are numbered in `THEORY.md`.

pub mod auto;
pub mod domain;
pub mod error;
pub mod fluid;
pub mod interactions;
pub mod legacy;
mod memory;
pub mod neighbours;
pub mod parallel;
pub mod particles;
pub mod projection;
pub mod scheme;
pub mod solver;
pub mod system;
pub mod timers;
pub mod walls;
pub mod wcsph;

pub use auto::Auto;
pub use domain::{Domain, FluidSettings, Slip};
pub use error::Breakdown;
pub use fluid::Fluid;
pub use interactions::dissipation::Dissipation;
pub use interactions::kernel::Kernel;
pub use legacy::density_filter::DensityFilter;
pub use legacy::ideal_gas::IdealGas;
pub use legacy::integrator::Integrator;
pub use legacy::pilorget2010::ThesisSettings;
pub use legacy::summation::DensityEvolution;
pub use legacy::turbulence::Turbulence;
pub use legacy::wall_model::WallModel;
pub use particles::refinement::RefinementZone;
pub use particles::{Particles, Seed};
pub use scheme::{Scheme, SchemeSettings};
pub use solver::Solver;
pub use system::ParticleSystem;
pub use timers::{Phase, Timers};
pub use walls::interface::{InterfaceDynamics, WallInterface};
pub use walls::midline::{Passage, PlateMidline};
pub use walls::{WallForces, WallLayout, WallPoint, Walls, WallsMut};
