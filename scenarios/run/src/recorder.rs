//! The observers of a run, their schedule, and the summary of their results.

use std::path::Path;
use std::time::{Duration, Instant};

use fsi_coupling::Coupled;
use scene::vocabulary::{Doubt, ResultName, Status};
use scene::{Scene, known_compressibility_error, thesis_work, validity};
use sph_core::{Fluid, Phase, Solver, projection};
use tracing::warn;

use super::RunError;
use super::audit::{held, structure_gap};
use super::link_results::{contact_results, joint_results};
use super::modes::ModesResult;
use super::particle_order::particle_order;
use super::summary::{
    Audit, Compressibility, Coupling, Log, PanelResult, Particles, Peak, Projection, Summary, phase_times,
};
use crate::compare::{self, ReferenceCurve};
use crate::error_bar::ErrorBars;
use crate::log::{Level, Logged};
use crate::observers::{
    ForceRules, Frame, GaugeReader, GaugeResult, History, LiveObserver, LogObserver, ObserveError, Observer, Series,
    SimilarityResult, SimilarityWindow, WorstPenetration, body_values, unlikely_waves,
};
use crate::results::ResultsObserver;

/// Means are taken over the run from this share of it on.
const LATE: f64 = 0.8;

/// What was due after a step.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Observed {
    /// Nothing that is not observed in every step.
    Nothing,
    /// A sample.
    Sample,
    /// A sample with a frame of particles.
    Frame,
}

/// When something is due at a regular interval: after `time` [s].
pub(super) fn next(every: f64, time: f64) -> f64 {
    every * ((time / every + 1e-9).floor() + 1.0)
}

/// All observers of a run and their schedule.
pub(crate) struct Recorder {
    pub(super) gauges: GaugeReader,
    pub(super) results: ResultsObserver,
    pub(super) extremes: Vec<(String, Peak)>,
    pub series: Series,
    pub log: Option<LogObserver>,
    pub live: Option<LiveObserver>,
    pub(super) similarity: Option<SimilarityWindow>,
    pub(super) force_rules: Option<ForceRules>,
    pub(super) next_sample: f64,
    pub(super) next_frame: f64,
    every: [f64; 2],
    pub(super) history: History,
    energy_of_body: f64,
    time_of_log: Duration,
    pub(super) reported_until: f64,
    pub(super) crossing_reported: bool,
    /// Where a host moved the body otherwise than the scene expects.
    pub host_doubt: Option<String>,
}

impl Recorder {
    pub fn new(
        scene: &Scene,
        series: Option<&Path>,
        log: Option<&Path>,
        system: &Coupled,
    ) -> Result<Recorder, RunError> {
        let body = system.bodies().find(|b| b.motion().is_some());
        Ok(Recorder {
            gauges: GaugeReader::new(scene),
            results: ResultsObserver::new(scene),
            extremes: Vec::new(),
            series: Series::new(scene, series)?,
            log: log.map(|path| LogObserver::create(path, scene)).transpose()?,
            live: None,
            similarity: scene.similarity.and_then(|_| SimilarityWindow::new(scene)),
            force_rules: ForceRules::new(scene),
            next_sample: scene.time.start,
            next_frame: scene.time.start,
            every: [scene.time.sample_every, scene.time.frame_every],
            history: History::new(scene),
            energy_of_body: body.map_or(0.0, |b| held(&b.energy())),
            time_of_log: Duration::ZERO,
            reported_until: f64::NEG_INFINITY,
            crossing_reported: false,
            host_doubt: None,
        })
    }

    /// Observe if something is due; schedules never shorten a step.
    pub fn observe(&mut self, system: &Coupled) -> Result<Observed, ObserveError> {
        let pressures = self.gauges.follow(system);
        self.results.follow(system, &pressures);
        if let Some(window) = &mut self.similarity {
            window.follow(system);
        }
        self.follow(system);
        let t = system.fluid.time();
        if t < self.next_sample && t < self.next_frame {
            return Ok(Observed::Nothing);
        }
        let particles = t >= self.next_frame;
        if particles {
            self.next_frame = next(self.every[1], t);
        }
        self.next_sample = next(self.every[0], t);
        self.record(system, particles)?;
        Ok(if particles { Observed::Frame } else { Observed::Sample })
    }

