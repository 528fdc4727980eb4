//! Continue a run from its checkpoint, to the bits that it would have had without a break.

use std::path::{Path, PathBuf};

use scene::{MOST_ROWS, Scene, all_warnings, with_end};
use tracing::{info, warn};

use super::checkpoint::{Checkpoint, CheckpointError, fingerprint, write_whole};
use super::driver::{Run, start_live};
use super::recorder::Recorder;
use crate::error::RunError;
use crate::folder::hold;
use crate::observers::LogObserver;
use crate::options::{Outcome, RunOptions};
use crate::{build, compare};

/// Files that say how a run ended: none of a run that goes on.
const OF_THE_END: [&str; 2] = ["summary.json", "report.html"];
const SCENE: &str = "scene.resolved.toml";
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A run that can be continued.
pub struct Resumable {
    dir: PathBuf,
    until: Option<f64>,
    scene: Scene,
    /// End of the run so far [s].
    end_before: f64,
    warnings: Vec<String>,
    checkpoint: Checkpoint,
}

impl Resumable {
    /// The run in a folder, up to the end of its scene or to `until` [s]. Nothing is changed yet.
    pub fn open(dir: &Path, until: Option<f64>) -> Result<Resumable, RunError> {
        let (checkpoint, version, of_scene) = Checkpoint::read(dir)?;
        let path = dir.join(SCENE);
        let text = std::fs::read_to_string(&path).map_err(|error| CheckpointError::Read(path.clone(), error))?;
        let unreadable =
            |error: toml::de::Error| CheckpointError::Unreadable(path.clone(), error.message().to_string());
        let mut scene = Scene::from_toml(&text).map_err(unreadable)?;
        if fingerprint(&scene) != of_scene {
            return Err(CheckpointError::Scene(path).into());
        }
        if version != VERSION {
            warn!("the checkpoint is of splashdown {version}, this is {VERSION}: the bits may differ");
        }
        scene.choice.clone_from(&checkpoint.choice);
        let (end_before, mut warnings) = (scene.time.end, checkpoint.warnings.clone());
        if let Some(later) = until.filter(|later| later.is_finite() && *later > 0.0) {
            let old = all_warnings(&scene);
            scene = with_end(&scene, later);
            // those that are not of the resolved scene stay
            warnings.retain(|warning| !old.contains(warning));
            warnings.extend(all_warnings(&scene));
        }
        Ok(Resumable { dir: dir.to_owned(), until, scene, end_before, warnings, checkpoint })
    }

    /// Its scene, with the end that it goes on to.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The end that it had so far [s].
    pub fn end_before(&self) -> f64 {
        self.end_before
    }

    /// Interval of its checkpoints in simulated time [s].
    pub fn checkpoint_interval(&self) -> Option<f64> {
        self.checkpoint.every
    }

    /// Warnings about its scene, with the end that it goes on to.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// Continue it. Of the options the folder is its own; `force`, `without_log` have no effect. A run that is refused is left as it is.
    pub fn resume(self, options: &RunOptions<'_>) -> Result<Outcome, RunError> {
        let Resumable { dir, until, scene, checkpoint, .. } = self;
        let file = |name: &str| dir.join(name);
        let _held = hold(&dir)?;
        let refused = |error| CheckpointError::State(file(super::checkpoint::FILE), error);
        let references = scene.compare.iter().map(compare::curve).collect::<Result<Vec<_>, _>>()?;
        let mut system = build::build(&scene)?;
        let mut recorder = Recorder::new(&scene, None, None, &system)?;
        let volume = system.fluid.volume();
        system.restore_bytes(&checkpoint.system).map_err(refused)?;
        let (time, end) = (system.fluid.time(), scene.time.end);
        let [summary, page] = OF_THE_END.map(|name| file(name).exists());
        let written = summary && (page || options.page.is_none());
        refuse_end(until, time, &scene, written)?;
        let rows = recorder.restore_bytes(&checkpoint.recorder).map_err(refused)?;
        recorder.live = start_live(&scene, options)?;
        let log = checkpoint.log.map(|log| LogObserver::resume(&file("log.mcap"), &scene, log));
        recorder.log = log.transpose()?;
        recorder.restore_series(rows, Some(&file("series.csv")))?;
        let written = write_whole(&dir, SCENE, "scene.resolved.toml.part", scene.to_toml().as_bytes());
        written.map_err(|error| RunError::Write(file(SCENE).display().to_string(), error))?;
        for path in OF_THE_END.map(file).into_iter().filter(|path| path.exists()) {
            std::fs::remove_file(&path).map_err(|error| RunError::Write(path.display().to_string(), error))?;
        }
        info!(scene = scene.name, time, end, steps = system.fluid.steps(), "resumed");
        let (scene, wall) = (&scene, checkpoint.wall);
        Run { scene, options, dir: Some(&dir), references, system, recorder, volume, wall, resumed: true }.complete()
    }
}

/// An error where the end is no later than the run is, or too late for its samples. A run that was killed at its end, before its last files
/// were `written`, goes on to write them.
fn refuse_end(until: Option<f64>, time: f64, scene: &Scene, written: bool) -> Result<(), CheckpointError> {
    let end = scene.time.end;
    let every = scene.time.sample_every.min(scene.time.frame_every);
    match until {
        Some(given) if !(given > time && given.is_finite() && every >= given / MOST_ROWS) => {
            Err(CheckpointError::Until { given, time })
        }
        None if written && !(end > time && end.is_finite()) => Err(CheckpointError::Ended { time, end }),
        _ => Ok(()),
    }
}
