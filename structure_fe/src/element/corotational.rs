//! Large displacements: the element in the co-rotational frame of its chord.
//!
//! The chord follows any rigid motion; the deformations against it are small (Crisfield 1991, ch. 7; Battini 2002).
//! Elongation e, arc psi_s and S psi_a are exact functions of the end values, so the energy does not change in a rigid
//! motion of any size, and forces and tangent are its first and second derivatives (THEORY BE11). Nodes may rotate
//! by many turns; the end of an element may rotate against its chord by less than half a turn.

use super::ends::{angle_of, rotate};
use super::{ElementConstants, Ends, EndsMatrix, end_forces};
use std::f64::consts::TAU;

/// Direction and length of the chord of an element, and the deformations against it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Chord {
    /// Cosine and sine of its direction \[-\].
    pub direction: [f64; 2],
    /// Its length l \[m\].
    pub length: f64,
    /// Elongation e \[m\], arc psi_s \[rad\], S psi_a \[rad\].
    pub deformation: [f64; 3],
}

impl Chord {
    /// The chord of the end values `q`.
    #[inline]
    pub fn new(element: &ElementConstants, q: &Ends) -> Self {
        let [along, across, _] = Self::end_to_end(element, q);
        let rotation = across.atan2(along);
        let psi = [q[2], q[5]].map(|theta| {
            let psi = theta - rotation;
            psi - TAU * (psi / TAU).round()
        });
        Self::with_rotations(element, q, psi)
    }

    /// The chord of the end values `q` after the chord `from` of the end values `before`; with the rotation between
    /// both \[rad\] and its ratio to its sine. Equal to [`Chord::new`] up to rounding, and cheaper for small rotations.
    #[inline]
    pub fn moved(element: &ElementConstants, from: &Self, before: &Ends, q: &Ends) -> (Self, f64, f64) {
        // Differences first: this keeps the digits of small motions.
        let (dx, dy) = ((q[3] - q[0]) - (before[3] - before[0]), (q[4] - q[1]) - (before[4] - before[1]));
        let [x, y] = from.direction;
        let (stretch, across) = (x * dx + y * dy, x * dy - y * dx);
        let along = from.length + stretch;
        let length = (along * along + across * across).sqrt();
        let (rotation, ratio) = angle_of(across / length, along / length);
        let [_, arc, ess] = from.deformation;
        let psi = [(ess + arc) + (q[2] - before[2]) - rotation, (ess - arc) + (q[5] - before[5]) - rotation];
        (Self::with_rotations(element, q, psi), rotation, ratio)
    }

    /// Components of the end-to-end vector along and across the undeformed element, and the elongation of the first.
    #[inline]
    fn end_to_end(element: &ElementConstants, q: &Ends) -> [f64; 3] {
        let [c, s] = element.tangent;
        let (du, dw) = (q[3] - q[0], q[4] - q[1]);
        let (stretch, across) = (c * du + s * dw, c * dw - s * du);
        [element.length + stretch, across, stretch]
    }

    #[inline]
    fn with_rotations(element: &ElementConstants, q: &Ends, psi: [f64; 2]) -> Self {
        let [c, s] = element.tangent;
        let original = element.length;
        let [along, across, stretch] = Self::end_to_end(element, q);
        let length = (along * along + across * across).sqrt();
        // l - L as (l^2 - L^2)/(l + L), which keeps the digits of small strains.
        let (du, dw) = (q[3] - q[0], q[4] - q[1]);
        let squares = 2.0 * original * stretch + du * du + dw * dw;
        Self {
            direction: [(c * along - s * across) / length, (s * along + c * across) / length],
            length,
            deformation: [squares / (length + original), 0.5 * (psi[0] - psi[1]), 0.5 * (psi[0] + psi[1])],
        }
    }

    /// End values of the global axes in the chord's.
    #[inline]
    pub fn to_local(self, global: &Ends) -> Ends {
        let [c, s] = self.direction;
        rotate(global, c, -s)
    }

