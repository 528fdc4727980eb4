//! The element: a straight beam with two nodes in the plane, and its constants.
//!
//! The elastic relations use three *deformations*, which no rigid motion changes (Argyris 1964): the elongation e and
//! the rotations psi_1, psi_2 of the ends against the chord, as the symmetric part psi_s = (psi_1 - psi_2)/2 (an arc)
//! and the antisymmetric part psi_a = (psi_1 + psi_2)/2 (an S). Only psi_a shears the element, so the shear parameter
//! Phi = 12 EI/(kappa G A L^2) divides its stiffness by 1 + Phi; Phi = 0 gives Euler-Bernoulli's element (THEORY BE4).
//! With the end values q = (u1, w1, theta1, u2, w2, theta2) the deformations are d = B q, the conjugate forces D d, and
//! K = B^T D B: exact for linear loads and uniform stiffness (Przemieniecki 1968, ch. 5), hence without locking. This
//! file is for small displacements; `corotational.rs` adds arbitrary rotations.

use super::ends::{Ends, EndsMatrix, end_forces, rotate};
use super::mass::{consistent_mass, mass_times};
use super::plastic::PlasticElement;
use crate::material::{Material, Section};
use serde::{Deserialize, Serialize};

/// The theory of an element. Euler-Bernoulli by default; see [`Beam::with_theory`](crate::Beam::with_theory).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Theory {
    /// Sections stay normal to the axis: no shear deformation. For length/thickness above about 10.
    #[default]
    EulerBernoulli,
    /// Sections stay plane but turn against the axis by Q/(kappa G A) (Timoshenko 1921).
    Timoshenko {
        /// Shear correction kappa \[-\], positive: 5/6 for a rectangle (Reissner 1945), or
        /// (5 + 5 nu)/(6 + 5 nu) (Kaneko 1975).
        shear_correction: f64,
    },
}

impl Theory {
    /// Timoshenko's theory with kappa = 5/6, a rectangle's.
    pub const TIMOSHENKO: Self = Self::Timoshenko { shear_correction: 5.0 / 6.0 };
}

/// Geometry, stiffness and mass of one element.
#[derive(Debug, Clone)]
pub(crate) struct ElementConstants {
    /// Length L \[m\].
    pub length: f64,
    /// Unit vector (cos, sin) from the first node to the second \[-\].
    pub tangent: [f64; 2],
    /// The diagonal of D: stiffness against elongation \[N/m\], arc and S \[N m\] (THEORY BE4).
    pub stiffness: [f64; 3],
    /// Factors of psi_s^2/2 and psi_a^2/2 in the mean strain \[-\] (THEORY BE11).
    pub curvature_strain: [f64; 2],
    /// Shear parameter Phi = 12 EI/(kappa G A L^2) \[-\]; 0 without shear deformation.
    pub shear_parameter: f64,
    /// Mass per length rho A \[kg/m\].
    pub mass_per_length: f64,
    /// Square of the section's radius of gyration I/A \[m^2\]; 0 without rotatory inertia.
    pub radius_squared: f64,
    /// Consistent mass in the element's axes (THEORY BE5).
    pub mass: EndsMatrix,
    /// Its layers, if the element can yield.
    pub plastic: Option<PlasticElement>,
}

impl ElementConstants {
    /// An elastic element whose second node is at `[dx, dy]` \[m\] from the first.
    pub fn new(
        material: &Material,
        section: &Section,
        theory: Theory,
        rotatory_inertia: bool,
        [dx, dy]: [f64; 2],
    ) -> Self {
        let length = dx.hypot(dy);
        let bending_stiffness = section.bending_stiffness(material);
        let phi = match theory {
            Theory::EulerBernoulli => 0.0,
            Theory::Timoshenko { shear_correction } => {
                12.0 * bending_stiffness / (section.shear_stiffness(material, shear_correction) * length.powi(2))
            }
        };
        let bending = 4.0 * bending_stiffness / length;
        let mass_per_length = section.mass_per_length(material);
        let radius_squared = if rotatory_inertia { section.second_moment() / section.area() } else { 0.0 };
        Self {
            length,
            tangent: [dx / length, dy / length],
            stiffness: [section.axial_stiffness(material) / length, bending, 3.0 * bending / (1.0 + phi)],
            curvature_strain: [1.0 / 3.0, 0.2 / (1.0 + phi).powi(2)],
            shear_parameter: phi,
            mass_per_length,
            radius_squared,
            mass: consistent_mass(mass_per_length * length, length, phi, radius_squared),
            plastic: None,
        }
    }

