//! How near to its value each result is: by the band of its run, or by the study of three spacings.

use run::error_bar::{ErrorBar, ErrorBars};
use scene::Scene;
use scene::vocabulary::{ResultId, Results};
use serde::Serialize;

use super::level::Level;
use crate::experiments::convergence::{Sample, fit, sound_share};

/// Spacings of a study.
const STUDIED: usize = 3;

/// What a band is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum By {
    /// The band that the run states.
    Run,
    /// The error bar of the study.
    Study,
    /// Neither has one.
    Nothing,
}

/// A result and how near it is.
#[derive(Clone, Debug, Serialize)]
pub struct Achieved {
    /// Its name, with the panel.
    pub name: String,
    /// Its value, in the unit that its name ends with.
    pub value: f64,
    /// Half width of its band over the value [-]; `null` where none is known.
    pub share: Option<f64>,
    /// What the band is of.
    pub by: By,
    /// Whether it is within the share asked for.
    pub within: bool,
}

/// The path of a result in `summary.json`.
fn path(id: &ResultId) -> String {
    match &id.panel {
        None => format!("results/{}/value", id.name.name()),
        Some(panel) => format!("results/panels/{panel}/{}/value", id.name.name()),
    }
}

/// The results of a run, with the smaller of the two bands of each.
pub(super) fn achieved(chosen: &[ResultId], results: &Results, bars: &ErrorBars, share: f64) -> Vec<Achieved> {
    let of = |id: &ResultId| {
        let named = results.named().find(|(known, _)| known == id);
        let value = named.as_ref().map_or(f64::NAN, |(_, quantity)| quantity.value);
        let by_run = named.and_then(|(_, quantity)| quantity.share().filter(|_| quantity.verdict.is_sound()));
        let by_study = bars.get(&path(id)).map(|bar| (bar.band / value).abs());
        let (own, by) = match (by_run, by_study) {
            (Some(run), Some(study)) if study < run => (Some(study), By::Study),
            (Some(run), _) => (Some(run), By::Run),
            (None, Some(study)) => (Some(study), By::Study),
            (None, None) => (None, By::Nothing),
        };
        Achieved { name: id.to_string(), value, share: own, by, within: own.is_some_and(|own| own <= share) }
    };
    chosen.iter().map(of).collect()
}

/// Error bars of the results of the run at the finest spacing, from it and the two next coarser ones: without an observed
/// order the band is three times their range (GE16).
pub(super) fn bars(scene: &Scene, levels: &[Level], finest: &Level, chosen: &[ResultId]) -> ErrorBars {
    let mut studied: Vec<&Level> = levels.iter().filter(|level| level.spacing > finest.spacing * 1.01).collect();
    studied.sort_by(|a, b| a.spacing.total_cmp(&b.spacing));
    let studied: Vec<&Level> = std::iter::once(finest).chain(studied).take(STUDIED).collect();
    let bar = |id: &ResultId| {
        let sample = |level: &&Level| Some(Sample { spacing: level.spacing, law: 1.0, value: level.get(id)?.value });
        let samples: Vec<Sample> = studied.iter().map(sample).collect::<Option<_>>()?;
        let found = fit(&samples).filter(|found| samples.len() == STUDIED && found.uncertainty.is_finite())?;
        let sound = sound_share(scene)? * found.extrapolated.abs();
        Some((
            path(id),
            ErrorBar {
                value: samples[0].value,
                extrapolated: Some(found.extrapolated),
                band: found.uncertainty * found.extrapolated.abs() + sound,
                order: found.order,
                verdict: found.verdict(),
                method: "study of three spacings at one bandwidth".into(),
            },
        ))
    };
    chosen.iter().filter_map(bar).collect()
}
