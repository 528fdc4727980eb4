//! The pair physics: one readable page. Target a, neighbour b; everything per metre of span.
//!
//! Each function gathers one target's sum over its neighbours. Forces between fluid and wall come from
//! one function with the roles swapped, so that action equals reaction to rounding.

use crate::dissipation::{ElasticPair, PairDissipation};
use crate::kernel::Shape;
use crate::particles::Surroundings;

/// A particle as its neighbours see it: one cache line. For a wall particle, velocity and pressure are
/// those that the fluid is to feel (THEORY E9–E11) and both volumes are the area it stands for.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, Default)]
pub struct Row {
    /// Position [m].
    pub x: f64,
    /// Position [m].
    pub y: f64,
    /// Velocity [m/s].
    pub u: f64,
    /// Velocity [m/s].
    pub v: f64,
    /// Pressure [Pa].
    pub p: f64,
    /// Corrected volume V = θ m/ρ [m²].
    pub volume: f64,
    /// Uncorrected volume m/ρ [m²].
    pub fill: f64,
    /// Smoothing length [m].
    pub h: f64,
}

/// A wall particle in the continuity equation: where it is, which way it faces, how fast it comes.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, Default)]
pub struct Face {
    /// Position [m].
    pub x: f64,
    /// Position [m].
    pub y: f64,
    /// Unit normal into the fluid [-].
    pub nx: f64,
    /// Unit normal into the fluid [-].
    pub ny: f64,
    /// Velocity of the wall along the normal V·n [m/s].
    pub vn: f64,
    /// Velocity of the fluid nearby along the tangent t = (−n_y, n_x), ũ·t [m/s].
    pub vt: f64,
    /// Area it stands for [m²].
    pub volume: f64,
    /// Smoothing length [m].
    pub h: f64,
}

/// Numbers that every pair shares.
#[derive(Clone, Copy, Debug)]
pub struct Constants {
    /// Gravity [m/s²].
    pub gravity: [f64; 2],
    /// Reference density ρ₀ [kg/m³].
    pub rho0: f64,
    /// Sound speed c₀ [m/s].
    pub c0: f64,
    /// Density diffusion δ [-] (E5).
    pub delta: f64,
    /// Artificial viscosity α [-] (E7).
    pub alpha: f64,
    /// Kinematic viscosity ν [m²/s] (E8).
    pub nu: f64,
    /// Whether walls feel the fluid stretch along them [-]: 0 or 1 (E10).
    pub stretch: f64,
}

/// Geometry of a pair whose supports overlap: r_ab, h̄ = (h_a + h_b)/2 and ∇_a W_ab = `slope` r_ab.
pub struct Bond {
    pub(crate) dx: f64,
    pub(crate) dy: f64,
    pub(crate) r2: f64,
    pub(crate) h: f64,
    pub(crate) q: f64,
    peak: f64, // α/h²
    pub(crate) slope: f64,
}

/// E2: the pair's kernel is taken at the mean smoothing length, so ∇_a W_ab = −∇_b W_ab exactly.
#[inline(always)]
pub(crate) fn bond<K: Shape>(ax: f64, ay: f64, ah: f64, bx: f64, by: f64, bh: f64) -> Option<Bond> {
    let (dx, dy, h) = (ax - bx, ay - by, 0.5 * (ah + bh));
    let r2 = dx * dx + dy * dy;
    if r2 >= 4.0 * h * h {
        return None;
    }
    let inverse = 1.0 / h;
    let q = r2.sqrt() * inverse;
    let i2 = inverse * inverse;
    let peak = K::ALPHA * i2;
    Some(Bond { dx, dy, r2, h, q, peak, slope: peak * i2 * K::slope(q) })
}

impl Bond {
    /// W_ab [1/m²].
    #[inline(always)]
    pub fn w<K: Shape>(&self) -> f64 {
        self.peak * K::w(self.q)
    }
}

/// E4 + E5 (R1): dρ_a/dt [kg/(m³ s)] from the divergence of velocity and the density diffusion.
#[inline(always)]
pub fn density_rate<'r, K: Shape, D: PairDissipation>(
    a: &Row,
    rho_a: f64,
    fluid: impl Iterator<Item = &'r Row>,
    walls: impl Iterator<Item = &'r Face>,
    c: &Constants,
) -> f64 {
    let (mut compression, mut diffusion) = (0.0, 0.0);
    for b in fluid {
        let Some(ab) = bond::<K>(a.x, a.y, a.h, b.x, b.y, b.h) else {
            continue;
        };
        let closing = ((a.u - b.u) * ab.dx + (a.v - b.v) * ab.dy) * ab.slope;
        // dynamic pressure difference: the hydrostatic part must not diffuse (Fourtakas et al. 2019)
        let hydrostatic = -c.rho0 * (c.gravity[0] * ab.dx + c.gravity[1] * ab.dy);
        let excess = b.p - a.p - hydrostatic;
        compression += b.volume * closing;
        diffusion -= b.volume * D::length(&ab) * excess * ab.slope;
    }
    for w in walls {
        let Some(aw) = bond::<K>(a.x, a.y, a.h, w.x, w.y, w.h) else {
            continue;
        };
        // E10: behind the wall the fluid moves with the reflected velocity, so the pair closes at 2(u_a − V)·n across
        // the wall; along it, if so chosen, with the velocity of the fluid in front, whose stretching is then felt
        let (un, ut) = (a.u * w.nx + a.v * w.ny, a.v * w.nx - a.u * w.ny);
        let (rn, rt) = (aw.dx * w.nx + aw.dy * w.ny, aw.dy * w.nx - aw.dx * w.ny);
        let closing = (2.0 * (un - w.vn) * rn + c.stretch * (ut - w.vt) * rt) * aw.slope;
        compression += w.volume * closing;
    }
    rho_a * compression + D::rate(c) * diffusion
}

