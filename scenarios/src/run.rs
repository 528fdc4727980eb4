//! A run: step until the end, sample on the way, leave everything readable whatever happens.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use fsi_coupling::{Coupled, CouplingError};
use sph_core::{Fluid, Solver};
use tracing::{debug, info, warn};

use crate::balance::{held, structure_gap};
use crate::build;
use crate::compare::{self, Comparison, ReferenceCurve};
use crate::log::Level;
use crate::observe::{
    EnergyLedger, FlowPictures, ForceRules, Frame, GaugeReader, LogObserver, ObserveError, Observer, Series,
    SimilarityWindow,
};
use crate::panel_result::PanelResult;
use crate::present;
use crate::reference::ReferenceError;
use crate::scene::{Scene, known_compressibility_error};
use crate::summary::{
    Audit, Compressibility, Coupling, Particles, Peak, Projection, Status, Summary, WorstPenetration,
};

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
    /// Set from outside to end the run cleanly.
    pub interrupt: Option<&'a AtomicBool>,
    /// Called with (time, steps): when the stepping begins, and now and then.
    pub progress: Option<&'a dyn Fn(f64, u64)>,
    /// Doubts about the scene, for the report.
    pub warnings: Vec<String>,
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
/// Means are taken over the run from this share of it on.
const LATE: f64 = 0.8;
/// Between two calls of the progress function.
const PROGRESS_EVERY: Duration = Duration::from_millis(100);

/// Run a scene.
pub fn run(scene: &Scene, options: &RunOptions<'_>) -> Result<Outcome, RunError> {
    let references = scene.compare.iter().map(compare::curve).collect::<Result<Vec<_>, _>>()?;
    let file = |name: &str| options.out.as_ref().map(|dir| dir.join(name));
    if let Some(dir) = &options.out {
        refuse_occupied(dir, options.force)?;
    }
    let mut system = build::build(scene)?;
    if let Some(dir) = &options.out {
        std::fs::create_dir_all(dir).map_err(|e| RunError::Write(dir.display().to_string(), e))?;
        clear(dir)?;
        write(&dir.join("scene.resolved.toml"), &scene.to_toml())?;
    }
    let mut recorder = Recorder::new(scene, file("series.csv").as_deref(), file("log.mcap").as_deref(), &system)?;
    let (start, volume) = (Instant::now(), system.fluid.volume());
    info!(scene = scene.name, fluid = system.fluid.particles.len(), walls = system.walls.len(), "built");

    let ended = advance(scene, &mut system, &mut recorder, options)?;

    let (status, message) = match ended {
        Ok(status) => (status, None),
        Err(breakdown) => (Status::Failed, Some(breakdown.to_string())),
    };
    if status != Status::Completed {
        recorder.last_words(&system, status, message.as_deref())?;
    }
    let wall = start.elapsed().as_secs_f64();
    info!(?status, steps = system.fluid.steps, lists = system.fluid.search.rebuilds, wall, "ended");
    let summary = recorder.summarise(scene, &system, &references, status, message, wall, volume);
    recorder.series.flush()?;
    if summary.audit.work > LARGEST_WORK_GAP {
        warn!(
            "{:.1} % of the work that the water did on the body did not arrive as such: the steps are too long for how fast it \
             bends; take a smaller time.step or fluid.cfl",
            100.0 * summary.audit.work
        );
    }
    if let Some(log) = recorder.log {
        log.finish()?;
    }
    let outcome = Outcome { summary, series: recorder.series, references, pictures: recorder.pictures };
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
) -> Result<Result<Status, CouplingError>, RunError> {
    let mut told = Instant::now();
    if let Some(tell) = options.progress {
        tell(0.0, 0);
    }
    recorder.observe(system)?;
    while system.fluid.time < scene.time.end {
        if options.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            return Ok(Ok(Status::Interrupted));
        }
        let dt = scene.time.step.map_or_else(|| system.stable_dt(), Ok);
        let stepped = dt.and_then(|dt| Ok((dt, system.step_or_shorter(dt)?)));
        match stepped {
            Err(breakdown) => return Ok(Err(breakdown)),
            Ok((asked, taken)) if taken < asked => {
                warn!(
                    "pressure not converged: a step of {taken:.3e} s in the place of {asked:.3e} s to t = {}",
                    system.fluid.time
                );
            }
            Ok(_) => {}
        }
        debug!(step = system.fluid.steps, time = system.fluid.time, "stepped");
        recorder.observe(system)?;
        if told.elapsed() > PROGRESS_EVERY {
            told = Instant::now();
            if let Some(tell) = options.progress {
                tell(system.fluid.time, system.fluid.steps);
            }
        }
    }
    Ok(Ok(Status::Completed))
}