    /// End values of the chord's axes in the global ones.
    #[inline]
    pub fn to_global(self, local: &Ends) -> Ends {
        let [c, s] = self.direction;
        rotate(local, c, s)
    }

    /// A matrix of the chord's axes in the global ones: R A R^T.
    #[inline]
    pub fn matrix_to_global(self, local: &EndsMatrix) -> EndsMatrix {
        let [c, s] = self.direction;
        let mut global = *local;
        for end in [0, 3] {
            for i in 0..6 {
                let (x, y) = (global[(i, end)], global[(i, end + 1)]);
                global[(i, end)] = c * x - s * y;
                global[(i, end + 1)] = s * x + c * y;
            }
        }
        for end in [0, 3] {
            for j in 0..6 {
                let (x, y) = (global[(end, j)], global[(end + 1, j)]);
                global[(end, j)] = c * x - s * y;
                global[(end + 1, j)] = s * x + c * y;
            }
        }
        global
    }

    /// Elastic end forces in the chord's axes, B^T (N, M_s, M_a), with the part of plastic strains (THEORY BE11, BE25).
    #[inline]
    pub fn elastic_forces(&self, element: &ElementConstants, plastic: Option<&[f64; 3]>) -> Ends {
        let elastic = deformation_forces(element, &self.deformation);
        let forces = plastic.map_or(elastic, |plastic| [0, 1, 2].map(|k| elastic[k] + plastic[k]));
        end_forces(&forces, self.length)
    }

    /// Rates (de/dt \[m/s\], dpsi_s/dt, dpsi_a/dt \[rad/s\]) of end velocities `v` in the chord's axes.
    #[inline]
    pub fn deformation_rates(&self, v: &Ends) -> [f64; 3] {
        [v[3] - v[0], 0.5 * (v[2] - v[5]), 0.5 * (v[2] + v[5]) - self.angular_velocity(v)]
    }

    /// Angular velocity of the chord \[rad/s\], of end velocities `v` in its axes.
    #[inline]
    pub fn angular_velocity(&self, v: &Ends) -> f64 {
        (v[4] - v[1]) / self.length
    }
}

/// Mean strain of the axis \[-\] (THEORY BE11).
#[inline]
pub(super) fn mean_strain(element: &ElementConstants, [e, arc, ess]: &[f64; 3]) -> f64 {
    let [g_arc, g_ess] = element.curvature_strain;
    e / element.length + 0.5 * (g_arc * arc * arc + g_ess * ess * ess)
}

/// Forces (N \[N\], M_s, M_a \[N m\]) conjugate to the deformations (THEORY BE11).
#[inline]
pub(crate) fn deformation_forces(element: &ElementConstants, [e, arc, ess]: &[f64; 3]) -> [f64; 3] {
    let [axial, for_arc, for_ess] = element.stiffness;
    let [g_arc, g_ess] = element.curvature_strain;
    let length = element.length;
    let normal = axial * (e + 0.5 * length * (g_arc * arc * arc + g_ess * ess * ess));
    [normal, (for_arc + normal * length * g_arc) * arc, (for_ess + normal * length * g_ess) * ess]
}

/// Derivatives of the forces by the deformations, symmetric: 11, 12, 13, 22, 23, 33.
#[inline]
fn deformation_tangent(element: &ElementConstants, [_, arc, ess]: &[f64; 3], normal: f64) -> [f64; 6] {
    let [axial, for_arc, for_ess] = element.stiffness;
    let length = element.length;
    let [g_arc, g_ess] = element.curvature_strain.map(|factor| factor * length);
    let (strain_by_arc, strain_by_ess) = (g_arc * arc, g_ess * ess);
    [
        axial,
        axial * strain_by_arc,
        axial * strain_by_ess,
        for_arc + normal * g_arc + axial * strain_by_arc * strain_by_arc,
        axial * strain_by_arc * strain_by_ess,
        for_ess + normal * g_ess + axial * strain_by_ess * strain_by_ess,
    ]
}

