//! Runs of a chart on this machine.

use std::collections::BTreeMap;
use std::path::Path;

use scene::Scene;

use super::case::{CHARTS, Case};
use super::measured::{Measured, Outcome, Point, Run};
use crate::experiments::ExperimentError;
use crate::experiments::runs::{run_to_end, scene_with};

/// Run every point of a case, except those that `before` holds.
///
/// `tell` is called before each run with its number, the number of runs, and its name; `keep` stores the chart after each run. A
/// run that fails is a point with a reason.
///
/// # Errors
/// A scene is wrong, the chart to resume was measured under other conditions, or `keep` fails.
pub fn measure(
    case: &Case,
    before: Option<&Measured>,
    tell: impl Fn(usize, usize, &str),
    mut keep: impl FnMut(&Measured) -> Result<(), ExperimentError>,
) -> Result<Measured, ExperimentError> {
    let (threads, version) = (rayon::current_num_threads(), env!("CARGO_PKG_VERSION").to_string());
    let mut measured = Measured { case: case.clone(), threads, version, points: Vec::new() };
    let mut todo = Vec::new();
    for family in &case.family {
        for (at, set) in family.runs(case) {
            let scene = scene_with(&case.scene, &set, &[])?; // all are read before the first run
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

/// The chart to resume, if its costs compare with those of new runs.
fn same_conditions<'a>(new: &Measured, before: &'a Measured) -> Result<&'a Measured, ExperimentError> {
    let conditions = |m: &Measured| (m.case.scene.clone(), m.threads, m.version.clone());
    match conditions(new) == conditions(before) {
        true => Ok(before),
        false => Err(ExperimentError::Input {
            key: "--resume",
            given: format!("{}, measured as {}", new.case.name, conditions_text(before)),
            expected: format!("{}, so that costs compare", conditions_text(new)),
        }),
    }
}

fn conditions_text(m: &Measured) -> String {
    format!("{} with {} threads and version {}", m.case.scene, m.threads, m.version)
}

/// True where a point has all quantities of the case, against the same references.
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
    let run = match run_to_end(scene) {
        Ok(run) => run,
        Err(ExperimentError::Ended(_, _, why)) => return Outcome::Failed(why),
        Err(error) => return Outcome::Failed(error.to_string()),
    };
    let (mut readings, mut missing) = (BTreeMap::new(), BTreeMap::new());
    for quantity in &case.quantity {
        match quantity.read(&run) {
            Ok(reading) => readings.insert(quantity.name.clone(), reading).map(|_| ()),
            Err(why) => missing.insert(quantity.name.clone(), why).map(|_| ()),
        };
    }
    let draught = scene.entry().map(|entry| entry.attached_draught());
    Outcome::Done(Run {
        readings,
        missing,
        spacings_per_draught: draught.map(|d| d / scene.resolution.spacing),
        particles: run.summary.particles.fluid,
        steps: run.summary.steps,
        core_seconds: run.core_seconds(),
    })
}

/// A chart that was measured before.
///
/// # Errors
/// The file cannot be read, or is not a chart.
pub fn stored(path: &Path) -> Result<Measured, ExperimentError> {
    let measured: Measured = CHARTS.stored(path)?;
    let name = Path::new(&measured.case.name).file_name().unwrap_or_default().to_string_lossy().into_owned();
    let case = CHARTS.checked(Case { name, ..measured.case })?;
    Ok(Measured { case, ..measured })
}
