//! XSPH (THEORY LE8): particles move with a velocity smoothed over their neighbours; momentum does not notice.

use crate::kernel::{Shape, TargetSum};
use crate::legacy::fluid_pairs;
use crate::system::ParticleSystem;

/// LE8: Σ_b (m_b/ρ̄_ab) (v_b − v_a) W_ab [m/s]. Times m_a it is antisymmetric in a and b.
struct ExcessVelocity<'a>(&'a ParticleSystem);

impl TargetSum for ExcessVelocity<'_> {
    type Sum = [f64; 2];
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> [f64; 2] {
        let ParticleSystem { packed, particles: p, neighbours, .. } = self.0;
        let (a, mut excess) = (&packed.fluid[k], [0.0; 2]);
        for (j, b, ab) in fluid_pairs::<K>(self.0, k) {
            let s = neighbours.source(j, p.len());
            let w = 2.0 * p.mass[s] / (p.rho[k] + p.rho[s]) * ab.w::<K>();
            excess = [excess[0] + w * (b.u - a.u), excess[1] + w * (b.v - a.v)];
        }
        excess
    }
}

/// LE8: what the neighbours' velocities have over each particle's own [m/s], from the state last packed.
pub fn excess_velocities(system: &ParticleSystem) -> Vec<[f64; 2]> {
    let mut excess = vec![[0.0; 2]; system.particles.len()];
    system.domain.fluid.kernel.gather(&ExcessVelocity(system), &mut excess);
    excess
}

/// LE8: x ← x + Δt ε Σ …, with the velocities that the density rate was found with.
pub(crate) fn drift_with_neighbours(system: &mut ParticleSystem, epsilon: f64, dt: f64) {
    let excess = excess_velocities(system);
    let p = &mut system.particles;
    for (k, [u, v]) in excess.into_iter().enumerate() {
        p.x[k] += dt * epsilon * u;
        p.y[k] += dt * epsilon * v;
    }
}
