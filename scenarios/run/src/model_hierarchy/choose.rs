//! `model = "auto"`: the cheapest model whose measured error is within the tolerance.

use scene::{Choice, QuantityOfInterest, Scene, core_seconds};
use settings::significant;

use super::{Assessment, Measured, assess};
use crate::charted::charted_error;

/// Path in `summary.json` of the charted number for a quantity of interest, with `BODY` for the body's name.
pub fn charted_number(want: QuantityOfInterest) -> Option<&'static str> {
    match want {
        QuantityOfInterest::PeakForce | QuantityOfInterest::History => Some("similarity/force_coefficient"),
        QuantityOfInterest::PeakPressure => Some("similarity/cp_max"),
        QuantityOfInterest::Motion => Some("means/BODY.vy_m_per_s"),
        QuantityOfInterest::Strain => None,
    }
}

/// The cheapest model whose measured error meets the tolerance: of the theories, in their order; then of the same scene by
/// particles, with one solver or several, by estimated cost. The first scene's solver where nothing does.
pub fn choose(of_particles: &[Scene], want: QuantityOfInterest, within: f64) -> Choice {
    let per_cent = |share: f64| format!("{} %", significant(100.0 * share));
    let reason_for = |model: &str, m: &Measured| {
        let (within, off) = (per_cent(within), per_cent(m.error));
        format!("{model}: the cheapest model within {within} for {}: {off} off in {}", want.words(), m.case)
    };
    let theories = assess(&of_particles[0], want);
    let near = |m: &&Measured| m.error <= within;
    if let Some((model, m)) = theories.iter().find_map(|a| Some((a.model, a.measured.as_ref().filter(near)?))) {
        return Choice { model, scene: 0, spacing: false, why: reason_for(model.name(), m) };
    }
    let charted = of_particles.iter().enumerate().filter_map(|(k, scene)| {
        let (error, from) = charted_error(scene, charted_number(want)?)?;
        Some((k, Measured { error, case: format!("the charts of {from}, 9 runs of 10") }))
    });
    let cost = |k: &usize| core_seconds(&of_particles[*k]);
    let cheapest = charted.filter(|(_, m)| m.error <= within).min_by(|a, b| cost(&a.0).total_cmp(&cost(&b.0)));
    if let Some((k, m)) = cheapest {
        let Scene { model, resolution, .. } = &of_particles[k];
        let at = format!("{} at {} m", model.name(), significant(resolution.spacing));
        return Choice { model: *model, scene: k, spacing: true, why: reason_for(&at, &m) };
    }
    let model = of_particles[0].model;
    let known = reason(&theories);
    let (name, within, want) = (model.name(), per_cent(within), want.words());
    let why = format!("{name}: no model is known to be within {within} for {want}: {known}");
    Choice { model, scene: 0, spacing: false, why }
}

/// Why no theory is chosen.
fn reason(theories: &[Assessment]) -> String {
    let measured = theories.iter().filter_map(|a| Some((a.model, a.measured.as_ref()?)));
    if let Some((model, m)) = measured.min_by(|a, b| a.1.error.total_cmp(&b.1.error)) {
        return format!("the best theory, {}, is {} % off in {}", model.name(), significant(100.0 * m.error), m.case);
    }
    if let Some(holds) = theories.iter().rev().find(|a| a.obstacle.is_none()) {
        let model = holds.model.name();
        return format!(
            "{model} holds, but its error was not measured near this scene; model = \"{model}\" without want and within runs it"
        );
    }
    let nearest = theories.iter().find(|a| a.begins).or(theories.last()); // the last holds for most sections
    let why = nearest.and_then(|a| Some(format!("{} {}", a.model.name(), a.obstacle.as_ref()?)));
    why.unwrap_or_default()
}
