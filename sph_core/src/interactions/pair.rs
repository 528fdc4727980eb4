//! The pair physics of a whole step, for one target or four; acoustic steps and the projection have forms of some equations with held weights
//! (`wcsph/split_explicit`, `projection/pair_clusters`). Target a, neighbour b; everything per metre of span.
//!
//! Each function gathers one target's sum over its neighbours, or those of several targets side by side
//! ([`crate::simd`]). Forces between fluid and wall come from one function with the roles swapped, so that action equals
//! reaction to rounding.

use serde::{Deserialize, Serialize};

use crate::interactions::dissipation::{ElasticPair, PairDissipation};
use crate::interactions::geometry::{MeanScale, PairConstants, PairGeometry, ScaleRule};
use crate::interactions::packed_particle::{PackedParticle, PackedWall};
use crate::kernel::Shape;
use crate::particles::KernelMoments;
use crate::simd::{LANES, SimdReal};

/// WC3 + WC4 (WC8): dρ_a/dt [kg/(m³ s)] from the divergence of velocity and the density diffusion.
#[inline(always)]
pub fn density_rate<R: SimdReal, K: Shape, D: PairDissipation>(
    a: &PackedParticle<R>,
    rho_a: R,
    fluid: impl Iterator<Item = PackedParticle<R>>,
    walls: impl Iterator<Item = PackedWall<R>>,
    sizes: impl ScaleRule<R>,
    c: &PairConstants<R>,
) -> R {
    let (mut compression, mut diffusion) = (a.x.of(0.0), a.x.of(0.0));
    let weight = [c.rho0 * c.gravity[0], c.rho0 * c.gravity[1]];
    for b in fluid {
        let ab = PairGeometry::new::<K>(a.x - b.x, a.y - b.y, sizes.of::<K>(a.h, b.h));
        let flux = b.volume * ab.grad_factor;
        let approach = (a.u - b.u).mul_add(ab.dx, (a.v - b.v) * ab.dy);
        // dynamic pressure difference: the hydrostatic part must not diffuse (Fourtakas et al. 2019)
        let excess = weight[0].mul_add(ab.dx, weight[1].mul_add(ab.dy, b.p - a.p));
        compression = approach.mul_add(flux, compression);
        diffusion = excess.mul_add(D::length(&ab) * flux, diffusion);
    }
    // ends the sum's life in a register here: else the compiler keeps it in memory through the loop above, which doubles its time
    let diffusion = std::hint::black_box(diffusion);
    for w in walls {
        let aw = PairGeometry::new::<K>(a.x - w.x, a.y - w.y, MeanScale.of::<K>(a.h, w.h));
        // WA4: behind the wall the fluid moves with the reflected velocity, so the pair closes at 2(u_a − V)·n across
        // the wall; along it, if so chosen, with the velocity of the fluid in front, whose stretching is then felt
        let (un, ut) = (a.u * w.nx + a.v * w.ny, a.v * w.nx - a.u * w.ny);
        let (rn, rt) = (aw.dx * w.nx + aw.dy * w.ny, aw.dy * w.nx - aw.dx * w.ny);
        let approach = un.of(2.0) * (un - w.vn) * rn + c.stretch * (ut - w.vt) * rt;
        compression = approach.mul_add(w.volume * aw.grad_factor, compression);
    }
    rho_a * compression - D::rate(c) * diffusion
}

/// WC5 + WC6 (WC9) + WC7: force of b on a over V_a, in parts along r_ab [Pa/m²] and along v_ab [Pa s/m³]: pressure, artificial
/// and laminar viscosity.
#[inline(always)]
pub(crate) fn force<R: SimdReal, D: PairDissipation>(
    a: &PackedParticle<R>,
    b: &PackedParticle<R>,
    ab: &PairGeometry<R>,
    c: &PairConstants<R>,
    nu: R,
) -> [R; 2] {
    let weight = b.volume * ab.grad_factor;
    let along = (a.u - b.u).mul_add(ab.dx, (a.v - b.v) * ab.dy);
    let normal = weight * (D::pressure(ab, along, c) - (a.p + b.p));
    let shear = weight * (nu.of(2.0) * c.rho0 * nu); // (r·∇W)/r² is the kernel's slope: nothing to regularise
    [normal, shear]
}

/// Sums of the momentum equation for one target.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gathered {
    /// Force of all neighbours [N/m].
    pub force: [f64; 2],
    /// Geometry of the neighbourhood.
    pub moments: KernelMoments,
}

