//! Smoothing kernels (THEORY OP2): W(r, h) = α/h² w(q), q = r/h, support q < 2.
//!
//! Adding a kernel touches this file only: a unit struct with its [`Shape`], a variant of [`Kernel`], its entry in [`Kernel::ALL`] and its arm in
//! [`Kernel::run`]. Rules that name single kernels, such as limits of steps, are in the crate `scene`: `resolve` and `validity`.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::parallel;
use crate::simd::{self, SimdReal, Task};

/// The kernels a scene may choose from; each is normalised on its own support of radius 2h.
///
/// ```
/// use sph_core::Kernel;
/// assert!(Kernel::WendlandC2.value(0.0, 0.1) > Kernel::WendlandC2.value(0.1, 0.1));
/// assert_eq!(Kernel::WendlandC2.value(0.2, 0.1), 0.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kernel {
    /// w = exp(−q²), cut at q = 2 and normalised there (the textbook 1/π loses 1.8 %).
    Gaussian,
    /// w = (3/16)(2 − q)² (Johnson, Stryk & Beissel 1996).
    Quadratic,
    /// Monaghan & Lattanzio (1985) M4 spline.
    CubicSpline,
    /// w = (1 − q/2)⁴(2q + 1) (Wendland 1995, C2): positive definite, so particles do not pair.
    #[default]
    WendlandC2,
    /// w = (1 − q/2)⁶(35q²/12 + 3q + 1) (Wendland 1995, C4): narrower for its support than C2.
    WendlandC4,
    /// w = (1 − q/2)⁸(4q³ + 25q²/4 + 4q + 1) (Wendland 1995, C6): narrower still, for smoothing ratios from 2.
    WendlandC6,
}

/// A kernel's dimensionless shape. `W = ALPHA/h² w(q)`; `∇_a W_ab = F r_ab` with `F = ALPHA/h⁴ DW_FACTOR dw_over_q(q)`; `F'(r)/r = ALPHA/h⁶
/// DW_FACTOR bend(q)`. All are nothing for q ≥ 2: pairs are not asked first.
pub(crate) trait Shape: Copy + Send + Sync + 'static {
    /// Normalisation [-]: α ∫₀² w(q) 2πq dq = 1.
    const ALPHA: f64;
    /// w(q) [-], for 0 ≤ q.
    fn w<R: SimdReal>(q: R) -> R;
    /// Factor of [`Shape::dw_over_q`] [-].
    const DW_FACTOR: f64;
    /// w'(q)/q over `DW_FACTOR` [-] (never negative), for 0 < q; finite at 0.
    fn dw_over_q<R: SimdReal>(q: R) -> R;
    /// Slope of [`Shape::dw_over_q`] over q [-], for 0 < q: how ∇W changes as a pair moves.
    fn bend<R: SimdReal>(q: R) -> R;
    /// Its sums are compiled for several targets side by side too. False for the kernels of 2010, which few scenes use.
    const SIDE_BY_SIDE: bool = true;
    /// Its sums are compiled for the registers of AVX-512 too.
    const AVX512: bool = false;
}

/// Do `task`, sums with kernel `K`, as wide as they are compiled and this processor can; one target at a time where `simd` is false.
#[inline]
pub(crate) fn run_sums<K: Shape, T: Task>(simd: bool, task: T) -> T::Out {
    if K::AVX512 {
        simd::run_wide::<true, T>(simd, task)
    } else if K::SIDE_BY_SIDE {
        simd::run_wide::<false, T>(simd, task)
    } else {
        task.run(0.0)
    }
}

/// See [`Kernel::Gaussian`].
#[derive(Clone, Copy)]
pub(crate) struct Gaussian;
/// See [`Kernel::Quadratic`].
#[derive(Clone, Copy)]
pub(crate) struct Quadratic;
/// See [`Kernel::CubicSpline`].
#[derive(Clone, Copy)]
pub(crate) struct CubicSpline;
/// See [`Kernel::WendlandC2`].
#[derive(Clone, Copy)]
pub(crate) struct WendlandC2;
/// See [`Kernel::WendlandC4`].
#[derive(Clone, Copy)]
pub(crate) struct WendlandC4;
/// See [`Kernel::WendlandC6`].
#[derive(Clone, Copy)]
pub(crate) struct WendlandC6;

