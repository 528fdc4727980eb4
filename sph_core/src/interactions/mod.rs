//! Sums over pairs of neighbours: the kernel, the pair terms, and the lanes in which they are summed.

pub mod dissipation;
pub(crate) mod gather;
pub mod kernel;
pub mod packed;
pub mod pair;
pub mod simd;
