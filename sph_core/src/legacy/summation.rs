//! Density by summation (THEORY LE13), for comparison: it fails at a free surface.

use crate::interactions::geometry::pair_geometry;
use crate::kernel::{Shape, TargetSum};
use crate::legacy::fluid_pairs;
use crate::system::ParticleSystem;
use crate::timers::Phase;

/// LE13: ρ_a = Σ_b m_b W_ab [kg/m³], a itself included; a wall particle counts with ρ₀ V_w.
struct SummedDensity<'a>(&'a ParticleSystem);

impl TargetSum for SummedDensity<'_> {
    type Sum = f64;
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> f64 {
        let ParticleSystem { packed, particles, neighbours, domain, .. } = self.0;
        let (a, mass) = (&packed.fluid[k], &particles.mass);
        let mut rho = mass[k] * K::ALPHA * K::w(0.0) / (a.h * a.h);
        for (j, _, ab) in fluid_pairs::<K>(self.0, k) {
            rho += mass[neighbours.source(j, mass.len())] * ab.w::<K>();
        }
        for w in neighbours.walls_of_fluid.of(k).map(|j| &packed.walls[j as usize]) {
            if let Some(aw) = pair_geometry::<K>(a.x, a.y, a.h, w.x, w.y, w.h) {
                rho += domain.fluid.density * w.volume * aw.w::<K>();
            }
        }
        rho
    }
}

/// LE13: densities from masses, at the state last packed.
pub(crate) fn sum_density(system: &mut ParticleSystem) {
    system.timers.begin(Phase::Density);
    let mut rho = vec![0.0; system.particles.len()];
    system.domain.fluid.kernel.gather(&SummedDensity(system), &mut rho);
    system.particles.rho = rho;
}