/// The same for several targets side by side.
pub struct GatheredOver<R> {
    force: [R; 2],
    kernel_sum: R,
    fluid_kernel_sum: R,
    concentration_gradient: [R; 2],
    lambda: R,
}

impl<R: SimdReal> GatheredOver<R> {
    /// Each target's.
    #[inline(always)]
    pub fn lanes(&self) -> [Gathered; LANES] {
        let GatheredOver { force, kernel_sum, fluid_kernel_sum, concentration_gradient, lambda } = self;
        let (fx, fy, all, fluid) = (force[0].lanes(), force[1].lanes(), kernel_sum.lanes(), fluid_kernel_sum.lanes());
        let (cx, cy, least) = (concentration_gradient[0].lanes(), concentration_gradient[1].lanes(), lambda.lanes());
        std::array::from_fn(|k| {
            let moments = KernelMoments::new(all[k], fluid[k], [cx[k], cy[k]], least[k]);
            Gathered { force: [fx[k], fy[k]], moments }
        })
    }
}

/// Forces on a fluid particle, and how its neighbours lie: it is one of them. `wall_nu` is ν where walls do not slip, else 0.
#[inline(always)]
pub fn momentum<R: SimdReal, K: Shape, D: PairDissipation>(
    a: &PackedParticle<R>,
    fluid: impl Iterator<Item = PackedParticle<R>>,
    walls: impl Iterator<Item = PackedParticle<R>>,
    sizes: impl ScaleRule<R>,
    c: &PairConstants<R>,
    wall_nu: R,
) -> GatheredOver<R> {
    let none = a.x.of(0.0);
    let mut sum =
        MomentumSum { force: [none; 2], kernel_sum: none, concentration_gradient: [none; 2], second_moment: [none; 3] };
    for b in fluid {
        let ab = PairGeometry::new::<K>(a.x - b.x, a.y - b.y, sizes.of::<K>(a.h, b.h));
        sum.take::<K, D>(a, &b, &ab, c, c.nu);
    }
    let fluid_kernel_sum = sum.kernel_sum;
    sum.force = std::hint::black_box(sum.force); // as in `density_rate`
    for w in walls {
        let aw = PairGeometry::new::<K>(a.x - w.x, a.y - w.y, MeanScale.of::<K>(a.h, w.h));
        sum.take::<K, ElasticPair>(a, &w, &aw, c, wall_nu);
    }
    let MomentumSum { force, kernel_sum, concentration_gradient, second_moment } = sum;
    let force = [a.volume * force[0], a.volume * force[1]];
    GatheredOver {
        force,
        kernel_sum,
        fluid_kernel_sum,
        concentration_gradient,
        lambda: smallest_eigenvalue(second_moment),
    }
}

/// Running sums of [`momentum`].
struct MomentumSum<R> {
    force: [R; 2],
    kernel_sum: R,
    concentration_gradient: [R; 2],
    second_moment: [R; 3],
}

impl<R: SimdReal> MomentumSum<R> {
    #[inline(always)]
    fn take<K: Shape, D: PairDissipation>(
        &mut self,
        a: &PackedParticle<R>,
        b: &PackedParticle<R>,
        ab: &PairGeometry<R>,
        c: &PairConstants<R>,
        nu: R,
    ) {
        let [normal, shear] = force::<R, D>(a, b, ab, c, nu);
        let [x, y] = self.force; // over V_a
        self.force =
            [normal.mul_add(ab.dx, shear.mul_add(a.u - b.u, x)), normal.mul_add(ab.dy, shear.mul_add(a.v - b.v, y))];
        self.kernel_sum = b.raw_volume.mul_add(ab.w::<K>(), self.kernel_sum);
        let pull = b.raw_volume * ab.grad_factor;
        let (px, py) = (pull * ab.dx, pull * ab.dy);
        self.concentration_gradient = [self.concentration_gradient[0] + px, self.concentration_gradient[1] + py];
        let [xx, xy, yy] = self.second_moment; // of the neighbours, so of −r_ab: λ's sign is turned at the end
        self.second_moment = [px.mul_add(ab.dx, xx), px.mul_add(ab.dy, xy), py.mul_add(ab.dy, yy)];
    }
}

