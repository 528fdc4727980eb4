//! What a run is given, and what it returns.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use scene::Scene;

use crate::error_bar::ErrorBars;
use crate::log::{LogError, Viewers};
use crate::observers::Series;
use crate::summary::Summary;

/// What a run is given besides its scene.
#[derive(Default)]
pub struct RunOptions<'a> {
    /// Folder for the files; without one nothing is written.
    pub out: Option<PathBuf>,
    /// Replace a run that the folder holds.
    pub force: bool,
    /// Starts viewers that are shown the run while it goes on.
    pub live: Option<&'a StartViewers<'a>>,
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
    /// Makes `report.html` of the other files in the folder; without it there is none.
    pub page: Option<Page>,
}

/// Starts the viewers of a scene's run.
pub type StartViewers<'a> = dyn Fn(&Scene) -> Result<Box<dyn Viewers>, LogError> + Sync + 'a;

/// The text of the page of the run in a folder.
pub type Page = fn(&Path) -> Result<String, Box<dyn Error + Send + Sync>>;

/// When a run writes its checkpoint: if it is interrupted, and as asked here.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Checkpoints {
    /// At this interval of simulated time, and at the end [s].
    pub every: Option<f64>,
}

/// A finished run in memory.
pub struct Outcome {
    /// The numbers.
    pub summary: Summary,
    /// The curves.
    pub series: Series,
}
