//! Keys of a landing's sea.

use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};

/// Table `[sea]`: regular, long-crested swell on deep water; without it the water is calm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SeaKeys {
    /// Height of the waves, crest to trough [m].
    #[schemars(range(min = 0.0))]
    pub height: f64,
    /// Length of the waves, crest to crest [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: f64,
    /// Direction of flight from that of the waves: 0 with them, 90 along the crests, 180 against them [deg].
    #[schemars(range(min = 0.0, max = 180.0))]
    pub heading_deg: f64,
    /// Where the aeroplane first touches, seen in the direction of flight; or the phase there, 0 at a crest, 90 on the down slope [deg].
    pub touchdown: TouchdownKey,
}

/// Value of `sea.touchdown`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum TouchdownKey {
    /// A part of the wave.
    Part(WavePart),
    /// Phase in the direction of flight [deg].
    PhaseDeg(f64),
}

/// A part of a wave, seen in the direction of flight.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WavePart {
    /// The crest.
    Crest,
    /// Half the way down behind it.
    DownSlope,
    /// The trough.
    Trough,
    /// Half the way up to the next crest.
    UpSlope,
}

impl JsonSchema for TouchdownKey {
    fn schema_name() -> Cow<'static, str> {
        "TouchdownKey".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [
            { "type": "string", "enum": ["crest", "down_slope", "trough", "up_slope"] },
            { "type": "number", "minimum": 0, "maximum": 360 }
        ] })
    }
}

impl TouchdownKey {
    /// Phase in the direction of flight [rad].
    pub(super) fn phase(self) -> f64 {
        match self {
            TouchdownKey::Part(part) => FRAC_PI_2 * part as usize as f64,
            TouchdownKey::PhaseDeg(phase) => phase.to_radians(),
        }
    }

    /// As it is written.
    pub(super) fn text(self) -> String {
        serde_json::to_string(&self).unwrap_or_default()
    }
}
