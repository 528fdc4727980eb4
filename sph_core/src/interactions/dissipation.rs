//! How a pair dissipates: density diffusion with artificial viscosity (THEORY WC4, WC6), or the limited Riemann form
//! (WC8, WC9). A type inside the sums over pairs, as kernels are: one dispatch per sum, none per pair.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::interactions::geometry::{PairConstants, PairGeometry};
use crate::kernel::{Kernel, Shape, WithKernel};
use crate::simd::SimdReal;

/// What smooths pressures and velocities between fluid particles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Dissipation {
    /// WC4 and WC6: density diffusion δ and artificial viscosity α.
    #[default]
    Diffusion,
    /// WC8 and WC9: the linearised Riemann problem of each pair, with the limiter of low dissipation (Zhang, Hu & Adams
    /// 2017). Has no coefficients.
    Riemann,
}

/// Factor of the limiter [-] (WC9; Zhang, Hu & Adams 2017).
const LIMITER: f64 = 3.0;

/// Least distance over h [-] along which a closing speed is taken: particles in one place have none.
const NEAREST: f64 = 1e-9;

/// The dissipative part of a pair: what WC3 gains by a difference of pressure, and WC5 by a closing speed.
pub(crate) trait PairDissipation: Copy + Send + Sync + 'static {
    /// Length ℓ [m] of this pair in Σ V_b ℓ [p_a − p_b − ρ₀ g·r_ab] (r_ab·∇W_ab)/r² (WC4, WC8).
    fn length<R: SimdReal>(ab: &PairGeometry<R>) -> R;
    /// True if ℓ is the distance r.
    const LENGTH_IS_DISTANCE: bool = false;
    /// Factor of that sum [s/m].
    fn rate<R: SimdReal>(c: &PairConstants<R>) -> R;
    /// Pressure [Pa], taken off p_a + p_b in WC5, that v_ab·r_ab [m²/s] of the pair causes (WC6, WC9): never positive.
    fn pressure<R: SimdReal>(ab: &PairGeometry<R>, along: R, c: &PairConstants<R>) -> R;
}

/// WC4 and WC6.
#[derive(Clone, Copy)]
pub(crate) struct DiffusivePair;
/// WC8 and WC9.
#[derive(Clone, Copy)]
pub(crate) struct RiemannPair;
/// Nothing: walls.
#[derive(Clone, Copy)]
pub(crate) struct ElasticPair;

impl PairDissipation for DiffusivePair {
    #[inline(always)]
    fn length<R: SimdReal>(ab: &PairGeometry<R>) -> R {
        ab.size.h
    }
    #[inline(always)]
    fn rate<R: SimdReal>(c: &PairConstants<R>) -> R {
        c.delta.of(2.0) * c.delta / c.c0
    }
    #[inline(always)]
    fn pressure<R: SimdReal>(ab: &PairGeometry<R>, along: R, c: &PairConstants<R>) -> R {
        let h = ab.size.h;
        c.rho0 * c.alpha * c.c0 * h * along.min(h.of(0.0)) / (ab.r2 + h.of(0.01) * h * h)
    }
}

impl PairDissipation for RiemannPair {
    /// WC8: 2(v_a − v*)·∇W with v* = v̄ + (p_L − p_R)/(2ρ₀c₀) leaves (p_a − p_b) r/(ρ₀c₀) beside WC3.
    #[inline(always)]
    fn length<R: SimdReal>(ab: &PairGeometry<R>) -> R {
        ab.r
    }
    const LENGTH_IS_DISTANCE: bool = true;
    #[inline(always)]
    fn rate<R: SimdReal>(c: &PairConstants<R>) -> R {
        c.c0.of(1.0) / c.c0
    }
    /// WC9: p_a + p_b − 2p* = −ρ₀ β w, w the closing speed.
    #[inline(always)]
    fn pressure<R: SimdReal>(ab: &PairGeometry<R>, along: R, c: &PairConstants<R>) -> R {
        let parting = along.min(along.of(0.0)) / ab.r.max(along.of(NEAREST) * ab.size.h); // −w
        c.rho0 * (parting * along.of(-LIMITER)).min(c.c0) * parting
    }
}

impl PairDissipation for ElasticPair {
    #[inline(always)]
    fn length<R: SimdReal>(ab: &PairGeometry<R>) -> R {
        ab.r.of(0.0)
    }
    #[inline(always)]
    fn rate<R: SimdReal>(c: &PairConstants<R>) -> R {
        c.c0.of(0.0)
    }
    #[inline(always)]
    fn pressure<R: SimdReal>(_: &PairGeometry<R>, along: R, _: &PairConstants<R>) -> R {
        along.of(0.0)
    }
}

/// Something to be done with a kernel and a dissipation known at compile time.
pub(crate) trait WithPairs {
    fn with<K: Shape, D: PairDissipation>(self);
}

struct Dissipating<T>(Dissipation, T);

impl<T: WithPairs> WithKernel for Dissipating<T> {
    type Out = ();
    fn with<K: Shape>(self) {
        match self.0 {
            Dissipation::Diffusion => self.1.with::<K, DiffusivePair>(),
            Dissipation::Riemann => self.1.with::<K, RiemannPair>(),
        }
    }
}

