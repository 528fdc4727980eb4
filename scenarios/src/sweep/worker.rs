//! The process of a point: it locks the point's folder, runs the scene, and keeps how it ended.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use run::{Checkpoints, Resumable, RunError, RunOptions, run};
use scene::Loaded;
use scene::vocabulary::Status;

use super::error::SweepError;
use super::folder::{Outcome, PointFolder, SweepFolder};
use super::plan::Resolved;
use crate::ditching;

/// Run a point of a planned sweep; an interrupted one keeps no outcome, so that it runs again: from its checkpoint, where it has one.
///
/// `memory`: what a scene may need [bytes]; `lean`: keep no page and no log; `interrupt` ends the run after the present step;
/// `stepped` is set when the last step has been taken.
///
/// # Errors
/// The point was not planned, runs in another process, or its scene has changed since.
pub fn run_point(
    folder: &SweepFolder,
    id: &str,
    memory: u64,
    lean: bool,
    interrupt: &AtomicBool,
    stepped: &AtomicBool,
) -> Result<Option<Outcome>, SweepError> {
    let point = folder.point(id);
    let task = point.task()?;
    let held = point.lock()?;
    if held.is_none() {
        return Err(SweepError::Failed(format!("point {id} runs in another process")));
    }
    let start = Instant::now();
    let resolved = task.resolve()?;
    if resolved.id() != id {
        return Err(SweepError::Input(format!(
            "{}: the scene {} or the program has changed since the sweep was planned: run `splashdown sweep FILE` again",
            point.path().display(),
            task.scene
        )));
    }
    let (status, message) = match resolved {
        Resolved::Scene(loaded) => run_scene(&loaded, &point, memory, lean, interrupt, stepped)?,
        Resolved::Landing(landing) => {
            let landed = ditching::run(&landing, point.path(), true);
            landed.map(|landed| (landed.summary.status, landed.summary.message)).map_err(failed)?
        }
    };
    if status == Status::Interrupted {
        return Ok(None);
    }
    let status = serde_json::to_value(status).ok().and_then(|word| word.as_str().map(String::from));
    let outcome = Outcome {
        status: status.unwrap_or_default(),
        message,
        wall_time_s: start.elapsed().as_secs_f64(),
        threads: rayon::current_num_threads(),
    };
    point.end(&outcome)?;
    Ok(Some(outcome))
}

/// Run the point's scene: how it ended. A scene that cannot be built has failed.
fn run_scene(
    loaded: &Loaded,
    point: &PointFolder,
    memory: u64,
    lean: bool,
    interrupt: &AtomicBool,
    stepped: &AtomicBool,
) -> Result<(Status, Option<String>), SweepError> {
    if let Err(error) = loaded.fits_in_memory(memory) {
        return Err(SweepError::Failed(error.to_string()));
    }
    let options = RunOptions {
        page: (!lean).then_some(report::page_of_run),
        without_log: lean,
        out: Some(point.path().to_path_buf()),
        force: true,
        interrupt: Some(interrupt),
        stepped: Some(stepped),
        checkpoints: Some(Checkpoints { every: None }),
        warnings: loaded.warnings.clone(),
        ..RunOptions::default()
    };
    let ended = match Resumable::open(point.path(), None).and_then(|interrupted| interrupted.resume(&options)) {
        Err(RunError::Checkpoint(_)) => run(&loaded.scene, &options),
        resumed => resumed,
    };
    match ended {
        Ok(outcome) => Ok((outcome.summary.status, outcome.summary.message)),
        Err(error) if error.is_input() => Ok((Status::Failed, Some(error.to_string()))),
        Err(error) => Err(failed(error)),
    }
}

fn failed(error: RunError) -> SweepError {
    SweepError::Failed(error.to_string())
}
