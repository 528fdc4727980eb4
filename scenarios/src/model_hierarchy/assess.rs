//! Every theory for a scene: range of validity, cost, measured error.

use std::time::Instant;

use fsi_coupling::entry_theory::{EntryModel, OutOfRange};
use serde::Serialize;

use super::{Measured, QuantityOfInterest, Theory, measured};
use crate::scene::Scene;

/// A theory, for a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Assessment {
    /// The model.
    #[serde(rename = "rung")]
    pub model: EntryModel,
    /// True if it is valid at the start of the scene.
    #[serde(skip)]
    pub begins: bool,
    /// Why it is not valid for the scene; absent where it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub obstacle: Option<String>,
    /// Core-seconds, measured for formulae, estimated for boundary elements and particles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub core_seconds: Option<f64>,
    /// Its error in the nearest case that was measured; absent where none is near.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured: Option<Measured>,
}

/// Every theory, from the cheapest, for a quantity of interest.
pub fn assess(scene: &Scene, want: QuantityOfInterest) -> Vec<Assessment> {
    let assessed = |model: EntryModel| {
        let start = Instant::now();
        let followed = Theory::outlined(scene, model).map(|(theory, end)| {
            let end = end.or_else(|| theory.may_go_under(scene));
            (theory, end)
        });
        let unknown =
            Assessment { model, begins: followed.is_ok(), obstacle: None, core_seconds: None, measured: None };
        match followed {
            Ok((theory, None)) => Assessment {
                core_seconds: Some(match model.is_formula() {
                    true => start.elapsed().as_secs_f64(),
                    false => flow_seconds(&theory),
                }),
                measured: measured(scene, &theory, want),
                ..unknown
            },
            Ok((_, Some(OutOfRange { what, range, .. }))) | Err(OutOfRange { what, range, .. }) => {
                Assessment { obstacle: Some(format!("holds for {range}, not {what}")), ..unknown }
            }
        }
    };
    EntryModel::ALL.into_iter().filter(|model| model.is_theory()).map(assessed).collect()
}

/// Slope of the wedge whose flow takes as long as one about a round bottom [-].
const ROUND_STARTS_AS: f64 = 0.32;

/// Core-seconds of boundary elements: steps are as short as the jet is thin, which is as tan²β of the flattest face.
fn flow_seconds(theory: &Theory) -> f64 {
    let flattest = || theory.section.followed_deadrises().fold(90.0, f64::min).to_radians().tan();
    let slope = theory.section.radius().map_or_else(flattest, |_| ROUND_STARTS_AS);
    0.15 + 0.22 / (slope * slope)
}
