//! Whole runs: a dam break with two solvers, and what the log costs.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use run::summary::{PhaseTime, Summary};
use run::{RunOptions, run};
use scene::Scene;
use serde::Serialize;

use super::error::BenchError;

/// A column of water of 1 m x 2 m lets go; 20 000 particles.
const COLUMN: &str = include_str!("column.toml");

/// A dam break that was stepped for some time.
#[derive(Clone, Debug, Serialize)]
pub struct Column {
    /// What gave the pressure.
    pub solver: &'static str,
    /// Particles.
    pub particles: usize,
    /// Threads.
    pub threads: usize,
    /// Time reached [s].
    pub simulated_s: f64,
    /// Steps.
    pub steps: u64,
    /// Wall time of a second of simulated time [-].
    pub wall_s_per_simulated_s: f64,
    /// Where the wall time went.
    pub phases: BTreeMap<&'static str, PhaseTime>,
}

/// A run with its log and without.
#[derive(Clone, Debug, Serialize)]
pub struct LogCost {
    /// The scene.
    pub scene: String,
    /// Threads.
    pub threads: usize,
    /// Steps between two frames of particles, mean.
    pub steps_per_frame: f64,
    /// Wall time with the log over that without [-].
    pub on_over_off: f64,
}

/// The dam break to `end` [s] of simulated time or for `most` of wall time, whichever is first.
pub(super) fn column(solver: &'static str, end: f64, most: Duration) -> Result<Column, BenchError> {
    let scene = scene_of(COLUMN, &[format!("solver={solver}"), format!("time.end={end}")])?;
    let (enough, start) = (AtomicBool::new(false), Instant::now());
    let watch = |_: f64, _: u64| enough.store(start.elapsed() > most, Ordering::Relaxed);
    let options = RunOptions { interrupt: Some(&enough), progress: Some(&watch), ..RunOptions::default() };
    let Summary { particles, threads, time_end_s, wall_time_s, steps, phases, .. } = run(&scene, &options)?.summary;
    Ok(Column {
        solver,
        particles: particles.fluid,
        threads,
        simulated_s: time_end_s,
        steps,
        wall_s_per_simulated_s: wall_time_s / time_end_s,
        phases,
    })
}

/// The column with samples and frames as often as those of a run of 0.1 s.
pub(super) fn log_of_column(end: f64, turns: usize) -> Result<LogCost, BenchError> {
    let often = ["time.sample_every=0.0002".into(), "time.frame_every=0.002".into()];
    let sets = [&often[..], &[format!("time.end={end}")]].concat();
    log_cost(&scene_of(COLUMN, &sets)?, turns)
}

/// A built-in scene as it is, or with another spacing [m].
pub(super) fn log_of_builtin(name: &str, spacing: Option<f64>, turns: usize) -> Result<LogCost, BenchError> {
    let sets: Vec<String> = spacing.map(|dx| format!("resolution.spacing={dx}")).into_iter().collect();
    log_cost(&run::load(name, &sets)?.scene, turns)
}

fn scene_of(toml: &str, sets: &[String]) -> Result<Scene, BenchError> {
    Ok(run::load_text("column.toml", toml, sets)?.scene)
}

/// With the log and without by turns, into a temporary folder; the shortest of each counts.
fn log_cost(scene: &Scene, turns: usize) -> Result<LogCost, BenchError> {
    let folder = std::env::temp_dir().join(format!("splashdown-bench-{}", std::process::id()));
    let measured = log_cost_in(&folder, scene, turns);
    let _ = std::fs::remove_dir_all(&folder); // what is left of it is in the system's folder for such things
    measured
}

fn log_cost_in(folder: &Path, scene: &Scene, turns: usize) -> Result<LogCost, BenchError> {
    let (mut shortest, mut last) = ([f64::INFINITY; 2], None);
    for turn in 0..turns {
        for on in [turn % 2 == 0, turn % 2 == 1] {
            let out = Some(folder.to_path_buf());
            let options = RunOptions {
                out,
                force: true,
                page: Some(report::page_of_run),
                without_log: !on,
                ..RunOptions::default()
            };
            let summary = run(scene, &options)?.summary;
            let best = &mut shortest[usize::from(on)];
            *best = best.min(summary.wall_time_s);
            last = if on { Some(summary) } else { last };
        }
    }
    let [off, on] = shortest;
    let (steps, threads) = last.as_ref().map_or((0, 0), |s| (s.steps, s.threads));
    let frames = last.and_then(|s| s.log).map_or(1, |log| log.frames.max(1));
    let steps_per_frame = steps as f64 / frames as f64;
    Ok(LogCost { scene: scene.name.clone(), threads, steps_per_frame, on_over_off: on / off })
}
