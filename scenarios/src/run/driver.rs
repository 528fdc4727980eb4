//! The loop of a run: step until the end, observe, and keep what was computed even if the run fails.

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use fsi_coupling::{Coupled, CouplingError};
use sph_core::{Phase, parallel};
use tracing::{debug, info, warn};

use super::recorder::Recorder;
use super::summary::Status;
use super::{Outcome, RunError, RunOptions, prepare, refuse_occupied, write};
use crate::build;
use crate::charted;
use crate::compare;
use crate::model_hierarchy;
use crate::observers::{LiveObserver, LogObserver, ObserveError};
use crate::report::run_page;
use crate::scene::Scene;

/// Why a run stopped before its end.
#[derive(Debug, thiserror::Error)]
enum Breakdown {
    #[error(transparent)]
    Step(#[from] CouplingError),
    #[error("end time not reached after {0} steps: t = {1:.6} s")]
    Endless(u64, f64),
}

/// Interval between two calls of the progress function.
const PROGRESS_EVERY: Duration = Duration::from_millis(100);

/// Run a scene.
pub fn run(scene: &Scene, options: &RunOptions<'_>) -> Result<Outcome, RunError> {
    let references = scene.compare.iter().map(compare::curve).collect::<Result<Vec<_>, _>>()?;
    let file = |name: &str| options.out.as_ref().map(|dir| dir.join(name));
    if let Some(dir) = &options.out {
        refuse_occupied(dir, options.force)?;
    }
    if scene.model.is_theory() {
        start_folder(scene, options)?;
        return keep(model_hierarchy::run(scene, options, references)?, options);
    }
    let mut system = build::build(scene)?;
    let live = options.live.map(|address| LiveObserver::start(address, scene)).transpose()?;
    if let (Some(live), Some(tell)) = (&live, options.live_at) {
        tell(live.port());
    }
    start_folder(scene, options)?;
    let log = file("log.mcap").filter(|_| !options.without_log);
    let mut recorder = Recorder::new(scene, file("series.csv").as_deref(), log.as_deref(), &system)?;
    recorder.live = live;
    let (start, volume) = (Instant::now(), system.fluid.volume());
    info!(scene = scene.name, fluid = system.fluid.particles().len(), walls = system.walls.len(), "built");

    // on one thread of the pool for the whole run: no step wakes the pool
    let ended = parallel::within_pool(|| advance(scene, &mut system, &mut recorder, options))?;

    if let Some(stepped) = options.stepped {
        stepped.store(true, Ordering::Relaxed);
    }
    let (status, message) = match ended {
        Ok(status) => (status, None),
        Err(breakdown) => (Status::Failed, Some(breakdown.to_string())),
    };
    if status != Status::Completed {
        recorder.record_stop(&system, status, message.as_deref())?;
    }
    system.fluid.timers_mut().begin(Phase::Log);
    let logged = recorder.log.take().map(LogObserver::finish).transpose()?;
    system.fluid.timers_mut().end();
    let wall = start.elapsed().as_secs_f64();
    info!(?status, steps = system.fluid.steps(), lists = system.fluid.neighbours().rebuilds, wall, "ended");
    let mut summary = recorder.summarise(scene, &system, &references, status, message, wall, volume, logged);
    recorder.series.flush()?;
    if summary.status.is_completed() {
        summary.error_bars = options.error_bars.map_or_else(|| charted::error_bars(scene, &summary), |of| of(&summary));
    }
    keep(Outcome { summary, series: recorder.series }, options)
}

/// Empty the folder and write the resolved scene into it.
fn start_folder(scene: &Scene, options: &RunOptions<'_>) -> Result<(), RunError> {
    let Some(dir) = &options.out else { return Ok(()) };
    prepare(dir)?;
    write(&dir.join("scene.resolved.toml"), &scene.to_toml())
}

/// Write summary and report.
fn keep(mut outcome: Outcome, options: &RunOptions<'_>) -> Result<Outcome, RunError> {
    outcome.summary.warnings = options.warnings.clone();
    if let Some(dir) = &options.out {
        write(&dir.join("summary.json"), &outcome.summary.to_json())?;
        write(&dir.join("report.html"), &run_page::report(dir)?)?;
    }
    Ok(outcome)
}

/// Step to the end. The inner error is the breakdown that stopped the run.
fn advance(
    scene: &Scene,
    system: &mut Coupled,
    recorder: &mut Recorder,
    options: &RunOptions<'_>,
) -> Result<Result<Status, Breakdown>, RunError> {
    let mut shown = Instant::now();
    if let Some(show) = options.progress {
        show(0.0, 0);
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
                    "pressure not converged: a step of {taken:.3e} s instead of {asked:.3e} s to t = {}",
                    system.fluid.time()
                );
            }
            Ok(_) => {}
        }
        debug!(step = system.fluid.steps(), time = system.fluid.time(), "stepped");
        observe(system, recorder)?;
        if shown.elapsed() > PROGRESS_EVERY {
            shown = Instant::now();
            if let Some(show) = options.progress {
                show(system.fluid.time(), system.fluid.steps());
            }
        }
    }
    Ok(Ok(Status::Completed))
}

/// Observe if something is due; the time counts as that of the observers and of the log.
fn observe(system: &mut Coupled, recorder: &mut Recorder) -> Result<(), ObserveError> {
    let outer = system.fluid.timers_mut().begin(Phase::Observers);
    recorder.observe(system)?;
    recorder.show(system)?;
    system.fluid.timers_mut().hand_over(Phase::Log, recorder.time_of_log());
    system.fluid.timers_mut().resume(outer);
    Ok(())
}
