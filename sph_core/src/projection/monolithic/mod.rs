//! Accelerations of bodies and pressures found together (THEORY PB1–PB6).

pub(crate) mod reaction;
pub mod solve;
mod subspace;
