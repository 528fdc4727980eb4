//! What gives the pressure in an element's water: the key `solver` and the keys that it selects.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sph_core::{SchemeSettings, projection, wcsph};

/// A solver with its settings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "solver", rename_all = "snake_case")]
#[schemars(extend(
    "x-solver-default" = "weakly_compressible",
    "x-solver-doc" = "What gives the pressure: weakly_compressible: an equation of state; incompressible: a projection; \
               incompressible_explicit: the projection with one explicit pressure per step (THEORY PR16)"
))]
pub enum ElementScheme {
    /// Pressures from an equation of state.
    WeaklyCompressible {
        /// The scheme.
        #[serde(flatten)]
        scheme: wcsph::Settings,
        /// Time integration of the water: symplectic or predictor_corrector (THEORY WC11, LE2).
        #[serde(default)]
        integrator: Integrator,
    },
    /// Pressures from a projection.
    Incompressible {
        /// The flow.
        #[serde(flatten)]
        flow: projection::FlowSettings,
        /// The projection.
        #[serde(default)]
        projection: projection::Settings,
    },
    /// Pressures explicitly from the projection's equation, once per step.
    IncompressibleExplicit {
        /// The flow.
        #[serde(flatten)]
        flow: projection::FlowSettings,
        /// The projection.
        #[serde(default)]
        projection: projection::Settings,
    },
}

/// Time integration of an element's water.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Kick–drift–kick (WC11).
    #[default]
    Symplectic,
    /// Monaghan's (1989), with the cargo feature `legacy` (LE2).
    PredictorCorrector,
}

impl Default for ElementScheme {
    fn default() -> ElementScheme {
        ElementScheme::WeaklyCompressible { scheme: wcsph::Settings::default(), integrator: Integrator::default() }
    }
}

impl ElementScheme {
    /// A projection with its usual settings.
    pub fn incompressible() -> ElementScheme {
        ElementScheme::Incompressible {
            flow: projection::FlowSettings::default(),
            projection: projection::Settings::default(),
        }
    }

    /// The settings of the weakly compressible scheme; `None` of a projection.
    pub fn weakly_compressible(&self) -> Option<&wcsph::Settings> {
        match self {
            ElementScheme::WeaklyCompressible { scheme, .. } => Some(scheme),
            _ => None,
        }
    }

    /// The settings of a projection; `None` of the weakly compressible scheme.
    pub fn projection(&self) -> Option<projection::Settings> {
        use projection::Method::{OneIteration, Solve};
        match *self {
            ElementScheme::WeaklyCompressible { .. } => None,
            ElementScheme::Incompressible { flow, projection } => {
                Some(projection::Settings { flow, method: Solve, ..projection })
            }
            ElementScheme::IncompressibleExplicit { flow, projection } => {
                Some(projection::Settings { flow, method: OneIteration, ..projection })
            }
        }
    }

    /// Courant number of a step of the water [-].
    pub fn courant_number(&self) -> f64 {
        match (self.weakly_compressible(), self.projection()) {
            (Some(scheme), _) => self.by_equation_of_state(*scheme, 1.0).courant_number(),
            (None, Some(projection)) => projection.courant_number(),
            (None, None) => f64::NAN,
        }
    }

    /// As the solver takes them, with a speed of sound [m/s] and for water of a depth [m].
    pub(super) fn settings(&self, speed_of_sound: f64, depth: f64) -> Box<dyn SchemeSettings> {
        match (self.weakly_compressible(), self.projection()) {
            (Some(scheme), _) => {
                let scheme = wcsph::Settings { sound_speed: speed_of_sound.into(), ..*scheme };
                Box::new(self.by_equation_of_state(scheme, depth))
            }
            (None, projection) => Box::new(projection.unwrap_or_default()),
        }
    }

    #[cfg(feature = "legacy")]
    fn by_equation_of_state(&self, scheme: wcsph::Settings, depth: f64) -> sph_core::legacy::Settings {
        use sph_core::legacy::{Options, Settings};
        let integrator = match self {
            ElementScheme::WeaklyCompressible { integrator: Integrator::PredictorCorrector, .. } => {
                sph_core::Integrator::PredictorCorrector
            }
            _ => sph_core::Integrator::Symplectic,
        };
        Settings { scheme, options: Options { integrator, water_depth: depth, ..Options::default() } }
    }

    #[cfg(not(feature = "legacy"))]
    fn by_equation_of_state(&self, scheme: wcsph::Settings, _depth: f64) -> wcsph::Settings {
        scheme
    }
}
