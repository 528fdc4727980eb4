//! Errors of boundary elements about round bottoms, curves and flat keels, in the measured cases.

use scene::{Motion, QuantityOfInterest, Scene};
use water_entry::EntryModel;

use super::{Measured, Theory};

/// Largest difference of the force on a round bottom from particles (case `arc_constant`, five windows of the draught) [-].
const ROUND_ERROR: f64 = 0.025;
/// RMS error of a cylinder's depth over the largest (`tests/verification/potential_flow.rs`) [-].
const ROUND_DROP_ERROR: f64 = 0.035;

/// The same of ellipses and ovoids given by points: force from a twentieth of the half breadth on, four of them, and speed, three of them [-].
const CURVE_ERROR: f64 = 0.03;
const CURVE_DROP_ERROR: f64 = 0.01;
/// Largest force on arcs and curves, of four of them, where it comes after the first contact: from a draught over the half breadth on [-].
const CURVE_PEAK_ERROR: f64 = 0.045;
const AFTER_CONTACT: f64 = 0.04;
/// The same of curves with a keel of 12 to 28 degrees, of five of them: force and speed [-], and the least angle of the keel [deg].
const KEELED_CURVE_ERROR: f64 = 0.03;
const KEELED_CURVE_DROP_ERROR: f64 = 0.01;
const KEELED_CURVE: f64 = 12.0;
/// RMS difference of the speed of a falling body with a flat keel from particles, over that at contact [-].
const FLAT_DROP_ERROR: f64 = 0.02;

/// Under a round bottom only boundary elements were measured, and the peak of the first contact, which no theory without sound or air has, was not.
pub(super) fn of_round_bottom(scene: &Scene, theory: &Theory, want: QuantityOfInterest) -> Option<Measured> {
    if theory.model != EntryModel::BoundaryElement {
        return None;
    }
    let falls = scene.body.as_ref().is_some_and(|body| matches!(body.motion, Motion::Free(_)));
    let dropped = if falls { ROUND_DROP_ERROR } else { 0.0 };
    let drop = "the depth of cylinder_entry to 0.07 s, against others' boundary elements";
    let past_chines = theory.instants.iter().any(|now| now.wetted >= theory.section.half_breadth());
    let [of_flow, dropped] = match theory.section.radius() {
        Some(_) => [ROUND_ERROR, dropped],
        None => [CURVE_ERROR, if falls { CURVE_DROP_ERROR } else { 0.0 }],
    };
    let (constant, drop) = match theory.section.radius() {
        Some(_) => ("arc_constant to half a radius, against particles", drop),
        None => (
            "ellipses and ovoids at constant speed, against particles",
            "the speed of falling ellipses and ovoids, against particles",
        ),
    };
    match want {
        QuantityOfInterest::Motion if falls => Some(Measured { error: dropped, case: drop.into() }),
        QuantityOfInterest::Motion => Some(Measured { error: 0.0, case: "a motion that is given".into() }),
        QuantityOfInterest::History if !past_chines => {
            let case = if falls { format!("{constant}, and {drop}") } else { constant.into() };
            Some(Measured { error: of_flow + dropped, case })
        }
        QuantityOfInterest::PeakForce if peaks_after_contact(theory) => {
            Some(Measured { error: CURVE_PEAK_ERROR, case: "four arcs and curves, against particles".into() })
        }
        _ => None,
    }
}

/// Does the largest force come after the first contact?
fn peaks_after_contact(theory: &Theory) -> bool {
    let largest = theory.instants.iter().max_by(|a, b| a.force.total_cmp(&b.force));
    largest.is_some_and(|now| now.draught >= AFTER_CONTACT * theory.section.half_breadth())
}

/// Under a flat keel, which all meets the water at once, only speeds were measured.
pub(super) fn of_flat_keel(scene: &Scene, want: QuantityOfInterest) -> Option<Measured> {
    let falls = scene.body.as_ref().is_some_and(|body| matches!(body.motion, Motion::Free(_)));
    match want {
        QuantityOfInterest::Motion if falls => {
            Some(Measured { error: FLAT_DROP_ERROR, case: "a drop of a flat keel, against particles".into() })
        }
        QuantityOfInterest::Motion => Some(Measured { error: 0.0, case: "a motion that is given".into() }),
        _ => None,
    }
}

/// Under a curve that begins at a keel.
pub(super) fn of_keeled_curve(scene: &Scene, theory: &Theory, want: QuantityOfInterest) -> Option<Measured> {
    if theory.section.slope(0.0).atan().to_degrees() < KEELED_CURVE {
        return None;
    }
    let falls = scene.body.as_ref().is_some_and(|body| matches!(body.motion, Motion::Free(_)));
    let dropped = if falls { KEELED_CURVE_DROP_ERROR } else { 0.0 };
    let case = || "five curves with keels, against particles".into();
    match want {
        QuantityOfInterest::Motion if falls => Some(Measured { error: dropped, case: case() }),
        QuantityOfInterest::Motion => Some(Measured { error: 0.0, case: "a motion that is given".into() }),
        QuantityOfInterest::PeakForce => Some(Measured { error: CURVE_PEAK_ERROR, case: case() }),
        QuantityOfInterest::History => Some(Measured { error: KEELED_CURVE_ERROR + dropped, case: case() }),
        QuantityOfInterest::PeakPressure | QuantityOfInterest::Strain => None,
    }
}
