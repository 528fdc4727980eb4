//! The free surface: where it is, and its conditions on pressures and particles (THEORY I4, I5, I7, I8, I16).

pub(crate) mod active_set;
pub(crate) mod detection;
pub(crate) mod lattice;
pub(crate) mod occupancy_grid;
pub(crate) mod tangential;
