//! Sums over pairs of neighbours: the pair terms, and the packed particles that the sums read.
//!
//! Read in this order: [`crate::kernel`], [`geometry`], [`pair`], [`dissipation`]; then the machinery.

pub mod dissipation;
pub(crate) mod gather;
pub mod geometry;
pub mod packed;
pub mod packed_particle;
pub mod pair;
