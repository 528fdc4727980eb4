//! The key `solver` and the tables that it selects: `[fluid]`, `[projection]`, `[thesis]`.

use fsi_coupling::settings::OrAuto;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sph_core::legacy::pilorget2010;
use sph_core::legacy::settings::Options;
use sph_core::{FluidSettings, Solver, projection, wcsph};

/// A solver and the settings that it reads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "solver", rename_all = "snake_case")]
#[schemars(extend(
    "x-solver-default" = "weakly_compressible",
    "x-solver-doc" = "What gives the pressure: weakly_compressible: an equation of state; incompressible: a projection; \
               incompressible_explicit: the projection with one explicit pressure per step, as weakly compressible as its step is \
               long (THEORY PR16); incompressible_thesis: Pilorget 2010"
))]
pub enum SolverSettings {
    /// Pressures from an equation of state.
    WeaklyCompressible {
        /// The water and the scheme.
        #[schemars(extend("x-default" = "every key's"))]
        fluid: WeaklyCompressibleFluid,
    },
    /// Pressures from a projection.
    Incompressible {
        /// The water and the scheme.
        #[schemars(extend("x-default" = "every key's"))]
        fluid: IncompressibleFluid,
        /// The projection.
        #[serde(default)]
        projection: projection::Settings,
    },
    /// Pressures explicitly from the projection's equation, once per step.
    IncompressibleExplicit {
        /// The water and the scheme.
        #[schemars(extend("x-default" = "every key's"))]
        fluid: IncompressibleFluid,
        /// The projection.
        #[serde(default)]
        projection: projection::Settings,
    },
    /// The projection of Pilorget (2010).
    IncompressibleThesis {
        /// The water and the scheme.
        #[schemars(extend("x-default" = "every key's"))]
        fluid: ThesisFluid,
        /// The projection.
        #[serde(default)]
        thesis: pilorget2010::ThesisSettings,
    },
}

/// Keys of `[fluid]` that every solver has.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Water {
    /// Properties of the water.
    #[serde(flatten)]
    pub fluid: FluidSettings,
    /// Share of the force that compressibility may cost; sets an "auto" speed of sound [-].
    #[serde(default = "usual_error")]
    #[schemars(range(min = 1e-6, max = 0.25))]
    pub compressibility_error: f64,
}

/// `[fluid]` of the weakly compressible solver.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WeaklyCompressibleFluid {
    /// The water.
    #[serde(flatten)]
    pub water: Water,
    /// The scheme.
    #[serde(flatten)]
    pub scheme: wcsph::Settings,
    /// Its options of 2010.
    #[serde(flatten)]
    pub options: Options,
}

/// `[fluid]` of the incompressible solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct IncompressibleFluid {
    /// The water.
    #[serde(flatten)]
    pub water: Water,
    /// Speed of sound from which the size of an "auto" tank follows [m/s].
    #[schemars(with = "OrAuto<f64>", extend("exclusiveMinimum" = 0, "x-default" = "auto"))]
    pub sound_speed: f64,
    /// The scheme.
    #[serde(flatten)]
    pub scheme: projection::FlowSettings,
}

/// `[fluid]` of the thesis's projection.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ThesisFluid {
    /// The water.
    #[serde(flatten)]
    pub water: Water,
    /// The scheme.
    #[serde(flatten)]
    pub scheme: pilorget2010::settings::FlowSettings,
}

fn usual_error() -> f64 {
    0.01
}

impl SolverSettings {
    /// The water.
    pub fn water(&self) -> &Water {
        match self {
            SolverSettings::WeaklyCompressible { fluid } => &fluid.water,
            SolverSettings::Incompressible { fluid, .. } | SolverSettings::IncompressibleExplicit { fluid, .. } => {
                &fluid.water
            }
            SolverSettings::IncompressibleThesis { fluid, .. } => &fluid.water,
        }
    }

    /// Speed of sound c₀ [m/s]; of a projection the one from which an automatic tank follows.
    pub fn sound_speed(&self) -> f64 {
        match self {
            SolverSettings::WeaklyCompressible { fluid } => fluid.scheme.sound_speed.value(),
            SolverSettings::Incompressible { fluid, .. } | SolverSettings::IncompressibleExplicit { fluid, .. } => {
                Some(fluid.sound_speed)
            }
            SolverSettings::IncompressibleThesis { fluid, .. } => fluid.scheme.sound_speed.value(),
        }
        .unwrap_or(f64::NAN)
    }

    /// Courant number of the step limit [-].
    pub fn courant_number(&self) -> f64 {
        match self {
            SolverSettings::WeaklyCompressible { fluid } => fluid.scheme.courant_number(),
            SolverSettings::Incompressible { fluid, .. } | SolverSettings::IncompressibleExplicit { fluid, .. } => {
                fluid.scheme.cfl
            }
            SolverSettings::IncompressibleThesis { fluid, .. } => fluid.scheme.cfl,
        }
    }

    /// Name of the solver.
    pub fn kind(&self) -> Solver {
        match self {
            SolverSettings::WeaklyCompressible { .. } => Solver::WeaklyCompressible,
            SolverSettings::Incompressible { .. } => Solver::Incompressible,
            SolverSettings::IncompressibleExplicit { .. } => Solver::IncompressibleExplicit,
            SolverSettings::IncompressibleThesis { .. } => Solver::IncompressibleThesis,
        }
    }

    /// Its name in a scene.
    pub fn name(&self) -> &'static str {
        self.kind().name()
    }

    /// True where a density has nothing to do with a pressure.
    pub fn is_incompressible(&self) -> bool {
        self.kind().is_incompressible()
    }

    /// The weakly compressible scheme; `None` with another solver.
    pub fn weakly_compressible(&self) -> Option<&WeaklyCompressibleFluid> {
        match self {
            SolverSettings::WeaklyCompressible { fluid } => Some(fluid),
            _ => None,
        }
    }
}