/// OP4: ∇C [1/m] of a fluid particle alone.
#[inline(always)]
pub fn concentration_gradient<R: SimdReal, K: Shape>(
    a: &PackedParticle<R>,
    fluid: impl Iterator<Item = PackedParticle<R>>,
    walls: impl Iterator<Item = PackedParticle<R>>,
    sizes: impl ScaleRule<R>,
) -> [R; 2] {
    let take = |[x, y]: [R; 2], b: &PackedParticle<R>, ab: &PairGeometry<R>| {
        let pull = b.raw_volume * ab.grad_factor;
        [pull.mul_add(ab.dx, x), pull.mul_add(ab.dy, y)]
    };
    let mut sum = [a.x.of(0.0); 2];
    for b in fluid {
        sum = take(sum, &b, &PairGeometry::new::<K>(a.x - b.x, a.y - b.y, sizes.of::<K>(a.h, b.h)));
    }
    for w in walls {
        sum = take(sum, &w, &PairGeometry::new::<K>(a.x - w.x, a.y - w.y, MeanScale.of::<K>(a.h, w.h)));
    }
    sum
}

/// WA6: force of the fluid on a wall particle [N/m]: the same pairs with the roles swapped.
#[inline(always)]
pub fn wall_force<R: SimdReal, K: Shape>(
    wall: &PackedParticle<R>,
    fluid: impl Iterator<Item = PackedParticle<R>>,
    c: &PairConstants<R>,
    wall_nu: R,
) -> [R; 2] {
    let mut sum = [wall.x.of(0.0); 2];
    for a in fluid {
        let wa = PairGeometry::new::<K>(wall.x - a.x, wall.y - a.y, MeanScale.of::<K>(wall.h, a.h));
        let [normal, shear] = force::<R, ElasticPair>(wall, &a, &wa, c, wall_nu);
        sum = [
            normal.mul_add(wa.dx, shear.mul_add(wall.u - a.u, sum[0])),
            normal.mul_add(wa.dy, shear.mul_add(wall.v - a.v, sum[1])),
        ];
    }
    [wall.volume * sum[0], wall.volume * sum[1]]
}

/// What a wall particle extrapolates from the fluid.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Extrapolated<R = f64> {
    /// Pressure [Pa] (WA3).
    pub pressure: R,
    /// Velocity of the fluid nearby [m/s] (WA5).
    pub velocity: [R; 2],
}

impl<R: SimdReal> Extrapolated<R> {
    /// Each target's.
    #[inline(always)]
    pub(crate) fn lanes(&self) -> [Extrapolated; LANES] {
        let (p, u, v) = (self.pressure.lanes(), self.velocity[0].lanes(), self.velocity[1].lanes());
        std::array::from_fn(|k| Extrapolated { pressure: p[k], velocity: [u[k], v[k]] })
    }
}

/// Least Σ V W [-] that is a neighbourhood to extrapolate from.
pub(crate) const TOUCHED: f64 = 1e-9;

/// WA3 (Adami, Hu & Adams 2012): pressure at a wall particle that moves with acceleration `acceleration`;
/// the pressure gradient beside it is ρ(g − a_w).
#[inline(always)]
pub fn extrapolate<R: SimdReal, K: Shape>(
    wall: &PackedParticle<R>,
    acceleration: [R; 2],
    fluid: impl Iterator<Item = PackedParticle<R>>,
    c: &PairConstants<R>,
) -> Extrapolated<R> {
    let none = wall.x.of(0.0);
    let (mut weight, mut pressure, mut velocity, mut arm) = (none, none, [none; 2], [none; 2]);
    for b in fluid {
        let ab = PairGeometry::new::<K>(wall.x - b.x, wall.y - b.y, MeanScale.of::<K>(wall.h, b.h));
        let w = b.volume * ab.w::<K>();
        weight = weight + w;
        pressure = w.mul_add(b.p, pressure);
        velocity = [w.mul_add(b.u, velocity[0]), w.mul_add(b.v, velocity[1])];
        arm = [w.mul_add(ab.dx, arm[0]), w.mul_add(ab.dy, arm[1])];
    }
    let field = [c.gravity[0] - acceleration[0], c.gravity[1] - acceleration[1]];
    let total = pressure + c.rho0 * (field[0] * arm[0] + field[1] * arm[1]);
    let touched = none.of(TOUCHED);
    let mean = weight.of(1.0) / weight.max(touched);
    Extrapolated {
        pressure: weight.below(touched, none, total * mean),
        velocity: [
            weight.below(touched, wall.u, velocity[0] * mean),
            weight.below(touched, wall.v, velocity[1] * mean),
        ],
    }
}

