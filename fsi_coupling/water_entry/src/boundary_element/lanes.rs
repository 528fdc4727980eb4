//! Numbers on which vector instructions act together; a product and a sum are rounded once.

use std::array::from_fn;
use std::ops::{Add, Mul, Sub};

/// Numbers of as many elements as are treated at a time.
#[derive(Clone, Copy, Default)]
pub(super) struct Lanes(pub [f64; LANES]);

/// Numbers in it: vector instructions of 512 bits take one, others two or four.
pub(super) const LANES: usize = 8;

impl Add for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn add(self, other: Lanes) -> Lanes {
        Lanes(from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn sub(self, other: Lanes) -> Lanes {
        Lanes(from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl Mul for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn mul(self, other: Lanes) -> Lanes {
        Lanes(from_fn(|k| self.0[k] * other.0[k]))
    }
}

impl Lanes {
    #[inline(always)]
    pub fn all(value: f64) -> Lanes {
        Lanes([value; LANES])
    }

    /// a b + c, rounded once.
    #[inline(always)]
    pub fn times_plus(self, b: Lanes, c: Lanes) -> Lanes {
        Lanes(from_fn(|k| self.0[k].mul_add(b.0[k], c.0[k])))
    }

    /// c − a b, rounded once.
    #[inline(always)]
    pub fn times_less(self, b: Lanes, c: Lanes) -> Lanes {
        Lanes(from_fn(|k| (-self.0[k]).mul_add(b.0[k], c.0[k])))
    }

    #[inline(always)]
    pub fn inverse(self) -> Lanes {
        Lanes(from_fn(|k| 1.0 / self.0[k]))
    }

    /// The largest of them; NaN counts as the largest.
    #[inline(always)]
    pub fn largest(self) -> f64 {
        self.0.iter().fold(0.0, |most: f64, number| if *number < most { most } else { *number })
    }
}

/// Product of complex numbers.
#[inline(always)]
pub(super) fn times(a: [Lanes; 2], b: [Lanes; 2]) -> [Lanes; 2] {
    [a[1].times_less(b[1], a[0] * b[0]), a[0].times_plus(b[1], a[1] * b[0])]
}

/// a b + c of complex numbers.
#[inline(always)]
pub(super) fn times_plus(a: [Lanes; 2], b: [Lanes; 2], c: [Lanes; 2]) -> [Lanes; 2] {
    [a[1].times_less(b[1], a[0].times_plus(b[0], c[0])), a[0].times_plus(b[1], a[1].times_plus(b[0], c[1]))]
}
