//! The pressure of an incompressible fluid: its matrix, and how the system is solved.

pub mod cg;
pub mod matrix;
mod null_space;
#[cfg(test)]
mod tests;

pub use cg::{NotConverged, Preconditioner, PressureSolver, Solved, Stop};
pub use matrix::{Matrix, RankOne};
