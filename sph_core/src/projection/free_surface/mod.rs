//! The free surface: where it is (`detection`), and its conditions on pressures (`active_set`) and particles (THEORY PR4, PR5, PR7, PR8).

pub(crate) mod active_set;
pub(crate) mod detection;
pub(crate) mod occupancy_grid;
