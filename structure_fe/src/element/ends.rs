//! Vectors and matrices over the end values of an element; rotations in the plane, with digits kept at small angles.

use std::ops::{Add, AddAssign, Index, IndexMut, Mul, Sub};

/// Values at the two ends of an element, (u1, w1, theta1, u2, w2, theta2), or forces conjugate to them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ends(pub [f64; 6]);

/// A square matrix over the end values: its columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EndsMatrix(pub [[f64; 6]; 6]);

impl Ends {
    pub const ZERO: Self = Self([0.0; 6]);

    #[inline]
    pub fn from_fn(value: impl FnMut(usize) -> f64) -> Self {
        Self(std::array::from_fn(value))
    }

    #[inline]
    pub fn dot(&self, other: &Self) -> f64 {
        (0..6).fold(0.0, |sum, i| sum + self[i] * other[i])
    }
}

impl Index<usize> for Ends {
    type Output = f64;
    #[inline]
    fn index(&self, i: usize) -> &f64 {
        &self.0[i]
    }
}

impl IndexMut<usize> for Ends {
    #[inline]
    fn index_mut(&mut self, i: usize) -> &mut f64 {
        &mut self.0[i]
    }
}

impl Add for Ends {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::from_fn(|i| self[i] + other[i])
    }
}

impl AddAssign for Ends {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Ends {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::from_fn(|i| self[i] - other[i])
    }
}

impl Mul<Ends> for f64 {
    type Output = Ends;
    #[inline]
    fn mul(self, ends: Ends) -> Ends {
        Ends::from_fn(|i| self * ends[i])
    }
}

impl EndsMatrix {
    pub const ZERO: Self = Self([[0.0; 6]; 6]);

    /// The matrix of a linear map: its columns are the images of the unit vectors.
    pub fn of(map: impl Fn(&Ends) -> Ends) -> Self {
        let unit = |j: usize| Ends::from_fn(|i| if i == j { 1.0 } else { 0.0 });
        Self(std::array::from_fn(|j| map(&unit(j)).0))
    }

    pub fn diagonal(&self) -> Ends {
        Ends::from_fn(|i| self[(i, i)])
    }
}

impl Index<(usize, usize)> for EndsMatrix {
    type Output = f64;
    #[inline]
    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.0[j][i]
    }
}

impl IndexMut<(usize, usize)> for EndsMatrix {
    #[inline]
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.0[j][i]
    }
}

impl Mul<f64> for &EndsMatrix {
    type Output = EndsMatrix;
    #[inline]
    fn mul(self, factor: f64) -> EndsMatrix {
        let mut product = *self;
        product.0.as_flattened_mut().iter_mut().for_each(|value| *value *= factor);
        product
    }
}

/// End forces B^T (N, M_s, M_a) in the element's axes: M_s, M_a are conjugate to psi_s and psi_a.
#[inline]
pub(crate) fn end_forces(&[normal, arc, ess]: &[f64; 3], length: f64) -> Ends {
    let shear = ess / length;
    Ends([-normal, shear, 0.5 * (ess + arc), normal, -shear, 0.5 * (ess - arc)])
}

/// The two vectors of `q` rotated by the angle of cosine `c` and sine `s`; the rotations unchanged.
#[inline]
pub(crate) fn rotate(q: &Ends, c: f64, s: f64) -> Ends {
    Ends([c * q[0] - s * q[1], s * q[0] + c * q[1], q[2], c * q[3] - s * q[4], s * q[3] + c * q[4], q[5]])
}

/// A plane vector rotated by an angle \[rad\].
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
