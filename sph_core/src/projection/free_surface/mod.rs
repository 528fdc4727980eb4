//! Where the free surface is, and what it asks of pressures and particles (THEORY I4, I5, I7, I8, I16).

pub(crate) mod active_set;
pub(crate) mod detection;
pub(crate) mod lattice;
pub(crate) mod occupancy_grid;
mod tangential;