/// 1 − e⁻⁴, the part of the Gaussian inside q < 2.
const GAUSSIAN_INSIDE: f64 = 0.981_684_361_111_265_8;

impl Shape for Gaussian {
    const ALPHA: f64 = 1.0 / (PI * GAUSSIAN_INSIDE);
    const DW_FACTOR: f64 = -2.0;
    const SIDE_BY_SIDE: bool = false;
    #[inline(always)]
    fn w<R: SimdReal>(q: R) -> R {
        q.below(q.of(2.0), (q.of(-1.0) * q * q).exp(), q.of(0.0))
    }
    #[inline(always)]
    fn dw_over_q<R: SimdReal>(q: R) -> R {
        Self::w(q)
    }
    #[inline(always)]
    fn bend<R: SimdReal>(q: R) -> R {
        q.of(-2.0) * Self::w(q)
    }
}

impl Shape for Quadratic {
    const ALPHA: f64 = 2.0 / PI;
    const DW_FACTOR: f64 = -0.375;
    const SIDE_BY_SIDE: bool = false;
    #[inline(always)]
    fn w<R: SimdReal>(q: R) -> R {
        let t = (q.of(2.0) - q).max(q.of(0.0));
        q.of(0.1875) * t * t
    }
    #[inline(always)]
    fn dw_over_q<R: SimdReal>(q: R) -> R {
        (q.of(2.0) - q).max(q.of(0.0)) / q.max(q.of(1e-12))
    }
    #[inline(always)]
    fn bend<R: SimdReal>(q: R) -> R {
        q.below(q.of(2.0), q.of(-2.0) / (q * q * q), q.of(0.0))
    }
}

impl Shape for CubicSpline {
    const ALPHA: f64 = 10.0 / (7.0 * PI);
    const DW_FACTOR: f64 = -0.75;
    const SIDE_BY_SIDE: bool = false;
    #[inline(always)]
    fn w<R: SimdReal>(q: R) -> R {
        let t = (q.of(2.0) - q).max(q.of(0.0));
        q.below(q.of(1.0), q.of(1.0) - q * q * (q.of(1.5) - q.of(0.75) * q), q.of(0.25) * t * t * t)
    }
    #[inline(always)]
    fn dw_over_q<R: SimdReal>(q: R) -> R {
        let t = (q.of(2.0) - q).max(q.of(0.0));
        q.below(q.of(1.0), q.of(4.0) - q.of(3.0) * q, t * t / q)
    }
    #[inline(always)]
    fn bend<R: SimdReal>(q: R) -> R {
        let t = (q.of(2.0) - q).max(q.of(0.0));
        q.below(q.of(1.0), q.of(-3.0) / q, q.of(-1.0) * t * (q.of(2.0) + q) / (q * q * q))
    }
}

impl Shape for WendlandC2 {
    const ALPHA: f64 = 7.0 / (4.0 * PI);
    const DW_FACTOR: f64 = -5.0;
    const AVX512: bool = true;
    #[inline(always)]
    fn w<R: SimdReal>(q: R) -> R {
        let t = half_left(q);
        let t2 = t * t;
        t2 * t2 * q.mul_add(q.of(2.0), q.of(1.0))
    }
    #[inline(always)]
    fn dw_over_q<R: SimdReal>(q: R) -> R {
        let t = half_left(q);
        t * t * t
    }
    #[inline(always)]
    fn bend<R: SimdReal>(q: R) -> R {
        let t = half_left(q);
        q.of(-1.5) * t * t / q
    }
}

