//! `splashdown validate`: cases that hold a scene's numbers against others' data.
//!
//! A case is a TOML file in `scenarios/cases/validation`: a scene, overrides, and what its `summary.json` must say.
//! There is no source code in a case.

use std::path::PathBuf;

use include_dir::{Dir, include_dir};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::embedded;
use crate::run::{self, RunError, RunOptions};
use crate::scene::{self, Scene, SceneError};
use crate::summary::Summary;

static CASES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/cases/validation");

/// A validation case.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Name, that of its file.
    #[serde(skip)]
    pub name: String,
    /// What is shown.
    pub about: String,
    /// Name of a built-in scene.
    pub scene: String,
    /// Overrides, as for `--set`.
    #[serde(default)]
    pub set: Vec<String>,
    /// Require every judged comparison of the scene to pass.
    #[serde(default)]
    pub comparisons: bool,
    /// Numbers that must hold.
    #[serde(default)]
    pub expect: Vec<Expect>,
    /// A coarser run of the same, whose errors must be larger.
    pub coarser: Option<Coarser>,
}

/// A number of `summary.json` and what it must be: near a reference, or within bounds.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expect {
    /// Path in `summary.json`, keys joined by `/`.
    pub value: String,
    /// What it should be.
    pub reference: Option<f64>,
    /// Largest relative difference from the reference.
    pub tolerance: Option<f64>,
    /// Largest magnitude.
    pub at_most: Option<f64>,
    /// Where the reference is from.
    pub source: String,
}

/// A coarser run.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coarser {
    /// Further overrides.
    pub set: Vec<String>,
    /// Paths of expected numbers whose error must fall from the coarser run to the finer: the relative error
    /// where the number has a reference, else the number itself.
    pub error_falls: Vec<String>,
    /// Errors below this need not fall any further: they are lost in the noise.
    #[serde(default)]
    pub noise: f64,
}

/// A line of the table.
#[derive(Clone, Debug, Serialize)]
pub struct Line {
    /// The case.
    pub case: String,
    /// The number.
    pub quantity: String,
    /// Ours.
    pub ours: f64,
    /// What it is held against.
    pub theirs: String,
    /// The error, where there is a reference.
    pub error: Option<f64>,
    /// What is allowed.
    pub allowed: String,
    /// Whether it holds.
    pub holds: bool,
    /// Where the reference is from.
    pub source: String,
    /// Core-seconds of the case's run.
    pub core_seconds: f64,
}

/// A case that cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum ValidateError {
    /// No case of that name.
    #[error("no validation case `{0}`; there are: {1}")]
    Unknown(String, String),
    /// The case's file is wrong.
    #[error("validation case `{0}`: {1}")]
    Case(String, String),
    /// The case's scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The run could not be made.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// All cases, by name.
pub fn cases() -> Result<Vec<Case>, ValidateError> {
    let all: Vec<(String, Case)> = embedded::all(&CASES).map_err(|(name, why)| ValidateError::Case(name, why))?;
    Ok(all.into_iter().map(|(name, case)| Case { name, ..case }).collect())
}

/// The cases of the given names; all of them if none is given.
pub fn select(names: &[String]) -> Result<Vec<Case>, ValidateError> {
    let all = cases()?;
    let known = all.iter().map(|c| c.name.as_str()).collect::<Vec<_>>().join(", ");
    if let Some(stranger) = names.iter().find(|n| all.iter().all(|c| c.name != **n)) {
        return Err(ValidateError::Unknown(stranger.clone(), known));
    }
    Ok(all.into_iter().filter(|c| names.is_empty() || names.contains(&c.name)).collect())
}

/// Run a case; its files go to a folder of its name under `out`, if one is given.
pub fn run_case(case: &Case, out: Option<&PathBuf>) -> Result<Vec<Line>, ValidateError> {
    let (scene, summary) = run_with(case, &[], out.map(|dir| dir.join(&case.name)))?;
    let cost = summary.wall_time_s * summary.threads as f64;
    let json = serde_json::to_value(&summary).unwrap_or_default();
    let mut lines: Vec<Line> = case.expect.iter().map(|e| judge(case, e, &json, cost)).collect();
    if case.comparisons {
        lines.extend(summary.comparison.iter().filter(|c| c.tolerance.is_some()).map(|c| Line {
            case: case.name.clone(),
            quantity: c.quantity.clone(),
            ours: c.ours,
            theirs: number(c.theirs),
            error: Some(c.error),
            allowed: c.tolerance.map_or(String::new(), number),
            holds: c.passes(),
            source: c.reference.clone(),
            core_seconds: cost,
        }));
        let judged = summary.comparison.iter().filter(|c| c.tolerance.is_some()).count();
        lines.extend(missing(case, &scene, judged, cost));
    }
    if let Some(coarser) = &case.coarser {
        let coarse = serde_json::to_value(run_with(case, &coarser.set, None)?.1).unwrap_or_default();
        lines.extend(coarser.error_falls.iter().map(|path| falls(case, coarser, path, &json, &coarse, cost)));
    }
    let finished = summary.status == crate::summary::Status::Completed;
    lines.iter_mut().for_each(|l| l.holds &= finished);
    Ok(lines)
}

