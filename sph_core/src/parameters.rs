//! What does not change about a fluid during a run.

use serde::{Deserialize, Serialize};

use crate::eos::Tait;
use crate::images::Mirror;
use crate::integrator::Integrator;
use crate::kernel::Kernel;
use crate::pair::Constants;
use crate::repulsive::Repulsion;
use crate::wall_model::WallTreatment;

/// What the fluid does along a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Slip {
    /// No viscous traction.
    #[default]
    Free,
    /// The fluid sticks: the wall shows it the velocity 2V_w − ũ (E11, Adami et al. 2012).
    None,
}

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
    /// Correct the volumes by the filling ΣVW (E12).
    pub volume_correction: bool,
    /// What the fluid does along a wall.
    pub slip: Slip,
    /// Time integration.
    pub integrator: Integrator,
    /// Courant number of the acoustic step limit (E17).
    pub cfl: f64,
    /// Plane of symmetry, if the scene has one.
    pub mirror: Option<Mirror>,
    /// How walls keep the fluid out.
    pub walls: WallTreatment,
}

impl Parameters {
    /// The numbers that every pair shares.
    pub(crate) fn constants(&self) -> Constants {
        let Parameters { eos, gravity, alpha, nu, delta, .. } = *self;
        Constants { gravity, rho0: eos.rho0, c0: eos.c0, delta, alpha, nu }
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
