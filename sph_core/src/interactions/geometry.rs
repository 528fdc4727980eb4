//! Geometry of a pair: distance, mean smoothing length, kernel and its gradient (THEORY OP2, OP3).

use crate::kernel::Shape;
use crate::simd::SimdReal;

/// Least r/h at which the bend of a kernel is taken [-]: it may be infinite at 0, where a particle meets itself without a share.
const NEAREST: f64 = 1e-9;

/// Numbers that every pair shares.
#[derive(Clone, Copy, Debug)]
pub struct PairConstants<R = f64> {
    /// Gravity [m/s²].
    pub gravity: [R; 2],
    /// Reference density ρ₀ [kg/m³].
    pub rho0: R,
    /// Sound speed c₀ [m/s].
    pub c0: R,
    /// Density diffusion δ [-] (WC4).
    pub delta: R,
    /// Artificial viscosity α [-] (WC6).
    pub alpha: R,
    /// Kinematic viscosity ν [m²/s] (WC7).
    pub nu: R,
    /// Whether walls feel the fluid stretch along them [-]: 0 or 1 (WA4).
    pub stretch: R,
}

impl PairConstants {
    /// The same for every lane.
    #[inline(always)]
    pub(crate) fn splat<R: SimdReal>(&self, zero: R) -> PairConstants<R> {
        PairConstants {
            gravity: [zero.of(self.gravity[0]), zero.of(self.gravity[1])],
            rho0: zero.of(self.rho0),
            c0: zero.of(self.c0),
            delta: zero.of(self.delta),
            alpha: zero.of(self.alpha),
            nu: zero.of(self.nu),
            stretch: zero.of(self.stretch),
        }
    }
}

/// A pair's smoothing length h̄ and what follows from it.
#[derive(Clone, Copy)]
pub struct KernelScale<R = f64> {
    pub(crate) h: R,
    inverse: R,
    peak: R,     // α/h²
    gradient: R, // α/h⁴ times the kernel's factor of w'/q
}

/// How a pair finds its size.
pub trait ScaleRule<R>: Copy {
    /// Size of a pair of smoothing lengths `a` and `b` [m].
    fn of<K: Shape>(self, a: R, b: R) -> KernelScale<R>;
}

/// OP3: the pair's kernel is taken at the mean smoothing length, so ∇_a W_ab = −∇_b W_ab exactly.
#[derive(Clone, Copy)]
pub struct MeanScale;

/// The same where all smoothing lengths are one: found once.
#[derive(Clone, Copy)]
pub struct UniformScale<R>(KernelScale<R>);

impl<R: SimdReal> ScaleRule<R> for MeanScale {
    #[inline(always)]
    fn of<K: Shape>(self, a: R, b: R) -> KernelScale<R> {
        let h = a.of(0.5) * (a + b);
        let inverse = h.of(1.0) / h;
        let i2 = inverse * inverse;
        let peak = h.of(K::ALPHA) * i2;
        KernelScale { h, inverse, peak, gradient: h.of(K::DW_FACTOR) * peak * i2 }
    }
}

impl<R: SimdReal> UniformScale<R> {
    /// The size of every pair of smoothing lengths `h` [m].
    #[inline(always)]
    pub fn new<K: Shape>(h: R) -> UniformScale<R> {
        UniformScale(MeanScale.of::<K>(h, h))
    }
}

impl<R: Copy> ScaleRule<R> for UniformScale<R> {
    #[inline(always)]
    fn of<K: Shape>(self, _: R, _: R) -> KernelScale<R> {
        self.0
    }
}

/// Geometry of a pair: r_ab, its length r, h̄ and ∇_a W_ab = `grad_factor` r_ab, which is nothing beyond the support.
#[derive(Clone, Copy)]
pub struct PairGeometry<R = f64> {
    pub(crate) dx: R,
    pub(crate) dy: R,
    pub(crate) r2: R,
    pub(crate) r: R,
    pub(crate) q: R,
    pub(crate) size: KernelScale<R>,
    pub(crate) grad_factor: R,
}

impl<R: SimdReal> PairGeometry<R> {
    #[inline(always)]
    pub(crate) fn new<K: Shape>(dx: R, dy: R, size: KernelScale<R>) -> PairGeometry<R> {
        let r2 = dx.mul_add(dx, dy * dy);
        let r = r2.sqrt();
        let q = r * size.inverse;
        PairGeometry { dx, dy, r2, r, q, size, grad_factor: size.gradient * K::dw_over_q(q) }
    }

    /// d/dt of `flux` ∇_a W_ab/`grad_factor` as the pair moves apart with a velocity [m/s] (WC23), where `flux` is `grad_factor` times `share`.
    #[inline(always)]
    pub(crate) fn gradient_rate<K: Shape>(&self, share: R, flux: R, [u, v]: [R; 2]) -> [R; 2] {
        let bend = K::bend(self.q.max(self.q.of(NEAREST)));
        let bend = share * self.size.gradient * self.size.inverse * self.size.inverse * bend;
        let turn = bend * self.dx.mul_add(u, self.dy * v);
        [flux.mul_add(u, turn * self.dx), flux.mul_add(v, turn * self.dy)]
    }

    /// W_ab [1/m²].
    #[inline(always)]
    pub fn w<K: Shape>(&self) -> R {
        self.size.peak * K::w(self.q)
    }
}

/// The bond of a pair whose supports overlap.
#[inline(always)]
pub(crate) fn pair_geometry<K: Shape>(ax: f64, ay: f64, ah: f64, bx: f64, by: f64, bh: f64) -> Option<PairGeometry> {
    let (dx, dy, h) = (ax - bx, ay - by, 0.5 * (ah + bh));
    (dx * dx + dy * dy < 4.0 * h * h).then(|| PairGeometry::new::<K>(dx, dy, MeanScale.of::<K>(ah, bh)))
}

/// W [1/m²] and grad_factor [1/m⁴] (∇W = grad_factor · d) of a distance d = (dx, dy) [m]; `None` outside the support.
#[inline(always)]
pub(crate) fn kernel_and_gradient<K: Shape>(dx: f64, dy: f64, h: f64) -> Option<(f64, f64)> {
    pair_geometry::<K>(dx, dy, h, 0.0, 0.0, h).map(|b| (b.w::<K>(), b.grad_factor))
}
