//! The verdict on a run of a map.

use serde::{Deserialize, Serialize};

use super::map::{Bound, Map};
use crate::experiments::runs::RunRecord;
use crate::summary::{Status, Summary};

/// Verdict on a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Ran to its end, within all bounds.
    Stable,
    /// Ran to its end, but a number is wrong.
    Inaccurate,
    /// Broke down, took too many steps, gained energy, let water penetrate a wall, violated the momentum balance, or left the
    /// map's bounds of failure.
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

/// The verdict on a run, and why.
pub(super) fn judge(map: &Map, run: &RunRecord) -> (Verdict, String) {
    let first = |bounds: &[Bound]| bounds.iter().find_map(|bound| bound.breach(&run.numbers));
    if let Some(why) = failure(map, &run.summary).or_else(|| first(&map.failed)) {
        return (Verdict::Failed, why);
    }
    match first(&map.inaccurate) {
        Some(why) => (Verdict::Inaccurate, why),
        None => (Verdict::Stable, "ran to its end within all bounds".into()),
    }
}

/// Why a run has failed on any map.
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
