//! Errors of boundary elements about round bottoms, curves and flat keels, in the measured cases.

use scene::{Motion, QuantityOfInterest, Scene};
use water_entry::EntryModel;

use super::largest_mean::{Averaging, doubt};
use super::{Measured, Theory};

/// Largest difference of the force on a round bottom from particles at constant speed (case `arc_constant`, five windows of the draught) and in
/// drops (eighths of the run) [-].
const ROUND_ERROR: f64 = 0.025;
const ROUND_DROP_HISTORY_ERROR: f64 = 0.08;
/// RMS error of a cylinder's depth over the largest (`tests/verification/potential_flow.rs`), of the speed of arcs over that at contact
/// as far as they were dropped, and that draught over the radius [-].
const ROUND_DROP_ERROR: f64 = 0.035;
const SHALLOW_DROP_ERROR: f64 = 0.01;
const SHALLOW_DROP: f64 = 0.15;
/// No difference of the mean force of the first contact (THEORY GE18) from particles was larger, of eight arcs and twenty curves [-].
const ROUND_PEAK_ERRORS: [f64; 2] = [0.03, 0.055];

/// The same of ellipses and ovoids given by points: force from a twentieth of the half breadth on, four of them, and speed, three of them [-].
const CURVE_ERROR: f64 = 0.03;
const CURVE_DROP_ERROR: f64 = 0.01;
/// Least mass of those arcs over ρR², and of the curves over ρ times the square of the half breadth [-].
const LEAST_MASSES: [f64; 2] = [0.2, 0.5];
/// Largest force on curves with a keel, of four of them [-].
const CURVE_PEAK_ERROR: f64 = 0.045;
/// The same of curves with a keel of 12 to 28 degrees, of five of them: force and speed [-], and the least angle of the keel [deg].
const KEELED_CURVE_ERROR: f64 = 0.03;
const KEELED_CURVE_DROP_ERROR: f64 = 0.01;
const KEELED_CURVE: f64 = 12.0;
/// RMS difference of the speed of a falling body with a flat keel from particles, over that at contact [-].
const FLAT_DROP_ERROR: f64 = 0.02;

/// Under a round bottom only boundary elements were measured.
pub(super) fn of_round_bottom(scene: &Scene, theory: &Theory, want: QuantityOfInterest) -> Option<Measured> {
    if theory.model != EntryModel::BoundaryElement {
        return None;
    }
    let falls = scene.body.as_ref().is_some_and(|body| matches!(body.motion, Motion::Free(_)));
    let past_chines = theory.instants.iter().any(|now| now.wetted >= theory.section.half_breadth());
    let error = |error: f64, case: &str| Some(Measured { error, case: case.into() });
    let deepest = theory.instants.iter().map(|now| now.draught).fold(0.0, f64::max);
    match (want, theory.section.radius()) {
        (QuantityOfInterest::Motion, _) if !falls => error(0.0, "a motion that is given"),
        (QuantityOfInterest::Motion, Some(radius)) if deepest <= SHALLOW_DROP * radius => {
            error(SHALLOW_DROP_ERROR, "the speed of eight falling arcs to a draught of 0.15 radii, against particles")
        }
        (QuantityOfInterest::Motion, Some(_)) => {
            error(ROUND_DROP_ERROR, "the depth of cylinder_entry to 0.07 s, against others' boundary elements")
        }
        (QuantityOfInterest::Motion, None) => {
            error(CURVE_DROP_ERROR, "the speed of falling ellipses and ovoids, against particles")
        }
        (QuantityOfInterest::History, Some(_)) if !past_chines && falls => {
            error(ROUND_DROP_HISTORY_ERROR, "eight falling arcs, against particles")
        }
        (QuantityOfInterest::History, Some(_)) if !past_chines => {
            error(ROUND_ERROR, "arc_constant to half a radius, against particles")
        }
        (QuantityOfInterest::History, None) if !past_chines => {
            let dropped = if falls { CURVE_DROP_ERROR } else { 0.0 };
            error(CURVE_ERROR + dropped, "ellipses and ovoids at constant speed and falling, against particles")
        }
        // sound and air decide it
        (QuantityOfInterest::PeakForce, _) if scene.entry().is_none_or(|entry| entry.is_flat()) => None,
        (QuantityOfInterest::PeakForce, _) if is_lighter_than_measured(scene, theory) => None,
        (QuantityOfInterest::PeakForce, _) if is_doubted(scene, theory) => None,
        (QuantityOfInterest::PeakForce, Some(_)) => {
            error(ROUND_PEAK_ERRORS[0], "the mean force of the first contact of eight arcs, against particles")
        }
        (QuantityOfInterest::PeakForce, None) => {
            error(ROUND_PEAK_ERRORS[1], "the largest mean force on twenty curves, against particles")
        }
        _ => None,
    }
}

/// A falling body that is lighter, over the water's density and the square of the radius or half breadth, than those that were measured.
fn is_lighter_than_measured(scene: &Scene, theory: &Theory) -> bool {
    let least = match theory.section.radius() {
        Some(radius) => LEAST_MASSES[0] * radius.powi(2),
        None => LEAST_MASSES[1] * theory.section.half_breadth().powi(2),
    };
    scene.body.as_ref().is_some_and(|body| match &body.motion {
        Motion::Free(freedom) => freedom.mass < least * scene.water().density,
        _ => false,
    })
}

/// Does something speak against the largest force, such as a start in the water or a run that is too short?
fn is_doubted(scene: &Scene, theory: &Theory) -> bool {
    scene.body.as_ref().is_some_and(|body| doubt(scene, body, theory, Averaging::of(scene, theory)).is_some())
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
