//! Direct solvers for the equations of beams: banded matrices with a border, node ordering, connected parts.
//!
//! The tangent of a step is factorised here and not by faer: a beam's matrix is a band of half-width five to eight and
//! the few rows of rigid bodies, which a direct loop factorises in O(n b^2) without index arrays or supernodes, and its
//! negative pivots count unstable directions. Linear statics and modes, with matrices of any pattern, use faer.

mod banded;
mod bordered;
mod graph;

pub(crate) use banded::ZeroPivot;
pub(crate) use bordered::Bordered;
pub(crate) use graph::{connected_parts, narrow_band};
