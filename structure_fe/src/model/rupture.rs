//! Limits at which a joint breaks, and the record of a break.

use crate::error::{Error, positive};
use serde::{Deserialize, Serialize};

/// The limit at which a node is [released](crate::Supports::breakable) by its supports and joints.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Rupture {
    /// A strain \[-\] of an outer fibre, of either sign, at the end of an element at the node.
    FibreStrain(f64),
    /// A rotation \[rad\], of either sign, relative to the partner of the node's hinge or pinned link.
    Rotation(f64),
}

/// A rupture that happened, at the end of a step: the node is free from the next step on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Break {
    /// The node.
    pub node: usize,
    /// When \[s\].
    pub time: f64,
    /// Where the node was \[m\].
    pub place: [f64; 2],
    /// The strain \[-\] or rotation \[rad\] that exceeded the limit.
    pub value: f64,
}

impl Rupture {
    pub(crate) fn check(&self, index: usize) -> Result<(), Error> {
        let (quantity, value) = match *self {
            Rupture::FibreStrain(limit) => ("rupture strain [-]", limit),
            Rupture::Rotation(limit) => ("rupture rotation [rad]", limit),
        };
        positive(quantity, "breakable joint", index, value).map(|_| ())
    }
}
