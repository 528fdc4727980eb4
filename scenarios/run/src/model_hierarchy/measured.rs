//! Error of a theory in the measured case that is nearest to a scene.

use scene::{Body, Choice, Loader, Models, Motion, Panel, PanelEnd, QuantityOfInterest, Scene};
use settings::significant;
use water_entry::{BOUNDARY_ELEMENT_DEADRISES, EntryModel, OutOfRange, Section, SimilarityFlow};

use super::{Measured, Theory, curves, rolled};
use crate::compare;
use crate::observers::{Series, columns};

/// The free drop against which theories are measured: a wedge of 25°, against boundary elements.
const DROP: &str = "wedge25";
/// Largest difference of the deadrise from the drop's, of a formula, and of boundary elements, which three drops at 40 to 42 degrees confirm [deg].
const BESIDE_DROP: f64 = 15.0;
const BESIDE_DROP_OF_FLOW: f64 = 20.0;
/// Largest difference of the force on a wedge with wet chines by boundary elements from particles [-].
const WET_CHINES_ERROR: f64 = 0.02;
/// The elastic wedge of 10° against which the modal beam is measured.
const BENCHMARK: &str = "elastic_wedge";
const BENCHMARK_DEADRISE: f64 = 10.0;
/// Largest difference of the deadrise from the benchmark's [deg].
const BESIDE_BENCHMARK: f64 = 5.0;
/// Largest error of the similarity solution's numbers against an independent program's (`tests/verification/theory.rs`) [-].
const SIMILARITY_ERROR: f64 = 1e-4;
/// Largest errors of boundary elements in force and largest pressure at constant speed (`tests/verification/potential_flow.rs`) [-].
const FLOW_ERRORS: [f64; 2] = [0.005, 0.01];
/// RMS error of their speed in the validated drop over that at contact (`tests/verification/potential_flow.rs`) [-].
const FLOW_DROP_ERROR: f64 = 0.0075;

/// Deadrises of the faces of bent bottoms that were measured, and their turns at knuckles [deg].
const BENT_FACES: [f64; 2] = [13.5, 55.0];
const BENT_TURNS: [f64; 2] = [-10.5, 33.5];
/// Largest difference of the force on a bent bottom from particles (five windows of the draught, nine sections) [-].
const BENT_ERROR: f64 = 0.05;
/// Largest difference of their largest force from particles, of three of them [-].
const BENT_PEAK_ERROR: f64 = 0.015;
/// RMS difference of a falling bent section's speed from particles over that at contact [-].
const BENT_DROP_ERROR: f64 = 0.01;

/// Deadrises of the wedges with panels that were measured [deg], and the largest half breadth of the arcs over their radius [-].
const BENDING_FACES: [f64; 2] = [10.0, 35.0];
const BENDING_ARC: f64 = 0.67;
/// Deadrises of straight faces whose panels were clamped at one end or both and elastic [deg], and the largest difference of their stress from particles [-].
const CLAMPED_FACES: [f64; 2] = [12.0, 34.0];
const CLAMPED_STRESS_ERROR: f64 = 0.025;
/// Largest differences from particles on them: largest force, largest stress, and RMS of a falling frame's speed over that at contact [-].
const BENDING_ERROR: f64 = 0.06;
const BENDING_STRESS_ERROR: f64 = 0.05;
const BENDING_DROP_ERROR: f64 = 0.01;

/// Largest error of force and largest pressures on rolled wedges at constant speed (`tests/verification/asymmetric_similarity.rs`) [-].
const ROLLED_ERROR: f64 = 0.02;
/// Deadrises of the faces in the drops of rolled wedges [deg].
const ROLLED_DROP_FACES: [f64; 2] = [20.0, 57.0];
/// Largest differences from particles in them: RMS of the speed over that at contact, largest force, force in tenths of the run [-].
const ROLLED_DROP_ERRORS: [f64; 3] = [0.005, 0.03, 0.05];

