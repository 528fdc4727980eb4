//! Vectors and matrices over the end values of an element; rotations in the plane, with digits kept at small angles.

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

/// A plane vector rotated by an angle \[rad\].
///
/// Not by nalgebra's `Rotation2`: its sine depends on features of other crates (`simba/libm_force`).
pub(crate) fn rotated([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (s, c) = angle.sin_cos();
    [c * x - s * y, s * x + c * y]
}

/// sin(x)/x.
pub(crate) fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-3 { 1.0 - x * x / 6.0 * (1.0 - x * x / 20.0) } else { x.sin() / x }
}

/// The angle of a sine and a cosine, and its ratio to the sine; by a series for the small angles of a time step.
#[inline]
pub(crate) fn angle_of(sine: f64, cosine: f64) -> (f64, f64) {
    let s = sine * sine;
    if s < 1e-3 && cosine > 0.0 {
        let ratio =
            1.0 + s * (1.0 / 6.0 + s * (3.0 / 40.0 + s * (5.0 / 112.0 + s * (35.0 / 1152.0 + s * 63.0 / 2816.0))));
        return (ratio * sine, ratio);
    }
    let angle = sine.atan2(cosine);
    (angle, sinc(angle).recip())
}