/// Run `task` with the kernel and the dissipation as types.
pub(crate) fn with_pairs<T: WithPairs>(kernel: Kernel, dissipation: Dissipation, task: T) {
    kernel.run(Dissipating(dissipation, task));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interactions::geometry::{MeanScale, pair_geometry};
    use crate::interactions::packed_particle::PackedParticle;
    use crate::interactions::pair::{density_rate, momentum};
    use crate::kernel::WendlandC2;

    const WATER: PairConstants =
        PairConstants { gravity: [0.0, -9.81], rho0: 1000.0, c0: 50.0, delta: 0.0, alpha: 0.0, nu: 0.0, stretch: 0.0 };

    fn row(x: f64, y: f64, u: f64, v: f64, p: f64) -> PackedParticle {
        PackedParticle { x, y, u, v, p, volume: 0.01, raw_volume: 0.01, h: 0.15 }
    }

    fn rate_of<D: PairDissipation>(a: &PackedParticle, b: &PackedParticle, c: &PairConstants) -> f64 {
        density_rate::<f64, WendlandC2, D>(a, 1000.0, [*b].into_iter(), [].into_iter(), MeanScale, c)
    }

    fn pushed(a: &PackedParticle, b: &PackedParticle) -> [f64; 2] {
        let (near, c) = ([*b].into_iter(), &WATER);
        momentum::<f64, WendlandC2, RiemannPair>(a, near, [].into_iter(), MeanScale, c, 0.0).lanes()[0].force
    }

    /// Zhang, Hu & Adams' own form, written out: 2 ρ_a V_b (v_a − v*)·∇W and −2 V_a V_b p* ∇W with ρ = ρ₀, the states L
    /// and R along e = −r_ab/r.
    fn written_out(a: &PackedParticle, b: &PackedParticle) -> (f64, [f64; 2]) {
        let ab = pair_geometry::<WendlandC2>(a.x, a.y, a.h, b.x, b.y, b.h).expect("neighbours");
        let r = ab.dx.hypot(ab.dy);
        let e = [-ab.dx / r, -ab.dy / r];
        let (left, right) = (a.u * e[0] + a.v * e[1], b.u * e[0] + b.v * e[1]);
        let weight = WATER.rho0 * (WATER.gravity[0] * ab.dx + WATER.gravity[1] * ab.dy);
        let mean = 0.5 * (left + right);
        let star = mean + (a.p - b.p - weight) / (2.0 * WATER.rho0 * WATER.c0);
        let velocity = [0, 1].map(|k| 0.5 * ([a.u, a.v][k] + [b.u, b.v][k]) + (star - mean) * e[k]);
        let beta = (3.0 * (left - right).max(0.0)).min(WATER.c0);
        let pressure = 0.5 * (a.p + b.p) + 0.5 * beta * WATER.rho0 * (left - right);
        let gradient = [ab.grad_factor * ab.dx, ab.grad_factor * ab.dy];
        let flux = (a.u - velocity[0]) * gradient[0] + (a.v - velocity[1]) * gradient[1];
        let force = gradient.map(|g| -2.0 * a.volume * b.volume * pressure * g);
        (2.0 * WATER.rho0 * b.volume * flux, force)
    }

    /// Approaching slowly, approaching at more than c₀/3 (the limiter binds), and parting (no dissipation of velocity).
    #[test]
    fn a_pair_is_the_limited_riemann_problem_written_out() {
        let a = row(0.0, 0.0, 1.0, -2.0, 350.0);
        for b in [row(0.1, 0.07, -0.5, 0.2, -80.0), row(0.1, 0.07, -40.0, 0.2, 90.0), row(-0.1, 0.07, -0.5, 0.2, 7.0)] {
            let (rate, force) = written_out(&a, &b);
            let ours = rate_of::<RiemannPair>(&a, &b, &WATER);
            assert!((ours / rate - 1.0).abs() < 1e-12, "{ours}, written out {rate}");
            let ours = pushed(&a, &b);
            for k in 0..2 {
                assert!((ours[k] / force[k] - 1.0).abs() < 1e-12, "{ours:?}, written out {force:?}");
            }
        }
    }

    /// WC8 of a pair is WC4 with δ = q/2.
    #[test]
    fn a_riemann_pair_diffuses_as_half_its_distance_says() {
        let (a, b) = (row(0.0, 0.0, 0.3, 0.0, 350.0), row(0.12, 0.1, 0.0, 0.1, -80.0));
        let delta = 0.5 * 0.12_f64.hypot(0.1) / 0.15;
        let diffusive = PairConstants { delta, ..WATER };
        let ours = rate_of::<RiemannPair>(&a, &b, &WATER);
        let theirs = rate_of::<DiffusivePair>(&a, &b, &diffusive);
        assert!((ours / theirs - 1.0).abs() < 1e-13, "{ours}, {theirs}");
    }

    #[test]
    fn a_riemann_pair_acts_as_it_reacts_and_does_not_diffuse_where_it_is_hydrostatic() {
        let (a, mut b) = (row(0.0, 0.0, 1.0, -2.0, 0.0), row(0.1, 0.07, -0.5, 0.2, 0.0));
        b.h = 0.21;
        b.p = WATER.rho0 * (WATER.gravity[0] * b.x + WATER.gravity[1] * b.y);
        let on_a = pushed(&a, &b);
        let on_b = pushed(&b, &a);
        for k in 0..2 {
            assert!(on_a[k] != 0.0 && (on_a[k] + on_b[k]).abs() <= 1e-15 * on_a[k].abs());
        }
        let still = PackedParticle { u: 0.0, v: 0.0, ..a };
        let rate = rate_of::<RiemannPair>(&still, &PackedParticle { u: 0.0, v: 0.0, ..b }, &WATER);
        assert!(rate.abs() < 1e-12, "{rate}");
    }

    /// No push from nowhere: two particles in one place have no closing speed, and the force stays a number.
    #[test]
    fn particles_in_one_place_do_not_divide_by_nothing() {
        let (a, b) = (row(0.0, 0.0, 1.0, 0.0, 10.0), row(0.0, 0.0, -1.0, 0.0, 10.0));
        let found = pushed(&a, &b);
        assert_eq!(found, [0.0; 2]);
    }
}
