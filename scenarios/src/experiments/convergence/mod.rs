//! `splashdown study`: how a number of `summary.json` depends on spacing and sound speed, and its limit.
//!
//! A scene is run at every pair of a few spacings and sound speeds. [`fit()`] extrapolates to zero spacing and infinite
//! sound speed, with the observed order and an uncertainty (THEORY GE16). The result states whether the runs have converged.

mod fit;
mod page;
mod refinement;

use std::f64::consts::SQRT_2;

use scene::{Scene, compressibility_error};
use serde::Serialize;

use super::ExperimentError;
use super::runs::{run_to_end, scene_with};

pub use fit::{Fit, Sample, fit};
pub use page::{page, text};
pub(super) use refinement::sound_share;
pub use refinement::{Refinement, coarser_runs};

/// What is run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Name of a built-in scene, or path of a scene file.
    pub scene: String,
    /// Overrides, as for `--set`.
    pub sets: Vec<String>,
    /// Path of a number in `summary.json`, keys joined by `/`.
    pub quantity: String,
    /// Spacings [m]; empty: the scene's own, √2 and 2 times it.
    pub spacings: Vec<f64>,
    /// Sound speeds [m/s]; empty: the scene's own and half of it.
    pub sound_speeds: Vec<f64>,
}

/// One run of the study.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// Finest spacing [m].
    pub spacing_m: f64,
    /// Sound speed [m/s].
    pub sound_speed_m_per_s: f64,
    /// The flow's characteristic speed over the sound speed: the spray root's, or the fastest known speed [-].
    pub mach: f64,
    /// The quantity.
    pub value: f64,
    /// Relative difference from the extrapolated value [-].
    pub error: Option<f64>,
    /// Fluid particles.
    pub particles: usize,
    /// Steps.
    pub steps: u64,
    /// Wall-clock time × threads [s].
    pub core_seconds: f64,
    #[serde(skip)]
    law: f64,
}

/// A study, done.
#[derive(Clone, Debug, Serialize)]
pub struct Study {
    /// Name of the scene.
    pub scene: String,
    /// Path of the number in `summary.json`.
    pub quantity: String,
    /// The law f(M) of the sound speed's error.
    pub sound_speed_law: &'static str,
    /// The runs, from the coarsest.
    pub points: Vec<Point>,
    /// What they tend to.
    pub fit: Fit,
    /// Cost of all runs [s].
    pub core_seconds: f64,
}

/// Make a study; `tell` is called before each run with its number, the number of runs, spacing [m] and sound speed [m/s].
///
/// # Errors
/// The plan is wrong, a run ended early, or the runs cannot be distinguished.
pub fn study(plan: &Plan, tell: impl Fn(usize, usize, f64, f64)) -> Result<Study, ExperimentError> {
    let base = run::load(&plan.scene, &plan.sets)?.scene;
    if base.model.is_theory() {
        let expected = "a model of particles: a theory has no spacing".to_string();
        return Err(ExperimentError::Input { key: "model", given: base.model.name().into(), expected });
    }
    let own = base.resolution.spacing;
    let spacings = chosen("--spacings", &plan.spacings, &[2.0 * own, SQRT_2 * own, own])?;
    let own = base.sound_speed();
    let usual = if base.solver.is_incompressible() { vec![own] } else { vec![0.5 * own, own] };
    let speeds = chosen("--sound-speeds", &plan.sound_speeds, &usual)?;
    let pairs: Vec<[f64; 2]> = spacings.iter().flat_map(|dx| speeds.iter().map(|c| [*dx, *c])).collect();
    let at = |[dx, c]: &[f64; 2]| {
        let pair = [format!("resolution.spacing={dx:?}"), format!("fluid.sound_speed={c:?}")];
        scene_with(&plan.scene, &plan.sets, &pair)
    };
    let scenes = pairs.iter().map(at).collect::<Result<Vec<_>, _>>()?; // all are read before the first run
    let mut points = Vec::new();
    for (k, (scene, [dx, c])) in scenes.iter().zip(&pairs).enumerate() {
        tell(k + 1, pairs.len(), *dx, *c);
        points.push(point(plan, scene)?);
    }
    let samples: Vec<Sample> =
        points.iter().map(|p| Sample { spacing: p.spacing_m, law: p.law, value: p.value }).collect();
    let fit = fit(&samples).ok_or_else(|| ExperimentError::Input {
        key: "--sound-speeds",
        given: listed(&speeds),
        expected: "speeds whose effects can be distinguished from each other and from the spacing's".into(),
    })?;
    for point in &mut points {
        point.error = Some(point.value / fit.extrapolated - 1.0).filter(|e| e.is_finite());
    }
    let sound_speed_law = match base.entry() {
        Some(_) => "M^2 ln(1/M), M of the spray root (THEORY WC17)",
        None => "M^2, M of the fastest speed known beforehand",
    };
    let core_seconds = points.iter().map(|p| p.core_seconds).sum();
    Ok(Study { scene: base.name, quantity: plan.quantity.clone(), sound_speed_law, points, fit, core_seconds })
}

/// The values given, or the usual ones, from the largest spacing and the lowest speed.
fn chosen(key: &'static str, given: &[f64], usual: &[f64]) -> Result<Vec<f64>, ExperimentError> {
    let mut values = if given.is_empty() { usual.to_vec() } else { given.to_vec() };
    values.sort_by(f64::total_cmp);
    let sound = values.iter().all(|v| *v > 0.0 && v.is_finite()) && values.windows(2).all(|w| w[0] < w[1]);
    if !sound {
        let expected = "different finite numbers above 0".to_string();
        return Err(ExperimentError::Input { key, given: listed(given), expected });
    }
    if key == "--spacings" {
        values.reverse();
    }
    Ok(values)
}

fn listed(values: &[f64]) -> String {
    values.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}

fn point(plan: &Plan, scene: &Scene) -> Result<Point, ExperimentError> {
    let run = run_to_end(scene)?;
    let value = run.numbers.get(&plan.quantity);
    let value = value.ok_or_else(|| ExperimentError::unknown_quantity(&plan.quantity, &run.numbers.paths()))?;
    let c = scene.sound_speed();
    let root = scene.entry().map(|entry| entry.root_speed());
    let mach = root.unwrap_or_else(|| scene.fastest_speed()) / c;
    Ok(Point {
        spacing_m: scene.resolution.spacing,
        sound_speed_m_per_s: c,
        mach,
        value,
        error: None,
        particles: run.summary.particles.fluid,
        steps: run.summary.steps,
        core_seconds: run.core_seconds(),
        law: root.map_or(mach * mach, |speed| compressibility_error(speed, c)),
    })
}

impl Study {
    /// As the text of `study.json`.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a study holds nothing that JSON cannot say")
    }
}
