//! Schemes and options of the thesis of 2010 that the default schemes do not need: [`Compressible`]
//! is the weakly compressible scheme with other integrators, density filters, walls, turbulence and an ideal gas;
//! [`pilorget2010`] is the thesis's projection.

pub mod compressible;
pub mod density_filter;
pub(crate) mod dynamic_walls;
pub mod ideal_gas;
pub mod integrator;
pub(crate) mod mirror_point;
pub(crate) mod multistep;
pub mod pilorget2010;
pub(crate) mod repulsive;
mod scheme;
pub mod settings;
mod steps;
pub mod summation;
pub mod turbulence;
pub mod wall_model;
pub mod xsph;

pub use compressible::Compressible;
pub use settings::{DiffusionForm, EquationOfState, Options, Settings};
