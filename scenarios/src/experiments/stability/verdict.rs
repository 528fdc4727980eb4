//! What became of a run.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::Map;
use crate::summary::{Status, Summary};

/// What a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Ran to its end, within all bounds.
    Stable,
    /// Ran to its end, but a number is wrong.
    Inaccurate,
    /// Broke down, took too many steps, gained energy, let water through a wall, broke the momentum audit, or left the map's
    /// bounds of what a run can be.
    Failed,
}

impl Verdict {
    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Stable => "stable",
            Verdict::Inaccurate => "inaccurate",
            Verdict::Failed => "failed",
        }
    }
}

/// Bounds on a number of `summary.json`.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Bound {
    /// Its path, keys joined by `/`.
    pub quantity: String,
    /// Least value.
    pub least: Option<f64>,
    /// Largest value.
    pub most: Option<f64>,
    /// What the bounds mean, with their source.
    pub meaning: String,
}

impl Bound {
    /// What is wrong with a run's number; a number that is not there or not finite is outside every bound.
    fn breach(&self, summary: &Value) -> Option<String> {
        let Bound { quantity, least, most, meaning } = self;
        let Some(value) = summary.pointer(&format!("/{quantity}")).and_then(Value::as_f64) else {
            return Some(format!("{quantity} is not a number: {meaning}"));
        };
        let (low, high) = (least.is_some_and(|least| value < least), most.is_some_and(|most| value > most));
        let limit = if low { least } else { most }.unwrap_or_default();
        let side = if low { "below" } else { "above" };
        (low || high).then(|| format!("{quantity} = {value:.4e}, {side} {limit}: {meaning}"))
    }
}

/// The verdict on a run, and why.
pub(super) fn judge(map: &Map, summary: &Summary) -> (Verdict, String) {
    let json = serde_json::to_value(summary).unwrap_or_default();
    let first = |bounds: &[Bound]| bounds.iter().find_map(|bound| bound.breach(&json));
    if let Some(why) = failure(map, summary).or_else(|| first(&map.failed)) {
        return (Verdict::Failed, why);
    }
    match first(&map.inaccurate) {
        Some(why) => (Verdict::Inaccurate, why),
        None => (Verdict::Stable, "ran to its end within all bounds".into()),
    }
}

/// What no map forgives.
fn failure(map: &Map, summary: &Summary) -> Option<String> {
    let audit = &summary.audit;
    let beyond = |value: f64, most: f64| value.is_nan() || value > most;
    match () {
        () if summary.status != Status::Completed => Some(summary.message.clone().unwrap_or_default()),
        () if beyond(audit.energy, map.most_energy_gain) => {
            Some(format!("energy grew by {:.3} of what was exchanged", audit.energy))
        }
        () if beyond(audit.momentum, map.most_momentum_gap) => Some(format!("momentum open by {:.1e}", audit.momentum)),
        () if audit.penetrated > 0 => Some(audit.worst_penetration.as_ref().map_or(String::new(), ToString::to_string)),
        () => None,
    }
}
