//! What does not change about a fluid during a run.

use serde::{Deserialize, Serialize};

use crate::domain::Slip;
use crate::interactions::dissipation::Dissipation;
use crate::interactions::kernel::Kernel;
use crate::interactions::pair::Constants;
use crate::legacy::density_filter::DensityFilter;
use crate::legacy::ideal_gas::IdealGas;
use crate::legacy::integrator::Integrator;
use crate::legacy::pilorget2010::ThesisSettings;
use crate::legacy::repulsive::Repulsion;
use crate::legacy::summation::DensityEvolution;
use crate::legacy::turbulence::Turbulence;
use crate::legacy::wall_model::WallTreatment;
use crate::neighbours::images::{Mirror, Periodic};
use crate::projection::Projecting;
use crate::solver::Solver;
use crate::wcsph::eos::Tait;

/// Everything about the fluid that does not change during a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    /// Equation of state: ρ₀, c₀, γ.
    pub eos: Tait,
    /// Smoothing kernel.
    pub kernel: Kernel,
    /// Smoothing length over particle spacing h/Δx [-].
    pub smoothing_ratio: f64,
    /// Gravity [m/s²].
    pub gravity: [f64; 2],
    /// Artificial viscosity α [-] (E7).
    pub alpha: f64,
    /// Kinematic viscosity ν [m²/s] (E8).
    pub nu: f64,
    /// Density diffusion δ [-] (E5).
    pub delta: f64,
    /// Shift particles towards an even spread (E13).
    pub shifting: bool,
    /// Shift κ h² ∇C in each step, whatever the speed, away from the surface: κ [-] (E13).
    pub settling: f64,
    /// Correct the volumes by the filling ΣVW (E12).
    pub volume_correction: bool,
    /// What the fluid does along a wall.
    pub slip: Slip,
    /// Walls feel the fluid stretch along them (E10).
    pub wall_stretch: bool,
    /// Air comes in between a wall and water under tension where both touch it (E3).
    pub ventilation: bool,
    /// Sum several targets side by side where the processor can (see [`crate::interactions::simd`]); one at a time otherwise, for
    /// comparison.
    pub wide: bool,
    /// Time integration.
    pub integrator: Integrator,
    /// Courant number of the acoustic step limit (E17).
    pub cfl: f64,
    /// Plane of symmetry, if the scene has one.
    pub mirror: Option<Mirror>,
    /// Steps between two Euler steps of Verlet's integrator; 0 is never (L1).
    pub verlet_correction_every: u64,
    /// How densities are smoothed (L4, L5).
    pub density_filter: DensityFilter,
    /// Steps between two filterings.
    pub density_filter_every: u64,
    /// Share ε of the neighbours' velocity that particles move with [-] (L6); 0 is none.
    pub xsph: f64,
    /// What stands for unresolved eddies (L7).
    pub turbulence: Turbulence,
    /// The gas, if the fluid is one (L9): then `eos` gives ρ₀, γ and the speed of sound at rest only.
    pub gas: Option<IdealGas>,
    /// Where densities come from (L11).
    pub density_evolution: DensityEvolution,
    /// Take the hydrostatic difference out of density diffusion (E5, Fourtakas et al. 2019); without: L12.
    pub hydrostatic_diffusion: bool,
    /// Shift free-surface particles too: the error that E13 avoids, for comparison.
    pub shift_surface: bool,
    /// Periodic plane pairs (V1), if the fluid repeats itself.
    pub periodic: Option<Periodic>,
    /// How walls keep the fluid out.
    pub walls: WallTreatment,
    /// What smooths pressures and velocities between fluid particles: E5 and E7, or R1 and R2.
    pub dissipation: Dissipation,
    /// What gives the pressure.
    pub solver: Solver,
    /// The projection, where pressures come from one.
    pub projecting: Projecting,
    /// Fastest speed that is known beforehand [m/s]: of the body, the spray root, or water that falls (I14).
    pub speed: f64,
    /// The thesis's projection, where pressures come from that.
    pub thesis: ThesisSettings,
}

impl Parameters {
    /// The scheme as it is by default, without gravity and planes of symmetry.
    pub fn usual(eos: Tait) -> Parameters {
        Parameters {
            eos,
            kernel: Kernel::WendlandC2,
            smoothing_ratio: 1.5,
            gravity: [0.0; 2],
            alpha: 0.02,
            nu: 0.0,
            delta: 0.3,
            shifting: true,
            settling: 0.1,
            volume_correction: false,
            slip: Slip::Free,
            wall_stretch: false,
            ventilation: false,
            wide: true,
            integrator: Integrator::Symplectic,
            cfl: 0.6,
            mirror: None,
            periodic: None,
            verlet_correction_every: 40,
            density_filter: DensityFilter::None,
            density_filter_every: 20,
            xsph: 0.0,
            turbulence: Turbulence::None,
            gas: None,
            density_evolution: DensityEvolution::Continuity,
            hydrostatic_diffusion: true,
            shift_surface: false,
            walls: WallTreatment::default(),
            dissipation: Dissipation::Diffusion,
            solver: Solver::default(),
            projecting: Projecting::default(),
            speed: 0.1 * eos.c0,
            thesis: ThesisSettings::default(),
        }
    }

    /// The numbers that every pair shares.
    pub(crate) fn constants(&self) -> Constants {
        let Parameters { eos, gravity, alpha, nu, delta, .. } = *self;
        Constants {
            gravity,
            rho0: eos.rho0,
            c0: eos.c0,
            delta,
            alpha,
            nu,
            stretch: f64::from(u8::from(self.wall_stretch)),
        }
    }

    /// Density [kg/m³] and specific internal energy [J/kg] at rest under a pressure [Pa]: water, or gas at T₀.
    pub(crate) fn state_at(&self, pressure: f64) -> (f64, f64) {
        match self.gas {
            None => (self.eos.density(pressure), 0.0),
            Some(gas) => (gas.density(pressure, gas.energy_at_rest()), gas.energy_at_rest()),
        }
    }

    /// Volumes are not m/ρ alone: corrected (E12), or a projection's own.
    pub(crate) fn keeps_volumes(&self) -> bool {
        self.volume_correction || self.solver.is_incompressible()
    }

    /// E5, or L12: the same without gravity, so that pressures themselves diffuse.
    pub(crate) fn diffusion_constants(&self) -> Constants {
        let constants = self.constants();
        if self.hydrostatic_diffusion { constants } else { Constants { gravity: [0.0; 2], ..constants } }
    }

    /// The law of repulsive walls (W1).
    pub(crate) fn repulsion(&self) -> Repulsion {
        let (eos, water_depth) = (self.eos, self.walls.water_depth);
        let heavy = self.gravity != [0.0; 2];
        Repulsion { rho0: eos.rho0, c0: eos.c0, ratio: self.smoothing_ratio, water_depth, heavy }
    }

    /// ν between fluid and wall [m²/s]: 0 where walls slip.
    pub fn wall_nu(&self) -> f64 {
        if self.slip == Slip::None { self.nu } else { 0.0 }
    }
}
