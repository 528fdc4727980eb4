//! What a scene chooses of the thesis's projection; each default is the choice that worked there.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::auto::Auto;
use crate::interactions::dissipation::Dissipation;

/// How masses are found (LE18, LE28).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MassRule {
    /// One mass, that of a particle with a whole support; the deficits of the others are stored (LE18, LE19).
    #[default]
    Interior,
    /// All masses from W m = ρ₀ (LE28): the thesis's first attempt, which gives negative ones.
    Inverse,
}

/// What stands in the rows of limit particles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LimitRows {
    /// The Poisson equation, as for fluid (LE22).
    #[default]
    Poisson,
    /// No gradient along the wall's normal (LE28): the thesis's first attempt, which diverges.
    ZeroGradient,
}

/// What acts in the predictor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Predictor {
    /// Gravity and viscosity (LE20).
    #[default]
    Gravity,
    /// The last step's pressure too, and the Poisson equation gives its change (LE28): always diverged.
    OldPressure,
}

/// Settings of the thesis's projection (INDAT i_algorithm 4): a scene's table `[thesis]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ThesisSettings {
    /// Where masses come from (no INDAT switch).
    pub masses: MassRule,
    /// Rows of limit particles (no INDAT switch).
    pub limit_rows: LimitRows,
    /// What acts before the pressure equation (no INDAT switch).
    pub predictor: Predictor,
    /// Upright walls at rest take the predictor's motion (LE21). false gives density errors beside them.
    pub side_freedom: bool,
    /// The pressure's gradient is scaled so that water at rest does not depend on h (LE26).
    pub gradient_correction: bool,
    /// Particles at the free surface have a divergence of r below this share of that inside (LE23), 0 to 1 [-].
    #[schemars(range(min = 0.0, max = 1.0))]
    pub surface_ratio: f64,
    /// The inner corrector loop ends where no density differs from the reference by more than this share (LE27) [-].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density_tolerance: f64,
    /// Most passes of the inner corrector loop, 1 or more [-].
    #[schemars(range(min = 1))]
    pub inner_passes: usize,
    /// Share of the largest right-hand side that the residual of no row of the pressure equation exceeds (LE27), 1e-12 to 0.1 [-].
    #[schemars(range(min = 1e-12, max = 0.1))]
    pub residual: f64,
    /// Iterations of Bi-CGSTAB after which a pressure equation ends the run with an error, 1 or more [-].
    #[schemars(range(min = 1))]
    pub most_iterations: usize,
    /// Keys of the table `[fluid]`.
    #[serde(skip)]
    pub flow: FlowSettings,
}

/// The keys of a scene's table `[fluid]` that belong to `solver = "incompressible_thesis"`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FlowSettings {
    /// Speed of sound c0 in the artificial viscosity [m/s]. auto: 10 times the largest known speed of the flow.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub sound_speed: Auto<f64>,
    /// What smooths velocities between particles of water.
    pub dissipation: Dissipation,
    /// Coefficient alpha of artificial viscosity (INDAT i_viscos 1: viscos_val); 0 is none [-]. Absent or 0 with
    /// dissipation = riemann.
    #[schemars(range(min = 0.0), extend("x-neutral" = 0))]
    pub artificial_viscosity: f64,
    /// Courant number of the step limit dt <= cfl dx/(2 |v|) (INDAT CFL_number) [-].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub cfl: f64,
}

impl Default for FlowSettings {
    fn default() -> FlowSettings {
        FlowSettings {
            sound_speed: Auto::Auto,
            dissipation: Dissipation::Diffusion,
            artificial_viscosity: 0.1,
            cfl: 0.6,
        }
    }
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
            flow: FlowSettings::default(),
        }
    }
}