/// E6 + E7 (R2) + E8: force of b on a [N/m] along and across r_ab: pressure, artificial and laminar viscosity.
#[inline(always)]
pub(crate) fn force<D: PairDissipation>(a: &Row, b: &Row, ab: &Bond, c: &Constants, nu: f64) -> [f64; 2] {
    let (du, dv) = (a.u - b.u, a.v - b.v);
    let weight = a.volume * b.volume * ab.slope;
    let normal = weight * (D::pressure(ab, du * ab.dx + dv * ab.dy, c) - (a.p + b.p));
    let shear = weight * 2.0 * c.rho0 * nu; // (r·∇W)/r² is the kernel's slope: nothing to regularise
    [normal * ab.dx + shear * du, normal * ab.dy + shear * dv]
}

/// W [1/m²] and slope [1/m⁴] (∇W = slope · d) of a distance d = (dx, dy) [m]; `None` outside the support.
#[inline(always)]
pub(crate) fn kernel_and_slope<K: Shape>(dx: f64, dy: f64, h: f64) -> Option<(f64, f64)> {
    bond::<K>(dx, dy, h, 0.0, 0.0, h).map(|b| (b.w::<K>(), b.slope))
}

/// What the momentum sweep gathers for one target.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gathered {
    /// Force of all neighbours [N/m].
    pub force: [f64; 2],
    /// Geometry of the neighbourhood.
    pub around: Surroundings,
}

/// Forces on a fluid particle, and how its neighbours lie. `wall_nu` is ν where walls do not slip, else 0.
#[inline(always)]
pub fn momentum<'r, K: Shape, D: PairDissipation>(
    a: &Row,
    fluid: impl Iterator<Item = &'r Row>,
    walls: impl Iterator<Item = &'r Row>,
    c: &Constants,
    wall_nu: f64,
) -> Gathered {
    let mut sum = MomentumSum { filling: a.fill * K::ALPHA * K::w(0.0) / (a.h * a.h), ..MomentumSum::default() };
    for b in fluid {
        sum.take::<K, D>(a, b, c, c.nu);
    }
    let fluid_filling = sum.filling;
    for w in walls {
        sum.take::<K, ElasticPair>(a, w, c, wall_nu);
    }
    let lambda = smallest_eigenvalue(sum.spread);
    Gathered {
        force: sum.force,
        around: Surroundings { filling: sum.filling, fluid_filling, crowding: sum.crowding, lambda },
    }
}

/// Running sums of [`momentum`].
#[derive(Default)]
struct MomentumSum {
    force: [f64; 2],
    filling: f64,
    crowding: [f64; 2],
    spread: [f64; 3],
}

impl MomentumSum {
    #[inline(always)]
    fn take<K: Shape, D: PairDissipation>(&mut self, a: &Row, b: &Row, c: &Constants, nu: f64) {
        let Some(ab) = bond::<K>(a.x, a.y, a.h, b.x, b.y, b.h) else {
            return;
        };
        let f = force::<D>(a, b, &ab, c, nu);
        self.force[0] += f[0];
        self.force[1] += f[1];
        self.filling += b.fill * ab.w::<K>();
        let pull = b.fill * ab.slope;
        self.crowding[0] += pull * ab.dx;
        self.crowding[1] += pull * ab.dy;
        self.spread[0] -= pull * ab.dx * ab.dx;
        self.spread[1] -= pull * ab.dx * ab.dy;
        self.spread[2] -= pull * ab.dy * ab.dy;
    }
}

/// Force of the fluid on a wall particle [N/m]: the same pairs with the roles swapped.
#[inline(always)]
pub fn wall_force<'r, K: Shape>(
    wall: &Row,
    fluid: impl Iterator<Item = &'r Row>,
    c: &Constants,
    wall_nu: f64,
) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for a in fluid {
        let Some(ab) = bond::<K>(wall.x, wall.y, wall.h, a.x, a.y, a.h) else {
            continue;
        };
        let f = force::<ElasticPair>(wall, a, &ab, c, wall_nu);
        sum[0] += f[0];
        sum[1] += f[1];
    }
    sum
}

