//! What the thesis of 2010 needs and the default schemes do not.

pub mod density_filter;
pub(crate) mod dynamic_walls;
pub mod ideal_gas;
pub mod integrator;
pub(crate) mod mirror_point;
pub(crate) mod multistep;
pub mod pilorget2010;
pub(crate) mod repulsive;
pub mod settings;
pub mod summation;
pub mod turbulence;
pub mod wall_model;
mod xsph;
