//! Stands in for `legacy.rs` where the program is built without the cargo feature `legacy`: its keys and solver are refused.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use settings::Problem;
use sph_core::{Fluid, FluidSettings, SchemeSettings, wcsph};

use super::draft::Draft;

/// The keys of 2010 in `[fluid]`.
const KEYS: [&str; 13] = [
    "integrator",
    "verlet_correction_every",
    "density_filter",
    "density_filter_every",
    "xsph",
    "turbulence",
    "equation_of_state",
    "temperature",
    "molar_mass",
    "density_evolution",
    "density_diffusion_form",
    "walls",
    "limit_pressure",
];

/// No options: time is integrated by the symplectic scheme.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Options {
    /// The symplectic one.
    #[serde(skip)]
    pub integrator: Integrator,
    /// Not used.
    #[serde(skip)]
    pub verlet_correction_every: u32,
}

/// Time integrations, for theories about them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Integrator {
    #[default]
    Symplectic,
    PredictorCorrector,
    Verlet,
    Beeman,
}

/// Refuses the solver and the keys that need the feature.
pub(super) fn refuse_absent(given: &Value) -> Result<(), Problem> {
    let fluid = given.get("fluid").and_then(Value::as_object).into_iter().flatten();
    let keys = fluid.filter(|(key, _)| KEYS.contains(&key.as_str()));
    let keys = keys.map(|(key, value)| (format!("fluid.{key}"), value, "no such key"));
    let thesis = given.get("solver").filter(|solver| *solver == "incompressible_thesis");
    let solver = thesis.map(|value| ("solver".to_string(), value, "another solver"));
    match solver.into_iter().chain(keys).next() {
        None => Ok(()),
        Some((key, value, instead)) => {
            let expected = format!("{instead}: this program was built without the cargo feature `legacy`");
            Err(Problem::new(&key, value, expected))
        }
    }
}

pub(super) fn breakdown_cfl(_: &Options) -> (f64, &'static str) {
    (1.2, "symplectic")
}

pub(crate) fn scheme(scheme: wcsph::Settings, _: &Options, _depth: f64) -> Box<dyn SchemeSettings> {
    Box::new(scheme)
}

pub(super) fn complete(
    draft: &mut Draft,
    _: &FluidSettings,
    scheme: wcsph::Settings,
    _: Options,
    _sound: Option<f64>,
) -> Result<(), Problem> {
    draft.fill("fluid.cfl", scheme.courant_number());
    draft.fill("fluid.acoustic_steps", scheme.acoustic_steps());
    Ok(())
}

/// True: there are no options that it would not go with.
pub(super) fn holds_geometry(_: &Options) -> bool {
    true
}

pub(super) fn fill(_: &mut Draft, _thesis: bool) -> bool {
    false
}

pub(super) fn wall_rows(_: &Options, ratio: f64) -> f64 {
    (2.0 * ratio).ceil()
}

pub(super) fn extrapolates(_: &Options) -> bool {
    true
}

pub(super) fn leaps(_: &Options) -> bool {
    false
}

pub(super) fn repulsive_walls(_: &Options) -> bool {
    false
}

pub(super) fn hollow_walls(_: &Options) -> Option<String> {
    None
}

pub(super) fn check_coupling(_: &Options, _iterated: bool) -> Result<(), Problem> {
    Ok(())
}

pub(super) fn obstacle_to_tracking(_: &Options) -> Option<&'static str> {
    None
}

pub(super) fn warnings(_: &wcsph::Settings, _: &Options, _cfl: f64) -> Vec<String> {
    Vec::new()
}

pub(super) fn thesis_warnings(_ratio: f64, _body: bool) -> Vec<String> {
    Vec::new()
}

pub(crate) fn thesis_work(_: &Fluid) -> Option<(u64, u64)> {
    None
}