    /// Observe, and show the state to viewers; the time counts as that of the observers and of the log.
    pub fn timed<T>(
        &mut self,
        system: &mut Coupled,
        observe: impl FnOnce(&mut Recorder, &Coupled) -> Result<T, ObserveError>,
    ) -> Result<T, ObserveError> {
        let outer = system.fluid.timers_mut().begin(Phase::Observers);
        let seen = observe(self, system)?;
        self.show(system)?;
        system.fluid.timers_mut().hand_over(Phase::Log, self.time_of_log());
        system.fluid.timers_mut().resume(outer);
        Ok(seen)
    }

    /// The last sample of a run and its frame, where they were not due of themselves.
    pub fn complete(&mut self, system: &Coupled, seen: Observed) -> Result<(), ObserveError> {
        match seen {
            Observed::Nothing => self.record(system, true),
            Observed::Frame => Ok(()),
            Observed::Sample => {
                self.series.flush()?;
                let Some(log) = &mut self.log else { return Ok(()) };
                let start = Instant::now();
                log.picture(system, true)?;
                self.time_of_log += start.elapsed();
                Ok(())
            }
        }
    }

    /// Extremes of the body's columns, in every step: samples miss what is shorter than they are apart.
    fn follow(&mut self, system: &Coupled) {
        let time_s = system.fluid.time();
        let Some((body, motion)) = system.bodies().find_map(|body| Some((body, body.motion()?))) else { return };
        let values = body_values(&motion);
        if self.extremes.is_empty() {
            let named = |(column, _): &(&str, f64)| (format!("{}.{column}", body.name()), Peak::default());
            self.extremes = values.iter().map(named).collect();
        }
        for ((_, largest), (_, value)) in self.extremes.iter_mut().zip(values) {
            if value.abs() > largest.value.abs() {
                *largest = Peak { value, time_s, verdict: None };
            }
        }
    }

    fn record(&mut self, system: &Coupled, particles: bool) -> Result<(), ObserveError> {
        let gauges = self.gauges.read();
        let (held, penetration) = (system.fluid.totals(), system.penetration());
        let frame = Frame { system, gauges: &gauges, held: &held, penetration: &penetration, particles };
        if let (Some(breach), None) = (&penetration.worst, self.history.worst_penetration()) {
            self.warn(frame.time(), &WorstPenetration::new(breach, frame.time(), frame.time()).to_string())?;
        }
        self.report_failures(system)?;
        self.history.observe(&frame)?;
        self.series.observe(&frame)?;
        if let Some(window) = &mut self.similarity {
            window.observe(&frame)?;
        }
        if let Some(rules) = &mut self.force_rules {
            rules.observe(&frame)?;
        }
        if let Some(log) = &mut self.log {
            let start = Instant::now();
            log.observe(&frame)?;
            self.time_of_log += start.elapsed();
        }
        Ok(())
    }

    /// Show the present state to viewers, if one waits for it.
    pub fn show(&mut self, system: &Coupled) -> Result<(), ObserveError> {
        let Some(live) = self.live.as_mut().filter(|live| live.is_due()) else { return Ok(()) };
        let (gauges, held, penetration) = (self.gauges.read(), system.fluid.totals(), system.penetration());
        live.observe(&Frame { system, gauges: &gauges, held: &held, penetration: &penetration, particles: true })
    }

    /// Wall time of the log since the last call.
    fn time_of_log(&mut self) -> Duration {
        std::mem::take(&mut self.time_of_log)
    }

    /// Warn on the console and in the log.
    fn warn(&mut self, time: f64, text: &str) -> Result<(), ObserveError> {
        warn!("{text}");
        self.log.as_mut().map_or(Ok(()), |log| log.note(time, Level::Warning, text))
    }