    /// Deformations d = (e \[m\], psi_s \[rad\], psi_a \[rad\]) of the end values (THEORY BE3).
    ///
    /// Differences are taken first, so that a rigid translation gives exactly zero.
    fn deformations(&self, q: &Ends) -> [f64; 3] {
        let [c, s] = self.tangent;
        let (du, dw) = (q[3] - q[0], q[4] - q[1]);
        let chord_rotation = (c * dw - s * du) / self.length;
        let (psi_1, psi_2) = (q[2] - chord_rotation, q[5] - chord_rotation);
        [c * du + s * dw, 0.5 * (psi_1 - psi_2), 0.5 * (psi_1 + psi_2)]
    }

    /// Elastic end forces K q, in the global axes \[N, N, N m, ...\].
    pub fn elastic_forces(&self, q: &Ends) -> Ends {
        let d = self.deformations(q);
        self.to_global(&end_forces(&[0, 1, 2].map(|i| self.stiffness[i] * d[i]), self.length))
    }

    /// Elastic energy d^T D d/2 \[J\]: a sum of squares, so never negative.
    pub fn strain_energy(&self, q: &Ends) -> f64 {
        let d = self.deformations(q);
        0.5 * (0..3).map(|i| self.stiffness[i] * d[i].powi(2)).sum::<f64>()
    }

    /// Stiffness matrix K = B^T D B in the global axes.
    pub fn stiffness(&self) -> EndsMatrix {
        EndsMatrix::of(|unit| self.elastic_forces(unit))
    }

    /// Consistent mass matrix in the global axes (THEORY BE5).
    pub fn global_mass(&self) -> EndsMatrix {
        EndsMatrix::of(|unit| self.to_global(&mass_times(&self.mass, &self.to_local(unit))))
    }

    /// Kinetic energy v^T M v/2 \[J\] of the end velocities.
    pub fn kinetic_energy(&self, v: &Ends) -> f64 {
        let local = self.to_local(v);
        0.5 * local.dot(&mass_times(&self.mass, &local))
    }

    /// Consistent end forces of a load that varies linearly from `start` to `end`, both in the
    /// global axes and per length of the element \[N/m\] (THEORY BE6; Przemieniecki 1968, ch. 5).
    ///
    /// Minus these are the forces of the fixed ends.
    pub fn load_forces(&self, start: [f64; 2], end: [f64; 2]) -> Ends {
        let local = self.to_local(&Ends([start[0], start[1], 0.0, end[0], end[1], 0.0]));
        self.to_global(&self.local_load_forces([local[0], local[1]], [local[3], local[4]]))
    }

    /// The same in the element's axes, of loads (along it, to its left) \[N/m\].
    pub fn local_load_forces(&self, [n1, q1]: [f64; 2], [n2, q2]: [f64; 2]) -> Ends {
        let (length, phi) = (self.length, self.shear_parameter);
        let force = |near: f64, far: f64| {
            length * ((7.0 * near + 3.0 * far) / 20.0 + phi * (2.0 * near + far) / 6.0) / (1.0 + phi)
        };
        let moment = |near: f64, far: f64| {
            length.powi(2) * ((3.0 * near + 2.0 * far) / 60.0 + phi * (near + far) / 24.0) / (1.0 + phi)
        };
        let axial = |near: f64, far: f64| length / 6.0 * (2.0 * near + far);
        Ends([axial(n1, n2), force(q1, q2), moment(q1, q2), axial(n2, n1), force(q2, q1), -moment(q2, q1)])
    }

    /// End values of the global axes in the element's axes: along it, and across it to the left.
    pub fn to_local(&self, global: &Ends) -> Ends {
        let [c, s] = self.tangent;
        rotate(global, c, -s)
    }

    /// End values of the element's axes in the global axes.
    fn to_global(&self, local: &Ends) -> Ends {
        let [c, s] = self.tangent;
        rotate(local, c, s)
    }
}
