//! `splashdown chart`: what an answer costs, and how wrong it is, for each way to get it.
//!
//! A chart is a TOML file in `tests/charts`: a scene, a number of its `summary.json` whose exact value is known, and
//! families of runs, each of one solver or setting at growing effort. Every run is made on this machine; its JSON draws
//! the chart again without a run.

mod page;

use std::path::Path;

use include_dir::{Dir, include_dir};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::embedded;
use crate::run::{self, RunError, RunOptions};
use crate::scene::{self, Scene, SceneError};
use crate::summary::Status;

pub use page::{page, svg, table};

static CASES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../tests/charts");

/// What is charted.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Name, that of its file.
    #[serde(default)]
    pub name: String,
    /// What is shown.
    pub about: String,
    /// Name of a built-in scene, or path of a scene file.
    pub scene: String,
    /// Overrides of every run, as for `--set`.
    #[serde(default)]
    pub set: Vec<String>,
    /// Path of a number in `summary.json`, keys joined by `/`.
    pub quantity: String,
    /// Its exact or measured value.
    pub reference: f64,
    /// Path of its standard deviation, where it is a mean of something that should not vary.
    pub scatter: Option<String>,
    /// Where the reference is from.
    pub source: String,
    /// Ways to the number.
    pub family: Vec<Family>,
}

/// One way to the number, at growing effort.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Family {
    /// Name.
    pub name: String,
    /// Overrides, as for `--set`.
    #[serde(default)]
    pub set: Vec<String>,
    /// The key that tells the effort.
    pub vary: String,
    /// Its values.
    pub values: Vec<f64>,
}

/// One run.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Point {
    /// The family.
    pub family: String,
    /// Value of the family's key.
    pub at: f64,
    /// The number.
    pub value: f64,
    /// Its relative difference from the reference [-].
    pub bias: f64,
    /// Its standard deviation over the reference [-]; 0 where the case names none.
    pub scatter: f64,
    /// √(bias² + scatter²) [-].
    pub error: f64,
    /// Fluid particles.
    pub particles: usize,
    /// Steps.
    pub steps: u64,
    /// Wall-clock time × threads [s].
    pub core_seconds: f64,
}

/// A chart, measured.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Measured {
    /// What was charted.
    pub case: Case,
    /// Threads of each run.
    pub threads: usize,
    /// Version of the program.
    pub version: String,
    /// The runs, family by family.
    pub points: Vec<Point>,
}

/// A chart that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum ChartError {
    /// No case of that name.
    #[error("no chart `{0}`; there are: {1}")]
    Unknown(String, String),
    /// A case's file is wrong.
    #[error("chart `{0}`: {1}")]
    Case(String, String),
    /// A stored chart cannot be read.
    #[error("{0}: {1}; expected the JSON file of a chart that was measured")]
    Stored(String, String),
    /// The case's scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A run could not be made.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A run gave no number.
    #[error("{family} at {at}: {why}")]
    Ended {
        /// The family.
        family: String,
        /// Value of its key.
        at: f64,
        /// What was wrong.
        why: String,
    },
}

/// All cases, by name.
pub fn cases() -> Result<Vec<Case>, ChartError> {
    let all: Vec<(String, Case)> = embedded::all(&CASES).map_err(|(name, why)| ChartError::Case(name, why))?;
    all.into_iter().map(|(name, case)| sound(Case { name, ..case })).collect()
}

/// The cases of the given names, or of the given TOML files; all that are built in if none is given.
pub fn select(names: &[String]) -> Result<Vec<Case>, ChartError> {
    let all = cases()?;
    if names.is_empty() {
        return Ok(all);
    }
    let known = || all.iter().map(|c| c.name.as_str()).collect::<Vec<_>>().join(", ");
    let chosen = |name: &String| match name.strip_suffix(".toml") {
        Some(path) => from_file(Path::new(name), path),
        None => all.iter().find(|c| c.name == *name).cloned().ok_or_else(|| ChartError::Unknown(name.clone(), known())),
    };
    names.iter().map(chosen).collect()
}

/// The case of a file, named like it.
fn from_file(file: &Path, path: &str) -> Result<Case, ChartError> {
    let wrong = |why: String| ChartError::Case(file.display().to_string(), why);
    let text = std::fs::read_to_string(file).map_err(|e| wrong(e.to_string()))?;
    let case = toml::from_str(&text).map_err(|e| wrong(e.to_string()))?;
    sound(Case { name: name_of(path), ..case })
}

