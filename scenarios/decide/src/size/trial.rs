//! A value that was tried.

use serde::Serialize;

use super::margin::Margin;

/// A value with its margin.
#[derive(Clone, Debug, Serialize)]
pub struct Trial {
    /// Of the key.
    pub value: f64,
    /// The model that was run.
    pub model: String,
    /// The least margin of all limits.
    #[serde(flatten)]
    pub margin: Margin,
    /// Mass of all panels, both sides of a section that is simulated by half [kg/m].
    pub panel_mass_kg_per_m: f64,
    /// Doubts about the result that decides.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub doubts: Vec<String>,
}
