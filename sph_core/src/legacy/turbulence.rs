//! Sub-particle-scale turbulence (THEORY LE9, LE10): stresses, then their divergence. Fluid pairs only.

use crate::forces::Forces;
use crate::interactions::packed_particle::PackedParticle;
use crate::kernel::{Shape, TargetSum};
use crate::legacy::{FluidPair, fluid_pairs};
use crate::system::ParticleSystem;
use crate::timers::Phase;

/// Smagorinsky's constant C_s [-] (LE9; Dalrymple & Rogers 2006).
pub const SMAGORINSKY: f64 = 0.12;
/// C_I [-], of the isotropic part (LE9; Dalrymple & Rogers 2006).
pub const ISOTROPIC: f64 = 0.0066;
/// Below this determinant of the renormalisation matrix a gradient is taken as it is summed.
const LEAST_DETERMINANT: f64 = 0.05;

/// Symmetric stress τ_xx, τ_xy, τ_yy [Pa].
pub type Stress = [f64; 3];

/// LE9 for every fluid particle.
struct StressSum<'a>(&'a ParticleSystem);

impl TargetSum for StressSum<'_> {
    type Sum = Stress;
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> Stress {
        let (a, spacing_ratio) = (&self.0.packed.fluid[k], 1.0 / self.0.domain.fluid.smoothing_ratio);
        stress(velocity_gradient(a, fluid_pairs::<K>(self.0, k)), self.0.particles.rho[k], a.h * spacing_ratio)
    }
}

/// ∂u_i/∂x_j [1/s] as [[u_x, u_y], [v_x, v_y]]: Σ V (u_b − u_a)⊗∇W, renormalised (OP5) to be exact for a linear field.
#[inline(always)]
fn velocity_gradient<'r>(a: &PackedParticle, near: impl Iterator<Item = FluidPair<'r>>) -> [[f64; 2]; 2] {
    let (mut sum, mut spread) = ([[0.0; 2]; 2], [0.0; 3]);
    for (_, b, ab) in near {
        let pull = b.raw_volume * ab.grad_factor;
        let gradient = [pull * ab.dx, pull * ab.dy];
        for j in 0..2 {
            sum[0][j] += (b.u - a.u) * gradient[j];
            sum[1][j] += (b.v - a.v) * gradient[j];
        }
        spread[0] -= gradient[0] * ab.dx;
        spread[1] -= gradient[0] * ab.dy;
        spread[2] -= gradient[1] * ab.dy;
    }
    let determinant = spread[0] * spread[2] - spread[1] * spread[1];
    if determinant < LEAST_DETERMINANT {
        return sum;
    }
    sum.map(|[x, y]| [(spread[2] * x - spread[1] * y) / determinant, (spread[0] * y - spread[1] * x) / determinant])
}

/// LE9: τ = ρ [2 ν_t (S − ⅓ tr(S) I) − ⅔ C_I Δ² |S|² I], ν_t = (C_s Δ)² |S|, |S| = √(2 S:S) [Pa].
pub fn stress(gradient: [[f64; 2]; 2], rho: f64, spacing: f64) -> Stress {
    let [[xx, uy], [vx, yy]] = gradient;
    let xy = 0.5 * (uy + vx);
    let square = 2.0 * (xx * xx + 2.0 * xy * xy + yy * yy);
    let eddy = (SMAGORINSKY * spacing).powi(2) * square.sqrt();
    let isotropic = 2.0 / 3.0 * (eddy * (xx + yy) + ISOTROPIC * spacing * spacing * square);
    [rho * (2.0 * eddy * xx - isotropic), rho * 2.0 * eddy * xy, rho * (2.0 * eddy * yy - isotropic)]
}

/// LE10 for every fluid particle.
struct Divergence<'a> {
    system: &'a ParticleSystem,
    stress: &'a [Stress],
}

impl TargetSum for Divergence<'_> {
    type Sum = [f64; 2];
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> [f64; 2] {
        stress_force(&self.system.packed.fluid[k], &self.stress[k], fluid_pairs::<K>(self.system, k), self.stress)
    }
}