/// What a formula is off in the force of a drop, over what it is off in the speed: the similarity solution 4 to 5 % at 25 and 30° [-].
const FORCE_PER_SPEED: f64 = 4.0;
/// What the modified Logvinovich model is off more in the force when the chines get wet, than before: at 12 to 45° up to 0.8 % [-].
const AT_CHINES: f64 = 0.01;
/// Largest g D/V² of the measured cases [-], and what formulas without gravity in the flow are off per unit of it: 0.4 to 2 % at 20 to 40°.
const LARGEST_GAIN: f64 = 2.0;
const PER_GAIN: f64 = 0.02;
/// The same for the largest pressure at a gauge: up to 20 % at 1.9, at 30° and a given speed.
const PRESSURE_PER_GAIN: f64 = 0.12;
/// Largest draught at the start over that at the end [-].
const WET_START: f64 = 0.1;

/// The error of a theory where it was measured nearest to this scene: against the exact solution at the same deadrise, and for
/// free drops against the validated one. `None` where nothing was measured near.
pub fn measured(scene: &Scene, theory: &Theory, want: QuantityOfInterest) -> Option<Measured> {
    let gain = scene.gain_of_gravity()?;
    let depth = scene.entry()?.final_draught;
    let starts_wet = scene.body.as_ref().is_some_and(|body| body.draught() > WET_START * depth);
    let given = want == QuantityOfInterest::Motion && !scene.body.as_ref().is_some_and(Body::is_free);
    let from_table = scene.body.as_ref().is_some_and(|body| matches!(body.motion, Motion::Tabulated(_)));
    if !given && (gain > LARGEST_GAIN || starts_wet || from_table) {
        return None; // no case was measured there
    }
    let of_gravity = match want {
        _ if given || theory.model == EntryModel::BoundaryElement => 0.0,
        QuantityOfInterest::PeakPressure => PRESSURE_PER_GAIN * gain,
        _ => PER_GAIN * gain,
    };
    let found = measured_without_gravity(scene, theory, want)?;
    Some(Measured { error: found.error + of_gravity, ..found })
}

/// The same, but for what gravity adds.
fn measured_without_gravity(scene: &Scene, theory: &Theory, want: QuantityOfInterest) -> Option<Measured> {
    if theory.rolls() {
        return of_rolled_wedge(scene, want);
    }
    if theory.model == EntryModel::BoundaryElement && scene.body.as_ref().is_some_and(Body::bends) {
        return of_bending_bottom(scene, theory, want);
    }
    if theory.section.is_round() {
        return curves::of_round_bottom(scene, theory, want);
    }
    if theory.model == EntryModel::BoundaryElement && theory.section.flat_keel().is_some() {
        return curves::of_flat_keel(scene, want);
    }
    if theory.model == EntryModel::BoundaryElement && theory.section.is_curved() {
        return curves::of_keeled_curve(scene, theory, want);
    }
    let Some(deadrise) = theory.section.deadrise_deg() else { return of_bent_bottom(scene, theory, want) };
    if theory.bends() {
        return match want {
            QuantityOfInterest::Strain if (deadrise - BENCHMARK_DEADRISE).abs() < BESIDE_BENCHMARK => elastic_error(),
            _ => None,
        };
    }
    let falls = scene.body.as_ref().is_some_and(|body| matches!(body.motion, Motion::Free(_)));
    let model = theory.model;
    let past_chines = theory.wets_chines();
    let of_load = falls || want != QuantityOfInterest::Motion;
    let is_flow = model == EntryModel::BoundaryElement;
    let history = want == QuantityOfInterest::History;
    if past_chines && (history && !is_flow || model == EntryModel::VonKarman && of_load) {
        return None; // loads of formulas were measured on faces alone; von Karman's grows on behind wet chines
    }
    let beside = if is_flow { BESIDE_DROP_OF_FLOW } else { BESIDE_DROP };
    let dropped = match falls {
        true if (deadrise - drop_deadrise()?).abs() > beside => return None,
        true => drop_error(scene, theory)?,
        false => 0.0,
    };
    let against =
        format!("a wedge of {} degrees at constant speed, against the similarity solution", significant(deadrise));
    let and_drop =
        format!("free drops: the best theory in {DROP}, against boundary elements, and this one beside it here");
    let times = if model.is_formula() { FORCE_PER_SPEED } else { 1.0 };
    let with_drop = |error: f64| Measured {
        error: error + times * dropped,
        case: if falls { format!("{against}, and {and_drop}") } else { against.clone() },
    };
    match want {
        QuantityOfInterest::Strain => None,
        QuantityOfInterest::Motion if falls => Some(Measured { error: dropped, case: and_drop }),
        QuantityOfInterest::Motion => Some(Measured { error: 0.0, case: "a motion that is given".into() }),
        QuantityOfInterest::PeakForce | QuantityOfInterest::History => {
            let at_chines = match past_chines {
                true if model.is_formula() => AT_CHINES,
                true if history => WET_CHINES_ERROR,
                _ => 0.0,
            };
            Some(with_drop(coefficient_errors(model, deadrise)?[0]? + at_chines))
        }
        QuantityOfInterest::PeakPressure => Some(with_drop(coefficient_errors(model, deadrise)?[1]?)),
    }
}