    /// Report what has broken, or crossed itself, since the last sample.
    fn report_failures(&mut self, system: &Coupled) -> Result<(), ObserveError> {
        let (now, since) = (system.fluid.time(), self.reported_until);
        for panel in system.bodies().flat_map(|b| b.panels()) {
            for r in panel.ruptures.iter().filter(|r| r.time > since) {
                let ([x, y], name) = (r.place, &panel.name);
                let (time, strain) = (r.time, r.value);
                let text = format!("{name} broke off at ({x:.5}, {y:.5}) m, t = {time:.6} s, strain {strain:.4}");
                self.warn(now, &text)?;
            }
        }
        self.reported_until = now;
        let crossing = system.bodies().find_map(|b| Some((b.name(), b.self_intersection()?)));
        if let Some((body, [x, y])) = crossing.filter(|_| !self.crossing_reported) {
            self.crossing_reported = true;
            let text = format!(
                "the surface of `{body}` crosses itself at ({x:.5}, {y:.5}) m, t = {now:.6} s: from here on its inside is not \
                 defined"
            );
            self.warn(now, &text)?;
        }
        Ok(())
    }

    /// Record the last state of a run that stops early, and the reason.
    pub fn record_stop(&mut self, system: &Coupled, status: Status, message: Option<&str>) -> Result<(), ObserveError> {
        self.gauges.follow(system);
        let gauges = self.gauges.read();
        let (held, penetration) = (system.fluid.totals(), system.penetration());
        let frame = Frame { system, gauges: &gauges, held: &held, penetration: &penetration, particles: true };
        if let Some(log) = &mut self.log {
            log.keep(&frame)?;
            let (level, text) = match status {
                Status::Failed => (Level::Error, message.unwrap_or("failed")),
                _ => (Level::Warning, "interrupted by the user"),
            };
            log.note(system.fluid.time(), level, text)?;
        }
        Ok(())
    }

