//! A run of a scene at a spacing, made now or found in its folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use run::error_bar::ErrorBars;
use run::summary::Summary;
use run::{Checkpoints, Resumable, RunOptions, run};
use scene::vocabulary::{Quantity, ResultId, ResultName, Results, Status};
use scene::{Loaded, Scene};
use serde::Deserialize;

use crate::experiments::ExperimentError;

/// Spacings that differ by less are the same [-].
const SAME: f64 = 1e-9;

/// What a run gave.
#[derive(Clone, Debug)]
pub(super) struct Level {
    /// Its spacing [m].
    pub spacing: f64,
    pub model: String,
    pub results: Results,
    /// Wall-clock time × threads, 0 of a run that was found [s].
    pub core_seconds: f64,
}

/// What is read of `summary.json`.
#[derive(Deserialize)]
struct Stored {
    model: String,
    status: Status,
    results: Results,
}

impl Level {
    /// The run of a scene in its folder: found there, continued, or made.
    pub fn run(
        loaded: &Loaded,
        folder: PathBuf,
        bars: Option<&(dyn Fn(&Summary) -> ErrorBars + Sync)>,
        interrupt: Option<&AtomicBool>,
    ) -> Result<Level, ExperimentError> {
        let (scene, spacing) = (&loaded.scene, loaded.scene.resolution.spacing);
        if let Some(found) = Level::found(&folder, &scene.to_toml(), spacing) {
            return Ok(found);
        }
        let options = RunOptions {
            out: Some(folder.clone()),
            force: true,
            without_log: true,
            page: Some(report::page_of_run),
            warnings: loaded.warnings.clone(),
            error_bars: bars,
            checkpoints: Some(Checkpoints::default()),
            interrupt,
            ..RunOptions::default()
        };
        let is_own = fs::read_to_string(folder.join("scene.resolved.toml")).is_ok_and(|text| text == scene.to_toml());
        let interrupted = Resumable::open(&folder, None).ok().filter(|_| is_own);
        let summary = match interrupted {
            Some(begun) => begun.resume(&options)?,
            None => run(scene, &options)?,
        }
        .summary;
        match summary.status {
            Status::Interrupted => Err(ExperimentError::Interrupted(spacing, summary.time_end_s)),
            status if status.has_results() => Ok(Level::of(spacing, &summary)),
            _ => Err(ExperimentError::Ended(spacing, scene.sound_speed(), summary.message.clone().unwrap_or_default())),
        }
    }

    pub fn of(spacing: f64, summary: &Summary) -> Level {
        let core_seconds = summary.wall_time_s * summary.threads as f64;
        Level { spacing, model: summary.model.into(), results: summary.results.clone(), core_seconds }
    }

    /// Is the run of a scene in its folder, complete?
    pub fn is_done(scene: &Scene, folder: &Path) -> bool {
        Level::found(folder, &scene.to_toml(), scene.resolution.spacing).is_some()
    }

    fn found(folder: &Path, scene: &str, spacing: f64) -> Option<Level> {
        let text = |file: &str| fs::read_to_string(folder.join(file)).ok();
        let Stored { model, status, results } = serde_json::from_str(&text("summary.json")?).ok()?;
        let is_own = text("scene.resolved.toml")? == scene && status.has_results();
        is_own.then_some(Level { spacing, model, results, core_seconds: 0.0 })
    }

    pub fn is_at(&self, spacing: f64) -> bool {
        (self.spacing / spacing - 1.0).abs() < SAME
    }

    pub fn get(&self, id: &ResultId) -> Option<Quantity> {
        match &id.panel {
            None => self.results.get(id.name),
            Some(panel) => self.results.of_panel(panel, id.name),
        }
    }

    /// The bandwidths of this run as overrides: finer runs average over the same times.
    pub fn bandwidths(&self) -> Vec<String> {
        let keys =
            [(ResultName::PeakForce, "report.bandwidth"), (ResultName::PeakPressure, "report.pressure_bandwidth")];
        let set = |(name, key): (ResultName, &str)| Some(format!("{key}={:?}", self.results.get(name)?.cutoff_hz?));
        keys.into_iter().filter_map(set).collect()
    }
}
