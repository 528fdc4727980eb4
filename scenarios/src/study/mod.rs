//! `splashdown study`: how a number of `summary.json` depends on spacing and sound speed, and what it tends to.
//!
//! A scene is run at every pair of a few spacings and sound speeds; [`fit`] extrapolates to zero spacing and infinite
//! sound speed, with the observed order and an uncertainty (THEORY G6). The words "not converged" are part of the answer.

mod bands;
mod converge;
mod fit;
mod page;
mod table;

use std::f64::consts::SQRT_2;

use serde::Serialize;
use serde_json::Value;

use crate::run::{self, RunError, RunOptions};
use crate::scene::{self, Scene, SceneError, compressibility_error};
use crate::summary::{Status, Summary};

pub use bands::{BandCase, BandLine, band_cases, hold, select_bands, to_markdown};
pub use converge::{Coarser, coarser};
pub use fit::{Fit, Sample, fit};
pub use page::page;

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

/// A study that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A run could not be made.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A run did not reach its end.
    #[error("the run at spacing {0} m and sound speed {1} m/s ended early: {2}")]
    Ended(f64, f64, String),
    /// A case of bands is wrong, or there is none of that name.
    #[error("case of bands `{0}`: {1}")]
    Case(String, String),
    /// A value is wrong.
    #[error("{key} {given}: expected {expected}")]
    Input {
        /// The option.
        key: &'static str,
        /// What was given.
        given: String,
        /// What was expected.
        expected: String,
    },
}

impl StudyError {
    fn unknown_quantity(path: &str, known: &[String]) -> StudyError {
        let expected = format!("the path of a number in summary.json: {}", known.join(", "));
        StudyError::Input { key: "--quantity", given: path.to_string(), expected }
    }

    /// True if the user's input is at fault.
    pub fn is_input(&self) -> bool {
        match self {
            StudyError::Scene(_) | StudyError::Case(..) | StudyError::Input { .. } => true,
            StudyError::Run(error) => error.is_input(),
            StudyError::Ended(..) => false,
        }
    }
}

/// Make a study; `tell` hears of each run before it starts: its number, how many there are, spacing and sound speed.
pub fn study(plan: &Plan, tell: impl Fn(usize, usize, f64, f64)) -> Result<Study, StudyError> {
    let base = scene::load(&plan.scene, &plan.sets)?.scene;
    if base.model.is_theory() {
        let expected = "a model of particles: a theory has no spacing".to_string();
        return Err(StudyError::Input { key: "model", given: base.model.name().into(), expected });
    }
    let own = base.resolution.spacing;
    let spacings = chosen("--spacings", &plan.spacings, &[2.0 * own, SQRT_2 * own, own])?;
    let own = base.sound_speed();
    let usual = if base.solver.is_incompressible() { vec![own] } else { vec![0.5 * own, own] };
    let speeds = chosen("--sound-speeds", &plan.sound_speeds, &usual)?;
    let pairs: Vec<[f64; 2]> = spacings.iter().flat_map(|dx| speeds.iter().map(|c| [*dx, *c])).collect();
    // Every scene is read before any is run: what is wrong is said at once.
    let scenes = pairs.iter().map(|pair| at(plan, *pair)).collect::<Result<Vec<_>, _>>()?;
    let mut points = Vec::new();
    for (k, (scene, [dx, c])) in scenes.iter().zip(&pairs).enumerate() {
        tell(k + 1, pairs.len(), *dx, *c);
        points.push(point(plan, scene)?);
    }
    let samples: Vec<Sample> =
        points.iter().map(|p| Sample { spacing: p.spacing_m, law: p.law, value: p.value }).collect();
    let fit = fit(&samples).ok_or_else(|| StudyError::Input {
        key: "--sound-speeds",
        given: listed(&speeds),
        expected: "speeds whose effects can be told from each other and from the spacing's".into(),
    })?;
    for point in &mut points {
        point.error = Some(point.value / fit.extrapolated - 1.0).filter(|e| e.is_finite());
    }
    let sound_speed_law = match base.entry() {
        Some(_) => "M^2 ln(1/M), M of the spray root (THEORY E19)",
        None => "M^2, M of the fastest speed known beforehand",
    };
    let core_seconds = points.iter().map(|p| p.core_seconds).sum();
    Ok(Study { scene: base.name, quantity: plan.quantity.clone(), sound_speed_law, points, fit, core_seconds })
}