/// OP5: smallest eigenvalue of the symmetric matrix −[[m0, m1], [m1, m2]].
#[inline(always)]
fn smallest_eigenvalue<R: SimdReal>(m: [R; 3]) -> R {
    let (mean, half) = (m[0].of(-0.5) * (m[0] + m[2]), m[0].of(0.5) * (m[0] - m[2]));
    mean - (half * half + m[1] * m[1]).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interactions::dissipation::DiffusivePair;
    use crate::kernel::WendlandC2;

    fn constants() -> PairConstants {
        PairConstants { gravity: [0.3, -9.81], rho0: 1000.0, c0: 50.0, delta: 0.1, alpha: 0.05, nu: 1e-3, stretch: 1.0 }
    }

    fn row(x: f64, y: f64, u: f64, v: f64, p: f64) -> PackedParticle {
        PackedParticle { x, y, u, v, p, volume: 0.01, raw_volume: 0.0101, h: 0.15 }
    }

    fn pushed(
        a: &PackedParticle,
        fluid: &[PackedParticle],
        walls: &[PackedParticle],
        c: &PairConstants,
        wall_nu: f64,
    ) -> [f64; 2] {
        let (fluid, walls) = (fluid.iter().copied(), walls.iter().copied());
        momentum::<f64, WendlandC2, DiffusivePair>(a, fluid, walls, MeanScale, c, wall_nu).lanes()[0].force
    }

    #[test]
    fn action_equals_reaction_between_any_two_resolutions() {
        let (a, mut b) = (row(0.0, 0.0, 1.0, -2.0, 350.0), row(0.1, 0.07, -0.5, 0.2, -80.0));
        b.h = 0.21;
        let c = constants();
        let on_a = pushed(&a, &[b], &[], &c, 0.0);
        let on_b = pushed(&b, &[a], &[], &c, 0.0);
        for k in 0..2 {
            assert!(on_a[k] != 0.0 && (on_a[k] + on_b[k]).abs() <= 1e-15 * on_a[k].abs());
        }
        let on_fluid = pushed(&a, &[], &[b], &c, c.nu);
        let on_wall = wall_force::<f64, WendlandC2>(&b, [a].into_iter(), &c, c.nu);
        for k in 0..2 {
            assert!(on_fluid[k] != 0.0 && (on_fluid[k] + on_wall[k]).abs() <= 1e-15 * on_fluid[k].abs());
        }
    }

    #[test]
    fn a_hydrostatic_pair_does_not_diffuse() {
        let c = constants();
        let mut b = row(0.1, 0.07, 0.0, 0.0, 0.0);
        b.p = c.rho0 * (c.gravity[0] * b.x + c.gravity[1] * b.y);
        let a = row(0.0, 0.0, 0.0, 0.0, 0.0);
        let rate =
            density_rate::<f64, WendlandC2, DiffusivePair>(&a, 1000.0, [b].into_iter(), [].into_iter(), MeanScale, &c);
        assert!(rate.abs() < 1e-12, "{rate}");
    }

    #[test]
    fn a_wall_extrapolates_the_accelerated_hydrostatic_field_exactly() {
        let c = constants();
        let acceleration = [1.5, 4.0];
        let field = [c.gravity[0] - acceleration[0], c.gravity[1] - acceleration[1]];
        let p = |x: f64, y: f64| 700.0 + c.rho0 * (field[0] * x + field[1] * y);
        let fluid: Vec<PackedParticle> =
            [(0.1, 0.1), (0.02, 0.13), (-0.1, 0.2)].map(|(x, y)| row(x, y, 0.0, 0.0, p(x, y))).to_vec();
        let wall = row(0.03, -0.05, 0.0, 0.0, 0.0);
        let found = extrapolate::<f64, WendlandC2>(&wall, acceleration, fluid.into_iter(), &c).pressure;
        assert!((found - p(wall.x, wall.y)).abs() < 1e-9, "{found}");
    }

    #[test]
    fn eigenvalue_of_a_rotated_diagonal() {
        let (s, k) = (0.6_f64, 0.8_f64); // sine and cosine
        let (e1, e2) = (0.4, 0.9);
        let m = [e1 * k * k + e2 * s * s, (e2 - e1) * s * k, e1 * s * s + e2 * k * k].map(|x| -x);
        assert!((smallest_eigenvalue(m) - 0.4).abs() < 1e-14);
    }
}
