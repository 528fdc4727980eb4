//! Settings of the projection.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::motion::FREE_FALL;
use crate::Domain;

/// How a step's pressures follow from the pressure equation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Solved for, by conjugate gradients (THEORY PR8–PR11): `solver = "incompressible"`.
    #[default]
    Solve,
    /// One Jacobi iteration per step (THEORY PR15): `solver = "incompressible_explicit"`.
    OneIteration,
}

/// The keys of a scene's table `[fluid]` that belong to the incompressible solvers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FlowSettings {
    /// Particle shifting.
    pub shifting: bool,
    /// Air comes in where water under tension reaches the free surface, so that flow leaves a round bottom (THEORY PR8).
    pub ventilation: bool,
    /// Share of its smoothing length that a particle may move in a step, above 0 and up to 1 [-].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub cfl: f64,
}

impl Default for FlowSettings {
    fn default() -> FlowSettings {
        FlowSettings { shifting: true, ventilation: false, cfl: 0.4 }
    }
}

/// Settings of the projection: a scene's table `[projection]`.
///
/// ```
/// use sph_core::{Domain, Fluid, Seed, Walls, projection};
/// let drop = Seed { at: [0.0, 1.0], velocity: [0.0; 2], area: 0.01, pressure: 0.0 };
/// let domain = Domain { gravity: [0.0, -9.81], ..Domain::default() };
/// let mut fluid = Fluid::new(domain, &projection::Settings::default(), &[drop]);
/// let mut walls = Walls::default();
/// fluid.initialise(&mut walls)?;
/// fluid.step(&mut walls, 0.01)?;
/// assert!((fluid.particles().v[0] + 0.0981).abs() < 1e-9);
/// # Ok::<(), sph_core::Breakdown>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Share of the largest right-hand side that no residual of the pressure equation exceeds, 1e-12 to 0.1 (no INDAT
    /// switch) [-].
    #[schemars(range(min = 1e-12, max = 0.1))]
    pub tolerance: f64,
    /// Iterations after which a pressure equation has failed, 1 or more [-].
    #[schemars(range(min = 1))]
    pub most_iterations: usize,
    /// Time in which an error of density relaxes, over h/U with the fastest known speed U (THEORY PR9) [-].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub relaxation: f64,
    /// Viscosity over h sqrt(|g| h), which brings water to rest (THEORY PR13); 0 is none [-].
    #[serde(rename = "calming")]
    #[schemars(range(min = 0.0), extend("x-default" = "0.15; 0.02 with tank.wave_maker or a rigid body that starts under water"))]
    pub viscosity_coefficient: f64,
    /// Shift of particles over the distance moved in a step, times 2h grad C, 0 to 10 (THEORY PR14) [-]. Without effect where
    /// fluid.shifting is false.
    #[schemars(range(min = 0.0, max = 10.0), extend("x-default" = "1; 3 with a rigid body that starts under water"))]
    pub shift: f64,
    /// Keys of the table `[fluid]`.
    #[serde(skip)]
    pub flow: FlowSettings,
    /// How pressures are found: by the scene's key `solver`.
    #[serde(skip)]
    pub method: Method,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            tolerance: 3e-4,
            most_iterations: 2000,
            relaxation: 3.0,
            viscosity_coefficient: 0.15,
            shift: 1.0,
            flow: FlowSettings::default(),
            method: Method::Solve,
        }
    }
}

/// Largest Courant number of one iteration per step (PR16) [-].
const LARGEST_COURANT_OF_ONE_ITERATION: f64 = 0.2;

impl Settings {
    /// PR14: the step of water at rest [s]; `h` is the least smoothing length [m].
    pub fn step_at_rest(&self, h: f64, domain: &Domain) -> f64 {
        let g = domain.gravity[0].hypot(domain.gravity[1]);
        (self.courant_number() * h / domain.fastest_speed).min(FREE_FALL * (h / g).sqrt())
    }

    /// PR14, PR16: Courant number of a step [-].
    pub fn courant_number(&self) -> f64 {
        match self.method {
            Method::Solve => self.flow.cfl,
            Method::OneIteration => self.flow.cfl.min(LARGEST_COURANT_OF_ONE_ITERATION),
        }
    }
}
