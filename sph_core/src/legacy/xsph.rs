//! XSPH (THEORY L6): particles move with a velocity smoothed over their neighbours; momentum does not notice.

use crate::fluid::Fluid;
use crate::interactions::kernel::{Shape, WithKernel};
use crate::interactions::pair::{self, Row};
use crate::neighbours::Search;
use crate::parallel;

/// L6 without its ε, for every fluid particle.
struct Smoothing<'a> {
    fluid: &'a [Row],
    mass: &'a [f64],
    rho: &'a [f64],
    search: &'a Search,
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

/// L6: Σ_b (m_b/ρ̄_ab) (v_b − v_a) W_ab [m/s]. Times m_a it is antisymmetric in a and b.
#[inline(always)]
fn excess_velocity<'r, K: Shape>(a: &Row, near: impl Iterator<Item = (&'r Row, f64)>) -> [f64; 2] {
    let mut excess = [0.0; 2];
    for (b, volume) in near {
        if let Some(ab) = pair::bond::<K>(a.x, a.y, a.h, b.x, b.y, b.h) {
            let w = volume * ab.w::<K>();
            excess[0] += w * (b.u - a.u);
            excess[1] += w * (b.v - a.v);
        }
    }
    excess
}

impl Fluid {
    /// L6: what the neighbours' velocities have over each particle's own [m/s], from the state of the last sweep.
    pub fn excess_velocities(&mut self) -> &[[f64; 2]] {
        self.excess_velocity.resize(self.particles.len(), [0.0; 2]);
        self.parameters.kernel.run(Smoothing {
            fluid: &self.rows.fluid,
            mass: &self.particles.mass,
            rho: &self.particles.rho,
            search: &self.search,
            out: &mut self.excess_velocity,
        });
        &self.excess_velocity
    }

    /// L6: x ← x + Δt ε Σ …, with the velocities that the density rate was found with. Nothing to do where ε = 0.
    pub(crate) fn drift_with_neighbours(&mut self, dt: f64) {
        let epsilon = self.parameters.xsph;
        if epsilon == 0.0 {
            return;
        }
        self.excess_velocities();
        let p = &mut self.particles;
        for (k, [u, v]) in self.excess_velocity.iter().enumerate() {
            p.x[k] += dt * epsilon * u;
            p.y[k] += dt * epsilon * v;
        }
    }
}
