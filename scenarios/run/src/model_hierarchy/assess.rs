//! Every theory for a scene: range of validity, cost, measured error.

use std::time::Instant;

use scene::{Body, QuantityOfInterest, Scene};
use serde::Serialize;
use water_entry::{EntryModel, OutOfRange};

use super::{Measured, Theory, measured, rolled};

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
                    false => flow_seconds(scene, &theory),
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

/// Core-seconds of boundary elements about a flow: those of any, and what steps as short as the jet is thin add, times tan²β.
const OF_WEDGE: [f64; 2] = [0.02, 0.011];
/// The same about a bent bottom, with finer elements.
const OF_BENT: [f64; 2] = [0.07, 0.016];
/// About a round bottom.
const OF_ROUND: f64 = 0.2;
/// About a bottom that bends: from a smaller draught, and the structure's iterations.
const OF_BENDING: [f64; 2] = [0.1, 0.036];
/// Times as long about a rolled wedge: both sides.
const ROLLED: f64 = 1.5;

/// Core-seconds of boundary elements: steps are as short as the jet is thin, which is as tan²β of the flattest face.
fn flow_seconds(scene: &Scene, theory: &Theory) -> f64 {
    let faces = scene.body.as_ref().filter(|_| theory.rolls()).and_then(rolled::deadrises);
    let of_face = |[any, jet]: [f64; 2], deadrise: f64| any + jet / deadrise.to_radians().tan().powi(2);
    match faces {
        Some([left, right]) => ROLLED * of_face(OF_WEDGE, left.min(right)),
        None if theory.section.is_round() => OF_ROUND,
        None => {
            let [least, _] = water_entry::BOUNDARY_ELEMENT_DEADRISES;
            let deadrises: Vec<f64> = theory.section.followed_deadrises().filter(|face| *face >= least).collect();
            let of_flow = match deadrises.len() {
                _ if scene.body.as_ref().is_some_and(Body::bends) => OF_BENDING,
                1 => OF_WEDGE,
                _ => OF_BENT,
            };
            of_face(of_flow, deadrises.into_iter().fold(90.0, f64::min))
        }
    }
}
