//! Keys of the parts of a landing's aeroplane beside the bottom of its fuselage.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An item of `[[surfaces]]`: a wing, a flap or a tailplane whose lower side may meet the water, on both sides of the aeroplane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SurfaceKeys {
    /// A word that names it.
    pub name: String,
    /// Leading edge at the root: from the nose, from the plane of symmetry, over the body axis [m].
    pub root: [f64; 3],
    /// Leading edge at the tip, likewise [m].
    pub tip: [f64; 3],
    /// Chord at the root and at the tip [m].
    pub chords: [f64; 2],
    /// Angle of the chord over the body axis, nose up [deg].
    #[schemars(range(min = -20.0, max = 80.0))]
    pub incidence_deg: f64,
    /// Force of the water at which it is lost [N].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "it holds"))]
    pub breaks_at: Option<f64>,
}

/// An item of `[[nacelles]]`: engines or floats.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NacelleKeys {
    /// A word that names them.
    pub name: String,
    /// How many of them side by side.
    #[schemars(range(min = 1, max = 12))]
    pub number: u32,
    /// Centre of the face: from the nose, over the body axis [m].
    pub face: [f64; 2],
    /// Diameter [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub diameter: f64,
    /// Length [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: f64,
    /// Drag coefficient of the immersed part of the face [-].
    #[serde(default = "usual_drag")]
    #[schemars(range(min = 0.0, max = 2.0))]
    pub drag: f64,
    /// Force of the water on one at which it is lost [N].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "it holds"))]
    pub breaks_at: Option<f64>,
}

/// An item of `[[panels]]`: a part of the bottom that gives way; then it carries no load, and the frame at its rear end stands against the water.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PanelKeys {
    /// A word that names it.
    pub name: String,
    /// Front end, from the nose [m].
    pub from: f64,
    /// Rear end, from the nose [m].
    pub to: f64,
    /// Mean pressure over the breadth at which it gives way [Pa].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub gives_way_at: f64,
    /// Height of the frame at its rear end over the keel [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub frame_height: f64,
    /// Drag coefficient of the frame's immersed part [-].
    #[serde(default = "usual_drag")]
    #[schemars(range(min = 0.0, max = 2.0))]
    pub drag: f64,
    /// Area that water runs through after the stop when it has given way [m²].
    #[schemars(range(min = 0.0), extend("x-default" = "its length times the breadth"))]
    pub hole: Option<f64>,
}

/// A disc in a cavity (Reichardt 1946).
fn usual_drag() -> f64 {
    0.8
}

/// An item of `[[accelerometers]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AccelerometerKeys {
    /// A word that names it.
    pub name: String,
    /// Place: from the nose, over the body axis [m].
    pub at: [f64; 2],
    /// Frequency up to which it follows [Hz].
    #[serde(default = "usual_bandwidth")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bandwidth: f64,
}

fn usual_bandwidth() -> f64 {
    20.0
}

/// An item of `[[masses]]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MassKeys {
    /// Place from the nose [m].
    pub x: f64,
    /// Mass [kg].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: f64,
}

/// Table `[beam]`: the fuselage bends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BeamKeys {
    /// Bending stiffness E I at equal distances from nose to tail [N m²], a list; of one number: the same everywhere.
    pub stiffness: Vec<f64>,
    /// Damping of each mode over the critical one [-].
    #[serde(default = "usual_damping")]
    #[schemars(range(min = 0.0, max = 0.5))]
    pub damping: f64,
}

fn usual_damping() -> f64 {
    0.02
}
