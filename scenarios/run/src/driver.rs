//! The loop of a run: step until the end, observe, and keep what was computed even if the run fails.

use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use fsi_coupling::{BodyError, Coupled, CouplingError};
use scene::Scene;
use scene::vocabulary::Status;
use sph_core::{Phase, parallel};
use tracing::{debug, info, warn};

use super::checkpoint::{self, Checkpoint, fingerprint, write_whole};
use super::panel::first_rupture;
use super::recorder::{Observed, Recorder, next};
use crate::compare::{self, ReferenceCurve};
use crate::error::RunError;
use crate::folder::{HOST_MARK, Held, prepare, refuse_occupied, write};
use crate::observers::{LiveObserver, LogObserver, ObserveError};
use crate::options::{Checkpoints, Outcome, RunOptions};
use crate::{build, charted, model_hierarchy, stated};

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
        if options.checkpoints.is_some_and(|asked| asked.every.is_some()) {
            return Err(RunError::NoSteps(scene.model.name()));
        }
        let followed = model_hierarchy::Followed::new(scene)?;
        let _held = start_folder(scene, options)?;
        let outcome = model_hierarchy::run(scene, followed, options, references)?;
        return keep(scene, outcome, options.out.as_deref(), options);
    }
    let system = build::build(scene)?;
    let live = start_live(scene, options)?;
    let _held = start_folder(scene, options)?;
    let log = file("log.mcap").filter(|_| !options.without_log);
    let mut recorder = Recorder::new(scene, file("series.csv").as_deref(), log.as_deref(), &system)?;
    recorder.live = live;
    let (fluid, walls) = (system.fluid.particles().len(), system.walls.len());
    info!(scene = scene.name, fluid, walls, "built");
    let volume = system.fluid.volume();
    let dir = options.out.as_deref();
    Run { scene, options, dir, references, system, recorder, volume, wall: 0.0, resumed: false }.complete()
}

/// A run between two steps.
pub(crate) struct Run<'a> {
    pub scene: &'a Scene,
    pub options: &'a RunOptions<'a>,
    /// Folder for the files.
    pub dir: Option<&'a Path>,
    pub references: Vec<ReferenceCurve>,
    pub system: Coupled,
    pub recorder: Recorder,
    /// Volume of the fluid at the start [m²].
    pub volume: f64,
    /// Wall time of the processes before this one [s].
    pub wall: f64,
    /// Continued from a checkpoint: the state was observed, and its last step was another process's.
    pub resumed: bool,
}

impl Run<'_> {
    /// Step to the end, and write what is left to write.
    pub fn complete(mut self) -> Result<Outcome, RunError> {
        let start = Instant::now();
        // on one thread of the pool for the whole run: no step wakes the pool
        let (ended, checkpoint) = parallel::within_pool(|| {
            let (ended, seen) = self.advance(start)?;
            if let Some(stepped) = self.options.stepped {
                stepped.store(true, Ordering::Relaxed);
            }
            let checkpoint = self.last_checkpoint(&ended, start)?;
            if matches!(ended, Ok(Status::Completed | Status::Ruptured)) {
                self.observing(|recorder, system| recorder.complete(system, seen))?;
            }
            Ok::<_, RunError>((ended, checkpoint))
        })?;
        let (status, message) = match ended {
            // BE26: the surface stays closed to the water, which an opening would let in
            Ok(Status::Ruptured) => {
                (Status::Ruptured, first_rupture(&self.system).map(|what| format!("{what}: the run ends there")))
            }
            Ok(status) => (status, None),
            Err(breakdown) => (Status::Failed, Some(in_words(&breakdown, self.scene))),
        };
        let dir = self.dir;
        let outcome = self.conclude(status, message, start)?;
        if let Some((dir, bytes)) = dir.zip(checkpoint) {
            write_checkpoint(dir, &bytes)?;
        }
        Ok(outcome)
    }

    /// Complete the log of a run that took its last step, and write summary and report.
    pub(crate) fn conclude(self, status: Status, message: Option<String>, start: Instant) -> Result<Outcome, RunError> {
        let Run { scene, options, dir, references, mut system, mut recorder, volume, .. } = self;
        if !matches!(status, Status::Completed | Status::Ruptured) {
            recorder.record_stop(&system, status, message.as_deref())?;
        }
        recorder.series.release();
        system.fluid.timers_mut().begin(Phase::Log);
        let logged = recorder.log.take().map(LogObserver::finish).transpose()?;
        system.fluid.timers_mut().end();
        let wall = self.wall + start.elapsed().as_secs_f64();
        info!(?status, steps = system.fluid.steps(), lists = system.fluid.neighbours().rebuilds, wall, "ended");
        let mut summary = recorder.summarise(scene, &system, &references, status, message, wall, volume, logged);
        recorder.series.flush()?;
        if summary.status.is_completed() {
            summary.error_bars =
                options.error_bars.map_or_else(|| charted::error_bars(scene, &summary), |of| of(&summary));
        }
        keep(scene, Outcome { summary, series: recorder.series }, dir, options)
    }
}

