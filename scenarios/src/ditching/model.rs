//! A landing: its settings, as its file gives them.

use std::sync::LazyLock;

use fsi_coupling::entry_theory::EntryModel;
use fsi_coupling::settings::Schema;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The schema of a landing's file.
pub fn schema() -> &'static Schema {
    static SCHEMA: LazyLock<Schema> = LazyLock::new(|| Schema::of::<Scene>("a landing"));
    &SCHEMA
}

/// A landing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Scene {
    /// A word that names the landing and its folder.
    pub name: String,
    /// What it is, in a line.
    #[serde(default)]
    pub description: String,
    /// Source of its numbers.
    #[serde(default)]
    pub source: String,
    /// Model of the sections: von_karman, wagner or mlm.
    #[serde(default = "usual::model")]
    pub model: EntryModel,
    /// Flight and its integration.
    pub landing: LandingKeys,
    /// The rigid aeroplane.
    pub aeroplane: AeroplaneKeys,
    /// The wing.
    pub wing: WingKeys,
    /// The water.
    #[serde(default)]
    pub water: WaterKeys,
    /// Sections of the fuselage, from the nose aft; two at least.
    pub stations: Vec<StationKeys>,
}

/// Table `[landing]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LandingKeys {
    /// Angle of the body axis over the flight path at the first touch [deg].
    pub angle_of_attack_deg: f64,
    /// Direction of flight at the first touch, upwards [deg].
    #[schemars(range(min = -15.0, max = -1e-3))]
    pub flight_path_deg: f64,
    /// Speed along the flight path at the first touch [m/s].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "where the wing carries the weight"))]
    pub speed: Option<f64>,
    /// End of time after the first touch [s].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub end: f64,
    /// Forward speed below which the landing ends [m/s].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "sqrt(g L), L the fuselage's length"))]
    pub least_speed: Option<f64>,
    /// Step of the integration [s].
    #[serde(default = "usual::step")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub step: f64,
    /// Interval between rows of the series, in whole steps [s].
    #[serde(default = "usual::sample_every")]
    pub sample_every: f64,
    /// Strips along the fuselage; stations are at their ends [-].
    #[serde(default = "usual::strips")]
    #[schemars(range(min = 20, max = 5000))]
    pub strips: usize,
}

/// Table `[aeroplane]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AeroplaneKeys {
    /// Mass [kg].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: f64,
    /// Radius of gyration in pitch, about the centre of mass [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius_of_gyration: f64,
    /// Centre of mass, from the nose and over the body axis [m].
    pub center_of_mass: [f64; 2],
}

/// Table `[wing]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WingKeys {
    /// Area of the wing [m²].
    #[schemars(range(min = 0.0))]
    pub area: f64,
    /// Mean chord of the wing [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub chord: f64,
    /// Slope of the lift coefficient against the angle of attack [1/rad].
    #[schemars(range(min = 0.0))]
    pub lift_slope: f64,
    /// Angle of attack of the body axis at which there is no lift [deg].
    pub zero_lift_deg: f64,
    /// Slope of the aeroplane's moment coefficient against the angle of attack [1/rad].
    #[serde(default = "usual::pitch_stiffness")]
    pub pitch_stiffness: f64,
    /// Its slope against q c/(2U), the rate of pitch [1/rad].
    #[serde(default = "usual::pitch_damping")]
    pub pitch_damping: f64,
    /// Density of the air [kg/m³].
    #[serde(default = "usual::air_density")]
    #[schemars(range(min = 0.0))]
    pub air_density: f64,
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
    /// Share of the theory's suction where the keel curves up [-].
    #[schemars(range(min = 0.0, max = 1.0))]
    pub suction: f64,
}

impl Default for WaterKeys {
    fn default() -> WaterKeys {
        WaterKeys { density: 1000.0, gravity: 9.81, friction: 0.003, suction: 1.0 }
    }
}

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
}

mod usual {
    use fsi_coupling::entry_theory::EntryModel;

    pub fn model() -> EntryModel {
        EntryModel::Mlm
    }
    pub fn step() -> f64 {
        0.001
    }
    pub fn sample_every() -> f64 {
        0.005
    }
    pub fn strips() -> usize {
        200
    }
    pub fn pitch_stiffness() -> f64 {
        -1.0
    }
    pub fn pitch_damping() -> f64 {
        -25.0
    }
    pub fn air_density() -> f64 {
        1.225
    }
}

impl Scene {
    /// The landing as a file.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a landing holds nothing that TOML cannot say")
    }
}
