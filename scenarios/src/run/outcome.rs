//! What a run is given besides its scene, and what it returns.

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use crate::compare::ReferenceCurve;
use crate::error_bar::ErrorBars;
use crate::observers::{FlowPictures, Series};
use crate::run::summary::Summary;

/// What a run is given besides its scene.
#[derive(Default)]
pub struct RunOptions<'a> {
    /// Folder for the files; without one nothing is written.
    pub out: Option<PathBuf>,
    /// Replace a run that the folder holds.
    pub force: bool,
    /// Write no `log.mcap`.
    pub without_log: bool,
    /// Set from outside to end the run after the present step.
    pub interrupt: Option<&'a AtomicBool>,
    /// Steps after which a run that has not reached its end has failed.
    pub most_steps: Option<u64>,
    /// Called with (time [s], steps) when the stepping begins and about ten times per second.
    pub progress: Option<&'a (dyn Fn(f64, u64) + Sync)>,
    /// Warnings about the scene, for the report.
    pub warnings: Vec<String>,
    /// Source of the error bars: a convergence study; stored charts if absent.
    pub error_bars: Option<&'a (dyn Fn(&Summary) -> ErrorBars + Sync)>,
}

/// A finished run in memory.
pub struct Outcome {
    /// The numbers.
    pub summary: Summary,
    /// The curves.
    pub series: Series,
    /// Reference curves, in the order of the scene's comparisons.
    pub references: Vec<ReferenceCurve>,
    /// Pictures of the flow.
    pub pictures: FlowPictures,
}