/// The server of a live view, if one is asked for.
pub(super) fn start_live(scene: &Scene, options: &RunOptions<'_>) -> Result<Option<LiveObserver>, ObserveError> {
    let viewers = options.live.map(|start| start(scene)).transpose()?;
    Ok(viewers.map(|viewers| LiveObserver::new(viewers, scene)))
}

/// Hold and empty the folder, and write the resolved scene into it.
pub(crate) fn start_folder(scene: &Scene, options: &RunOptions<'_>) -> Result<Option<Held>, RunError> {
    let Some(dir) = &options.out else { return Ok(None) };
    let held = prepare(dir)?;
    let mark = options.host.map_or(String::new(), |interface| format!("{HOST_MARK}{interface}\n"));
    write(&dir.join("scene.resolved.toml"), &(mark + &scene.to_toml()))?;
    Ok(Some(held))
}

/// Write summary and report.
fn keep(
    scene: &Scene,
    mut outcome: Outcome,
    dir: Option<&Path>,
    options: &RunOptions<'_>,
) -> Result<Outcome, RunError> {
    stated::add(scene, &mut outcome.summary, &outcome.series);
    outcome.summary.warnings = options.warnings.clone();
    outcome.summary.host = options.host;
    if let Some(dir) = dir {
        write(&dir.join("summary.json"), &outcome.summary.to_json())?;
        if let Some(page) = options.page {
            write(&dir.join("report.html"), &page(dir).map_err(RunError::Report)?)?;
        }
    }
    Ok(outcome)
}

/// A breakdown with the keys that prevent it.
fn in_words(breakdown: &Breakdown, scene: &Scene) -> String {
    let mut panels = scene.body.iter().flat_map(|body| &body.panels);
    match breakdown {
        Breakdown::Step(CouplingError::Body(BodyError::Structure { reason, .. }))
            if reason.contains("not converged") && panels.any(|panel| panel.yield_stress.is_some()) =>
        {
            format!(
                "{breakdown}; a panel yields faster than its equations are solved: expected fewer `body.panels[].elements`, a higher \
                 `hardening_modulus`, or a smaller `time.step`"
            )
        }
        _ => breakdown.to_string(),
    }
}

