//! Runs of a chart on this machine.

use std::collections::BTreeMap;
use std::path::Path;

use super::ChartError;
use super::case::{Case, name_of, sound};
use super::measured::{Measured, Outcome, Point, Run};
use crate::run::{self, RunOptions};
use crate::scene::{self, Scene};
use crate::summary::Status;

/// Run every point of a case, except those that `before` holds.
///
/// `tell` hears of each run before it starts: its number, how many there are, and its name; `keep` gets the chart as far as it
/// is after each. A run that fails is a point that says why.
pub fn measure(
    case: &Case,
    before: Option<&Measured>,
    tell: impl Fn(usize, usize, &str),
    mut keep: impl FnMut(&Measured) -> Result<(), ChartError>,
) -> Result<Measured, ChartError> {
    let (threads, version) = (rayon::current_num_threads(), env!("CARGO_PKG_VERSION").to_string());
    let mut measured = Measured { case: case.clone(), threads, version, points: Vec::new() };
    let mut todo = Vec::new();
    for family in &case.family {
        for (at, set) in family.runs(case) {
            let scene = scene::load(&case.scene, &set)?.scene; // all are read before any is run
            let point = Point { family: family.name.clone(), at, set, outcome: Outcome::Failed(String::new()) };
            todo.push((point, scene));
        }
    }
    let before = before.map(|b| same_conditions(&measured, b)).transpose()?;
    let count = todo.len();
    for (k, (point, scene)) in todo.into_iter().enumerate() {
        let kept = before.and_then(|b| b.points.iter().find(|p| p.set == point.set)).filter(|p| is_whole(p, case));
        let outcome = match kept.map(|p| p.outcome.clone()) {
            Some(outcome) => outcome,
            None => {
                tell(k + 1, count, &point.name());
                outcome(case, &scene)
            }
        };
        measured.points.push(Point { outcome, ..point });
        keep(&measured)?;
    }
    Ok(measured)
}

/// The chart to take up again, if its costs may stand beside new ones.
fn same_conditions<'a>(new: &Measured, before: &'a Measured) -> Result<&'a Measured, ChartError> {
    let conditions = |m: &Measured| (m.case.scene.clone(), m.threads, m.version.clone());
    match conditions(new) == conditions(before) {
        true => Ok(before),
        false => {
            Err(ChartError::Conditions { name: new.case.name.clone(), before: in_words(before), now: in_words(new) })
        }
    }
}

fn in_words(m: &Measured) -> String {
    format!("{} with {} threads and version {}", m.case.scene, m.threads, m.version)
}

/// True where a point has all that the case asks for, against the same references.
fn is_whole(point: &Point, case: &Case) -> bool {
    point.run().is_some_and(|run| {
        case.quantity.iter().all(|q| {
            run.missing.contains_key(&q.name)
                || run.readings.get(&q.name).is_some_and(|r| {
                    q.reference.is_none_or(|reference| (r.value / reference - 1.0 - r.bias).abs() < 1e-12)
                })
        })
    })
}

fn outcome(case: &Case, scene: &Scene) -> Outcome {
    let summary = match run::run(scene, &RunOptions::default()) {
        Ok(outcome) if outcome.summary.status == Status::Completed => outcome.summary,
        Ok(outcome) => return Outcome::Failed(outcome.summary.message.unwrap_or_default()),
        Err(error) => return Outcome::Failed(error.to_string()),
    };
    let json = serde_json::to_value(&summary).unwrap_or_default();
    let (mut readings, mut missing) = (BTreeMap::new(), BTreeMap::new());
    for quantity in &case.quantity {
        match quantity.read(&summary, &json) {
            Ok(reading) => readings.insert(quantity.name.clone(), reading).map(|_| ()),
            Err(why) => missing.insert(quantity.name.clone(), why).map(|_| ()),
        };
    }
    let draught = scene.entry().map(|entry| entry.attached_draught());
    Outcome::Done(Run {
        readings,
        missing,
        spacings_per_draught: draught.map(|d| d / scene.resolution.spacing),
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
    let case = sound(super::Case { name: name_of(&measured.case.name), ..measured.case })?;
    Ok(Measured { case, ..measured })
}
