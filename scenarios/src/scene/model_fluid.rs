//! The water of a resolved scene, and the numerical scheme.

use serde::Serialize;
pub use sph_core::legacy::{DiffusionForm, EquationOfState};
pub use sph_core::{
    DensityEvolution, DensityFilter, Dissipation, IdealGas, Integrator, Kernel, Slip as WallSlip, Turbulence, WallModel,
};

/// The water and the numerical scheme.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fluid {
    /// Density of the undisturbed water ρ [kg/m³].
    pub density: f64,
    /// Speed of sound c₀ [m/s].
    pub sound_speed: f64,
    /// Share of the force that compressibility may cost [-]; sets an "auto" speed of sound.
    pub compressibility_error: f64,
    /// Exponent γ of Tait's equation of state [-]; 1 is linear.
    pub eos_exponent: f64,
    /// Smoothing kernel.
    pub kernel: Kernel,
    /// Smoothing length over spacing, h/dx [-]; the kernel's support is 2h.
    pub smoothing_ratio: f64,
    /// Coefficient α of artificial viscosity [-].
    pub artificial_viscosity: f64,
    /// Kinematic viscosity ν [m²/s].
    pub kinematic_viscosity: f64,
    /// Coefficient δ of density diffusion [-].
    pub density_diffusion: f64,
    /// Particle shifting.
    pub shifting: bool,
    /// Share κ of h² ∇C that particles are shifted by in each step, whatever their speed [-].
    pub settling: f64,
    /// Tangential condition on walls.
    pub wall_slip: WallSlip,
    /// Walls feel the water stretch along them.
    pub wall_stretch: bool,
    /// Air comes in between a wall and water under tension where both touch it (THEORY E3).
    pub ventilation: bool,
    /// Time integration.
    pub integrator: Integrator,
    /// Step limit: dt ≤ cfl·h/(c₀ + |v|) [-].
    pub cfl: f64,
    /// Steps between two Euler steps of Verlet's integrator; 0 is never.
    pub verlet_correction_every: u32,
    /// How densities are smoothed now and then.
    pub density_filter: DensityFilter,
    /// Steps between two filterings.
    pub density_filter_every: u32,
    /// Share ε of its neighbours' velocity that a particle moves with [-].
    pub xsph: f64,
    /// What stands for eddies smaller than a particle.
    pub turbulence: Turbulence,
    /// What gives the pressure.
    pub equation_of_state: EquationOfState,
    /// Temperature of the ideal gas at rest [K].
    pub temperature: f64,
    /// Molar mass of the ideal gas [kg/mol].
    pub molar_mass: f64,
    /// Where densities come from.
    pub density_evolution: DensityEvolution,
    /// What density diffusion diffuses.
    pub density_diffusion_form: DiffusionForm,
    /// How walls keep the water out.
    pub walls: WallModel,
    /// Dynamic walls' pressure at the start: 0 none, 1 that of the water beside them.
    pub limit_pressure: i64,
    /// What smooths pressures and velocities between particles of water.
    pub dissipation: Dissipation,
}

impl Fluid {
    /// The gas, where the fluid is one.
    pub fn gas(&self) -> Option<IdealGas> {
        let Fluid { density, eos_exponent, temperature, molar_mass, .. } = *self;
        let gas = IdealGas { rho0: density, gamma: eos_exponent, temperature, molar_mass };
        (self.equation_of_state == EquationOfState::IdealGas).then_some(gas)
    }
}
