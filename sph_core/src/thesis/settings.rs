//! What a scene chooses of the thesis's projection; each default is the choice that worked there.

use serde::{Deserialize, Serialize};

/// How masses are found (J1, J3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MassRule {
    /// One mass, that of a particle with a whole support; what the others lack is stored (J1, J2).
    #[default]
    Interior,
    /// All masses from W m = ρ₀ (J3): the thesis's first attempt, which gives negative ones.
    Inverse,
}

/// What stands in the rows of limit particles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LimitRows {
    /// The Poisson equation, as for fluid (J6).
    #[default]
    Poisson,
    /// No gradient along the wall's normal (J13): the thesis's first attempt, which diverges.
    ZeroGradient,
}

/// What acts in the predictor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Predictor {
    /// Gravity and viscosity (J4).
    #[default]
    Gravity,
    /// The last step's pressure too, and the Poisson equation gives its change (J14): always diverged.
    OldPressure,
}

/// The thesis's projection as a scene asks for it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ThesisSettings {
    /// Where masses come from.
    pub masses: MassRule,
    /// What stands in the rows of limit particles.
    pub limit_rows: LimitRows,
    /// What acts in the predictor.
    pub predictor: Predictor,
    /// Side walls take the predictor's motion (J10).
    pub side_freedom: bool,
    /// The gradient is corrected (J9).
    pub gradient_correction: bool,
    /// Particles at the surface have ∇·r below this share of that inside (J7) [-].
    pub surface_ratio: f64,
    /// The inner loop ends where no density is farther from ρ₀ than this (J11) [-].
    pub density_tolerance: f64,
    /// Most passes of the inner loop.
    pub inner_passes: usize,
    /// Every row's residual ends below this share of the largest right-hand side (J12) [-].
    pub residual: f64,
    /// Iterations after which a solution has failed.
    pub most_iterations: usize,
}

impl Default for ThesisSettings {
    fn default() -> ThesisSettings {
        ThesisSettings {
            masses: MassRule::Interior,
            limit_rows: LimitRows::Poisson,
            predictor: Predictor::Gravity,
            side_freedom: true,
            gradient_correction: true,
            surface_ratio: 0.75,
            density_tolerance: 1e-5,
            inner_passes: 10,
            residual: 1e-6,
            most_iterations: 2000,
        }
    }
}