    pub fn summarise(
        &self,
        scene: &Scene,
        system: &Coupled,
        references: &[ReferenceCurve],
        status: Status,
        message: Option<String>,
        wall: f64,
        volume: f64,
        log: Option<Logged>,
    ) -> Summary {
        let fluid = &system.fluid;
        let since = LATE * fluid.time();
        let agreement = system.statistics();
        let body = system.bodies().position(|b| b.motion().is_some());
        let exact = compare::similarity_of(scene);
        let similarity = self.similarity.as_ref().and_then(|window| window.result(exact.as_ref()));
        let (results, mut doubts) = self.results.results(scene, system);
        let acceleration_filtered =
            scene.report.acceleration_cfc.and_then(|class| self.results.filtered(class, &results));
        doubts.extend(similarity.as_ref().and_then(SimilarityResult::doubt));
        let audit = Audit {
            momentum: system.momentum_audit().worst,
            energy: system.energy_drift() / self.history.scale(),
            work: body.map_or(0.0, |k| system.work_audit(k).residual()),
            structure: body.map_or(0.0, |k| structure_gap(system, k, self.energy_of_body)),
            surface: self.history.surface_gap(),
            volume: fluid.volume() / volume - 1.0,
            penetrated: self.history.penetrated(),
            worst_penetration: self.history.worst_penetration().cloned(),
            stopped_at_plate: Some(system.stopped()).filter(|&stopped| stopped > 0),
        };
        let mut results = results.with_work_lost(audit.loses_work());
        if status == Status::Failed {
            doubts.extend(results.unresolve(0.0, "the run broke down"));
        }
        let waves = self.series.waves(scene);
        let of_waves = unlikely_waves(scene, waves.as_ref());
        let others =
            super::panel::rupture_doubt(system, &results).into_iter().chain(self.host_doubt.clone().map(Doubt::of_run));
        doubts.extend(audit.doubts().into_iter().chain(of_waves).chain(others));
        let order = particle_order(fluid.particles());
        doubts.extend(order.and_then(|order| order.doubt(fluid.domain().fluid.kernel)));
        let compressibility = self.compressibility(scene);
        doubts.extend(compressibility.as_ref().and_then(|sound| validity::compressibility::doubt(sound.mach_reached)));
        let (comparison, not_compared) = compare::against_all(scene, references, &self.series, similarity.as_ref());
        let verdict = results.get(ResultName::PeakForce).map(|force| force.verdict).filter(|v| !v.is_sound());
        let gauges = self.gauges.results();
        let of_body = |name: &str| self.extremes.iter().find(|(own, _)| own == name).map(|(_, peak)| *peak);
        let extreme = |name: &str| {
            let gauge = |g: &GaugeResult| Peak { value: g.peak_pa, time_s: g.peak_time_s, verdict: None };
            let of_gauge = || name.strip_suffix(".p_Pa").and_then(|gauge_name| gauges.get(gauge_name)).map(gauge);
            of_body(name).or_else(of_gauge)
        };
        let peak = |(name, value, time_s): (&str, f64, f64)| {
            let sampled = Peak { value, time_s, verdict: None };
            let of_steps = extreme(name).filter(|largest| largest.value.abs() > value.abs());
            // "NAME.fy_N_per_m", "NAME.ay_m_per_s2" of the body
            let of_force = of_body(name).is_some() && [".f", ".a"].iter().any(|c| name.contains(c));
            let verdict = verdict.filter(|_| of_force && !name.ends_with("angle_deg"));
            (name.to_string(), Peak { verdict, ..of_steps.unwrap_or(sampled) })
        };
        Summary {
            scene: scene.name.clone(),
            status: status.with(&results, !doubts.is_empty()),
            message,
            results,
            ends: None,
            rule_loads: Vec::new(),
            acceleration_filtered,
            doubts,
            warnings: Vec::new(),
            model: model(scene.solver.kind()),
            choice: scene.choice.clone(),
            host: None,
            version: env!("CARGO_PKG_VERSION"),
            particles: Particles { fluid: fluid.particles().len(), wall: system.walls.len() },
            steps: fluid.steps(),
            time_end_s: fluid.time(),
            wall_time_s: wall,
            particle_updates_per_s: fluid.updates() as f64 / wall,
            threads: rayon::current_num_threads(),
            phases: phase_times(fluid.timers()),
            log: log.map(|Logged { bytes, frames, left_out }| Log {
                bytes,
                frames,
                frames_left_out: left_out,
                budget_megabytes: scene.report.log_budget,
            }),
            peaks: self.series.peaks().map(peak).collect(),
            means: self.series.means(since).map(|(name, mean)| (name.to_string(), mean)).collect(),
            rest: Some(self.history.rest(since)),
            order,
            water: self.series.water(since),
            waves,
            coupling: Some(Coupling {
                scheme: scene.coupling.scheme,
                iterations_mean: agreement.iterations as f64 / agreement.steps.max(1) as f64,
                iterations_max: agreement.most_iterations,
                residual_worst: agreement.worst_residual,
            }),
            audit,
            compressibility,
            similarity,
            force_rules: self.force_rules.as_ref().map_or(Vec::new(), |rules| rules.result(since)),
            comparison,
            not_compared,
            error_bars: ErrorBars::new(),
            panels: system.bodies().flat_map(|b| b.panels()).map(|p| (p.name.clone(), PanelResult::from(&p))).collect(),
            modes: scene.body.as_ref().and_then(|body| body.modal.as_ref()).and_then(|modal| {
                let state = system.bodies().find_map(|body| body.modes())?;
                Some(ModesResult::new(modal, &state))
            }),
            gauges,
            projection: projection(fluid),
            contacts: contact_results(system),
            joints: joint_results(system),
        }
    }

    /// Effect of the sound speed, for a weakly compressible fluid.
    fn compressibility(&self, scene: &Scene) -> Option<Compressibility> {
        let sound = scene.sound_speed();
        let share = scene.entry().and_then(|entry| known_compressibility_error(entry.root_speed(), sound));
        (!scene.solver.is_incompressible()).then(|| Compressibility {
            sound_speed_m_per_s: sound,
            mach_reached: self.history.fastest() / sound,
            force_error_estimate: share,
            force_corrected: share.map(|share| 1.0 / (1.0 - share)),
        })
    }
}

/// The model's name in the summary.
fn model(solver: Solver) -> &'static str {
    if solver.is_incompressible() { solver.name() } else { "wcsph" }
}

/// Work of the pressure solves, for a projection.
fn projection(fluid: &Fluid) -> Option<Projection> {
    let own = |scheme: &projection::Projection| (scheme.iterations(), scheme.solves(), Some(scheme.constrained_rows()));
    let theirs = || thesis_work(fluid).map(|(iterations, solves)| (iterations, solves, None));
    let (iterations, solves, pinned_last) = fluid.scheme().map(own).or_else(theirs)?;
    Some(Projection { iterations_mean: iterations as f64 / fluid.steps().max(1) as f64, solves, pinned_last })
}
