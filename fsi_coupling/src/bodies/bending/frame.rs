//! The rigid frame that holds what bends.

use crate::bodies::prescribed::Law;

/// The rigid part of a body that bends.
pub enum Frame {
    /// Prescribed motion.
    Given(Law),
    /// Moves under its loads.
    Free {
        /// Mass [kg/m].
        mass: f64,
        /// Moment of inertia about the centre of mass [kg m²/m].
        inertia: f64,
        /// Centre of mass [m].
        center_of_mass: [f64; 2],
        /// Which of x, y, angle are free; the others are held by a guide.
        free: [bool; 3],
    },
}

/// Σ a·b over the nodes: of loads with displacements, work [J/m].
pub(crate) fn power(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}
