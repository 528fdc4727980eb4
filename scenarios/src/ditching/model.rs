//! A landing: its settings, as its file gives them.

use std::sync::LazyLock;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use settings::Schema;
use water_entry::EntryModel;
use water_entry::ditching::{Water, Wing};

use super::afloat_keys::{FlotationKeys, OpeningKeys, StrutKeys};
use super::certify_keys::CertifyKeys;
use super::parts::{AccelerometerKeys, BeamKeys, MassKeys, NacelleKeys, PanelKeys, SurfaceKeys};
use super::plating_keys::PlatingKeys;
use super::sea_keys::SeaKeys;
use super::stations::StationKeys;
use super::windows::WindowKeys;

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
    /// What no source gives and the file assumes, a sentence each; printed beside the results.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumptions: Vec<String>,
    /// Model of the sections.
    #[serde(default = "usual::model")]
    #[schemars(with = "SectionModel")]
    pub model: EntryModel,
    /// Flight and its integration.
    pub landing: LandingKeys,
    /// The rigid aeroplane.
    pub aeroplane: AeroplaneKeys,
    /// The wing.
    pub wing: Wing,
    /// The water.
    #[serde(default)]
    pub water: Water,
    /// Waves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sea: Option<SeaKeys>,
    /// Sections of the fuselage, from the nose aft; two at least.
    pub stations: Vec<StationKeys>,
    /// Wing, flaps and tailplane, where they may meet the water.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub surfaces: Vec<SurfaceKeys>,
    /// Engines or floats.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub nacelles: Vec<NacelleKeys>,
    /// Parts of the bottom that give way.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub panels: Vec<PanelKeys>,
    /// Struts with wheels or floats that go into the water.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub struts: Vec<StrutKeys>,
    /// Parts of the bottom whose mean pressure is wanted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub windows: Vec<WindowKeys>,
    /// Parts of the bottom whose stresses are wanted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub plating: Vec<PlatingKeys>,
    /// How the aeroplane floats after it has stopped.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flotation: Option<FlotationKeys>,
    /// Exits and other holes of the fuselage.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub openings: Vec<OpeningKeys>,
    /// Where accelerations are taken.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub accelerometers: Vec<AccelerometerKeys>,
    /// Known masses along the fuselage; the rest of the aeroplane's mass is spread so that its centre and radius of gyration hold.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub masses: Vec<MassKeys>,
    /// The fuselage bends.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beam: Option<BeamKeys>,
    /// Landings that a rule asks for; `splashdown ditch` leaves them out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub certify: Option<CertifyKeys>,
}

/// Models whose load of a section is a formula of its depth and speed.
#[derive(JsonSchema)]
#[serde(rename_all = "snake_case")]
#[expect(dead_code, reason = "names the values in the schema")]
enum SectionModel {
    /// Added mass of a plate as wide as the body's cut with the still water (von Karman 1929).
    VonKarman,
    /// The same with the water's pile-up (Wagner 1932).
    Wagner,
    /// Modified Logvinovich model: Wagner's flow, the pressure's square terms, the body's shape (Korobkin 2004).
    Mlm,
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

mod usual {
    use water_entry::EntryModel;

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
}

impl Scene {
    /// The landing as a file.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a landing holds nothing that TOML cannot say")
    }
}
