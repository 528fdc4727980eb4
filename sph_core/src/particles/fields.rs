//! Quantities that a step recomputes: pressure, and the moments of the kernel.

use serde::{Deserialize, Serialize};

use crate::memory::of_vector;
use crate::particles::{Particles, Spare, permute};
use crate::state_bytes::{StateError, expect_count};

/// Quantities that a step recomputes, one entry per particle.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Fields {
    /// Pressure [Pa].
    pub pressure: Vec<f64>,
    /// Volume per metre of span that a scheme keeps [m²]; empty where it is m/ρ.
    pub volume: Vec<f64>,
    /// Kernel moments.
    pub moments: Vec<KernelMoments>,
    /// True for a particle that is, or has within its support, a free-surface particle.
    pub near_surface: Vec<bool>,
}

impl Fields {
    pub(crate) fn resize(&mut self, n: usize) {
        self.pressure.resize(n, 0.0);
        self.moments.resize(n, KernelMoments::default());
        self.near_surface.resize(n, false);
    }

    /// Memory that the arrays occupy [bytes].
    pub(crate) fn bytes(&self) -> usize {
        let Fields { pressure, volume, moments, near_surface } = self;
        of_vector(pressure) + of_vector(volume) + of_vector(moments) + of_vector(near_surface)
    }

    /// An error unless there are entries for `n` particles, volumes as `like` has them.
    pub(crate) fn check(&self, n: usize, like: &Fields) -> Result<(), StateError> {
        let volumes = if like.volume.is_empty() { 0 } else { n };
        expect_count("pressures", self.pressure.len(), n)?;
        expect_count("volumes", self.volume.len(), volumes)?;
        expect_count("kernel moments", self.moments.len(), n)?;
        expect_count("marks of the free surface", self.near_surface.len(), n)
    }

    pub(crate) fn permute(&mut self, order: &[u32], spare: &mut Spare) {
        permute(&mut self.pressure, order, &mut spare.numbers);
        permute(&mut self.volume, order, &mut spare.numbers);
        permute(&mut self.moments, order, &mut spare.moments);
        permute(&mut self.near_surface, order, &mut spare.marks);
    }

    /// Volume per metre of span of particle `k` of `p` [m²].
    pub(crate) fn volume_of(&self, k: usize, p: &Particles) -> f64 {
        self.volume.get(k).copied().unwrap_or_else(|| p.mass[k] / p.rho[k])
    }
}

/// Moments of the kernel over the neighbours of a particle (THEORY OP4, OP5, WC10), with V = m/ρ.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct KernelMoments {
    /// S = Σ V W [-] (OP4): 1 where space is filled as the densities say.
    pub kernel_sum: f64,
    /// The walls' share of S [-]; exactly 0 away from them.
    pub wall_kernel_sum: f32,
    /// ∇C = Σ V ∇W [1/m] (OP4), see [`KernelMoments::concentration_gradient`].
    pub concentration_gradient: [f32; 2],
    /// λ (OP5), smallest eigenvalue of the renormalisation matrix Σ V (r_b − r_a)⊗∇W [-]: 1 inside, about 0.5 on a flat free surface.
    pub lambda: f32,
}

impl KernelMoments {
    /// From sums in double precision; what is only compared with thresholds or shifts a particle is kept in single.
    pub(crate) fn new(
        kernel_sum: f64,
        fluid_kernel_sum: f64,
        concentration_gradient: [f64; 2],
        lambda: f64,
    ) -> KernelMoments {
        let wall_kernel_sum = (kernel_sum - fluid_kernel_sum) as f32;
        KernelMoments {
            kernel_sum,
            wall_kernel_sum,
            concentration_gradient: concentration_gradient.map(|c| c as f32),
            lambda: lambda as f32,
        }
    }

    /// The fluid's own share of S [-]: about 0.6 in the top row of a flat surface, 0.25 for a lone particle.
    #[inline]
    pub fn fluid_kernel_sum(&self) -> f64 {
        self.kernel_sum - f64::from(self.wall_kernel_sum)
    }

    /// ∇C = Σ V ∇W [1/m] (OP4): points to where particles crowd.
    #[inline]
    pub fn concentration_gradient(&self) -> [f64; 2] {
        self.concentration_gradient.map(f64::from)
    }

    /// Is it in the row of the free surface (OP5)?
    #[inline]
    pub(crate) fn at_surface(&self) -> bool {
        self.lambda < SURFACE_LAMBDA
    }

    /// WC2: true where the fluid holds no tension: in spray and, with `ventilation`, where both a wall and the air are within the
    /// kernel, so that air comes in between.
    #[inline]
    pub(crate) fn tensionless(&self, near_surface: bool, ventilation: bool) -> bool {
        let at_waterline = near_surface && self.wall_kernel_sum > 0.0;
        self.fluid_kernel_sum() < TENSIONLESS_KERNEL_SUM || (ventilation && at_waterline)
    }
}

impl Default for KernelMoments {
    /// Deep inside the fluid: the state before moments are found first.
    fn default() -> KernelMoments {
        KernelMoments { kernel_sum: 1.0, wall_kernel_sum: 0.0, concentration_gradient: [0.0; 2], lambda: 1.0 }
    }
}

/// Particles of the free surface have λ below this (OP5; Marrone et al. 2010 use 0.75 for the jump to the interior).
pub const SURFACE_LAMBDA: f32 = 0.7;

/// Spray (WC2): particles whose fluid kernel_sum is below this are in films a particle thick, or alone. They hold no
/// tension, so that they leave a wall instead of creeping along it.
pub const TENSIONLESS_KERNEL_SUM: f64 = 0.5;
