//! `model = "auto"`: the cheapest model that is near enough where it was measured.

use fsi_coupling::theory::Rung;

use super::{Want, rungs};
use crate::scene::{Scene, significant};

/// The cheapest model whose measured error meets the tolerance, and why, in a sentence.
pub fn choose(scene: &Scene, want: Want, within: f64) -> (Rung, String) {
    let per_cent = |share: f64| format!("{} %", significant(100.0 * share));
    let assessed = rungs(scene, want);
    let near = |m: &&super::Measured| m.error <= within;
    let found = assessed.iter().find_map(|a| a.measured.as_ref().filter(near).map(|m| (a.rung, m)));
    if let Some((rung, measured)) = found {
        let why = format!(
            "{}: the cheapest model within {} for {}: {} off in {}",
            rung.name(),
            per_cent(within),
            want.words(),
            per_cent(measured.error),
            measured.case
        );
        return (rung, why);
    }
    let best = assessed.iter().filter_map(|a| Some((a.rung, a.measured.as_ref()?)));
    let best = best.min_by(|a, b| a.1.error.total_cmp(&b.1.error));
    let cheaper = match (best, assessed.iter().find_map(|a| a.obstacle.as_ref())) {
        (Some((rung, m)), _) => format!("the best theory, {}, is {} off in {}", rung.name(), per_cent(m.error), m.case),
        (None, Some(obstacle)) => format!("a theory {obstacle}"),
        (None, None) => "no theory was measured near this scene".into(),
    };
    let why = format!("wcsph: no theory is within {} for {}: {cheaper}", per_cent(within), want.words());
    (Rung::Wcsph, why)
}