/// All observers of a run and their schedule.
struct Recorder {
    gauges: GaugeReader,
    series: Series,
    log: Option<LogObserver>,
    pictures: FlowPictures,
    similarity: Option<SimilarityWindow>,
    force_rules: Option<ForceRules>,
    next_sample: f64,
    next_frame: f64,
    every: [f64; 2],
    end: f64,
    ledger: EnergyLedger,
    energy_of_body: f64,
    told_until: f64,
    told_crossing: bool,
}

impl Recorder {
    fn new(scene: &Scene, series: Option<&Path>, log: Option<&Path>, system: &Coupled) -> Result<Recorder, RunError> {
        let body = system.bodies().find(|b| b.motion().is_some());
        Ok(Recorder {
            gauges: GaugeReader::new(scene),
            series: Series::new(scene, series)?,
            log: log.map(|path| LogObserver::create(path, scene)).transpose()?,
            pictures: FlowPictures::new(scene),
            similarity: scene.similarity.and_then(|_| SimilarityWindow::new(scene)),
            force_rules: ForceRules::new(scene),
            next_sample: 0.0,
            next_frame: 0.0,
            every: [scene.time.sample_every, scene.time.frame_every],
            end: scene.time.end,
            ledger: EnergyLedger::new(scene),
            energy_of_body: body.map_or(0.0, |b| held(&b.energy())),
            told_until: f64::NEG_INFINITY,
            told_crossing: false,
        })
    }

    /// Observe if something is due; schedules never shorten a step.
    fn observe(&mut self, system: &Coupled) -> Result<(), ObserveError> {
        self.gauges.follow(system);
        let t = system.fluid.time;
        let last = t >= self.end;
        if t < self.next_sample && t < self.next_frame && !last {
            return Ok(());
        }
        let particles = t >= self.next_frame || last;
        let next = |every: f64| every * ((t / every + 1e-9).floor() + 1.0);
        if particles {
            self.next_frame = next(self.every[1]);
        }
        self.next_sample = next(self.every[0]);
        self.record(system, particles)
    }

    fn record(&mut self, system: &Coupled, particles: bool) -> Result<(), ObserveError> {
        let gauges = self.gauges.read(system);
        let penetration = system.penetration();
        let frame = Frame { system, gauges: &gauges, penetration: &penetration, particles };
        if let (Some(breach), None) = (&penetration.worst, self.ledger.worst_penetration()) {
            let first = WorstPenetration::new(breach, frame.time(), frame.time()).to_string();
            warn!("{first}");
            if let Some(log) = &mut self.log {
                log.note(frame.time(), Level::Warning, &first)?;
            }
        }
        self.tell_ruptures(system)?;
        self.ledger.observe(&frame)?;
        self.series.observe(&frame)?;
        self.pictures.observe(&frame)?;
        if let Some(window) = &mut self.similarity {
            window.observe(&frame)?;
        }
        if let Some(rules) = &mut self.force_rules {
            rules.observe(&frame)?;
        }
        if let Some(log) = &mut self.log {
            log.observe(&frame)?;
        }
        Ok(())
    }

    /// Say aloud, and in the log, what has broken since the last sample.
    fn tell_ruptures(&mut self, system: &Coupled) -> Result<(), ObserveError> {
        for panel in system.bodies().flat_map(|b| b.panels()) {
            for r in panel.ruptures.iter().filter(|r| r.time > self.told_until) {
                let ([x, y], name) = (r.place, &panel.name);
                let text =
                    format!("{name} broke off at ({x:.5}, {y:.5}) m, t = {:.6} s, strain {:.4}", r.time, r.value);
                warn!("{text}");
                if let Some(log) = &mut self.log {
                    log.note(system.fluid.time, Level::Warning, &text)?;
                }
            }
        }
        self.told_until = system.fluid.time;
        if let (false, Some((body, [x, y]))) =
            (self.told_crossing, system.bodies().find_map(|b| Some((b.name(), b.crossing()?))))
        {
            self.told_crossing = true;
            let text = format!(
                "the surface of `{body}` crosses itself at ({x:.5}, {y:.5}) m, t = {:.6} s: what is inside is no longer sure",
                system.fluid.time
            );
            warn!("{text}");
            if let Some(log) = &mut self.log {
                log.note(system.fluid.time, Level::Warning, &text)?;
            }
        }
        Ok(())
    }

