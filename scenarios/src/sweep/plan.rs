//! The points of a sweep: their values, their folders, and what is left to run.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use scene::{Loaded, SceneError};
use serde::{Deserialize, Serialize};

use super::error::SweepError;
use super::file::{Kind, SCENE_AXIS, SweepFile, assignment};
use crate::ditching;

/// What the process of a point is given.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Task {
    /// What it is.
    pub kind: Kind,
    /// Built-in name or path.
    pub scene: String,
    /// Overrides, `key=value`.
    pub sets: Vec<String>,
}

/// The scene of a task, resolved.
pub(super) enum Resolved {
    /// Of a run.
    Scene(Box<Loaded>),
    /// Of a landing.
    Landing(Box<ditching::Scene>),
}

impl Task {
    /// The resolved scene.
    pub(super) fn resolve(&self) -> Result<Resolved, SceneError> {
        Ok(match self.kind {
            Kind::Run => Resolved::Scene(Box::new(run::load(&self.scene, &self.sets)?)),
            Kind::Ditch => Resolved::Landing(Box::new(ditching::load(&self.scene, &self.sets)?)),
        })
    }
}

impl Resolved {
    /// Name of the point's folder: a hash of the resolved scene and of the program's version.
    pub fn id(&self) -> String {
        match self {
            Resolved::Scene(loaded) => loaded.identity(),
            Resolved::Landing(landing) => scene::identity([landing.to_toml().as_str()]),
        }
    }
}

/// A point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Values of the axes.
    pub values: Vec<serde_json::Value>,
    /// What its process is given.
    pub task: Task,
    /// Name of its folder; absent where the scene is wrong.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub id: Option<String>,
    /// Why the scene is wrong.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub refused: Option<String>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// Its key.
    pub key: String,
    /// Unit of its values; `-` for pure numbers, empty for anything else.
    pub unit: String,
}

impl Axis {
    /// Key and unit.
    pub fn label(&self) -> String {
        match self.unit.as_str() {
            "" | "-" => self.key.clone(),
            unit => format!("{} [{unit}]", self.key),
        }
    }
}

/// The points of a sweep: `sweep.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// The sweep file.
    pub file: PathBuf,
    /// Version of the program that planned it.
    pub version: String,
    /// Axes, as they stand in the table.
    pub axes: Vec<Axis>,
    /// Paths in `summary.json` to tabulate; empty: the results.
    pub tabulate: Vec<String>,
    /// Processes at the same time.
    pub jobs: usize,
    /// The points, in the order of the table.
    pub points: Vec<Point>,
}

impl Plan {
    /// Of a sweep file: all points are resolved, on all threads.
    ///
    /// # Errors
    /// There are too many points, or every one is wrong: the first one's mistake.
    pub fn of(file: &SweepFile, jobs: usize) -> Result<Plan, SweepError> {
        let keys = file.keys();
        let rows = file.rows()?;
        let resolved: Vec<(Point, Option<SceneError>)> = rows.par_iter().map(|row| point(file, &keys, row)).collect();
        let (points, mistakes): (Vec<Point>, Vec<Option<SceneError>>) = resolved.into_iter().unzip();
        if points.iter().all(|point| point.refused.is_some())
            && let Some(first) = mistakes.into_iter().flatten().next()
        {
            return Err(match first {
                // a value of an axis or of [set]
                SceneError::Set { argument, problem, .. } => {
                    SweepError::Input(format!("{}: at the first point, {argument}: {problem}", file.path.display()))
                }
                other => other.into(),
            });
        }
        let axes = keys.into_iter().map(|key| Axis { unit: unit(file.kind, &key), key }).collect();
        Ok(Plan {
            file: file.path.clone(),
            version: env!("CARGO_PKG_VERSION").into(),
            axes,
            tabulate: file.tabulate.clone(),
            jobs,
            points,
        })
    }

    /// Name of the sweep: that of its file.
    pub fn name(&self) -> String {
        self.file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Folder of a sweep where none is given: `runs/NAME_sweep`.
    pub fn default_folder(file: &Path) -> PathBuf {
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        PathBuf::from("runs").join(format!("{name}_sweep"))
    }

    /// The points that have a folder, each folder once.
    pub fn distinct(&self) -> Vec<(&str, &Task)> {
        let mut seen = HashSet::new();
        let points = self.points.iter().filter_map(|point| Some((point.id.as_deref()?, &point.task)));
        points.filter(|(id, _)| seen.insert(*id)).collect()
    }
}

/// A point, and what is wrong with its scene.
fn point(file: &SweepFile, keys: &[String], row: &[toml::Value]) -> (Point, Option<SceneError>) {
    let place = |name: &str| file.scenes.iter().find(|[given, _]| given == name).map(|[_, place]| place.clone());
    let mut scene = file.scenes.first().map(|[_, place]| place.clone()).unwrap_or_default();
    let mut sets = file.sets.clone();
    for (key, value) in keys.iter().zip(row) {
        match (key.as_str(), value) {
            (SCENE_AXIS, toml::Value::String(name)) if file.scenes.len() > 1 => {
                scene = place(name).unwrap_or_else(|| name.clone());
            }
            _ => sets.push(assignment(key, value)),
        }
    }
    let task = Task { kind: file.kind, scene, sets };
    let (id, mistake) = match task.resolve() {
        Ok(resolved) => (Some(resolved.id()), None),
        Err(mistake) => (None, Some(mistake)),
    };
    let values = row.iter().map(|value| serde_json::to_value(value).unwrap_or_default()).collect();
    (Point { values, task, id, refused: mistake.as_ref().map(SceneError::to_string) }, mistake)
}

/// Unit of a key, as its documentation has it.
fn unit(kind: Kind, key: &str) -> String {
    let schema = match kind {
        Kind::Run => scene::schema(),
        Kind::Ditch => ditching::schema(),
    };
    schema.keyword(key).map(|keyword| keyword.unit.clone()).unwrap_or_default()
}