/// Elastic energy \[J\]: (EA L/2) strain^2 + bending, a sum of squares (THEORY BE11).
pub(crate) fn strain_energy(element: &ElementConstants, q: &Ends) -> f64 {
    let [e, arc, ess] = Chord::new(element, q).deformation;
    let [axial, for_arc, for_ess] = element.stiffness;
    let [g_arc, g_ess] = element.curvature_strain;
    let elongation = e + 0.5 * element.length * (g_arc * arc * arc + g_ess * ess * ess);
    0.5 * (axial * elongation.powi(2) + for_arc * arc.powi(2) + for_ess * ess.powi(2))
}

/// Adds `weight` times the elastic tangent, in the chord's axes, to `sum` (THEORY BE11).
///
/// `others` are further forces conjugate to the deformations, viscous or plastic; they add to the geometric part.
#[inline]
pub(crate) fn add_elastic_tangent(
    element: &ElementConstants,
    chord: &Chord,
    others: &[f64; 3],
    weight: f64,
    sum: &mut EndsMatrix,
) {
    let [normal, _, ess] = deformation_forces(element, &chord.deformation);
    let tangent = deformation_tangent(element, &chord.deformation, normal);
    add_deformation_matrix(chord, &tangent, weight, sum);
    add_geometric(chord, normal + others[0], ess + others[2], weight, sum);
}

/// Adds weight B^T D B to `sum`; D symmetric, in the order 11, 12, 13, 22, 23, 33.
///
/// Written out: the rows of B are (-1, 0, 0, 1, 0, 0), (0, 0, 1/2, 0, 0, -1/2), (0, y, 1/2, 0, -y, 1/2), y = 1/l.
#[inline]
pub(crate) fn add_deformation_matrix(chord: &Chord, d: &[f64; 6], weight: f64, sum: &mut EndsMatrix) {
    let [d11, d12, d13, d22, d23, d33] = d.map(|value| weight * value);
    let y = 1.0 / chord.length;
    let (u_w, w_w) = (-y * d13, y * y * d33);
    let u_theta = [0.5 * (d13 + d12), 0.5 * (d13 - d12)];
    let w_theta = [-0.5 * y * (d33 + d23), -0.5 * y * (d33 - d23)];
    for (i, sign_i) in [(0, -1.0), (3, 1.0)] {
        for (j, sign_j) in [(0, -1.0), (3, 1.0)] {
            let sign = sign_i * sign_j;
            sum[(i, j)] += sign * d11;
            sum[(i, j + 1)] += sign * u_w;
            sum[(i + 1, j)] += sign * u_w;
            sum[(i + 1, j + 1)] += sign * w_w;
        }
        for (end, (u, w)) in u_theta.into_iter().zip(w_theta).enumerate() {
            let theta = 3 * end + 2;
            sum[(i, theta)] += sign_i * u;
            sum[(theta, i)] += sign_i * u;
            sum[(i + 1, theta)] += sign_i * w;
            sum[(theta, i + 1)] += sign_i * w;
        }
    }
    sum[(2, 2)] += 0.25 * (d22 + d33) + 0.5 * d23;
    sum[(5, 5)] += 0.25 * (d22 + d33) - 0.5 * d23;
    let both = 0.25 * (d33 - d22);
    sum[(2, 5)] += both;
    sum[(5, 2)] += both;
}

/// Adds the change of B under constant forces: weight (N z z^T/l + M_a (r z^T + z r^T)/l^2), r along
/// the chord, z across it.
#[inline]
fn add_geometric(chord: &Chord, normal: f64, ess: f64, weight: f64, sum: &mut EndsMatrix) {
    let tension = weight * normal / chord.length;
    let couple = weight * ess / chord.length.powi(2);
    for (i, sign_i) in [(0, -1.0), (3, 1.0)] {
        for (j, sign_j) in [(0, -1.0), (3, 1.0)] {
            let sign = sign_i * sign_j;
            sum[(i + 1, j + 1)] += sign * tension;
            sum[(i, j + 1)] += sign * couple;
            sum[(i + 1, j)] += sign * couple;
        }
    }
}

#[cfg(test)]
#[path = "corotational_tests.rs"]
mod tests;
