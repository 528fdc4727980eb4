//! `splashdown run --to`: the cheapest run whose quoted results are within a share of their values.
//!
//! Theories come first, from the cheapest: their bands are known. Particles follow: the scene's own run, whose bandwidths are held from then
//! on, and runs at 2 and 4 times its spacing. It ends when each result has a band, of the run or of the study of the three, within the share
//! asked for; else with a finer spacing. Runs that a folder already has are not made again.

mod level;
mod target;

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use run::error_bar::ErrorBars;
use run::model_hierarchy::assess;
use run::summary::Summary;
use scene::vocabulary::{Quantity, ResultId, ResultName, Results};
use scene::{Loaded, Scene};
use serde::Serialize;

use super::ExperimentError;
use crate::preflight::preflight;
use level::Level;
pub use target::{Achieved, By};
use target::{achieved, bars};

/// Finer runs that are tried.
const ROUNDS: usize = 4;
/// A spacing is not made finer by more than this in one round [-].
const FINEST_STEP: f64 = 0.25;
/// Share of the spacing that a band asks for which is taken: bands scatter [-].
const MARGIN: f64 = 0.9;
/// Spacings of the coarser runs over that of the run.
const COARSER: [f64; 2] = [4.0, 2.0];

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Request {
    /// Name of a built-in scene, or path of a scene file.
    pub scene: String,
    /// Overrides, as for `--set`.
    pub sets: Vec<String>,
    /// Largest half width of a band over the value [-].
    pub share: f64,
    /// Results, as `peak_force_N_per_m` or `PANEL.peak_stress_Pa`; empty: those that the scene's own run gives as sound.
    pub results: Vec<String>,
    /// Folder of the runs.
    pub out: PathBuf,
    /// Set from outside to end the present run after a step; its checkpoint stays.
    pub interrupt: Option<&'static AtomicBool>,
}

/// How it ended.
#[derive(Clone, Debug, Serialize)]
pub struct Done {
    /// The model of the last run.
    pub model: String,
    /// Its folder.
    pub folder: PathBuf,
    /// Its spacing [m]; absent for a theory.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spacing_m: Option<f64>,
    /// Its results.
    pub results: Vec<Achieved>,
    /// Whether all are within the share asked for.
    pub within: bool,
    /// Core-seconds that were stated before the runs, without those that their folders had.
    pub estimated_core_seconds: f64,
    /// Core-seconds of the runs that were made.
    pub core_seconds: f64,
}

impl Request {
    fn scene(&self, further: &[String]) -> Result<Loaded, ExperimentError> {
        Ok(run::load(&self.scene, &[&self.sets, further].concat())?)
    }

    /// The results that count: those asked for; else those against which nothing speaks in the first run, or all where none is so.
    fn chosen(&self, results: &Results) -> Vec<ResultId> {
        let of = |keep: &dyn Fn(&ResultId, &Quantity) -> bool| -> Vec<ResultId> {
            results.named().filter(|(id, quantity)| keep(id, quantity)).map(|(id, _)| id).collect()
        };
        if !self.results.is_empty() {
            return of(&|id, _| self.results.contains(&id.to_string()));
        }
        let sound = of(&|id, quantity| id.name != ResultName::ReserveFactor && quantity.verdict.is_sound());
        if sound.is_empty() { of(&|id, _| id.name != ResultName::ReserveFactor) } else { sound }
    }
}

/// Runs as little as is needed; `tell` is called with sentences on what comes next.
///
/// # Errors
/// The scene is wrong, a result is unknown, or a run could not be made.
pub fn refine(request: &Request, tell: impl Fn(String)) -> Result<Done, ExperimentError> {
    let own = request.scene(&[])?;
    refuse_unknown(&request.results, &own.scene)?;
    let named = own.scene.choice.is_none() && ["model", "solver"].iter().any(|key| own.names(key));
    if !named || own.scene.model.is_theory() {
        if let Some(done) = by_theory(request, &own.scene, named, &tell)? {
            return Ok(done);
        }
        if named {
            let expected = format!("a model with results within {} %, or model = \"auto\"", 100.0 * request.share);
            return Err(ExperimentError::Input { key: "model", given: own.scene.model.name().into(), expected });
        }
    }
    by_particles(request, own.scene.model.is_theory(), &tell)
}

/// Refuses names that no result has, before the first run.
fn refuse_unknown(asked: &[String], scene: &Scene) -> Result<(), ExperimentError> {
    let panels: Vec<&str> = scene.all_bodies().flat_map(|body| &body.panels).map(|panel| panel.name.as_str()).collect();
    let is_known = |name: &String| match name.rsplit_once('.') {
        Some((panel, result)) => panels.contains(&panel) && ResultName::of(result).is_some(),
        None => ResultName::of(name).is_some(),
    };
    if asked.iter().all(is_known) {
        return Ok(());
    }
    let of_panels = panels.iter().map(|panel| format!("{panel}.{}", ResultName::PeakStress.name()));
    let names = [ResultName::PeakForce, ResultName::PeakAcceleration, ResultName::PeakPressure, ResultName::Impulse];
    let known: Vec<String> = names.map(|name| name.name().to_string()).into_iter().chain(of_panels).collect();
    Err(ExperimentError::unknown_result(asked, &known))
}