impl Shape for WendlandC4 {
    const ALPHA: f64 = 9.0 / (4.0 * PI);
    const DW_FACTOR: f64 = -14.0 / 3.0;
    #[inline(always)]
    fn w<R: SimdReal>(q: R) -> R {
        let t = half_left(q);
        let t2 = t * t;
        t2 * t2 * t2 * q.of(35.0 / 12.0).mul_add(q, q.of(3.0)).mul_add(q, q.of(1.0))
    }
    #[inline(always)]
    fn dw_over_q<R: SimdReal>(q: R) -> R {
        let t = half_left(q);
        let t2 = t * t;
        t2 * t2 * t * q.mul_add(q.of(2.5), q.of(1.0))
    }
    #[inline(always)]
    fn bend<R: SimdReal>(q: R) -> R {
        let t = half_left(q);
        let t2 = t * t;
        q.of(-7.5) * t2 * t2
    }
}

impl Shape for WendlandC6 {
    const ALPHA: f64 = 39.0 / (14.0 * PI);
    const DW_FACTOR: f64 = -5.5;
    #[inline(always)]
    fn w<R: SimdReal>(q: R) -> R {
        let t = half_left(q);
        let t2 = t * t;
        let t4 = t2 * t2;
        t4 * t4 * q.of(4.0).mul_add(q, q.of(6.25)).mul_add(q, q.of(4.0)).mul_add(q, q.of(1.0))
    }
    #[inline(always)]
    fn dw_over_q<R: SimdReal>(q: R) -> R {
        let t = half_left(q);
        let t3 = t * t * t;
        t3 * t3 * t * q.of(4.0).mul_add(q, q.of(3.5)).mul_add(q, q.of(1.0))
    }
    #[inline(always)]
    fn bend<R: SimdReal>(q: R) -> R {
        let t = half_left(q);
        let t3 = t * t * t;
        q.of(-6.0) * t3 * t3 * q.mul_add(q.of(3.0), q.of(1.0))
    }
}

/// 1 − q/2, and nothing beyond the support.
#[inline(always)]
fn half_left<R: SimdReal>(q: R) -> R {
    q.mul_add(q.of(-0.5), q.of(1.0)).max(q.of(0.0))
}

/// Something to be done with a kernel known at compile time: one dispatch, then an inlined loop.
pub(crate) trait WithKernel {
    /// What comes back.
    type Out;
    /// Do it with kernel `K`.
    fn with<K: Shape>(self) -> Self::Out;
}

/// A sum over the neighbours of each of many targets.
pub(crate) trait TargetSum: Sync {
    /// A target's sum.
    type Sum: Send;
    /// The sum of target `k`.
    fn of<K: Shape>(&self, k: usize) -> Self::Sum;
}

struct Gathering<'a, S: TargetSum>(&'a S, &'a mut [S::Sum]);

impl<S: TargetSum> WithKernel for Gathering<'_, S> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Gathering(sum, out) = self;
        parallel::gather_into(out, |k| sum.of::<K>(k));
    }
}

impl Kernel {
    /// Every kernel, for tests and tables.
    pub const ALL: [Kernel; 6] = [
        Kernel::Gaussian,
        Kernel::Quadratic,
        Kernel::CubicSpline,
        Kernel::WendlandC2,
        Kernel::WendlandC4,
        Kernel::WendlandC6,
    ];

    /// Run `task` with this kernel's shape as a type.
    pub(crate) fn run<T: WithKernel>(self, task: T) -> T::Out {
        match self {
            Kernel::Gaussian => task.with::<Gaussian>(),
            Kernel::Quadratic => task.with::<Quadratic>(),
            Kernel::CubicSpline => task.with::<CubicSpline>(),
            Kernel::WendlandC2 => task.with::<WendlandC2>(),
            Kernel::WendlandC4 => task.with::<WendlandC4>(),
            Kernel::WendlandC6 => task.with::<WendlandC6>(),
        }
    }

