//! A hull in a towing tank: its settings, as its file gives them.

use std::sync::LazyLock;

use scene::source::word;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use settings::{Problem, Schema};
use water_entry::planing::{Immersion, NotPlaning, Planing, PlaningHull};

/// The schema of a planing hull's file.
pub fn schema() -> &'static Schema {
    static SCHEMA: LazyLock<Schema> = LazyLock::new(|| Schema::of::<Scene>("a planing hull"));
    &SCHEMA
}

/// A prismatic hull that planes steadily on calm water.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Scene {
    /// A word that names the hull and its folder.
    pub name: String,
    /// What it is, in a line.
    #[serde(default)]
    pub description: String,
    /// Source of its numbers.
    #[serde(default)]
    pub source: String,
    /// Angle of the keel over the water, bow up [deg].
    #[schemars(range(min = 0.5, max = 30.0))]
    pub trim_deg: f64,
    /// Speed [m/s].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub speed: f64,
    /// Mean wetted length over the breadth: half the sum of wetted keel and chine with wet chines, else wetted area over the square of the breadth [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.05, max = 20.0), extend("x-default" = "required unless draught"))]
    pub wetted_length: Option<f64>,
    /// Draught of the keel at the step, below still water [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required unless wetted_length"))]
    pub draught: Option<f64>,
    /// The hull.
    pub hull: HullKeys,
    /// The water.
    #[serde(default)]
    pub water: WaterKeys,
}

/// Table `[hull]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HullKeys {
    /// Breadth between the chines [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub breadth: f64,
    /// Angle between bottom and still water [deg].
    #[schemars(range(min = 4.0, max = 60.0))]
    pub deadrise_deg: f64,
}

/// Table `[water]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct WaterKeys {
    /// Density of the water [kg/m³].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: f64,
    /// Acceleration of gravity [m/s²].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub gravity: f64,
    /// Friction coefficient of the wetted bottom [-].
    #[schemars(range(min = 0.0, max = 0.1))]
    pub friction: f64,
}

impl Default for WaterKeys {
    fn default() -> WaterKeys {
        WaterKeys { density: 1000.0, gravity: 9.81, friction: 0.003 }
    }
}

impl Scene {
    /// The scene, if its hull can plane so.
    pub(super) fn checked(self) -> Result<Scene, Problem> {
        word("name", &self.name)?;
        self.hull_and_load().map(|_| self)
    }

    /// The hull and its load.
    pub(super) fn hull_and_load(&self) -> Result<(PlaningHull, Planing), Problem> {
        let immersion = match (self.wetted_length, self.draught) {
            (Some(length), None) => Immersion::WettedLength(length),
            (None, Some(draught)) => Immersion::Draught(draught),
            (Some(_), Some(given)) => {
                return Err(Problem::new("draught", given, "wetted_length or draught, not both"));
            }
            (None, None) => return Err(Problem::missing("wetted_length", "wetted_length or draught")),
        };
        let hull = PlaningHull {
            breadth: self.hull.breadth,
            deadrise_deg: self.hull.deadrise_deg,
            trim_deg: self.trim_deg,
            speed: self.speed,
            density: self.water.density,
            gravity: self.water.gravity,
        };
        let refused = |NotPlaning { what, value, expected }: NotPlaning| {
            let key = match what {
                "breadth" | "deadrise_deg" => format!("hull.{what}"),
                "density" | "gravity" => format!("water.{what}"),
                "convergence" => "speed".to_string(),
                key => key.to_string(),
            };
            Problem::new(&key, if what == "convergence" { self.speed } else { value }, expected)
        };
        hull.planes(immersion).map(|load| (hull, load)).map_err(refused)
    }

    /// The hull as a file.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a planing hull holds nothing that TOML cannot say")
    }
}