impl Run<'_> {
    /// Step to the end, and what was due after the last step. The inner error is the breakdown that stopped the run.
    fn advance(&mut self, start: Instant) -> Result<(Result<Status, Breakdown>, Observed), RunError> {
        let Run { scene, options, .. } = *self;
        let mut shown = Instant::now();
        let every = options.checkpoints.and_then(|asked| asked.every);
        let mut due = every.map(|every| next(every, self.system.fluid.time()));
        if let Some(show) = options.progress {
            show(self.system.fluid.time(), self.system.fluid.steps());
        }
        let mut seen = if self.resumed { Observed::Frame } else { self.observe()? };
        let first = self.system.fluid.steps();
        while self.system.fluid.time() < scene.time.end {
            let system = &mut self.system;
            let is_asked = options.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed));
            // a state of another process is stepped from before it is observed
            if is_asked && !(self.resumed && system.fluid.steps() == first) {
                return Ok((Ok(Status::Interrupted), seen));
            }
            if options.most_steps.is_some_and(|most| system.fluid.steps() >= most) {
                return Ok((Err(Breakdown::Endless(system.fluid.steps(), system.fluid.time())), seen));
            }
            system.fluid.timers_mut().begin(Phase::Integration);
            let whole = scene.time.end - scene.time.start; // water at rest without gravity has no limit
            let dt = scene.time.step.map_or_else(|| system.stable_dt().map(|dt| dt.min(whole)), Ok); // LE5
            let stepped = dt.and_then(|dt| Ok((dt, system.step_or_shorter(dt)?)));
            match stepped {
                Err(breakdown) => return Ok((Err(breakdown.into()), seen)),
                Ok((asked, taken)) if taken < asked => {
                    warn!(
                        "pressure not converged: a step of {taken:.3e} s instead of {asked:.3e} s to t = {}",
                        system.fluid.time()
                    );
                }
                Ok(_) => {}
            }
            let (step, time) = (system.fluid.steps(), system.fluid.time());
            debug!(step, time, "stepped");
            seen = self.observe()?;
            if self.system.bodies().any(|body| body.first_rupture().is_some()) {
                return Ok((Ok(Status::Ruptured), seen));
            }
            if let Some((due, every)) =
                due.as_mut().zip(every).filter(|(due, _)| time >= **due && time < scene.time.end)
            {
                *due = next(every, time);
                self.system.fluid.timers_mut().begin(Phase::Log);
                if let Some(dir) = self.dir {
                    write_checkpoint(dir, &self.checkpoint(start)?)?;
                }
            }
            if shown.elapsed() > PROGRESS_EVERY {
                shown = Instant::now();
                if let Some(show) = options.progress {
                    show(time, step);
                }
            }
        }
        Ok((Ok(Status::Completed), seen))
    }

    /// Observe if something is due.
    fn observe(&mut self) -> Result<Observed, ObserveError> {
        self.observing(Recorder::observe)
    }

    fn observing<T>(
        &mut self,
        observe: impl FnOnce(&mut Recorder, &Coupled) -> Result<T, ObserveError>,
    ) -> Result<T, ObserveError> {
        self.recorder.timed(&mut self.system, observe)
    }

    /// The checkpoint of a run that stops: of an interrupted one it is written at once. That of the end is returned, to be written once
    /// all other files are: before, the one before serves.
    fn last_checkpoint(
        &mut self,
        ended: &Result<Status, Breakdown>,
        start: Instant,
    ) -> Result<Option<Vec<u8>>, RunError> {
        let (Some(dir), Some(Checkpoints { every })) = (self.dir, self.options.checkpoints) else {
            return Ok(None);
        };
        match ended {
            Ok(Status::Interrupted) => write_checkpoint(dir, &self.checkpoint(start)?).map(|()| None),
            Ok(Status::Completed) if every.is_some() => self.checkpoint(start).map(Some),
            _ => Ok(None),
        }
    }

    /// The present state, in whose log is what was handed over so far.
    fn checkpoint(&mut self, start: Instant) -> Result<Vec<u8>, RunError> {
        let Run { scene, options, system, recorder, wall, .. } = self;
        let checkpoint = Checkpoint {
            system: system.to_bytes(),
            recorder: recorder.to_bytes(),
            log: recorder.log.as_mut().map(LogObserver::stored).transpose()?,
            every: options.checkpoints.and_then(|asked| asked.every),
            wall: *wall + start.elapsed().as_secs_f64(),
            warnings: options.warnings.clone(),
            choice: scene.choice.clone(),
        };
        Ok(checkpoint.to_bytes(fingerprint(scene)))
    }
}

fn write_checkpoint(dir: &Path, bytes: &[u8]) -> Result<(), RunError> {
    let wrong = |error| RunError::Write(dir.join(checkpoint::FILE).display().to_string(), error);
    write_whole(dir, checkpoint::FILE, checkpoint::PART, bytes).map_err(wrong)
}
