//! Mirror planes (THEORY, "Walls"): a neighbour behind a plane of symmetry is the image of one in front of it.
//!
//! An image is never stored as state: it is a source particle and a reflection, applied whenever the
//! rows of a sweep are packed.

use serde::{Deserialize, Serialize};

/// A plane of symmetry x = `at`; the fluid lies on the side x > `at`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mirror {
    /// Where the plane stands [m].
    pub at: f64,
}

impl Mirror {
    /// Image of a horizontal position [m].
    #[inline(always)]
    pub fn reflect(&self, x: f64) -> f64 {
        2.0 * self.at - x
    }
}