/// LE10: Σ_b V_a V_b (τ_a + τ_b)·∇W_ab [N/m]: antisymmetric in a and b.
#[inline(always)]
fn stress_force<'r>(
    a: &PackedParticle,
    stress_a: &Stress,
    near: impl Iterator<Item = FluidPair<'r>>,
    stress: &[Stress],
) -> [f64; 2] {
    let mut force = [0.0; 2];
    for (j, b, ab) in near {
        let weight = a.volume * b.volume * ab.grad_factor;
        let [xx, xy, yy] = [0, 1, 2].map(|c| stress_a[c] + stress[j as usize][c]);
        force[0] += weight * (xx * ab.dx + xy * ab.dy);
        force[1] += weight * (xy * ab.dx + yy * ab.dy);
    }
    force
}

/// LE9: stress of every particle and image [Pa], from the state last packed. A reflection's shear has the other sign.
pub fn stresses(system: &ParticleSystem) -> Vec<Stress> {
    let n = system.particles.len();
    let mut stress = vec![[0.0; 3]; n + system.neighbours.fluid_images.len()];
    system.domain.fluid.kernel.gather(&StressSum(system), &mut stress[..n]);
    for (k, &source) in system.neighbours.fluid_images.iter().enumerate() {
        let [xx, xy, yy] = stress[source as usize];
        stress[n + k] = if system.domain.periodic.is_some() { [xx, xy, yy] } else { [xx, -xy, yy] };
    }
    stress
}

/// LE9, LE10: add the forces of the eddies.
pub(crate) fn add_eddy_forces(system: &mut ParticleSystem, forces: &mut Forces) {
    system.timers.begin(Phase::Momentum);
    let (stress, mut found) = (stresses(system), vec![[0.0; 2]; system.particles.len()]);
    system.domain.fluid.kernel.gather(&Divergence { system, stress: &stress }, &mut found);
    forces.add(&found);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interactions::geometry::pair_geometry;
    use crate::kernel::WendlandC2;

    fn pairs<'a>(a: &PackedParticle, near: &'a [PackedParticle]) -> Vec<FluidPair<'a>> {
        let geometry = |b: &PackedParticle| pair_geometry::<WendlandC2>(a.x, a.y, a.h, b.x, b.y, b.h);
        (0..).zip(near).map(|(j, b)| (j, b, geometry(b).expect("a neighbour"))).collect()
    }

    /// u = γ̇ y: S_xy = γ̇/2, |S| = γ̇, so τ_xy = ρ (C_s Δ)² γ̇² and τ_xx = τ_yy = −⅔ ρ C_I Δ² γ̇².
    #[test]
    fn stress_of_a_linear_shear_is_smagorinskys() {
        let (rate, rho, spacing) = (3.0, 1000.0, 0.1);
        let row = |x: f64, y: f64| PackedParticle {
            x,
            y,
            u: rate * y,
            raw_volume: 0.01,
            volume: 0.01,
            h: 0.15,
            ..PackedParticle::default()
        };
        let near = [(0.1, 0.02), (-0.08, 0.01), (0.03, 0.11), (-0.02, -0.1), (0.12, 0.13)].map(|(x, y)| row(x, y));
        let gradient = velocity_gradient(&row(0.0, 0.0), pairs(&row(0.0, 0.0), &near).into_iter());
        let found = stress(gradient, rho, spacing);
        let shear = rho * (0.12 * spacing * rate) * (0.12 * spacing * rate);
        let normal = -2.0 / 3.0 * rho * 0.0066 * spacing * spacing * rate * rate;
        for (found, exact) in found.into_iter().zip([normal, shear, normal]) {
            assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
        }
    }

    #[test]
    fn eddies_act_and_react() {
        let row = |x: f64, y: f64, h: f64| PackedParticle {
            x,
            y,
            raw_volume: 0.01,
            volume: 0.011,
            h,
            ..PackedParticle::default()
        };
        let (a, b) = (row(0.0, 0.0, 0.15), row(0.1, 0.07, 0.21));
        let (of_a, of_b) = ([-3.0, 5.0, 1.0], [2.0, -1.0, 4.0]);
        let on_a = stress_force(&a, &of_a, pairs(&a, &[b]).into_iter(), &[of_b]);
        let on_b = stress_force(&b, &of_b, pairs(&b, &[a]).into_iter(), &[of_a]);
        for c in 0..2 {
            assert!(on_a[c] != 0.0 && on_a[c] == -on_b[c], "{on_a:?} {on_b:?}");
        }
    }
}
