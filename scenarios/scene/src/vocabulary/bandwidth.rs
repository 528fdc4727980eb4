//! What a bandwidth follows from.

use serde::{Deserialize, Serialize};

/// The mean over a time τ halves the power at this over τ (THEORY GE18) [-].
pub const CUTOFF: f64 = 0.443;

/// What the bandwidth of a result follows from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum BandwidthBy {
    /// A key of the scene.
    Scene,
    /// The shape of the bottom and the speed at contact: the same at each spacing.
    Impact,
    /// The air that a flat bottom traps: the same at each spacing.
    Air,
    /// The spacing, which is too coarse for that of the impact, or where nothing falls into the water.
    Spacing,
}

impl BandwidthBy {
    /// In words, for a person who reads results.
    pub fn words(self) -> &'static str {
        match self {
            BandwidthBy::Scene => "as report.bandwidth asks",
            BandwidthBy::Impact => "that of the impact, at each spacing the same; report.bandwidth sets another",
            BandwidthBy::Air => "that of the air under the flat bottom",
            BandwidthBy::Spacing => {
                "what the spacing resolves; report.bandwidth sets one that is the same at each spacing"
            }
        }
    }
}
