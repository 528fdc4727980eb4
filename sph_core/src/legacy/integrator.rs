//! Which time integration a run uses.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Time integration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Kick–drift–kick with the density advanced about the midpoint: second order, one sum of each kind per step (WC11).
    #[default]
    Symplectic,
    /// Monaghan's (1989) predictor–corrector: second order, two sums of each kind per step (LE2).
    PredictorCorrector,
    /// Verlet's (1967) two-step leapfrog with an Euler step now and then: one sum of each kind per step (LE3).
    Verlet,
    /// Beeman's (1976) with the corrector of Adams and Moulton: third order, two sums of each kind per step (LE4).
    Beeman,
}

impl Integrator {
    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Integrator::Symplectic => "symplectic",
            Integrator::PredictorCorrector => "predictor_corrector",
            Integrator::Verlet => "verlet",
            Integrator::Beeman => "beeman",
        }
    }
}
