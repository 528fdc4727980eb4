//! The key `solver` and the tables that it selects: `[fluid]`, `[projection]`, `[thesis]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sph_core::{Auto, FluidSettings, SchemeSettings, Solver, projection, wcsph};

use crate::legacy;
use crate::library::WaterName;

/// A solver and the settings that it reads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "solver", rename_all = "snake_case")]
#[schemars(extend(
    "x-solver-default" = "weakly_compressible",
    "x-solver-doc" = "What gives the pressure: weakly_compressible: an equation of state; incompressible: a projection; \
               incompressible_explicit: the projection with one explicit pressure per step, the longer the step, the \
               more compressible the water (THEORY PR16); incompressible_thesis: Pilorget 2010"
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
        thesis: legacy::ThesisSettings,
    },
}

/// Keys of `[fluid]` that every solver has.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Water {
    /// Water by name, for fluid.density where it is absent. Its viscosity stays fluid.kinematic_viscosity.
    #[serde(default, skip_serializing)]
    pub water: Option<WaterName>,
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
    pub options: legacy::Options,
}

/// `[fluid]` of the incompressible solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct IncompressibleFluid {
    /// The water.
    #[serde(flatten)]
    pub water: Water,
    /// Speed of sound from which the size of an "auto" tank follows [m/s].
    #[schemars(with = "Auto<f64>", extend("exclusiveMinimum" = 0, "x-default" = "auto"))]
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
    pub scheme: legacy::ThesisFlow,
}

fn usual_error() -> f64 {
    0.01
}

/// What all solvers have.
struct Common<'a> {
    kind: Solver,
    water: &'a Water,
    sound_speed: f64,
    courant_number: f64,
    surface_ratio: Option<f64>,
}

impl SolverSettings {
    fn common(&self) -> Common<'_> {
        let of = |kind, water, sound_speed: Auto<f64>, courant_number| Common {
            kind,
            water,
            sound_speed: sound_speed.or(f64::NAN),
            courant_number,
            surface_ratio: None,
        };
        match self {
            SolverSettings::WeaklyCompressible { fluid: WeaklyCompressibleFluid { water, scheme, .. } } => {
                of(Solver::WeaklyCompressible, water, scheme.sound_speed, scheme.courant_number())
            }
            SolverSettings::Incompressible { fluid, .. } => {
                of(Solver::Incompressible, &fluid.water, fluid.sound_speed.into(), fluid.scheme.cfl)
            }
            SolverSettings::IncompressibleExplicit { fluid, .. } => {
                of(Solver::IncompressibleExplicit, &fluid.water, fluid.sound_speed.into(), fluid.scheme.cfl)
            }
            SolverSettings::IncompressibleThesis { fluid, thesis } => Common {
                surface_ratio: Some(thesis.surface_ratio),
                ..of(Solver::IncompressibleThesis, &fluid.water, fluid.scheme.sound_speed, fluid.scheme.cfl)
            },
        }
    }

    /// The scheme's settings, for water of a depth [m].
    pub fn scheme(&self, depth: f64) -> Box<dyn SchemeSettings> {
        use projection::Method::{OneIteration, Solve};
        match self {
            SolverSettings::WeaklyCompressible { fluid } => legacy::scheme(fluid.scheme, &fluid.options, depth),
            SolverSettings::Incompressible { fluid, projection } => {
                Box::new(projection::Settings { flow: fluid.scheme, method: Solve, ..*projection })
            }
            SolverSettings::IncompressibleExplicit { fluid, projection } => {
                Box::new(projection::Settings { flow: fluid.scheme, method: OneIteration, ..*projection })
            }
            SolverSettings::IncompressibleThesis { fluid, thesis } => {
                Box::new(legacy::ThesisSettings { flow: fluid.scheme, ..*thesis })
            }
        }
    }

    /// The water.
    pub fn water(&self) -> &Water {
        self.common().water
    }

    /// Speed of sound c₀ [m/s]; of a projection the one from which an automatic tank follows.
    pub fn sound_speed(&self) -> f64 {
        self.common().sound_speed
    }

    /// Courant number of the step limit [-].
    pub fn courant_number(&self) -> f64 {
        self.common().courant_number
    }

    /// Divergence of r below which the thesis's projection finds a free surface, over that inside (LE23) [-].
    pub fn surface_ratio(&self) -> Option<f64> {
        self.common().surface_ratio
    }

    /// Name of the solver.
    pub fn kind(&self) -> Solver {
        self.common().kind
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