    /// A run that stops early shows its last state and says why.
    fn last_words(&mut self, system: &Coupled, status: Status, message: Option<&str>) -> Result<(), ObserveError> {
        let gauges = self.gauges.read(system);
        let penetration = system.penetration();
        let frame = Frame { system, gauges: &gauges, penetration: &penetration, particles: true };
        self.pictures.keep(&frame);
        if let Some(log) = &mut self.log {
            log.observe(&frame)?;
            let (level, text) = match status {
                Status::Failed => (Level::Error, message.unwrap_or("failed")),
                _ => (Level::Warning, "interrupted by the user"),
            };
            log.note(system.fluid.time, level, text)?;
        }
        Ok(())
    }

    fn summarise(
        &self,
        scene: &Scene,
        system: &Coupled,
        references: &[ReferenceCurve],
        status: Status,
        message: Option<String>,
        wall: f64,
        volume: f64,
    ) -> Summary {
        let fluid = &system.fluid;
        let since = LATE * fluid.time;
        let agreement = system.agreement();
        let body = system.bodies().position(|b| b.motion().is_some());
        let exact = compare::similarity_of(scene);
        let similarity = self.similarity.as_ref().and_then(|window| window.result(exact.as_ref()));
        let curves = scene.compare.iter().zip(references);
        let mut comparison: Vec<Comparison> =
            curves.filter_map(|(c, r)| compare::against_curve(c, r, &self.series)).collect();
        comparison.extend(similarity.iter().flat_map(|s| compare::against_similarity(scene, s)));
        let peak = |(name, value, time_s): (&str, f64, f64)| (name.to_string(), Peak { value, time_s });
        Summary {
            scene: scene.name.clone(),
            status,
            message,
            model: model(scene.solver),
            version: env!("CARGO_PKG_VERSION"),
            particles: Particles { fluid: fluid.particles.len(), wall: system.walls.len() },
            steps: fluid.steps,
            time_end_s: fluid.time,
            wall_time_s: wall,
            particle_updates_per_s: fluid.particles.len() as f64 * fluid.steps as f64 / wall,
            threads: rayon::current_num_threads(),
            peaks: self.series.peaks().map(peak).collect(),
            means: self.series.means(since).map(|(name, mean)| (name.to_string(), mean)).collect(),
            rest: self.ledger.rest(since),
            water: self.series.water(since),
            coupling: Coupling {
                scheme: scene.coupling.scheme,
                iterations_mean: agreement.iterations as f64 / agreement.steps.max(1) as f64,
                iterations_max: agreement.most_iterations,
                residual_worst: agreement.worst_residual,
            },
            audit: Audit {
                momentum: system.momentum_audit().worst,
                energy: system.energy_drift() / self.ledger.scale(),
                work: body.map_or(0.0, |k| system.work_audit(k).residual()),
                structure: body.map_or(0.0, |k| structure_gap(system, k, self.energy_of_body)),
                volume: fluid.volume() / volume - 1.0,
                penetrated: self.ledger.penetrated(),
                worst_penetration: self.ledger.worst_penetration().cloned(),
                stopped_at_plate: Some(system.stopped()).filter(|&stopped| stopped > 0),
            },
            compressibility: self.compressibility(scene),
            similarity,
            force_rules: self.force_rules.as_ref().map_or(Vec::new(), |rules| rules.result(since)),
            comparison,
            panels: system.bodies().flat_map(|b| b.panels()).map(|p| (p.name.clone(), PanelResult::from(&p))).collect(),
            gauges: self.gauges.results(),
            projection: projection(scene.solver, fluid),
        }
    }

    /// What the speed of sound cost, where there is one.
    fn compressibility(&self, scene: &Scene) -> Option<Compressibility> {
        let sound = scene.fluid.sound_speed;
        let share = scene.entry().and_then(|entry| known_compressibility_error(entry.root_speed(), sound));
        (!scene.solver.is_incompressible()).then(|| Compressibility {
            sound_speed_m_per_s: sound,
            mach_reached: self.ledger.fastest() / sound,
            force_error_estimate: share,
            force_corrected: share.map(|share| 1.0 / (1.0 - share)),
        })
    }
}

/// The model's name in the summary.
fn model(solver: Solver) -> &'static str {
    if solver.is_incompressible() { solver.name() } else { "wcsph" }
}

/// What the pressure's equation took, where there is one.
fn projection(solver: Solver, fluid: &Fluid) -> Option<Projection> {
    let (iterations, solves, pinned_last) = match solver {
        Solver::IncompressibleThesis => (fluid.thesis.iterations, fluid.thesis.solutions, None),
        Solver::WeaklyCompressible => return None,
        Solver::Incompressible | Solver::IncompressibleExplicit => {
            (fluid.projection.iterations, fluid.projection.solves, Some(fluid.projection.pins))
        }
    };
    Some(Projection { iterations_mean: iterations as f64 / fluid.steps.max(1) as f64, solves, pinned_last })
}

fn refuse_occupied(dir: &Path, force: bool) -> Result<(), RunError> {
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