/// The last part of a path, without its folders.
fn name_of(path: &str) -> String {
    Path::new(path).file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// A case whose errors can be told.
fn sound(case: Case) -> Result<Case, ChartError> {
    let wrong = |why: String| Err(ChartError::Case(case.name.clone(), why));
    if case.reference == 0.0 || !case.reference.is_finite() {
        return wrong(format!(
            "`reference` = {}: expected a finite number other than 0, errors are relative to it",
            case.reference
        ));
    }
    match case.family.iter().find(|family| family.values.is_empty()) {
        _ if case.family.is_empty() => wrong("`family` is empty: expected at least one way to the number".into()),
        Some(family) => {
            wrong(format!("`values` of `{}` is empty: expected at least one value of its key", family.name))
        }
        None => Ok(case),
    }
}

/// Run every point of a case; `tell` hears of each before it starts: its number, how many there are, family and value.
pub fn measure(case: &Case, tell: impl Fn(usize, usize, &str, f64)) -> Result<Measured, ChartError> {
    let mut scenes = Vec::new();
    for family in &case.family {
        for &at in &family.values {
            let own = format!("{}={at:?}", family.vary);
            let sets: Vec<String> = case.set.iter().chain(&family.set).cloned().chain([own]).collect();
            scenes.push((family, at, scene::load(&case.scene, &sets)?.scene)); // all are read before any is run
        }
    }
    let mut points = Vec::new();
    for (k, (family, at, scene)) in scenes.iter().enumerate() {
        tell(k + 1, scenes.len(), &family.name, *at);
        points.push(point(case, family, *at, scene)?);
    }
    let version = env!("CARGO_PKG_VERSION").to_string();
    Ok(Measured { case: case.clone(), threads: rayon::current_num_threads(), version, points })
}

fn point(case: &Case, family: &Family, at: f64, scene: &Scene) -> Result<Point, ChartError> {
    let ended = |why: String| ChartError::Ended { family: family.name.clone(), at, why };
    let summary = run::run(scene, &RunOptions::default())?.summary;
    if summary.status != Status::Completed {
        return Err(ended(summary.message.unwrap_or_default()));
    }
    let json = serde_json::to_value(&summary).unwrap_or_default();
    let read = |path: &str| {
        let number = json.pointer(&format!("/{path}")).and_then(Value::as_f64);
        number.ok_or_else(|| ended(format!("summary.json has no number {path}")))
    };
    let value = read(&case.quantity)?;
    let bias = value / case.reference - 1.0;
    let scatter = case.scatter.as_deref().map_or(Ok(0.0), read)? / case.reference.abs();
    Ok(Point {
        family: family.name.clone(),
        at,
        value,
        bias,
        scatter,
        error: bias.hypot(scatter),
        particles: summary.particles.fluid,
        steps: summary.steps,
        core_seconds: summary.wall_time_s * summary.threads as f64,
    })
}

/// A chart that was measured before.
pub fn stored(path: &Path) -> Result<Measured, ChartError> {
    let wrong = |why: String| ChartError::Stored(path.display().to_string(), why);
    let text = std::fs::read_to_string(path).map_err(|e| wrong(e.to_string()))?;
    let measured: Measured = serde_json::from_str(&text).map_err(|e| wrong(e.to_string()))?;
    let case = sound(Case { name: name_of(&measured.case.name), ..measured.case })?;
    Ok(Measured { case, ..measured })
}

impl Measured {
    /// True where no other run is as cheap and more exact, or as exact and cheaper.
    pub fn is_on_front(&self, point: &Point) -> bool {
        let beats = |other: &Point| {
            other.core_seconds <= point.core_seconds
                && other.error <= point.error
                && (other.core_seconds, other.error) != (point.core_seconds, point.error)
        };
        !self.points.iter().any(beats)
    }

    /// As the text of a JSON file.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a chart holds nothing that JSON cannot say")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(cost: f64, error: f64) -> Point {
        let family = "a".to_string();
        Point {
            family,
            at: 1.0,
            value: 1.0,
            bias: error,
            scatter: 0.0,
            error,
            particles: 1,
            steps: 1,
            core_seconds: cost,
        }
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let case = cases().expect("they parse").swap_remove(0);
        let points = vec![point(1.0, 0.1), point(2.0, 0.2), point(2.0, 0.05), point(4.0, 0.05), point(8.0, 0.01)];
        let measured = Measured { case, threads: 1, version: String::new(), points };
        let front: Vec<bool> = measured.points.iter().map(|p| measured.is_on_front(p)).collect();
        assert_eq!(front, [true, false, true, false, true]);
    }

    #[test]
    fn a_stored_chart_comes_back() {
        let case = cases().expect("they parse").swap_remove(0);
        let measured = Measured { case, threads: 2, version: "1".into(), points: vec![point(1.0, 0.1)] };
        let file = tempfile::NamedTempFile::new().expect("a file");
        std::fs::write(file.path(), measured.to_json()).expect("written");
        let back = stored(file.path()).expect("read");
        assert_eq!(back.to_json(), measured.to_json());
        assert_eq!(svg(&back), svg(&measured));
        std::fs::write(file.path(), "{}").expect("written");
        assert!(matches!(stored(file.path()), Err(ChartError::Stored(..))));
    }
}
