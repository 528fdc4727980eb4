//! Conjugate gradients with a multigrid preconditioner (THEORY LS2–LS10).

mod aggregates;
pub mod cg;
pub(crate) mod cluster_matrix;
mod coarse;
mod hierarchy;
pub mod matrix;
mod multigrid;
mod null_space;
#[cfg(test)]
pub(crate) mod test_systems;
mod woodbury;

pub use cg::{NotConverged, PressureSolver, Solved, Stop};
pub use hierarchy::Preconditioner;
pub use matrix::{Matrix, MatrixRows, RankOne};
