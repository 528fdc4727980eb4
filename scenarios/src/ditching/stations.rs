//! Stations of a landing: their keys, and the shape of a section in a scene. A kind of section is a variant of [`Form`] and its lines here.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use settings::Problem;
use water_entry::ditching::{Form, Station};

/// An item of `[[stations]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StationKeys {
    /// Distance from the nose along the body axis [m].
    pub x: f64,
    /// Height of the keel over the body axis [m].
    pub keel: f64,
    /// Breadth between the edges at which the water separates [m].
    pub breadth: f64,
    /// Radius of a section that is an arc [m].
    #[schemars(extend("x-default" = "required unless deadrise_deg"))]
    pub radius: Option<f64>,
    /// Deadrise of a section that is a wedge [deg].
    #[schemars(extend("x-default" = "required unless radius"))]
    pub deadrise_deg: Option<f64>,
    /// Height over breadth of a wedge [-].
    #[schemars(extend("x-default" = "from deadrise_deg"))]
    pub slenderness: Option<f64>,
}

/// A station of its keys.
pub(super) fn station(index: usize, keys: &StationKeys) -> Result<Station, Problem> {
    let key = |name: &str| format!("stations[{index}].{name}");
    let form = match (keys.radius, keys.deadrise_deg) {
        (None, None) if keys.slenderness.is_some() => Form::Slenderness(keys.slenderness.unwrap_or_default()),
        (Some(radius), None) => Form::Radius(radius),
        (None, Some(deadrise)) => Form::DeadriseDeg(deadrise),
        (Some(_), Some(given)) => {
            return Err(Problem::new(&key("deadrise_deg"), given, "a radius or a deadrise, not both"));
        }
        (None, None) => return Err(Problem::missing(&key("radius"), "a radius or deadrise_deg")),
    };
    Ok(Station { x: keys.x, keel: keys.keel, breadth: keys.breadth, form })
}

/// The keys of a scene's body with a section of this form.
pub(super) fn shape_keys(form: Form) -> String {
    match form {
        Form::Radius(radius) => format!("shape = \"arc\"\nradius = {radius:?}"),
        Form::Slenderness(ratio) => {
            format!("shape = \"wedge\"\ndeadrise_deg = {:?}", (2.0 * ratio).atan().to_degrees())
        }
        Form::DeadriseDeg(deadrise) => format!("shape = \"wedge\"\ndeadrise_deg = {deadrise:?}"),
    }
}
