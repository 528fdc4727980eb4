//! What the points gave: statuses, and numbers of their `summary.json`.

use std::collections::{BTreeMap, HashMap};

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

/// A number of a summary.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// The value, in the unit of its name.
    pub value: f64,
    /// Half width of its band, where one is known.
    pub band: Option<f64>,
    /// What may be said of it, where it is judged.
    pub verdict: Option<Verdict>,
    /// When [s], where it has a time.
    pub time_s: Option<f64>,
    /// Whether it is within its limits, where it has some.
    pub allowed: Option<bool>,
}

impl Number {
    /// A number that is not judged.
    pub fn plain(value: f64) -> Number {
        Number { value, band: None, verdict: None, time_s: None, allowed: None }
    }

    /// What a reader must know: that it is beyond its limits, and what may be said of it.
    pub fn said(&self) -> impl Iterator<Item = Said> {
        let beyond = (self.allowed == Some(false)).then_some(Said::Beyond);
        beyond.into_iter().chain(self.verdict.map(Said::Of))
    }
}

/// What a reader must know of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Said {
    /// It is beyond its limits.
    Beyond,
    /// What may be said of it.
    Of(Verdict),
}

impl Said {
    /// All that may be said.
    pub fn all() -> impl Iterator<Item = Said> {
        Verdict::all().map(Said::Of).chain([Said::Beyond])
    }

    /// On a page.
    pub fn words(self) -> &'static str {
        match self {
            Said::Beyond => Status::BeyondAllowable.words(),
            Said::Of(verdict) => verdict.words(),
        }
    }
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
        let mut found = Found { outcome, numbers: Vec::new(), texts: Vec::new() };
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
        numbers: found.map(|found| found.numbers.iter().cloned().collect()).unwrap_or_default(),
        texts: found.map(|found| found.texts.iter().cloned().collect()).unwrap_or_default(),
    }
}

/// A number, or an object with a value.
fn number(value: &Value) -> Option<Number> {
    let of = |key: &str| value.get(key).and_then(Value::as_f64);
    match value.as_f64() {
        Some(value) => Some(Number::plain(value)),
        None => {
            let band = of("band");
            let verdict = value.get("verdict").and_then(Value::as_str);
            // folders of older versions: no value is resolved without a band, and being allowed was part of the verdict
            let of_older = verdict == Some(Status::BeyondAllowable.name());
            let verdict = verdict.map(|own| match Verdict::of(own) {
                _ if of_older => Verdict::NoBand,
                Verdict::Resolved if band.is_none() => Verdict::NoBand,
                own => own,
            });
            let allowed = value.get("allowed").and_then(Value::as_bool).or(of_older.then_some(false));
            Some(Number { value: of("value")?, band, verdict, time_s: of("time_s"), allowed })
        }
    }
}

/// Parts of the audit that are tabulated.
const AUDIT: [&str; 4] = ["momentum", "energy", "volume", "penetrated"];
/// Numbers of a landing that have no time.
const OF_LANDING: [&str; 2] = ["line_load_at_m", "run_length_m"];

/// True for the summary of a landing.
fn is_landing(summary: &Value) -> bool {
    summary.get("line_load_n_per_m").is_some()
}

/// Results of a run and its audit, or the extremes of a landing.
fn usual(summary: &Value) -> Vec<(String, Number)> {
    let named = |table: &Value, prefix: &str| -> Vec<(String, Number)> {
        let entries = table.as_object().into_iter().flatten();
        let with_value = entries.filter(|(_, value)| value.get("value").is_some());
        with_value.filter_map(|(key, value)| Some((format!("{prefix}{key}"), number(value)?))).collect()
    };
    let plain = |table: &Value, prefix: &str, keys: &[&str]| -> Vec<(String, Number)> {
        keys.iter().filter_map(|key| Some((format!("{prefix}{key}"), number(table.get(key)?)?))).collect()
    };
    let Some(results) = summary.get("results") else {
        let items = |list: &str| summary.get(list).and_then(Value::as_array).cloned().unwrap_or_default();
        let named_items = ["accelerometers", "parts", "windows"].map(items).concat();
        let of_named = named_items.iter().flat_map(|item| {
            let name = item.get("name").and_then(Value::as_str).unwrap_or_default();
            named(item, &format!("{name}."))
        });
        let of_named: Vec<(String, Number)> = of_named.collect();
        let stations = items("stations");
        let stations = stations.iter();
        let loads = stations.flat_map(|station| {
            let place = station.get("x_m").map_or(String::new(), Value::to_string);
            named(station, &format!("station {place} m."))
        });
        // no landing's load has a band
        let without_band =
            |(name, number): (String, Number)| (name, Number { verdict: Some(Verdict::NoBand), ..number });
        let loads: Vec<(String, Number)> = of_named.into_iter().chain(loads).map(without_band).collect();
        let peaks: Vec<(String, Number)> = named(summary, "").into_iter().map(without_band).collect();
        return [peaks, plain(summary, "", &OF_LANDING), loads].concat();
    };
    let mut numbers = named(results, "");
    for (name, panel) in results.get("panels").and_then(Value::as_object).into_iter().flatten() {
        numbers.extend(named(panel, &format!("{name}.")));
    }
    let is_particles = summary.pointer("/particles/fluid").and_then(Value::as_u64).unwrap_or(0) > 0;
    if let Some(audit) = summary.get("audit").filter(|_| is_particles) {
        numbers.extend(plain(audit, "audit.", &AUDIT));
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_of_runs_and_of_landings_have_names_with_units() {
        let run = serde_json::json!({
            "results": {
                "peak_force_N_per_m": {"value": 3.0, "band": 0.1, "time_s": 0.2, "verdict": "resolved"},
                "panels": {"plate": {"peak_stress_Pa": {"value": 2e8, "band": null, "verdict": "acoustic"}}}
            },
            "particles": {"fluid": 10},
            "audit": {"momentum": 1e-15, "penetrated": 0}
        });
        let names = |summary: &Value| usual(summary).into_iter().map(|(name, _)| name).collect::<Vec<_>>();
        let of_run = ["peak_force_N_per_m", "plate.peak_stress_Pa", "audit.momentum", "audit.penetrated"];
        assert_eq!(names(&run), of_run);
        assert_eq!(usual(&run)[0].1.band, Some(0.1));
        let station = serde_json::json!({"x_m": 3.5, "line_load_n_per_m": {"value": 2.0, "time_s": 0.2}});
        let cockpit = serde_json::json!({"name": "cockpit", "normal_g": {"value": 1.5, "time_s": 0.2}});
        let landing = serde_json::json!({
            "az_g": {"value": 1.0, "time_s": 0.1}, "line_load_at_m": 20.0, "strips": 20, "stations": [station],
            "accelerometers": [cockpit]
        });
        assert_eq!(names(&landing), ["az_g", "line_load_at_m", "cockpit.normal_g", "station 3.5 m.line_load_n_per_m"]);
    }
}