/// Largest horizontal over vertical speed at which boundary elements were judged [-].
const OBLIQUE: f64 = 0.5;

/// About a rolled wedge: at constant speed against the asymmetric similar flow, in drops against particles.
fn of_rolled_wedge(scene: &Scene, want: QuantityOfInterest) -> Option<Measured> {
    let body = scene.body.as_ref()?;
    let deadrises = rolled::deadrises(body)?;
    let falls = matches!(body.motion, Motion::Free(_));
    // with a horizontal speed only loads were judged, up to half of the vertical one
    let [along, down] = body.velocity;
    if along != 0.0 && (falls || want == QuantityOfInterest::PeakPressure || along.abs() > OBLIQUE * down.abs()) {
        return None;
    }
    let past_chines = rolled::wets_chines(scene)?;
    let [least, most] = if falls { ROLLED_DROP_FACES } else { BOUNDARY_ELEMENT_DEADRISES };
    if !deadrises.iter().all(|deadrise| (least - 1e-6..=most + 1e-6).contains(deadrise)) {
        return None;
    }
    let drop = "six drops of rolled wedges with faces of 20 to 57 degrees, against particles";
    let constant = "rolled and oblique wedges at constant speed, against the asymmetric similarity solution";
    match want {
        QuantityOfInterest::Motion if falls => Some(Measured { error: ROLLED_DROP_ERRORS[0], case: drop.into() }),
        QuantityOfInterest::Motion => Some(Measured { error: 0.0, case: "a motion that is given".into() }),
        QuantityOfInterest::PeakForce if falls => Some(Measured { error: ROLLED_DROP_ERRORS[1], case: drop.into() }),
        QuantityOfInterest::History if falls && !past_chines => {
            Some(Measured { error: ROLLED_DROP_ERRORS[2], case: drop.into() })
        }
        QuantityOfInterest::PeakForce | QuantityOfInterest::History | QuantityOfInterest::PeakPressure
            if !falls && !past_chines =>
        {
            Some(Measured { error: ROLLED_ERROR, case: constant.into() })
        }
        _ => None,
    }
}

