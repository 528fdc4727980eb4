//! What the points gave: statuses, and numbers of their `summary.json`.

use std::collections::{BTreeMap, HashMap};

use decide::numbers::{Number, is_landing, number, usual};
use rayon::prelude::*;
use scene::vocabulary::{Status, Verdict};
use serde_json::Value;

use super::file::SCENE_AXIS;
use super::folder::{KILLED, Outcome, State, SweepFolder};
use super::plan::{Axis, Plan, Point};

/// Status of a run that failed.
pub(super) fn is_failed(status: &str) -> bool {
    status == Status::Failed.name()
}

/// A point with what it gave.
#[derive(Clone, Debug, PartialEq)]
pub struct PointResult {
    /// Its number in the table, from 1.
    pub number: usize,
    /// Values of the axes.
    pub values: Vec<Value>,
    /// How it ended, or `waiting`, `running`.
    pub status: String,
    /// Why it has no results.
    pub message: Option<String>,
    /// Wall-clock time of its process [s].
    pub wall_time_s: Option<f64>,
    /// Threads of its process.
    pub threads: Option<usize>,
    /// Name of its folder.
    pub id: Option<String>,
    /// Its folder holds a page.
    pub has_page: bool,
    /// Its numbers, by name.
    pub numbers: BTreeMap<String, Number>,
    /// Texts that are tabulated, by name.
    pub texts: BTreeMap<String, String>,
}

impl PointResult {
    /// True for a point with results that did not fail.
    pub fn is_completed(&self) -> bool {
        let is_empty = self.numbers.is_empty() && self.texts.is_empty();
        !is_failed(&self.status) && !is_empty
    }

    /// True for a point that ended otherwise: without results, or a landing that left the range of its model.
    pub fn has_failed(&self) -> bool {
        !["waiting", "running"].contains(&self.status.as_str()) && !self.is_completed()
    }
}

/// The points of a sweep with what they gave.
#[derive(Clone, Debug, PartialEq)]
pub struct Collected {
    /// Name of the sweep.
    pub name: String,
    /// Its axes.
    pub axes: Vec<Axis>,
    /// Names of the numbers, in the order of the table.
    pub names: Vec<String>,
    /// Names of the texts.
    pub texts: Vec<String>,
    /// The points.
    pub points: Vec<PointResult>,
}

impl Collected {
    /// What stands in the folder of a sweep.
    pub fn read(plan: &Plan, folder: &SweepFolder) -> Collected {
        let found: HashMap<&str, Found> =
            plan.distinct().par_iter().map(|(id, _)| (*id, Found::of(plan, folder, id))).collect();
        let points: Vec<PointResult> =
            plan.points.iter().zip(1..).map(|(p, number)| result(p, number, &found)).collect();
        let (mut names, mut texts) = (Vec::new(), Vec::new());
        let add = |names: &mut Vec<String>, name: &String| {
            if !names.contains(name) {
                names.push(name.clone());
            }
        };
        for found in plan.distinct().iter().filter_map(|(id, _)| found.get(id)) {
            found.numbers.iter().for_each(|(name, _)| add(&mut names, name));
            found.texts.iter().for_each(|(name, _)| add(&mut texts, name));
        }
        Collected { name: plan.name(), axes: plan.axes.clone(), names, texts, points }
    }

    /// The points with results.
    pub fn completed(&self) -> impl Iterator<Item = &PointResult> {
        self.points.iter().filter(|point| point.is_completed())
    }

    /// The points with numbers: besides those with results, landings that left the range of their model.
    pub fn with_numbers(&self) -> impl Iterator<Item = &PointResult> {
        self.points.iter().filter(|point| !point.numbers.is_empty() || point.is_completed())
    }

    /// The points that failed.
    pub fn failed(&self) -> impl Iterator<Item = &PointResult> {
        self.points.iter().filter(|point| point.has_failed())
    }

    /// The index of the axis of several scenes, where there is one.
    pub fn scene_axis(&self) -> Option<usize> {
        self.axes.iter().position(|axis| axis.key == SCENE_AXIS)
    }
}

/// What stands in the folder of a point.
struct Found {
    outcome: Outcome,
    has_page: bool,
    numbers: Vec<(String, Number)>,
    texts: Vec<(String, String)>,
}

impl Found {
    fn of(plan: &Plan, folder: &SweepFolder, id: &str) -> Found {
        let point = folder.point(id);
        let status = |status: &str| Outcome { status: status.into(), message: None, wall_time_s: f64::NAN, threads: 0 };
        let outcome = match point.state() {
            State::Ended(outcome) => outcome,
            State::Running => status("running"),
            State::Waiting => point.outcome().filter(|o| o.status == KILLED).unwrap_or_else(|| status("waiting")),
        };
        let has_page = point.file("report.html").exists();
        let mut found = Found { outcome, has_page, numbers: Vec::new(), texts: Vec::new() };
        let has_failed = is_failed(&found.outcome.status);
        if !found.outcome.is_completed() && !has_failed {
            return found;
        }
        match point.summary() {
            // up to its end a landing that left the range of its model has loads, and they may be the largest of all
            Ok(summary) if has_failed && is_landing(&summary) && plan.tabulate.is_empty() => {
                let unresolved = |number: Number| Number { verdict: Some(Verdict::NotResolved), ..number };
                found.numbers = usual(&summary).into_iter().map(|(name, number)| (name, unresolved(number))).collect();
            }
            _ if has_failed => {}
            Ok(summary) if plan.tabulate.is_empty() => found.numbers = usual(&summary),
            Ok(summary) => {
                plan.tabulate.iter().for_each(|path| found.take(&summary, path));
                if found.numbers.is_empty() && found.texts.is_empty() {
                    found.outcome.status = Status::Failed.name().into();
                    let (path, paths) = (point.file("summary.json"), plan.tabulate.join(", "));
                    found.outcome.message =
                        Some(format!("{} has nothing at {paths}, the paths of `tabulate`", path.display()));
                }
            }
            Err(why) => {
                found.outcome.status = Status::Failed.name().into();
                found.outcome.message = Some(why);
            }
        }
        found
    }

    /// A tabulated path: a number, an object with a value, or a text.
    fn take(&mut self, summary: &Value, path: &str) {
        let name = path.trim_end_matches("/value");
        let at = |path: &str| summary.pointer(&format!("/{path}"));
        match (at(name).and_then(number), at(path)) {
            (Some(number), _) => self.numbers.push((name.into(), number)),
            (None, Some(Value::String(text))) => self.texts.push((name.into(), text.clone())),
            (None, Some(Value::Bool(truth))) => self.texts.push((name.into(), truth.to_string())),
            _ => {}
        }
    }
}

fn result(point: &Point, number: usize, found: &HashMap<&str, Found>) -> PointResult {
    let found = point.id.as_deref().and_then(|id| found.get(id));
    let outcome = found.map(|found| &found.outcome);
    PointResult {
        number,
        values: point.values.clone(),
        status: outcome.map_or("refused".into(), |outcome| outcome.status.clone()),
        message: outcome.map_or(point.refused.clone(), |outcome| outcome.message.clone()),
        wall_time_s: outcome.map(|outcome| outcome.wall_time_s).filter(|seconds| seconds.is_finite()),
        threads: outcome.map(|outcome| outcome.threads).filter(|threads| *threads > 0),
        id: point.id.clone(),
        has_page: found.is_some_and(|found| found.has_page),
        numbers: found.map(|found| found.numbers.iter().cloned().collect()).unwrap_or_default(),
        texts: found.map(|found| found.texts.iter().cloned().collect()).unwrap_or_default(),
    }
}
