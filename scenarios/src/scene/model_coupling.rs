//! Coupling of fluid and body, in a resolved scene.

use fsi_coupling::{Iteration, Scheme};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

/// The coupling scheme and its settings.
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
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CouplingScheme {
    /// One exchange a step.
    #[default]
    Weak,
    /// Accelerations and wall pressures together, without iterations (THEORY C2).
    AddedMass,
    /// Iterated, by quasi-Newton steps (THEORY C7).
    IqnIls,
}

impl CouplingScheme {
    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            CouplingScheme::Weak => "weak",
            CouplingScheme::AddedMass => "added_mass",
            CouplingScheme::IqnIls => "iqn_ils",
        }
    }
}

impl<'de> Deserialize<'de> for CouplingScheme {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<CouplingScheme, D::Error> {
        const ALL: [CouplingScheme; 3] = [CouplingScheme::Weak, CouplingScheme::AddedMass, CouplingScheme::IqnIls];
        let word = String::deserialize(from)?;
        if word == "aitken" {
            return Err(D::Error::custom("aitken was dropped: \"iqn_ils\" needs no more iterations"));
        }
        let unknown = || D::Error::unknown_variant(&word, &["weak", "added_mass", "iqn_ils"]);
        ALL.into_iter().find(|scheme| scheme.name() == word).ok_or_else(unknown)
    }
}

impl Coupling {
    /// As the coupled system takes it.
    pub fn scheme(&self) -> Scheme {
        let iteration = Iteration { tolerance: self.tolerance, max_iterations: self.max_iterations };
        match self.scheme {
            CouplingScheme::Weak => Scheme::Weak,
            CouplingScheme::AddedMass => Scheme::AddedMass,
            CouplingScheme::IqnIls => Scheme::IqnIls(iteration),
        }
    }
}