/// Under a bent bottom only boundary elements were measured, and no largest pressure.
fn of_bent_bottom(scene: &Scene, theory: &Theory, want: QuantityOfInterest) -> Option<Measured> {
    let deadrises: Vec<f64> = theory.section.followed_deadrises().collect();
    let [least, most] = BENT_FACES;
    let near = deadrises.iter().all(|deadrise| (least - 0.5..most + 0.5).contains(deadrise))
        && deadrises.windows(2).all(|faces| (BENT_TURNS[0]..BENT_TURNS[1]).contains(&(faces[1] - faces[0])));
    if theory.model != EntryModel::BoundaryElement || !near {
        return None;
    }
    let falls = scene.body.as_ref().is_some_and(|body| matches!(body.motion, Motion::Free(_)));
    let dropped = if falls { BENT_DROP_ERROR } else { 0.0 };
    let drop = "the speed of falling bent sections, against particles";
    match want {
        QuantityOfInterest::Motion if falls => Some(Measured { error: dropped, case: drop.into() }),
        QuantityOfInterest::Motion => Some(Measured { error: 0.0, case: "a motion that is given".into() }),
        QuantityOfInterest::History => {
            let case = "bent sections of two and three faces at a fifth of the draught and deeper, against particles";
            Some(Measured { error: BENT_ERROR + dropped, case: case.into() })
        }
        QuantityOfInterest::PeakForce => {
            let case = "the largest force on three bent sections, against particles";
            Some(Measured { error: BENT_PEAK_ERROR + dropped, case: case.into() })
        }
        _ => None,
    }
}

/// About a bottom that bends, against particles.
fn of_bending_bottom(scene: &Scene, theory: &Theory, want: QuantityOfInterest) -> Option<Measured> {
    let falls = scene.body.as_ref().is_some_and(|body| matches!(body.motion, Motion::Free(_)));
    let section = &theory.section;
    let is_in = |deadrise| (BENDING_FACES[0]..=BENDING_FACES[1]).contains(&deadrise);
    let measured = match section.radius() {
        Some(radius) => section.half_breadth() <= BENDING_ARC * radius,
        None => section.flat_keel().is_none() && section.followed_deadrises().all(is_in),
    };
    let case = || "wedges, arcs and bent bottoms with panels, against particles".into();
    match want {
        _ if !measured => None,
        QuantityOfInterest::Motion if falls => Some(Measured { error: BENDING_DROP_ERROR, case: case() }),
        QuantityOfInterest::Motion => Some(Measured { error: 0.0, case: "a motion that is given".into() }),
        QuantityOfInterest::PeakForce | QuantityOfInterest::History => {
            Some(Measured { error: BENDING_ERROR, case: case() })
        }
        QuantityOfInterest::Strain if is_clamped_wedge(scene, section) => {
            let case = "wedges of 12 to 34 degrees with clamped panels, against particles".into();
            Some(Measured { error: CLAMPED_STRESS_ERROR, case })
        }
        QuantityOfInterest::Strain => Some(Measured { error: BENDING_STRESS_ERROR, case: case() }),
        QuantityOfInterest::PeakPressure => None,
    }
}

/// Straight faces with elastic panels that are clamped at one end or both.
fn is_clamped_wedge(scene: &Scene, section: &Section) -> bool {
    let [least, most] = CLAMPED_FACES;
    let held = |panel: &Panel| {
        panel.ends.contains(&PanelEnd::Clamped)
            && panel.ends.iter().all(|end| matches!(end, PanelEnd::Clamped | PanelEnd::Pinned))
            && panel.end_springs.is_none()
            && panel.yield_stress.is_none()
    };
    section.radius().is_none()
        && section.deadrise_deg().is_some_and(|deadrise| (least - 1e-6..=most + 1e-6).contains(&deadrise))
        && scene.body.as_ref().is_some_and(|body| body.panels.iter().all(held))
}

