//! Numbers that stand beside the results: of rules, and of a section of finite length.

use serde::{Deserialize, Serialize};

/// A load that a rule states, and what was computed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RuleLoad {
    /// The paragraph.
    pub paragraph: String,
    /// What it states.
    pub load: String,
    /// Its unit: Pa, N, m/s, or - for one without.
    pub unit: String,
    /// By the rule; `null` where it has no number for this section.
    pub value: Option<f64>,
    /// Why it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// The computed number that is next to it; absent where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub computed: Option<f64>,
    /// What that number is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub computed_is: Option<String>,
}

/// A factor on a two-dimensional result, and the whole section's load by it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Share {
    /// The factor [-].
    pub factor: f64,
    /// Half of the spread of the formulas [-].
    pub band: f64,
    /// Wetted breadth for which it holds [m].
    pub wetted_breadth_m: f64,
    /// Length over this breadth [-].
    pub aspect_ratio: f64,
    /// Two-dimensional result times length and factor: N of the force, N s of the impulse.
    pub whole: f64,
}

/// The loads of a section of finite length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FiniteLength {
    /// Its length, `report.length` [m].
    pub length_m: f64,
    /// Of the peak force, at the wetted breadth of its time (RU8); absent where the chines were wet before, or there is no such result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_force: Option<Share>,
    /// Of the impulse, at the largest wetted breadth of the run (RU7); absent where the chines got wet, or there is no such result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impulse: Option<Share>,
}