/// The cheapest theory that quotes all results asked for within the share.
fn by_theory(
    request: &Request,
    own: &Scene,
    named: bool,
    tell: &impl Fn(String),
) -> Result<Option<Done>, ExperimentError> {
    let mut spent = 0.0;
    for theory in assess(own, own.want).into_iter().filter(|t| t.model.is_theory() && t.obstacle.is_none()) {
        if named && theory.model != own.model {
            continue;
        }
        let name = theory.model.name();
        let loaded = request.scene(&[format!("model={name}")])?;
        let estimated = theory.core_seconds.unwrap_or_default();
        tell(format!("{name}: about {estimated:.1} core-s"));
        let folder = request.out.join(name);
        let level = Level::run(&loaded, folder.clone(), None, request.interrupt)?;
        spent += level.core_seconds;
        let chosen = request.chosen(&level.results);
        let results = achieved(&chosen, &level.results, &ErrorBars::new(), request.share);
        let complete = results.len() >= request.results.len().max(1);
        if complete && results.iter().all(|result| result.within) {
            return Ok(Some(Done {
                model: name.into(),
                folder,
                spacing_m: None,
                results,
                within: true,
                estimated_core_seconds: estimated,
                core_seconds: spent,
            }));
        }
    }
    Ok(None)
}

/// `instead`: the scene's own model is a theory that did not do.
fn by_particles(request: &Request, instead: bool, tell: &impl Fn(String)) -> Result<Done, ExperimentError> {
    let mut further: Vec<String> = instead.then(|| "model=wcsph".to_string()).into_iter().collect();
    let pilot = request.scene(&further)?;
    let at_start = pilot.scene.resolution.spacing;
    let mut estimated = cost(request, &pilot.scene);
    tell(format!("the scene as it is, spacing {at_start:.6} m: about {estimated:.0} core-s"));
    let first = Level::run(&pilot, folder(request, at_start), None, request.interrupt)?;
    let chosen = request.chosen(&first.results);
    if chosen.is_empty() {
        let known: Vec<String> = first.results.named().map(|(id, _)| id.to_string()).collect();
        return Err(ExperimentError::unknown_result(&request.results, &known));
    }
    further.extend(first.bandwidths());
    let mut levels = vec![first];
    let mut spacing = at_start; // its study costs a seventh of the run
    for round in 1..=ROUNDS {
        let at = |spacing: f64| request.scene(&[&further[..], &[format!("resolution.spacing={spacing:?}")]].concat());
        let needed: Vec<f64> = COARSER.iter().map(|times| times * spacing).chain([spacing]).collect();
        let missing: Vec<f64> = needed.into_iter().filter(|dx| !levels.iter().any(|level| level.is_at(*dx))).collect();
        let scenes = missing.iter().map(|dx| at(*dx)).collect::<Result<Vec<_>, _>>()?; // all are read before the first run
        let more: f64 = scenes.iter().map(|loaded| cost(request, &loaded.scene)).sum();
        estimated += more;
        tell(format!("round {round}: spacing {spacing:.6} m, {} runs: about {more:.0} core-s", scenes.len()));
        for (loaded, dx) in scenes.iter().zip(&missing) {
            let studied = |summary: &Summary| bars(&loaded.scene, &levels, &Level::of(*dx, summary), &chosen);
            let bars: Option<&(dyn Fn(&Summary) -> ErrorBars + Sync)> = Some(&studied);
            let level = Level::run(loaded, folder(request, *dx), bars.filter(|_| *dx == spacing), request.interrupt)?;
            levels.push(level);
        }
        let finest = levels.iter().find(|level| level.is_at(spacing)).expect("it was run");
        let bars = bars(&at(spacing)?.scene, &levels, finest, &chosen);
        let results = achieved(&chosen, &finest.results, &bars, request.share);
        let within = results.iter().all(|result| result.within);
        if within || round == ROUNDS {
            return Ok(Done {
                model: finest.model.clone(),
                folder: folder(request, spacing),
                spacing_m: Some(spacing),
                results,
                within,
                estimated_core_seconds: estimated,
                core_seconds: levels.iter().map(|level| level.core_seconds).sum(),
            });
        }
        spacing = finer(spacing, &results, request.share);
    }
    unreachable!("the last round returns")
}

/// The next spacing [m]: errors fall with the spacing at least. A half lets the next study take runs of this one.
fn finer(spacing: f64, results: &[Achieved], share: f64) -> f64 {
    let needed = |result: &Achieved| result.share.map_or(0.5, |own| MARGIN * share / own);
    let factor = results.iter().filter(|result| !result.within).map(needed).fold(1.0, f64::min);
    match factor.max(FINEST_STEP) {
        factor if factor >= 1.0 => spacing,
        factor if factor > 0.4 => 0.5 * spacing,
        factor => factor * spacing,
    }
}

/// What a run will cost [core-s]; nothing where its folder has it.
fn cost(request: &Request, scene: &Scene) -> f64 {
    let folder = folder(request, scene.resolution.spacing);
    if Level::is_done(scene, &folder) { 0.0 } else { preflight(scene, &[]).core_seconds }
}

fn folder(request: &Request, spacing: f64) -> PathBuf {
    request.out.join(format!("spacing_{spacing:.6}"))
}
