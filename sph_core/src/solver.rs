//! Which set of equations gives the pressure.

use serde::{Deserialize, Serialize};

/// What makes the pressure of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Solver {
    /// An equation of state: pressures run through the water as sound (E3–E17).
    #[default]
    WeaklyCompressible,
    /// A Poisson equation: pressures are those that leave the water's volume as it is (THEORY I1–I16).
    Incompressible,
    /// The same with the diagonal in the place of the matrix: one sweep a step (THEORY EX3).
    IncompressibleExplicit,
    /// Pilorget's (2010) projection, with the choices of its thesis (THEORY J1–J16).
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

    /// True where a step is the projection's (THEORY I1), its pressure solved for or swept once.
    pub fn projects(self) -> bool {
        matches!(self, Solver::Incompressible | Solver::IncompressibleExplicit)
    }

    /// True where a density has nothing to do with a pressure.
    pub fn is_incompressible(self) -> bool {
        self != Solver::WeaklyCompressible
    }
}