/// Errors of force and largest pressure on a wedge at constant speed; of a quantity that the theory does not have, `None`.
fn coefficient_errors(model: EntryModel, deadrise_deg: f64) -> Option<[Option<f64>; 2]> {
    match model {
        EntryModel::Similarity => return Some([Some(SIMILARITY_ERROR); 2]),
        EntryModel::BoundaryElement => return Some(FLOW_ERRORS.map(Some)),
        _ => (),
    }
    let exact = SimilarityFlow::solve(deadrise_deg)?;
    let theory = Theory::at_constant_speed(model, Section::wedge(deadrise_deg, 1e3).ok()?).ok()?;
    let force = (theory.instants[0].force / exact.force_coefficient - 1.0).abs();
    let pressure = theory.peak_pressure(0).map(|[p, _]| (2.0 * p / exact.cp_max - 1.0).abs());
    Some([Some(force), pressure.filter(|_| model != EntryModel::VonKarman)])
}

/// A built-in scene of particles, of whose model nothing is asked.
fn built_in(name: &str) -> Option<Scene> {
    struct Particles;
    impl Models for Particles {
        fn columns(&self, scene: &Scene) -> Vec<String> {
            columns(scene)
        }
        fn holds(&self, _: &Scene, _: EntryModel) -> Result<(), OutOfRange> {
            Ok(())
        }
        fn spacing_within(&self, _: &Scene, _: QuantityOfInterest, _: f64) -> Option<f64> {
            None
        }
        fn choose(&self, of_particles: &[Scene], _: QuantityOfInterest, _: f64) -> Choice {
            Choice { model: of_particles[0].model, scene: 0, spacing: false, why: String::new() }
        }
    }
    Some(Loader::new(&Particles).load(name, &[]).ok()?.scene)
}

/// A built-in scene, and its series by a theory as far as it holds.
fn followed(name: &str, model: EntryModel) -> Option<(Scene, Series)> {
    let scene = built_in(name)?;
    let (theory, _) = Theory::while_in_range(&scene, model).ok()?;
    let mut series = Series::new(&scene, None).ok()?;
    theory.rows(&scene).into_iter().for_each(|row| series.push(row));
    Some((scene, series))
}

/// Largest RMS error of the benchmark's deflection over its peak, of those that others computed [-].
fn elastic_error() -> Option<Measured> {
    let (scene, series) = followed(BENCHMARK, EntryModel::Wagner)?;
    let judged = scene.compare.iter().filter(|c| c.tolerance.is_some());
    let errors = judged.filter_map(|c| compare::against_curve(c, &compare::curve(c).ok()?, &series));
    let error = errors.map(|c| c.error.abs()).reduce(f64::max)?;
    Some(Measured { error, case: format!("the deflection of {BENCHMARK}, against others' computations") })
}

fn drop_deadrise() -> Option<f64> {
    let scene = built_in(DROP)?;
    fsi_coupling::section_of(&scene.body?.shape).ok()?.deadrise_deg()
}

/// RMS error of a drop's speed over that at contact [-]: what the best theory was off in the validated drop, and what this one is
/// off the best in the scene's own, as far as both go.
fn drop_error(scene: &Scene, theory: &Theory) -> Option<f64> {
    if theory.model == EntryModel::BoundaryElement {
        return Some(FLOW_DROP_ERROR);
    }
    let best = [EntryModel::Similarity, EntryModel::Mlm].into_iter().find_map(|model| Theory::of(scene, model).ok())?;
    let here = theory.instants.iter().zip(&best.instants);
    let squares: Vec<f64> = here.map(|(a, b)| (a.speed - b.speed).powi(2)).collect();
    let fastest = best.instants.iter().map(|now| now.speed).fold(0.0, f64::max);
    let apart = (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt() / fastest;
    Some(apart + validated_drop_error(best.model)?)
}

/// RMS error of the validated drop's speed over that at contact [-], up to where the theory can follow.
fn validated_drop_error(model: EntryModel) -> Option<f64> {
    let (scene, series) = followed(DROP, model)?;
    let compare = scene.compare.iter().find(|c| c.reference.contains("bem"))?;
    Some(compare::against_curve(compare, &compare::curve(compare).ok()?, &series)?.error.abs())
}