/// The line that says so when a run gave nothing to judge some of its scene's comparisons by.
fn missing(case: &Case, scene: &Scene, judged: usize, core_seconds: f64) -> Option<Line> {
    let asked = scene.compare.iter().filter(|c| c.tolerance.is_some()).count();
    (judged < asked).then(|| Line {
        case: case.name.clone(),
        quantity: "comparisons that the run could be judged by".into(),
        ours: judged as f64,
        theirs: number(asked as f64),
        error: None,
        allowed: "all".into(),
        holds: false,
        source: case.scene.clone(),
        core_seconds,
    })
}

fn run_with(case: &Case, further: &[String], out: Option<PathBuf>) -> Result<(Scene, Summary), ValidateError> {
    let sets: Vec<String> = case.set.iter().chain(further).cloned().collect();
    let loaded = scene::load(&case.scene, &sets)?;
    let options = RunOptions { out, force: true, warnings: loaded.warnings, ..RunOptions::default() };
    let summary = run::run(&loaded.scene, &options)?.summary;
    Ok((loaded.scene, summary))
}

fn read(json: &Value, path: &str) -> f64 {
    json.pointer(&format!("/{path}")).and_then(Value::as_f64).unwrap_or(f64::NAN)
}

fn judge(case: &Case, expect: &Expect, json: &Value, core_seconds: f64) -> Line {
    let ours = read(json, &expect.value);
    let error = expect.reference.map(|r| ours / r - 1.0);
    let near = match (error, expect.tolerance) {
        (Some(error), Some(tolerance)) => error.abs() <= tolerance,
        _ => expect.at_most.is_some(), // a number that nothing bounds is not judged: it does not hold
    };
    let bounded = expect.at_most.is_none_or(|bound| ours.abs() <= bound);
    let mut allowed = Vec::new();
    allowed.extend(expect.tolerance.map(|t| format!("{} %", number(100.0 * t))));
    allowed.extend(expect.at_most.map(|b| format!("at most {}", number(b))));
    Line {
        case: case.name.clone(),
        quantity: expect.value.clone(),
        ours,
        theirs: expect.reference.map_or(String::new(), number),
        error,
        allowed: allowed.join(", "),
        holds: near && bounded && ours.is_finite(),
        source: expect.source.clone(),
        core_seconds,
    }
}

fn falls(case: &Case, coarser: &Coarser, path: &str, fine: &Value, coarse: &Value, core_seconds: f64) -> Line {
    let reference = case.expect.iter().find(|e| e.value == path).and_then(|e| e.reference);
    let error = |json: &Value| reference.map_or(read(json, path), |r| read(json, path) / r - 1.0);
    let (fine, coarse) = (error(fine), error(coarse));
    let noise = coarser.noise;
    Line {
        case: case.name.clone(),
        quantity: format!("{path}, error against the coarser run's"),
        ours: fine,
        theirs: number(coarse),
        error: None,
        allowed: if noise > 0.0 { format!("smaller, or both below {}", number(noise)) } else { "smaller".into() },
        holds: fine.abs() < coarse.abs() || fine.abs().max(coarse.abs()) < noise,
        source: coarser.set.join(" "),
        core_seconds,
    }
}

/// The table as Markdown.
pub fn to_markdown(lines: &[Line]) -> String {
    let mut text = String::from(
        "| case | quantity | ours | reference | error | allowed | holds | core-s | source |\n|---|---|---|---|---|---|---|---|---|\n",
    );
    for l in lines {
        let error = l.error.map_or(String::new(), |e| format!("{:+.2} %", 100.0 * e));
        let holds = if l.holds { "yes" } else { "**no**" };
        text += &format!(
            "| {} | {} | {} | {} | {error} | {} | {holds} | {:.0} | {} |\n",
            l.case,
            l.quantity,
            number(l.ours),
            l.theirs,
            l.allowed,
            l.core_seconds,
            l.source
        );
    }
    text
}

/// Six digits, in powers of ten where they would not show otherwise.
fn number(x: f64) -> String {
    if x == 0.0 {
        "0".into()
    } else if (1e-3..1e6).contains(&x.abs()) {
        let digits = (5.0 - x.abs().log10().floor()).max(0.0) as usize;
        let text = format!("{x:.digits$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
    } else {
        format!("{x:.2e}")
    }
}
