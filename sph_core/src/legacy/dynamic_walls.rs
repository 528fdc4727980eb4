//! Dynamic walls (THEORY LE16): wall particles are fluid particles with a prescribed motion. Their density follows
//! from continuity, their pressure from the equation of state.

use serde::{Deserialize, Serialize};

use crate::interactions::geometry::kernel_and_gradient;
use crate::interactions::packed_particle::PackedParticle;
use crate::kernel::{Shape, TargetSum};
use crate::neighbours::lists::Lists;
use crate::wcsph::eos::Tait;

/// Densities of the walls; empty where walls are not dynamic.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct DynamicWalls {
    pub rho: Vec<f64>,
    pub rate: Vec<f64>,
    old: Vec<f64>,
}

impl DynamicWalls {
    /// Walls that start at these pressures [Pa].
    pub fn start(&mut self, pressures: &[f64], eos: Tait) {
        self.rho = pressures.iter().map(|&p| eos.density(p)).collect();
        self.rate = vec![0.0; pressures.len()];
    }

    /// ρ ← ρ + Δt dρ/dt.
    pub fn advance_density(&mut self, dt: f64) {
        for (rho, rate) in self.rho.iter_mut().zip(&self.rate) {
            *rho += dt * rate;
        }
    }

    /// ρ ← ρ (2 + ε)/(2 − ε), as for the fluid (WC11).
    pub fn advance_density_midpoint(&mut self, dt: f64) {
        for (rho, rate) in self.rho.iter_mut().zip(&self.rate) {
            let strain = dt * rate / *rho;
            *rho *= (2.0 + strain) / (2.0 - strain);
        }
    }

    /// Remember the densities at n (LE2).
    pub fn keep(&mut self) {
        self.old.clone_from(&self.rho);
    }

    /// ρ' = ρ at n + Δt dρ/dt (LE2).
    pub fn correct(&mut self, dt: f64) {
        self.rho.clone_from(&self.old);
        self.advance_density(dt);
    }

    /// Pressures [Pa] of the densities, which never fall below ρ₀: a dry wall neither pulls nor stays stretched.
    pub fn pressures(&mut self, eos: Tait) -> impl Iterator<Item = f64> + '_ {
        self.rho.iter_mut().map(move |rho| {
            *rho = rho.max(eos.rho0);
            eos.pressure(*rho)
        })
    }
}

/// LE16: the density rate ρ_a Σ_b V_b (v_a − v_b)·∇W_ab [kg/(m³ s)] that `others` cause on `targets`, both moving with their
/// own velocities. Once for the fluid beside walls, once for the walls beside fluid.
pub(crate) struct OwnVelocityRate<'a> {
    pub targets: &'a [PackedParticle],
    pub rho: &'a [f64],
    pub others: &'a [PackedParticle],
    pub lists: &'a Lists,
}

impl TargetSum for OwnVelocityRate<'_> {
    type Sum = f64;
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> f64 {
        let (a, mut sum) = (&self.targets[k], 0.0);
        for b in self.lists.of(k).map(|j| &self.others[j as usize]) {
            let (dx, dy) = (a.x - b.x, a.y - b.y);
            if let Some((_, slope)) = kernel_and_gradient::<K>(dx, dy, 0.5 * (a.h + b.h)) {
                sum += b.volume * ((a.u - b.u) * dx + (a.v - b.v) * dy) * slope;
            }
        }
        self.rho[k] * sum
    }
}
