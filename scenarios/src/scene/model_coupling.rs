//! How fluid and body agree on a step, in a resolved scene.

use fsi_coupling::{Iteration, Scheme};
use serde::{Deserialize, Serialize};

/// How fluid and body agree on a step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Coupling {
    /// The scheme.
    pub scheme: CouplingScheme,
    /// Residual at which an iterated scheme stops (THEORY C5) [-].
    pub tolerance: f64,
    /// Iterations of a step after which one that still disagrees is an error.
    pub max_iterations: u32,
}

/// The `coupling.scheme` key.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CouplingScheme {
    /// One exchange a step.
    #[default]
    Weak,
    /// Accelerations and wall pressures together, without iterations (THEORY C2).
    AddedMass,
    /// Iterated, by Aitken's relaxation (THEORY C6).
    Aitken,
    /// Iterated, by quasi-Newton steps (THEORY C7).
    IqnIls,
}

impl CouplingScheme {
    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            CouplingScheme::Weak => "weak",
            CouplingScheme::AddedMass => "added_mass",
            CouplingScheme::Aitken => "aitken",
            CouplingScheme::IqnIls => "iqn_ils",
        }
    }
}

impl Coupling {
    /// As the coupled system takes it.
    pub fn scheme(&self) -> Scheme {
        let iteration = Iteration { tolerance: self.tolerance, max_iterations: self.max_iterations };
        match self.scheme {
            CouplingScheme::Weak => Scheme::Weak,
            CouplingScheme::AddedMass => Scheme::AddedMass,
            CouplingScheme::Aitken => Scheme::Aitken(iteration),
            CouplingScheme::IqnIls => Scheme::IqnIls(iteration),
        }
    }
}
