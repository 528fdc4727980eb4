//! Vectors and matrices over the end values of an element.

use nalgebra::{Matrix6, Vector6};

/// Values at the two ends of an element, (u1, w1, theta1, u2, w2, theta2), or forces conjugate to them.
pub(crate) type Ends = Vector6<f64>;

/// A square matrix over the end values.
pub(crate) type EndsMatrix = Matrix6<f64>;

/// End forces B^T (N, M_s, M_a) in the element's axes: M_s, M_a are conjugate to psi_s and psi_a.
#[inline]
pub(crate) fn end_forces(&[normal, arc, ess]: &[f64; 3], length: f64) -> Ends {
    let shear = ess / length;
    Ends::new(-normal, shear, 0.5 * (ess + arc), normal, -shear, 0.5 * (ess - arc))
}

/// The two vectors of `q` rotated by the angle of cosine `c` and sine `s`; the rotations unchanged.
#[inline]
pub(crate) fn rotate(q: &Ends, c: f64, s: f64) -> Ends {
    Ends::new(c * q[0] - s * q[1], s * q[0] + c * q[1], q[2], c * q[3] - s * q[4], s * q[3] + c * q[4], q[5])
}