    /// `out[k]` ← the sum of target `k`.
    pub(crate) fn gather<S: TargetSum>(self, sum: &S, out: &mut [S::Sum]) {
        self.run(Gathering(sum, out));
    }

    /// W(r, h) [1/m²] for a distance `r` [m] and a smoothing length `h` [m].
    pub fn value(self, r: f64, h: f64) -> f64 {
        struct At(f64, f64);
        impl WithKernel for At {
            type Out = f64;
            fn with<K: Shape>(self) -> f64 {
                K::ALPHA / (self.1 * self.1) * K::w(self.0 / self.1)
            }
        }
        self.run(At(r, h))
    }

    /// F(r, h) [1/m⁴] such that ∇_a W_ab = F r_ab.
    pub fn gradient_factor(self, r: f64, h: f64) -> f64 {
        struct At(f64, f64);
        impl WithKernel for At {
            type Out = f64;
            fn with<K: Shape>(self) -> f64 {
                let (q, h2) = (self.0 / self.1, self.1 * self.1);
                K::ALPHA / (h2 * h2) * K::DW_FACTOR * K::dw_over_q(q)
            }
        }
        self.run(At(r, h))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫₀² f(q) dq by Gauss–Legendre (5 points) on 2000 panels: exact far below 1e-12 for smooth pieces.
    fn integrate(f: impl Fn(f64) -> f64) -> f64 {
        let nodes = [
            (0.0, 128.0 / 225.0),
            (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
            (0.906_179_845_938_664, 0.236_926_885_056_189_1),
        ];
        let n = 2000;
        let half = 1.0 / n as f64;
        let mut sum = 0.0;
        for k in 0..n {
            let mid = (2 * k + 1) as f64 * half;
            for (x, w) in nodes {
                sum += if x == 0.0 { w * f(mid) } else { w * (f(mid - x * half) + f(mid + x * half)) };
            }
        }
        sum * half
    }

    #[test]
    fn every_kernel_is_normalised_on_its_support() {
        for kernel in Kernel::ALL {
            let h = 0.37;
            let total = integrate(|q| kernel.value(q * h, h) * 2.0 * PI * q * h * h);
            assert!((total - 1.0).abs() < 1e-12, "{kernel:?}: {total}");
        }
    }

    #[test]
    fn the_gradient_is_the_derivative_of_the_value() {
        for kernel in Kernel::ALL {
            for q in [0.1, 0.5, 0.99, 1.01, 1.5, 1.9] {
                let (h, e) = (0.8, 1e-6);
                let r = q * h;
                let slope = (kernel.value(r + e, h) - kernel.value(r - e, h)) / (2.0 * e);
                let ours = kernel.gradient_factor(r, h) * r;
                assert!((slope - ours).abs() < 1e-7, "{kernel:?} at q = {q}: {slope} against {ours}");
            }
        }
    }

    #[test]
    fn the_bend_is_the_slope_of_the_gradient() {
        struct At(f64);
        impl WithKernel for At {
            type Out = [f64; 2];
            fn with<K: Shape>(self) -> [f64; 2] {
                let (q, e) = (self.0, 1e-6);
                [(K::dw_over_q(q + e) - K::dw_over_q(q - e)) / (2.0 * e * q), K::bend(q)]
            }
        }
        for kernel in Kernel::ALL {
            for q in [0.1, 0.5, 0.99, 1.01, 1.5, 1.9, 2.1] {
                let [slope, ours] = kernel.run(At(q));
                assert!(
                    (slope - ours).abs() < 1e-6 * (1.0 + slope.abs()),
                    "{kernel:?} at q = {q}: {slope} against {ours}"
                );
            }
        }
    }

    #[test]
    fn nothing_is_felt_beyond_two_smoothing_lengths() {
        for kernel in Kernel::ALL {
            assert_eq!(kernel.value(2.0, 1.0), 0.0);
            assert_eq!(kernel.gradient_factor(2.5, 1.0), 0.0);
        }
    }
}
