//! Keys of a landing's sea.

use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use settings::Problem;
use water_entry::ditching::Jonswap;

/// Table `[sea]`: long-crested waves on deep water, regular ones or those of a spectrum; without it the water is calm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SeaKeys {
    /// Spectrum of irregular waves instead of regular ones.
    #[schemars(extend("x-default" = "none"))]
    pub spectrum: Option<SpectrumKey>,
    /// Height of regular waves, crest to trough [m].
    #[schemars(range(min = 0.0), extend("x-default" = "required without spectrum"))]
    pub height: Option<f64>,
    /// Length of regular waves, crest to crest [m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required without spectrum"))]
    pub length: Option<f64>,
    /// Direction of flight from that of the waves: 0 with them, 90 along the crests, 180 against them [deg].
    #[schemars(range(min = 0.0, max = 180.0))]
    pub heading_deg: f64,
    /// Where the aeroplane first touches, seen in the direction of flight; or the phase there, 0 at a crest, 90 on the down slope [deg].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "TouchdownKey", extend("x-default" = "required without spectrum"))]
    pub touchdown: Option<TouchdownKey>,
    /// Significant height of irregular waves [m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required with spectrum"))]
    pub significant_height: Option<f64>,
    /// Period of the peak of their spectrum [s].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required with spectrum"))]
    pub peak_period: Option<f64>,
    /// Peak enhancement of their spectrum [-].
    #[schemars(range(min = 1.0, max = 10.0), extend("x-default" = "3.3"))]
    pub gamma: Option<f64>,
    /// Seed of their phases; each whole number is another sea.
    #[schemars(extend("x-default" = "1"))]
    pub seed: Option<u32>,
}

/// Value of `sea.spectrum`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SpectrumKey {
    /// JONSWAP (Hasselmann et al. 1973).
    Jonswap,
}

/// A sea, read from its keys.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SeaState {
    /// Height and length [m], and where the aeroplane first touches.
    Regular(f64, f64, TouchdownKey),
    /// Of a spectrum.
    Irregular(Jonswap),
}

impl SeaKeys {
    /// The sea that the keys say.
    pub(super) fn state(&self) -> Result<SeaState, Problem> {
        let needs = |name: &str| {
            Problem::missing(&format!("sea.{name}"), "a value, as the sea is regular (or sea.spectrum with its keys)")
        };
        let no = |name: &str, given: Option<String>, expected: &str| {
            given.map_or(Ok(()), |given| Err(Problem::new(&format!("sea.{name}"), given, expected)))
        };
        let text = |value: Option<f64>| value.map(|v| v.to_string());
        if self.spectrum.is_none() {
            let expected = "none without sea.spectrum";
            no("significant_height", text(self.significant_height), expected)?;
            no("peak_period", text(self.peak_period), expected)?;
            no("gamma", text(self.gamma), expected)?;
            no("seed", self.seed.map(|seed| seed.to_string()), expected)?;
            let (height, length) =
                (self.height.ok_or_else(|| needs("height"))?, self.length.ok_or_else(|| needs("length"))?);
            return Ok(SeaState::Regular(height, length, self.touchdown.ok_or_else(|| needs("touchdown"))?));
        }
        let expected = "none beside sea.spectrum";
        no("height", text(self.height), expected)?;
        no("length", text(self.length), expected)?;
        no("touchdown", self.touchdown.map(TouchdownKey::text), expected)?;
        let needs = |name: &str| Problem::missing(&format!("sea.{name}"), "a value beside sea.spectrum");
        Ok(SeaState::Irregular(Jonswap {
            significant_height: self.significant_height.ok_or_else(|| needs("significant_height"))?,
            peak_period: self.peak_period.ok_or_else(|| needs("peak_period"))?,
            gamma: self.gamma.unwrap_or(3.3),
            seed: u64::from(self.seed.unwrap_or(1)),
        }))
    }
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
