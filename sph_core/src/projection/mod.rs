//! The pressure of an incompressible fluid: its matrix, and how the system is solved.

mod aggregates;
mod bodies;
pub mod cg;
mod coarse;
mod hierarchy;
pub mod matrix;
mod multigrid;
mod null_space;
#[cfg(test)]
mod test_systems;
#[cfg(test)]
mod tests;

pub use cg::{NotConverged, PressureSolver, Solved, Stop};
pub use hierarchy::Preconditioner;
pub use matrix::{Matrix, RankOne};
