//! Rotations in the plane, with functions that keep their digits at small angles.

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
