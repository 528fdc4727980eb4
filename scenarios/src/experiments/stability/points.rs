//! Runs of a map: each point by itself, on one thread.

use std::sync::atomic::{AtomicUsize, Ordering};

use run::summary::Summary;
use run::{self, RunError, RunOptions};
use scene::{Scene, SceneError};
use sph_core::parallel::on_threads;
use tracing::subscriber::{NoSubscriber, with_default};

use super::map::{Bound, Map};
use super::measured::{Measured, Point, Verdict};
use crate::experiments::ExperimentError;
use crate::experiments::runs::{RunRecord, side_by_side};

/// Run every point of a map, as many side by side as the current pool has threads; `tell` is called after each with the number
/// of finished points, the number of all, and the point.
///
/// # Errors
/// A scene is wrong, or a run could not be made.
pub fn run_map(map: &Map, tell: impl Fn(usize, usize, &Point) + Sync) -> Result<Measured, ExperimentError> {
    let row = |y: String| map.x.names().into_iter().map(move |x| [x, y.clone()]);
    let places: Vec<[String; 2]> = map.y.names().into_iter().flat_map(row).collect();
    let scenes = places.iter().map(|[x, y]| scene_of(map, x, y)).collect::<Result<Vec<Scene>, _>>()?;
    let done = AtomicUsize::new(0);
    let points = side_by_side(places.len(), |k| {
        let [x, y] = &places[k];
        let point = run_point(map, &scenes[k], x, y)?;
        tell(done.fetch_add(1, Ordering::Relaxed) + 1, places.len(), &point);
        Ok::<Point, RunError>(point)
    })?;
    Ok(Measured { map: map.clone(), version: env!("CARGO_PKG_VERSION").to_string(), points })
}

/// Run the point `X,Y` of a map; with its overrides.
///
/// # Errors
/// The map has no such point, its scene is wrong, or the run could not be made.
pub fn point(map: &Map, at: &str) -> Result<(Point, Vec<String>), ExperimentError> {
    let (x, y) = at.split_once(',').unwrap_or((at, ""));
    let (x, y) = (x.trim(), y.trim());
    for (axis, place) in [(&map.x, x), (&map.y, y)] {
        if axis.sets(place).is_none() {
            let expected = format!("{}, not `{place}`, on the axis `{}`", axis.expected(), axis.label);
            return Err(ExperimentError::Input { key: "--point", given: at.to_string(), expected });
        }
    }
    let scene = scene_of(map, x, y)?;
    Ok((run_point(map, &scene, x, y)?, map.sets(x, y)))
}

/// The parameters of a place of a map over the theoretical limit [-], without a run; `None` without a theory.
///
/// # Errors
/// The scene is wrong.
pub fn boundary_ratio(map: &Map, x: &str, y: &str) -> Result<Option<f64>, SceneError> {
    let scene = scene_of(map, x, y)?;
    Ok(map.theory.and_then(|theory| theory.ratio(&scene)))
}

/// The scene of a point, without limits on the step.
fn scene_of(map: &Map, x: &str, y: &str) -> Result<Scene, SceneError> {
    Ok(run::load_beyond_limits(&map.scene, &map.sets(x, y))?.scene)
}

fn run_point(map: &Map, scene: &Scene, x: &str, y: &str) -> Result<Point, RunError> {
    let options = RunOptions { most_steps: Some(map.most_steps), ..RunOptions::default() };
    // the verdict replaces the warnings
    let silent = || with_default(NoSubscriber::default(), || run::run(scene, &options));
    let run = RunRecord::new(on_threads(1, silent)?.summary);
    let (verdict, why) = judge(map, &run);
    let theory = map.theory.and_then(|theory| theory.ratio(scene));
    Ok(Point { x: x.to_string(), y: y.to_string(), verdict, why, theory, steps: run.summary.steps })
}

/// The verdict on a run, and why.
fn judge(map: &Map, run: &RunRecord) -> (Verdict, String) {
    let first = |bounds: &[Bound]| bounds.iter().find_map(|bound| bound.breach(&run.numbers));
    if let Some(why) = failure(map, &run.summary).or_else(|| first(&map.failed)) {
        return (Verdict::Failed, why);
    }
    match first(&map.inaccurate) {
        Some(why) => (Verdict::Inaccurate, why),
        None => (Verdict::Stable, "ran to its end within all bounds".into()),
    }
}

/// Why a run has failed on any map.
fn failure(map: &Map, summary: &Summary) -> Option<String> {
    let audit = &summary.audit;
    let beyond = |value: f64, most: f64| value.is_nan() || value > most;
    match () {
        () if !summary.status.is_completed() => Some(summary.message.clone().unwrap_or_default()),
        () if beyond(audit.energy, map.most_energy_gain) => {
            Some(format!("energy grew by {:.3} of what was exchanged", audit.energy))
        }
        () if beyond(audit.momentum, map.most_momentum_gap) => Some(format!("momentum open by {:.1e}", audit.momentum)),
        () if audit.penetrated > 0 => Some(audit.worst_penetration.as_ref().map_or(String::new(), ToString::to_string)),
        () => None,
    }
}
