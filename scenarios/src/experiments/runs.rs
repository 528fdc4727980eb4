//! Runs of an experiment, and the numbers they give.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use run::numbers::Numbers;
use run::summary::Summary;
use run::{self, RunOptions};
use scene::{Scene, SceneError};

use super::ExperimentError;

/// A run that has ended.
pub struct RunRecord {
    /// Its summary.
    pub summary: Summary,
    /// The summary's numbers.
    pub numbers: Numbers,
}

impl RunRecord {
    /// Of a summary.
    pub fn new(summary: Summary) -> RunRecord {
        RunRecord { numbers: Numbers::of(&summary), summary }
    }

    /// Wall-clock time × threads [s].
    pub fn core_seconds(&self) -> f64 {
        self.summary.wall_time_s * self.summary.threads as f64
    }
}

/// A scene with overrides of the case and further ones of the run.
///
/// # Errors
/// The scene is wrong.
pub fn scene_with(scene: &str, sets: &[String], further: &[String]) -> Result<Scene, SceneError> {
    Ok(run::load(scene, &[sets, further].concat())?.scene)
}

/// Run a scene to its end, without files.
///
/// # Errors
/// The run could not be made, or ended early.
pub fn run_to_end(scene: &Scene) -> Result<RunRecord, ExperimentError> {
    let summary = run::run(scene, &RunOptions::default())?.summary;
    match summary.status.is_completed() {
        true => Ok(RunRecord::new(summary)),
        false => {
            let (spacing, sound_speed) = (scene.resolution.spacing, scene.sound_speed());
            Err(ExperimentError::Ended(spacing, sound_speed, summary.message.unwrap_or_default()))
        }
    }
}

/// Do `count` tasks, as many at the same time as the current thread pool has threads; results in the order of the tasks.
///
/// # Errors
/// The first task that failed, after all were tried.
pub fn side_by_side<T: Send, E: Send>(count: usize, task: impl Fn(usize) -> Result<T, E> + Sync) -> Result<Vec<T>, E> {
    let next = AtomicUsize::new(0);
    let found: Mutex<Vec<Option<Result<T, E>>>> = Mutex::new((0..count).map(|_| None).collect());
    let work = || {
        while let Some(k) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|&k| k < count) {
            let result = task(k);
            found.lock().unwrap_or_else(PoisonError::into_inner)[k] = Some(result);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..rayon::current_num_threads().min(count) {
            scope.spawn(work);
        }
    });
    found.into_inner().unwrap_or_else(PoisonError::into_inner).into_iter().flatten().collect()
}
