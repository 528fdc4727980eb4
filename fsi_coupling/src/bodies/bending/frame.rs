//! The rigid frame that holds what bends.

use crate::bodies::prescribed::Law;
use crate::bodies::rigid_motion::RigidMotion;
use crate::geometry::vector::rotate;

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

impl Frame {
    /// Mass, moment of inertia, centre of mass, and what is free; all zero where the motion is prescribed.
    pub(crate) fn rigid_part(&self) -> (f64, f64, [f64; 2], [bool; 3]) {
        match self {
            Frame::Given(_) => (0.0, 0.0, [0.0; 2], [false; 3]),
            Frame::Free { mass, inertia, center_of_mass, free } => (*mass, *inertia, *center_of_mass, *free),
        }
    }

    /// Its motion at the start where that is prescribed.
    pub(crate) fn prescribed_start(&self) -> Option<RigidMotion> {
        match self {
            Frame::Given(law) => Some(law(0.0)),
            Frame::Free { .. } => None,
        }
    }
}

/// A load in the axes of a frame at an angle [rad].
pub(crate) fn in_frame([x, y, moment]: &[f64; 3], angle: f64) -> [f64; 3] {
    let [x, y] = rotate([*x, *y], -angle);
    [x, y, *moment]
}

/// a − b of all nodes.
pub(crate) fn less(a: &[[f64; 3]], b: &[[f64; 3]]) -> Vec<[f64; 3]> {
    a.iter().zip(b).map(|(a, b)| [0, 1, 2].map(|k| a[k] - b[k])).collect()
}

/// Σ a·b over the nodes: of loads with displacements, work [J/m].
pub(crate) fn power(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}