/// What a wall particle extrapolates from the fluid.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extrapolated {
    /// Pressure [Pa] (E9).
    pub pressure: f64,
    /// Velocity of the fluid nearby [m/s] (E11).
    pub velocity: [f64; 2],
}

/// E9 (Adami, Hu & Adams 2012): pressure at a wall particle that moves with acceleration `acceleration`;
/// the pressure gradient beside it is ρ(g − a_w).
#[inline(always)]
pub fn extrapolate<'r, K: Shape>(
    wall: &Row,
    acceleration: [f64; 2],
    fluid: impl Iterator<Item = &'r Row>,
    c: &Constants,
) -> Extrapolated {
    let (mut weight, mut pressure, mut velocity, mut arm) = (0.0, 0.0, [0.0; 2], [0.0; 2]);
    for b in fluid {
        let Some(ab) = bond::<K>(wall.x, wall.y, wall.h, b.x, b.y, b.h) else {
            continue;
        };
        let w = b.volume * ab.w::<K>();
        weight += w;
        pressure += w * b.p;
        velocity[0] += w * b.u;
        velocity[1] += w * b.v;
        arm[0] += w * ab.dx;
        arm[1] += w * ab.dy;
    }
    if weight < 1e-9 {
        return Extrapolated { pressure: 0.0, velocity: [wall.u, wall.v] };
    }
    let field = [c.gravity[0] - acceleration[0], c.gravity[1] - acceleration[1]];
    Extrapolated {
        pressure: (pressure + c.rho0 * (field[0] * arm[0] + field[1] * arm[1])) / weight,
        velocity: [velocity[0] / weight, velocity[1] / weight],
    }
}

/// E14: smallest eigenvalue of the symmetric matrix [[m0, m1], [m1, m2]].
#[inline(always)]
fn smallest_eigenvalue(m: [f64; 3]) -> f64 {
    let (mean, half) = (0.5 * (m[0] + m[2]), 0.5 * (m[0] - m[2]));
    mean - (half * half + m[1] * m[1]).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dissipation::DiffusivePair;
    use crate::kernel::WendlandC2;

    fn constants() -> Constants {
        Constants { gravity: [0.3, -9.81], rho0: 1000.0, c0: 50.0, delta: 0.1, alpha: 0.05, nu: 1e-3, stretch: 1.0 }
    }

    fn row(x: f64, y: f64, u: f64, v: f64, p: f64) -> Row {
        Row { x, y, u, v, p, volume: 0.01, fill: 0.0101, h: 0.15 }
    }

    #[test]
    fn action_equals_reaction_between_any_two_resolutions() {
        let (a, mut b) = (row(0.0, 0.0, 1.0, -2.0, 350.0), row(0.1, 0.07, -0.5, 0.2, -80.0));
        b.h = 0.21;
        let c = constants();
        let on_a = momentum::<WendlandC2, DiffusivePair>(&a, [b].iter(), [].iter(), &c, 0.0).force;
        let on_b = momentum::<WendlandC2, DiffusivePair>(&b, [a].iter(), [].iter(), &c, 0.0).force;
        for k in 0..2 {
            assert!(on_a[k] != 0.0 && (on_a[k] + on_b[k]).abs() <= 1e-15 * on_a[k].abs());
        }
        let on_fluid = momentum::<WendlandC2, DiffusivePair>(&a, [].iter(), [b].iter(), &c, c.nu).force;
        let on_wall = wall_force::<WendlandC2>(&b, [a].iter(), &c, c.nu);
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
        let rate = density_rate::<WendlandC2, DiffusivePair>(&a, 1000.0, [b].iter(), [].iter(), &c);
        assert!(rate.abs() < 1e-12, "{rate}");
    }

    #[test]
    fn a_wall_extrapolates_the_accelerated_hydrostatic_field_exactly() {
        let c = constants();
        let acceleration = [1.5, 4.0];
        let field = [c.gravity[0] - acceleration[0], c.gravity[1] - acceleration[1]];
        let p = |x: f64, y: f64| 700.0 + c.rho0 * (field[0] * x + field[1] * y);
        let fluid: Vec<Row> =
            [(0.1, 0.1), (0.02, 0.13), (-0.1, 0.2)].map(|(x, y)| row(x, y, 0.0, 0.0, p(x, y))).to_vec();
        let wall = row(0.03, -0.05, 0.0, 0.0, 0.0);
        let found = extrapolate::<WendlandC2>(&wall, acceleration, fluid.iter(), &c).pressure;
        assert!((found - p(wall.x, wall.y)).abs() < 1e-9, "{found}");
    }

    #[test]
    fn eigenvalue_of_a_rotated_diagonal() {
        let (s, k) = (0.6_f64, 0.8_f64); // sine and cosine
        let (e1, e2) = (0.4, 0.9);
        let m = [e1 * k * k + e2 * s * s, (e2 - e1) * s * k, e1 * s * s + e2 * k * k];
        assert!((smallest_eigenvalue(m) - 0.4).abs() < 1e-14);
    }
}