/// The values given, or the usual ones, from the largest spacing and the lowest speed.
fn chosen(key: &'static str, given: &[f64], usual: &[f64]) -> Result<Vec<f64>, StudyError> {
    let mut values = if given.is_empty() { usual.to_vec() } else { given.to_vec() };
    values.sort_by(f64::total_cmp);
    let sound = values.iter().all(|v| *v > 0.0 && v.is_finite()) && values.windows(2).all(|w| w[0] < w[1]);
    if !sound {
        let expected = "different finite numbers above 0".to_string();
        return Err(StudyError::Input { key, given: listed(given), expected });
    }
    if key == "--spacings" {
        values.reverse();
    }
    Ok(values)
}

fn listed(values: &[f64]) -> String {
    values.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}

/// The plan's scene at a spacing and a sound speed.
fn at(plan: &Plan, [dx, c]: [f64; 2]) -> Result<Scene, SceneError> {
    let mut sets = plan.sets.clone();
    sets.extend([format!("resolution.spacing={dx:?}"), format!("fluid.sound_speed={c:?}")]);
    Ok(scene::load(&plan.scene, &sets)?.scene)
}

fn point(plan: &Plan, scene: &Scene) -> Result<Point, StudyError> {
    let (dx, c) = (scene.resolution.spacing, scene.sound_speed());
    let summary = run::run(scene, &RunOptions::default())?.summary;
    if summary.status != Status::Completed {
        return Err(StudyError::Ended(dx, c, summary.message.unwrap_or_default()));
    }
    let root = scene.entry().map(|entry| entry.root_speed());
    let mach = root.unwrap_or_else(|| scene.fastest_speed()) / c;
    Ok(Point {
        spacing_m: dx,
        sound_speed_m_per_s: c,
        mach,
        value: number(&summary, &plan.quantity)?,
        error: None,
        particles: summary.particles.fluid,
        steps: summary.steps,
        core_seconds: summary.wall_time_s * summary.threads as f64,
        law: root.map_or(mach * mach, |speed| compressibility_error(speed, c)),
    })
}

/// The number at a path of a summary.
fn number(summary: &Summary, path: &str) -> Result<f64, StudyError> {
    let json = serde_json::to_value(summary).unwrap_or_default();
    let found = json.pointer(&format!("/{path}")).and_then(Value::as_f64);
    found.ok_or_else(|| StudyError::unknown_quantity(path, &listed_numbers(&json)))
}

/// Paths of all numbers of a summary.
fn listed_numbers(json: &Value) -> Vec<String> {
    let mut known = Vec::new();
    numbers("", json, &mut known);
    known
}

/// Paths of all numbers below a value.
fn numbers(path: &str, value: &Value, known: &mut Vec<String>) {
    let below = |key: &str| if path.is_empty() { key.to_string() } else { format!("{path}/{key}") };
    match value {
        Value::Number(_) => known.push(path.to_string()),
        Value::Array(items) => items.iter().enumerate().for_each(|(k, v)| numbers(&below(&k.to_string()), v, known)),
        Value::Object(map) => map.iter().for_each(|(key, v)| numbers(&below(key), v, known)),
        _ => {}
    }
}

impl Study {
    /// "converged", or "not converged" and why.
    pub fn verdict(&self) -> String {
        match self.fit.converged {
            true => "converged".to_string(),
            false => format!("not converged: {}", self.fit.doubts.join("; ")),
        }
    }

    /// As the text of `study.json`.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a study holds nothing that JSON cannot say")
    }
}
