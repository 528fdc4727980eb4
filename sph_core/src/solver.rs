//! Names of the schemes that give the pressure.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which equations give the pressure: a scene's key `solver`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Solver {
    /// An equation of state: pressures run through the water as sound (THEORY WC2–WC12, WA3–WA5).
    #[default]
    WeaklyCompressible,
    /// A Poisson equation: pressures are those that leave the water's volume as it is (THEORY PR2–PR14).
    Incompressible,
    /// The same with the diagonal instead of the matrix: one iteration per step (THEORY PR15).
    IncompressibleExplicit,
    /// Pilorget's (2010) projection, with the choices of its thesis (THEORY LE18–LE28).
    IncompressibleThesis,
}

impl Solver {
    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Solver::WeaklyCompressible => "weakly_compressible",
            Solver::Incompressible => "incompressible",
            Solver::IncompressibleExplicit => "incompressible_explicit",
            Solver::IncompressibleThesis => "incompressible_thesis",
        }
    }

    /// True where densities do not determine pressures.
    pub fn is_incompressible(self) -> bool {
        self != Solver::WeaklyCompressible
    }
}
