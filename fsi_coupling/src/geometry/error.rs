//! Why corners do not make an outline.

/// Corners that do not make a simple polygon, or polygons that overlap.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct OutlineError(pub(crate) String);
