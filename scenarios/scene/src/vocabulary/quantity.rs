//! A result with its band and verdict.

use serde::{Deserialize, Deserializer, Serialize};

use super::verdict::Verdict;

/// A result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quantity {
    /// The value, in the unit that its name ends with.
    #[serde(deserialize_with = "number")]
    pub value: f64,
    /// When [s]; `null` where it belongs to the whole run.
    pub time_s: Option<f64>,
    /// Half width of the band about the value, in the same unit; `null` where none is known.
    pub band: Option<f64>,
    /// Frequency at which the averaging halves the power [Hz]; `null` without averaging.
    #[serde(default)]
    pub cutoff_hz: Option<f64>,
    /// The largest value of a single step, in the same unit.
    #[serde(default = "unknown", deserialize_with = "number")]
    pub raw: f64,
    /// What may be said of it.
    pub verdict: Verdict,
    /// Whether what it belongs to stays within its limits; absent where there is no limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub allowed: Option<bool>,
}

/// JSON writes a number that is not finite as `null`.
fn number<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Option::<f64>::deserialize(deserializer).map(|value| value.unwrap_or(f64::NAN))
}

fn unknown() -> f64 {
    f64::NAN
}

impl Quantity {
    /// The same: resolved only with a band that is smaller than its value.
    pub fn with_known_band(self) -> Quantity {
        let verdict = match self.verdict {
            Verdict::Resolved | Verdict::NoBand if self.is_withheld() => Verdict::NotResolved,
            Verdict::Resolved if self.band.is_none() => Verdict::NoBand,
            known => known,
        };
        Quantity { verdict, ..self }
    }

    /// The same, not resolved where nothing spoke against it.
    pub fn doubted(self) -> Quantity {
        if self.verdict.is_sound() { Quantity { verdict: Verdict::NotResolved, ..self } } else { self }
    }

    /// True for a number that says nothing: its band is as large as itself.
    pub fn is_withheld(&self) -> bool {
        is_withheld(self.value, self.band)
    }

    /// The value, where it says something.
    pub fn shown(&self) -> Option<f64> {
        Some(self.value).filter(|value| value.is_finite() && !self.is_withheld())
    }

    /// The band as a share of the value.
    pub fn share(&self) -> Option<f64> {
        let (band, value) = (self.band?, self.shown()?);
        Some((band / value).abs()).filter(|share| share.is_finite())
    }
}

/// True for a value that says nothing: its band is as large as itself.
pub fn is_withheld(value: f64, band: Option<f64>) -> bool {
    band.is_some_and(|band| band > 0.0 && band >= value.abs())
}
