//! Section forces: normal force, shear force and bending moment in a section of an element (THEORY BE8).

use super::Ends;
use crate::material::Section;

/// Normal force, shear force and bending moment in a section of an element.
///
/// They are the force and the moment that the part beyond the section (towards the element's second
/// node) exerts on the part before it, in the element's axes: s along it, the normal to its left.
/// With the load (n, q) per length in these axes: N' = -n, Q' = -q, M' = -Q; and N = EA u', M = EI w''.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionForces {
    /// Normal force N \[N\], positive in tension.
    pub normal: f64,
    /// Shear force Q \[N\], positive towards the left-hand normal.
    pub shear: f64,
    /// Bending moment M \[N m\], positive if it compresses the left-hand side.
    pub moment: f64,
}

impl SectionForces {
    /// Stress along the element \[Pa\] in the fibre at distance `eta` \[m\] to the left of the axis:
    /// sigma = N/A - M eta/I, so eta = +/- thickness/2 gives the outer fibres.
    ///
    /// In a strip there is also nu sigma across the plane.
    pub fn fibre_stress(&self, section: &Section, eta: f64) -> f64 {
        self.normal / section.area() - self.moment * eta / section.second_moment()
    }

    /// Section forces at the two ends, from the end forces in the element's axes.
    pub(crate) fn at_ends(forces: &Ends) -> [Self; 2] {
        [
            Self { normal: -forces[0], shear: -forces[1], moment: -forces[2] },
            Self { normal: forces[3], shear: forces[4], moment: forces[5] },
        ]
    }
}
