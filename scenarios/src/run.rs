//! A run: step until the end, sample on the way, leave everything readable whatever happens.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use fsi_coupling::entry_theory::OutOfRange;
use fsi_coupling::{Coupled, CouplingError};
use sph_core::{Phase, parallel};
use tracing::{debug, info, warn};

use crate::build;
use crate::charted;
use crate::compare::{self, ReferenceCurve};
use crate::error_bar::ErrorBars;
use crate::model_hierarchy;
use crate::observe::{FlowPictures, LogObserver, ObserveError, Series};
use crate::present;
use crate::recorder::Recorder;
use crate::reference::ReferenceError;
use crate::scene::Scene;
use crate::summary::{Status, Summary};

/// Files of a run, by the contract of the command line.
pub const FILES: [&str; 5] = ["log.mcap", "series.csv", "summary.json", "scene.resolved.toml", "report.html"];

/// A run that cannot start, or cannot keep its results.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The output folder holds a run already.
    #[error("{0} already holds a run ({1}): choose another --out, or --force to replace it")]
    Occupied(String, &'static str),
    /// A file or folder could not be written.
    #[error("cannot write {0}: {1}")]
    Write(String, std::io::Error),
    /// The output folder's name is that of a file.
    #[error("{0} is a file: choose another --out")]
    NotAFolder(String),
    /// An observer failed.
    #[error(transparent)]
    Observe(#[from] ObserveError),
    /// A reference that the scene names cannot be used.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// The scene cannot be built.
    #[error(transparent)]
    Build(#[from] CouplingError),
    /// The model cannot do the scene.
    #[error("model = \"{0}\" holds for {1}")]
    Theory(&'static str, OutOfRange),
}

impl RunError {
    /// True if the user's input is at fault (exit 2), false if the run is (exit 1).
    pub fn is_input(&self) -> bool {
        !matches!(self, RunError::Write(..) | RunError::Observe(_))
    }
}

/// What a run is told besides its scene.
#[derive(Default)]
pub struct RunOptions<'a> {
    /// Folder for the files; nothing is written without one.
    pub out: Option<PathBuf>,
    /// Replace a run that is there.
    pub force: bool,
    /// Write no `log.mcap`.
    pub without_log: bool,
    /// Set from outside to end the run cleanly.
    pub interrupt: Option<&'a AtomicBool>,
    /// Steps after which a run that has not come to its end has failed.
    pub most_steps: Option<u64>,
    /// Called with (time, steps): when the stepping begins, and now and then.
    pub progress: Option<&'a (dyn Fn(f64, u64) + Sync)>,
    /// Doubts about the scene, for the report.
    pub warnings: Vec<String>,
    /// Where the error bars are from: a convergence study; charts measured before, if absent.
    pub error_bars: Option<&'a (dyn Fn(&Summary) -> ErrorBars + Sync)>,
}

/// Why a run stopped before its end.
#[derive(Debug, thiserror::Error)]
enum Breakdown {
    #[error(transparent)]
    Step(#[from] CouplingError),
    #[error("not at its end after {0} steps, but at t = {1:.6} s")]
    Endless(u64, f64),
}

/// A finished run in memory.
pub struct Outcome {
    /// The numbers.
    pub summary: Summary,
    /// The curves.
    pub series: Series,
    /// Reference curves with the scene's comparison they belong to.
    pub references: Vec<ReferenceCurve>,
    /// Pictures.
    pub pictures: FlowPictures,
}

/// Share of the exchanged work that may be lost on the way unmentioned.
const LARGEST_WORK_GAP: f64 = 0.01;
/// Between two calls of the progress function.
const PROGRESS_EVERY: Duration = Duration::from_millis(100);

/// Run a scene.
pub fn run(scene: &Scene, options: &RunOptions<'_>) -> Result<Outcome, RunError> {
    let references = scene.compare.iter().map(compare::curve).collect::<Result<Vec<_>, _>>()?;
    let file = |name: &str| options.out.as_ref().map(|dir| dir.join(name));
    if let Some(dir) = &options.out {
        refuse_occupied(dir, options.force)?;
    }
    if scene.model.is_theory() {
        prepare(scene, options)?;
        return keep(scene, model_hierarchy::run(scene, options, references)?, options);
    }
    let mut system = build::build(scene)?;
    prepare(scene, options)?;
    let log = file("log.mcap").filter(|_| !options.without_log);
    let mut recorder = Recorder::new(scene, file("series.csv").as_deref(), log.as_deref(), &system)?;
    let (start, volume) = (Instant::now(), system.fluid.volume());
    info!(scene = scene.name, fluid = system.fluid.particles().len(), walls = system.walls.len(), "built");

    // on a thread of the pool from beginning to end: no step has to wake it
    let ended = parallel::within_pool(|| advance(scene, &mut system, &mut recorder, options))?;

    let (status, message) = match ended {
        Ok(status) => (status, None),
        Err(breakdown) => (Status::Failed, Some(breakdown.to_string())),
    };
    if status != Status::Completed {
        recorder.last_words(&system, status, message.as_deref())?;
    }
    system.fluid.timers_mut().begin(Phase::Log);
    let logged = recorder.log.take().map(LogObserver::finish).transpose()?;
    system.fluid.timers_mut().end();
    let wall = start.elapsed().as_secs_f64();
    info!(?status, steps = system.fluid.steps(), lists = system.fluid.neighbours().rebuilds, wall, "ended");
    let mut summary = recorder.summarise(scene, &system, &references, status, message, wall, volume, logged);
    recorder.series.flush()?;
    if summary.audit.work > LARGEST_WORK_GAP {
        warn!(
            "{:.1} % of the work that the water did on the body did not arrive as such: the steps are too long for how fast it \
             bends; take a smaller time.step or fluid.cfl",
            100.0 * summary.audit.work
        );
    }
    if summary.status == Status::Completed {
        summary.error_bars = options.error_bars.map_or_else(|| charted::error_bars(scene, &summary), |of| of(&summary));
    }
    keep(scene, Outcome { summary, series: recorder.series, references, pictures: recorder.pictures }, options)
}

/// The folder, without a former run's files and with the scene.
fn prepare(scene: &Scene, options: &RunOptions<'_>) -> Result<(), RunError> {
    let Some(dir) = &options.out else { return Ok(()) };
    std::fs::create_dir_all(dir).map_err(|e| RunError::Write(dir.display().to_string(), e))?;
    clear(dir)?;
    write(&dir.join("scene.resolved.toml"), &scene.to_toml())
}

/// Summary and report of what came out.
fn keep(scene: &Scene, outcome: Outcome, options: &RunOptions<'_>) -> Result<Outcome, RunError> {
    if let Some(dir) = &options.out {
        write(&dir.join("summary.json"), &outcome.summary.to_json())?;
        write(&dir.join("report.html"), &present::report(scene, &outcome, &options.warnings))?;
    }
    Ok(outcome)
}

/// Step to the end; inside, the breakdown that stopped the run, if one did.
fn advance(
    scene: &Scene,
    system: &mut Coupled,
    recorder: &mut Recorder,
    options: &RunOptions<'_>,
) -> Result<Result<Status, Breakdown>, RunError> {
    let mut told = Instant::now();
    if let Some(tell) = options.progress {
        tell(0.0, 0);
    }
    observe(system, recorder)?;
    while system.fluid.time() < scene.time.end {
        if options.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            return Ok(Ok(Status::Interrupted));
        }
        if options.most_steps.is_some_and(|most| system.fluid.steps() >= most) {
            return Ok(Err(Breakdown::Endless(system.fluid.steps(), system.fluid.time())));
        }
        system.fluid.timers_mut().begin(Phase::Integration);
        let dt = scene.time.step.map_or_else(|| system.stable_dt(), Ok); // LE5
        let stepped = dt.and_then(|dt| Ok((dt, system.step_or_shorter(dt)?)));
        match stepped {
            Err(breakdown) => return Ok(Err(breakdown.into())),
            Ok((asked, taken)) if taken < asked => {
                warn!(
                    "pressure not converged: a step of {taken:.3e} s in the place of {asked:.3e} s to t = {}",
                    system.fluid.time()
                );
            }
            Ok(_) => {}
        }
        debug!(step = system.fluid.steps(), time = system.fluid.time(), "stepped");
        observe(system, recorder)?;
        if told.elapsed() > PROGRESS_EVERY {
            told = Instant::now();
            if let Some(tell) = options.progress {
                tell(system.fluid.time(), system.fluid.steps());
            }
        }
    }
    Ok(Ok(Status::Completed))
}

/// Observe if something is due, and say whose time that was.
fn observe(system: &mut Coupled, recorder: &mut Recorder) -> Result<(), ObserveError> {
    let outer = system.fluid.timers_mut().begin(Phase::Observers);
    recorder.observe(system)?;
    system.fluid.timers_mut().hand_over(Phase::Log, recorder.time_of_log());
    system.fluid.timers_mut().resume(outer);
    Ok(())
}

/// An error where a folder holds a run that is not to be replaced.
pub(crate) fn refuse_occupied(dir: &Path, force: bool) -> Result<(), RunError> {
    if dir.is_file() {
        return Err(RunError::NotAFolder(dir.display().to_string()));
    }
    match FILES.iter().find(|name| dir.join(name).exists()) {
        Some(name) if !force => Err(RunError::Occupied(dir.display().to_string(), name)),
        _ => Ok(()),
    }
}

/// Remove a former run's files, so that none of them can be taken for this run's.
fn clear(dir: &Path) -> Result<(), RunError> {
    for name in FILES {
        let path = dir.join(name);
        if path.exists() {
            std::fs::remove_file(&path).map_err(|e| RunError::Write(path.display().to_string(), e))?;
        }
    }
    Ok(())
}

fn write(path: &Path, text: &str) -> Result<(), RunError> {
    std::fs::write(path, text).map_err(|e| RunError::Write(path.display().to_string(), e))
}
