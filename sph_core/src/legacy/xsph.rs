//! XSPH (THEORY LE8): particles move with a velocity smoothed over their neighbours; momentum does not notice.

use crate::interactions::geometry::pair_geometry;
use crate::interactions::kernel::{Shape, WithKernel};
use crate::interactions::packed_particle::PackedParticle;
use crate::neighbours::Neighbours;
use crate::parallel;
use crate::system::ParticleSystem;

/// LE8 without its ε, for every fluid particle.
struct Smoothing<'a> {
    fluid: &'a [PackedParticle],
    mass: &'a [f64],
    rho: &'a [f64],
    search: &'a Neighbours,
    out: &'a mut [[f64; 2]],
}

impl WithKernel for Smoothing<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Smoothing { fluid, mass, rho, search, out } = self;
        let n = mass.len();
        parallel::gather_into(out, |k| {
            let near = search.fluid.of(k).map(|j| (&fluid[j as usize], search.source(j, n)));
            let volumes = near.map(|(b, s)| (b, 2.0 * mass[s] / (rho[k] + rho[s])));
            excess_velocity::<K>(&fluid[k], volumes)
        });
    }
}

/// LE8: Σ_b (m_b/ρ̄_ab) (v_b − v_a) W_ab [m/s]. Times m_a it is antisymmetric in a and b.
#[inline(always)]
fn excess_velocity<'r, K: Shape>(
    a: &PackedParticle,
    near: impl Iterator<Item = (&'r PackedParticle, f64)>,
) -> [f64; 2] {
    let mut excess = [0.0; 2];
    for (b, volume) in near {
        if let Some(ab) = pair_geometry::<K>(a.x, a.y, a.h, b.x, b.y, b.h) {
            let w = volume * ab.w::<K>();
            excess[0] += w * (b.u - a.u);
            excess[1] += w * (b.v - a.v);
        }
    }
    excess
}

/// LE8: what the neighbours' velocities have over each particle's own [m/s], from the state last packed.
pub fn excess_velocities(system: &ParticleSystem) -> Vec<[f64; 2]> {
    let mut excess = vec![[0.0; 2]; system.particles.len()];
    system.domain.fluid.kernel.run(Smoothing {
        fluid: &system.packed.fluid,
        mass: &system.particles.mass,
        rho: &system.particles.rho,
        search: &system.neighbours,
        out: &mut excess,
    });
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
