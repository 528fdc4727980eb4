//! A run: build the scene, step to its end, observe on the way, keep log, curves, summary and report.

mod audit;
pub mod checkpoint;
mod driver;
mod link_results;
mod modes;
mod panel;
mod particle_order;
mod recorder;
mod recorder_state;
mod resume;
pub mod summary;

use std::fs::{File, TryLockError};
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::thread;
use std::time::{Duration, Instant};

use fsi_coupling::CouplingError;
use sph_core::Breakdown;
use water_entry::OutOfRange;

use crate::error_bar::ErrorBars;
use crate::log::LogError;
use crate::observers::{ObserveError, Series};
use crate::reference::ReferenceError;
use crate::report::run_page::FolderError;
use checkpoint::CheckpointError;
use summary::Summary;

pub(crate) use driver::{Run, start_folder};
pub(crate) use recorder::{Observed, Recorder};
pub(crate) use recorder_state::Mark;

pub use driver::run;
pub use particle_order::ParticleOrder;
pub use resume::Resumable;
pub use summary::{Extremes, PanelEnvelope, PanelResult, Rupture};

/// Files of a run, by the contract of the command line.
pub const FILES: [&str; 6] =
    ["log.mcap", "series.csv", "summary.json", "scene.resolved.toml", "report.html", "checkpoint.bin"];

/// Longest wait for a folder that another process holds.
const PATIENCE: Duration = Duration::from_secs(1);

/// What a run is given besides its scene.
#[derive(Default)]
pub struct RunOptions<'a> {
    /// Folder for the files; without one nothing is written.
    pub out: Option<PathBuf>,
    /// Replace a run that the folder holds.
    pub force: bool,
    /// Address at which viewers are shown the run while it goes on; with port 0 the system chooses one.
    pub live: Option<SocketAddr>,
    /// Called with the port when the server of `live` listens.
    pub live_at: Option<&'a (dyn Fn(u16) + Sync)>,
    /// Write no `log.mcap`.
    pub without_log: bool,
    /// Set from outside to end the run after the present step.
    pub interrupt: Option<&'a AtomicBool>,
    /// Set when the last step has been taken and files are left to write.
    pub stepped: Option<&'a AtomicBool>,
    /// Keep checkpoints, so that the run can be resumed.
    pub checkpoints: Option<Checkpoints>,
    /// Steps after which a run that has not reached its end has failed.
    pub most_steps: Option<u64>,
    /// Called with (time [s], steps) when the stepping begins and about ten times per second.
    pub progress: Option<&'a (dyn Fn(f64, u64) + Sync)>,
    /// The interface by which a host program moves the body.
    pub host: Option<&'static str>,
    /// Warnings about the scene, for summary and report.
    pub warnings: Vec<String>,
    /// Source of the error bars: a convergence study; stored charts if absent.
    pub error_bars: Option<&'a (dyn Fn(&Summary) -> ErrorBars + Sync)>,
}

/// When a run writes its checkpoint: if it is interrupted, and as asked here.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Checkpoints {
    /// Every so many seconds of simulated time, and at the end [s].
    pub every: Option<f64>,
}

/// A finished run in memory.
pub struct Outcome {
    /// The numbers.
    pub summary: Summary,
    /// The curves.
    pub series: Series,
}

/// Why a run cannot start, or cannot keep its results.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The output folder holds a run already.
    #[error("{0} already holds a run ({1}): choose another folder, or replace it (--force)")]
    Occupied(String, &'static str),
    /// A file or folder could not be written.
    #[error("cannot write {0}: {1}")]
    Write(String, std::io::Error),
    /// Another process writes to the folder.
    #[error("{0}: another run writes there: wait for it, or choose another folder")]
    Held(String),
    /// The output folder's name is that of a file.
    #[error("{0} is a file: choose another folder")]
    NotAFolder(String),
    /// An observer failed.
    #[error(transparent)]
    Observe(#[from] ObserveError),
    /// The files of the run cannot be read back for its report.
    #[error(transparent)]
    Report(#[from] FolderError),
    /// A reference that the scene names cannot be used.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// The scene cannot be built.
    #[error("{}", at_start(.0))]
    Build(#[from] CouplingError),
    /// A run that cannot be resumed.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// Checkpoints of a model that has no steps.
    #[error("model = \"{0}\" has no steps to keep checkpoints of: expected a model of particles")]
    NoSteps(&'static str),
    /// The model does not apply to the scene.
    #[error("model = \"{0}\" holds for {1}")]
    Theory(&'static str, OutOfRange),
}

/// An error of the first moment, with the keys that make it.
fn at_start(error: &CouplingError) -> String {
    match error {
        CouplingError::Fluid(Breakdown::Density { .. }) => format!(
            "{error}; the water cannot start so: expected a larger `fluid.sound_speed`, or `fluid.density_evolution` = \"continuity\""
        ),
        other => other.to_string(),
    }
}

impl RunError {
    /// True if the user's input is at fault (exit 2), false if the run is (exit 1).
    pub fn is_input(&self) -> bool {
        match self {
            RunError::Write(..) | RunError::Report(_) => false,
            RunError::Observe(why) => matches!(why, ObserveError::Log(LogError::Live(..) | LogError::Read(..))),
            _ => true,
        }
    }
}

/// An error if the folder holds a run that may not be replaced.
pub(crate) fn refuse_occupied(dir: &Path, force: bool) -> Result<(), RunError> {
    refuse_files(dir, &FILES, force)
}

/// An error if the folder is a file, or holds one of these files that may not be replaced.
pub(crate) fn refuse_files(dir: &Path, files: &[&'static str], force: bool) -> Result<(), RunError> {
    if dir.is_file() {
        return Err(RunError::NotAFolder(dir.display().to_string()));
    }
    match files.iter().find(|name| dir.join(name).exists()) {
        Some(name) if !force => Err(RunError::Occupied(dir.display().to_string(), name)),
        _ => Ok(()),
    }
}

/// Make the folder, hold it and remove the files of an earlier run, so that no file is mistaken for one of this run.
fn prepare(dir: &Path) -> Result<Held, RunError> {
    let wrong = |path: &Path, e| RunError::Write(path.display().to_string(), e);
    std::fs::create_dir_all(dir).map_err(|e| wrong(dir, e))?;
    let held = hold(dir)?;
    let parts = [checkpoint::PART, "log.mcap.part", "series.csv.part", "scene.resolved.toml.part"];
    for path in FILES.iter().chain(&parts).map(|name| dir.join(name)).filter(|path| path.exists()) {
        std::fs::remove_file(&path).map_err(|e| wrong(&path, e))?;
    }
    Ok(held)
}

/// The lock on a folder, as long as the value lives; the system frees it when the process ends.
pub(crate) struct Held {
    _folder: Option<File>,
}

/// Hold a folder, so that no other process writes a run there. Where the system cannot lock folders, nothing is held.
fn hold(dir: &Path) -> Result<Held, RunError> {
    let folder = File::open(dir).ok();
    let start = Instant::now();
    loop {
        match folder.as_ref().map(File::try_lock) {
            // a process that was killed holds it until the system has taken it down
            Some(Err(TryLockError::WouldBlock)) if start.elapsed() < PATIENCE => thread::sleep(PATIENCE / 100),
            Some(Err(TryLockError::WouldBlock)) => return Err(RunError::Held(dir.display().to_string())),
            _ => return Ok(Held { _folder: folder }),
        }
    }
}

/// Write a text file.
pub(crate) fn write(path: &Path, text: &str) -> Result<(), RunError> {
    std::fs::write(path, text).map_err(|e| RunError::Write(path.display().to_string(), e))
}
