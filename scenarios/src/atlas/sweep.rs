//! Runs of a map: each point by itself, on one thread.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Serialize};
use sph_core::parallel::on_threads;
use tracing::subscriber::{NoSubscriber, with_default};

use super::verdict::judge;
use super::{AtlasError, Map, Measured, Verdict};
use crate::run::{self, RunError, RunOptions};
use crate::scene::{self, Scene};

/// One run.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Point {
    /// Place on the x axis.
    pub x: String,
    /// Place on the y axis.
    pub y: String,
    /// What became of it.
    pub verdict: Verdict,
    /// Why.
    pub why: String,
    /// The parameters over the theory's limit [-]: below 1 the run should hold; `None` where no theory speaks.
    pub theory: Option<f64>,
    /// Steps taken.
    pub steps: u64,
}

/// Run every point of a map, as many beside each other as the current pool has threads; `tell` hears of each that is done:
/// how many there are of how many, and the point.
pub fn sweep(map: &Map, tell: impl Fn(usize, usize, &Point) + Sync) -> Result<Measured, AtlasError> {
    let places = |y: String| map.x.names().into_iter().map(move |x| [x, y.clone()]);
    let places: Vec<[String; 2]> = map.y.names().into_iter().flat_map(places).collect();
    let scenes = places.iter().map(|[x, y]| scene_of(map, x, y)).collect::<Result<Vec<Scene>, _>>()?;
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let found: Mutex<Vec<Option<Result<Point, RunError>>>> = Mutex::new(places.iter().map(|_| None).collect());
    let work = || {
        while let Some(k) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|&k| k < places.len()) {
            let [x, y] = &places[k];
            let point = run_point(map, &scenes[k], x, y);
            if let Ok(point) = &point {
                tell(done.fetch_add(1, Ordering::Relaxed) + 1, places.len(), point);
            }
            found.lock().unwrap_or_else(PoisonError::into_inner)[k] = Some(point);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..rayon::current_num_threads().min(places.len()) {
            scope.spawn(work);
        }
    });
    let found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
    let points = found.into_iter().flatten().collect::<Result<Vec<Point>, RunError>>()?;
    Ok(Measured { map: map.clone(), version: env!("CARGO_PKG_VERSION").to_string(), points })
}

/// Run the point `X,Y` of a map, with the overrides that made it.
pub fn point(map: &Map, at: &str) -> Result<(Point, Vec<String>), AtlasError> {
    let (x, y) = at.split_once(',').unwrap_or((at, ""));
    let (x, y) = (x.trim(), y.trim());
    for (axis, place) in [(&map.x, x), (&map.y, y)] {
        if axis.sets(place).is_none() {
            return Err(AtlasError::Point {
                given: at.to_string(),
                part: place.to_string(),
                axis: axis.label.clone(),
                expected: axis.expected(),
            });
        }
    }
    let scene = scene_of(map, x, y)?;
    Ok((run_point(map, &scene, x, y)?, sets_of(map, x, y)))
}

/// The parameters of a place of a map over the theory's limit [-], without a run; `None` where no theory speaks.
pub fn foretold(map: &Map, x: &str, y: &str) -> Result<Option<f64>, AtlasError> {
    let scene = scene_of(map, x, y)?;
    Ok(map.theory.and_then(|theory| theory.ratio(&scene)))
}

fn sets_of(map: &Map, x: &str, y: &str) -> Vec<String> {
    let own = [(&map.x, x), (&map.y, y)].into_iter().flat_map(|(axis, place)| axis.sets(place).unwrap_or_default());
    map.set.iter().cloned().chain(own).collect()
}

/// The point's scene; steps that a scene may not ask for are let through, to see what becomes of them.
fn scene_of(map: &Map, x: &str, y: &str) -> Result<Scene, AtlasError> {
    Ok(scene::load_beyond_limits(&map.scene, &sets_of(map, x, y))?.scene)
}

fn run_point(map: &Map, scene: &Scene, x: &str, y: &str) -> Result<Point, RunError> {
    let options = RunOptions { most_steps: Some(map.most_steps), ..RunOptions::default() };
    // what a point would warn of is its verdict
    let silent = || with_default(NoSubscriber::default(), || run::run(scene, &options));
    let summary = on_threads(1, silent)?.summary;
    let (verdict, why) = judge(map, &summary);
    let theory = map.theory.and_then(|theory| theory.ratio(scene));
    Ok(Point { x: x.to_string(), y: y.to_string(), verdict, why, theory, steps: summary.steps })
}
