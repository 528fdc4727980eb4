//! Accelerations of bodies and pressures found together (THEORY CO19–CO23, CO25).

pub(crate) mod reaction;
pub mod solve;
mod subspace;
