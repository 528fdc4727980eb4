//! Density by summation (THEORY LE13), for comparison: it fails at a free surface.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::interactions::geometry::pair_geometry;
use crate::interactions::kernel::{Shape, WithKernel};
use crate::interactions::packed_particle::PackedParticle;
use crate::neighbours::Neighbours;
use crate::parallel;
use crate::system::ParticleSystem;
use crate::timers::Phase;

/// Where densities come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DensityEvolution {
    /// WC3: advanced with the divergence of velocity.
    #[default]
    Continuity,
    /// LE13: counted anew from masses (M. Pilorget 2010, eq. 13). Low where neighbours are missing.
    Summation,
}

/// LE13 for every fluid particle.
struct Summation<'a> {
    fluid: &'a [PackedParticle],
    walls: &'a [PackedParticle],
    mass: &'a [f64],
    rho0: f64,
    search: &'a Neighbours,
    out: &'a mut [f64],
}

impl WithKernel for Summation<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Summation { fluid, walls, mass, rho0, search, out } = self;
        parallel::gather_into(out, |k| {
            let near = search.fluid.of(k).map(|j| (&fluid[j as usize], mass[search.source(j, mass.len())]));
            let near_walls = search.walls_of_fluid.of(k).map(|j| &walls[j as usize]);
            let masses = near.chain(near_walls.map(|w| (w, rho0 * w.volume)));
            summed_density::<K>(&fluid[k], mass[k], masses)
        });
    }
}

/// LE13: ρ_a = Σ_b m_b W_ab [kg/m³], a itself included; a wall particle counts with ρ₀ V_w.
#[inline(always)]
fn summed_density<'r, K: Shape>(
    a: &PackedParticle,
    mass_a: f64,
    masses: impl Iterator<Item = (&'r PackedParticle, f64)>,
) -> f64 {
    let mut rho = mass_a * K::ALPHA * K::w(0.0) / (a.h * a.h);
    for (b, mass_b) in masses {
        if let Some(ab) = pair_geometry::<K>(a.x, a.y, a.h, b.x, b.y, b.h) {
            rho += mass_b * ab.w::<K>();
        }
    }
    rho
}

/// LE13: densities from masses, at the state last packed.
pub(crate) fn sum_density(system: &mut ParticleSystem) {
    system.timers.begin(Phase::Density);
    let rho0 = system.domain.fluid.density;
    let ParticleSystem { packed, particles, neighbours, domain, .. } = system;
    domain.fluid.kernel.run(Summation {
        fluid: &packed.fluid,
        walls: &packed.walls,
        mass: &particles.mass,
        rho0,
        search: neighbours,
        out: &mut particles.rho,
    });
}
