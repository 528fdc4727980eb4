//! Sums over pairs of neighbours: the kernel, the pair terms, and the lanes in which they are summed.
//!
//! Read in this order: [`kernel`], [`geometry`], [`pair`], [`dissipation`]; then the machinery.

pub mod dissipation;
pub(crate) mod forces;
pub(crate) mod gather;
pub mod geometry;
pub mod kernel;
pub mod packed;
pub mod packed_particle;
pub mod pair;
pub mod simd;
