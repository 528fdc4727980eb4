//! The element: a straight Euler-Bernoulli beam with two nodes in the plane.
//!
//! Everything elastic is written in the three *deformations* of the element, which no rigid motion
//! changes (Argyris 1964): its elongation e and the rotations psi_1, psi_2 of its ends against its
//! chord. With the end values q = (u1, w1, theta1, u2, w2, theta2) they are d = B q, the conjugate
//! forces (N, M_1, M_2) are D d, and so K = B^T D B. This is exact for linear loads and uniform
//! stiffness (cubic deflection, Przemieniecki 1968, ch. 5); small displacements, no shear
//! deformation, so for length/thickness above about 10.

/// Values at the two ends of an element, `[u1, w1, theta1, u2, w2, theta2]`, or forces conjugate to them.
pub(crate) type Ends = [f64; 6];

/// A square matrix over the end values.
pub(crate) type EndsMatrix = [[f64; 6]; 6];

/// Geometry, stiffness and mass of one element.
#[derive(Debug, Clone)]
pub(crate) struct EulerBernoulli {
    /// Length L \[m\].
    pub length: f64,
    /// Unit vector (cos, sin) from the first node to the second \[-\].
    pub tangent: [f64; 2],
    /// Axial stiffness EA \[N\].
    pub axial_stiffness: f64,
    /// Bending stiffness EI \[N m^2\].
    pub bending_stiffness: f64,
    /// Mass per length rho A \[kg/m\].
    pub mass_per_length: f64,
}

impl EulerBernoulli {
    /// Deformations d = (e \[m\], psi_1 \[rad\], psi_2 \[rad\]) of the end values.
    ///
    /// Differences are taken first, so that a rigid translation gives exactly zero.
    fn deformations(&self, q: &Ends) -> [f64; 3] {
        let [c, s] = self.tangent;
        let (du, dw) = (q[3] - q[0], q[4] - q[1]);
        let chord_rotation = (c * dw - s * du) / self.length;
        [c * du + s * dw, q[2] - chord_rotation, q[5] - chord_rotation]
    }

    /// Forces D d conjugate to the deformations: normal force \[N\] and the two end moments \[N m\].
    fn deformation_forces(&self, d: &[f64; 3]) -> [f64; 3] {
        let bending = 2.0 * self.bending_stiffness / self.length;
        [self.axial_stiffness / self.length * d[0], bending * (2.0 * d[1] + d[2]), bending * (d[1] + 2.0 * d[2])]
    }

    /// End forces B^T (N, M_1, M_2), in the global axes.
    fn end_forces(&self, forces: &[f64; 3]) -> Ends {
        let [normal, moment_1, moment_2] = *forces;
        let shear = (moment_1 + moment_2) / self.length;
        self.to_global(&[-normal, shear, moment_1, normal, -shear, moment_2])
    }

    /// Elastic end forces K q, in the global axes \[N, N, N m, ...\].
    pub fn elastic_forces(&self, q: &Ends) -> Ends {
        self.end_forces(&self.deformation_forces(&self.deformations(q)))
    }

    /// Elastic energy d^T D d/2 \[J\]: a sum of squares, so never negative.
    pub fn strain_energy(&self, q: &Ends) -> f64 {
        let [e, psi_1, psi_2] = self.deformations(q);
        let bending = psi_1.powi(2) + psi_2.powi(2) + (psi_1 + psi_2).powi(2);
        0.5 * self.axial_stiffness / self.length * e.powi(2) + self.bending_stiffness / self.length * bending
    }

    /// Stiffness matrix K = B^T D B in the global axes.
    pub fn stiffness(&self) -> EndsMatrix {
        columns(|unit| self.elastic_forces(unit))
    }

    /// Consistent mass matrix in the global axes: linear u, cubic w, no rotatory inertia
    /// (Przemieniecki 1968, ch. 11).
    pub fn mass(&self) -> EndsMatrix {
        columns(|unit| self.to_global(&self.local_momentum(&self.to_local(unit))))
    }

    /// Kinetic energy v^T M v/2 \[J\] of the end velocities.
    pub fn kinetic_energy(&self, v: &Ends) -> f64 {
        let local = self.to_local(v);
        let momentum = self.local_momentum(&local);
        0.5 * local.iter().zip(&momentum).map(|(v, p)| v * p).sum::<f64>()
    }

    /// Consistent mass times the end values, both in the element's axes.
    fn local_momentum(&self, v: &Ends) -> Ends {
        let length = self.length;
        let mass = self.mass_per_length * length;
        let (axial, bending) = (mass / 6.0, mass / 420.0);
        let [u1, w1, r1, u2, w2, r2] = [v[0], v[1], v[2] * length, v[3], v[4], v[5] * length];
        [
            axial * (2.0 * u1 + u2),
            bending * (156.0 * w1 + 22.0 * r1 + 54.0 * w2 - 13.0 * r2),
            bending * length * (22.0 * w1 + 4.0 * r1 + 13.0 * w2 - 3.0 * r2),
            axial * (u1 + 2.0 * u2),
            bending * (54.0 * w1 + 13.0 * r1 + 156.0 * w2 - 22.0 * r2),
            bending * length * (-13.0 * w1 - 3.0 * r1 - 22.0 * w2 + 4.0 * r2),
        ]
    }

    /// Consistent end forces of a load that varies linearly from `start` to `end`, both in the
    /// global axes and per length of the element \[N/m\] (Przemieniecki 1968, ch. 5).
    ///
    /// Minus these are the forces of the fixed ends.
    pub fn load_forces(&self, start: [f64; 2], end: [f64; 2]) -> Ends {
        let length = self.length;
        let [n1, q1, _, n2, q2, _] = self.to_local(&[start[0], start[1], 0.0, end[0], end[1], 0.0]);
        self.to_global(&[
            length / 6.0 * (2.0 * n1 + n2),
            length / 20.0 * (7.0 * q1 + 3.0 * q2),
            length.powi(2) / 60.0 * (3.0 * q1 + 2.0 * q2),
            length / 6.0 * (n1 + 2.0 * n2),
            length / 20.0 * (3.0 * q1 + 7.0 * q2),
            -length.powi(2) / 60.0 * (2.0 * q1 + 3.0 * q2),
        ])
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

/// The two vectors of `q` turned by the angle of cosine `c` and sine `s`, the rotations untouched.
fn rotate(q: &Ends, c: f64, s: f64) -> Ends {
    [c * q[0] - s * q[1], s * q[0] + c * q[1], q[2], c * q[3] - s * q[4], s * q[3] + c * q[4], q[5]]
}

/// The matrix of a symmetric linear map: its columns, hence rows, are the images of the unit vectors.
fn columns(map: impl Fn(&Ends) -> Ends) -> EndsMatrix {
    std::array::from_fn(|j| {
        let mut unit = [0.0; 6];
        unit[j] = 1.0;
        map(&unit)
    })
}
