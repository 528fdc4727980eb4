//! A landing as its file says it; what the file leaves out is filled in when it is read.

use fsi_coupling::entry_theory::EntryModel;
use serde::{Deserialize, Serialize};

/// A landing. Its keys are described in [`keywords`](super::keywords()).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// A word.
    pub name: String,
    /// What it is.
    #[serde(default)]
    pub description: String,
    /// Where its numbers come from.
    #[serde(default)]
    pub source: String,
    /// Theory of the sections.
    #[serde(default = "usual::model")]
    pub model: EntryModel,
    /// How it comes down, and how it is followed.
    pub landing: LandingKeys,
    /// What is rigid.
    pub aeroplane: AeroplaneKeys,
    /// The wing.
    pub wing: WingKeys,
    /// The water.
    #[serde(default)]
    pub water: WaterKeys,
    /// The fuselage, from the nose aft.
    pub stations: Vec<StationKeys>,
}

/// Table `[landing]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LandingKeys {
    /// Of the body axis [deg].
    pub angle_of_attack_deg: f64,
    /// Upwards [deg].
    pub flight_path_deg: f64,
    /// Along the flight path [m/s]; without it the wing carries the weight.
    pub speed: Option<f64>,
    /// End of time [s].
    pub end: f64,
    /// Forward speed that ends it [m/s]; without it √(g L).
    pub least_speed: Option<f64>,
    /// Step [s].
    #[serde(default = "usual::step")]
    pub step: f64,
    /// Between rows of the series [s].
    #[serde(default = "usual::sample_every")]
    pub sample_every: f64,
    /// Strips along the fuselage.
    #[serde(default = "usual::strips")]
    pub strips: usize,
}

/// Table `[aeroplane]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AeroplaneKeys {
    /// Mass [kg].
    pub mass: f64,
    /// In pitch, about the centre of mass [m].
    pub radius_of_gyration: f64,
    /// From the nose, over the body axis [m].
    pub center_of_mass: [f64; 2],
}

/// Table `[wing]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WingKeys {
    /// Area [m²].
    pub area: f64,
    /// Mean chord [m].
    pub chord: f64,
    /// dC_L/dα [1/rad].
    pub lift_slope: f64,
    /// Angle of attack without lift [deg].
    pub zero_lift_deg: f64,
    /// dC_m/dα [1/rad].
    #[serde(default = "usual::pitch_stiffness")]
    pub pitch_stiffness: f64,
    /// dC_m/d(q c/2U) [1/rad].
    #[serde(default = "usual::pitch_damping")]
    pub pitch_damping: f64,
    /// Density of the air [kg/m³].
    #[serde(default = "usual::air_density")]
    pub air_density: f64,
}

/// Table `[water]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WaterKeys {
    /// Density [kg/m³].
    pub density: f64,
    /// Acceleration of gravity [m/s²].
    pub gravity: f64,
    /// Friction coefficient [-].
    pub friction: f64,
    /// Share of the theory's suction [-].
    pub suction: f64,
}

impl Default for WaterKeys {
    fn default() -> WaterKeys {
        WaterKeys { density: 1000.0, gravity: 9.81, friction: 0.003, suction: 1.0 }
    }
}

/// An item of `[[stations]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StationKeys {
    /// From the nose [m].
    pub x: f64,
    /// Keel over the body axis [m].
    pub keel: f64,
    /// Between the edges that the water leaves [m].
    pub breadth: f64,
    /// Of an arc [m].
    pub radius: Option<f64>,
    /// Of a wedge [deg].
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
