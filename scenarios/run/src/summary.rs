//! `summary.json`: the contract that other programs read.

use std::collections::BTreeMap;

use serde::Serialize;
use sph_core::{Phase, Timers};

pub use super::audit::Audit;
use super::link_results::{ContactResult, JointResult};
pub use super::modes::ModesResult;
pub use super::panel::{Extremes, PanelEnvelope, PanelResult, Rupture};
use scene::CouplingScheme;
use scene::vocabulary::{Doubts, Results, Status, Verdict};

use super::particle_order::ParticleOrder;
use crate::compare::Comparison;
use crate::error_bar::ErrorBars;
use crate::observers::{GaugeResult, Rest, RuleResult, SimilarityResult, Water, Waves};
use crate::results::FilteredAcceleration;
use crate::stated_numbers::{FiniteLength, RuleLoad};

/// Numbers of particles.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Particles {
    /// Fluid particles simulated.
    pub fluid: usize,
    /// Wall particles simulated.
    pub wall: usize,
}

/// The extreme of a series column: of the body's motion and of gauges over every step, else over the samples.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Peak {
    /// Value of largest magnitude, in the column's unit.
    pub value: f64,
    /// When [s].
    pub time_s: f64,
    /// What may be said of it, where it is not resolved: that of `results.peak_force_N_per_m`, for forces and accelerations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
}

/// Convergence of the coupling.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Coupling {
    /// The scheme, as in the scene.
    pub scheme: CouplingScheme,
    /// Fluid solutions per step, mean [-].
    pub iterations_mean: f64,
    /// Fluid solutions per step, largest.
    pub iterations_max: u32,
    /// Largest mismatch of a step between the acceleration that the water saw and the one it caused, relative
    /// (THEORY CO8) [-].
    pub residual_worst: f64,
}

/// Effect of the sound speed.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Compressibility {
    /// Sound speed [m/s].
    pub sound_speed_m_per_s: f64,
    /// Fastest particle over sound speed, largest at any sample [-].
    pub mach_reached: f64,
    /// Estimated share of the force lost to compressibility (THEORY WC17) [-]; `null` without an impact.
    pub force_error_estimate: Option<f64>,
    /// Factor on the force that corrects for this share, 1/(1 − share) (THEORY GE15) [-]; `null` without an impact. No other
    /// number of the summary is corrected.
    pub force_corrected: Option<f64>,
}

/// Work of the pressure solves.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Projection {
    /// Iterations of all solves, mean over the steps [-].
    pub iterations_mean: f64,
    /// Solves.
    pub solves: u64,
    /// Particles held at p = 0 by the unilateral condition in the last step; absent without that condition.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pinned_last: Option<usize>,
}

/// The log.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Log {
    /// Size of the file [bytes].
    pub bytes: u64,
    /// Frames of particles in it.
    pub frames: u64,
    /// Frames left out to keep the budget.
    pub frames_left_out: u64,
    /// Its budget [MB]; absent without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub budget_megabytes: Option<f64>,
}

/// Wall time of a part of the run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PhaseTime {
    /// Wall time [s].
    pub seconds: f64,
    /// Over that of all parts [-].
    pub share: f64,
}

/// The parts of a run that took time, by name.
pub fn phase_times(phases: &Timers) -> BTreeMap<&'static str, PhaseTime> {
    let total = phases.total().max(f64::MIN_POSITIVE);
    let time = |phase: Phase| PhaseTime { seconds: phases.seconds(phase), share: phases.seconds(phase) / total };
    Phase::ALL.into_iter().map(|phase| (phase.name(), time(phase))).filter(|(_, time)| time.seconds > 0.0).collect()
}

/// The results of a run.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// How the run ended.
    pub status: Status,
    /// Why the run did not complete.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<String>,
    /// The results: what a designer takes away.
    pub results: Results,
    /// Share of the results of a section between two free ends; absent without report.length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ends: Option<FiniteLength>,
    /// Loads that rules state; absent without a table rule.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rule_loads: Vec<RuleLoad>,
    /// The largest acceleration through the filter of report.acceleration_cfc; absent where the scene does not ask.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acceleration_filtered: Option<FilteredAcceleration>,
    /// Doubts about them, in sentences.
    #[serde(flatten)]
    pub doubts: Doubts,
    /// Warnings about the scene, before the run; absent when there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// The model that was run: a theory, `wcsph`, or the name of an incompressible solver.
    pub model: &'static str,
    /// Why this model was chosen, for `model = "auto"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub choice: Option<String>,
    /// The interface by which a host program moved the body; absent where the scene's motion did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub host: Option<&'static str>,
    /// Version of the program.
    pub version: &'static str,
    /// Numbers of particles.
    pub particles: Particles,
    /// Steps taken.
    pub steps: u64,
    /// Time reached [s].
    pub time_end_s: f64,
    /// Wall-clock time of the stepping, observers included [s].
    pub wall_time_s: f64,
    /// Fluid particles × steps over wall-clock time [1/s].
    pub particle_updates_per_s: f64,
    /// Threads used.
    pub threads: usize,
    /// Wall time by part of the run.
    pub phases: BTreeMap<&'static str, PhaseTime>,
    /// The log, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log: Option<Log>,
    /// Extremes of the series, by column.
    pub peaks: BTreeMap<String, Peak>,
    /// Means of the series over the last fifth of the run, by column.
    pub means: BTreeMap<String, f64>,
    /// Conservation.
    pub audit: Audit,
    /// Convergence of the coupling; absent without particles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coupling: Option<Coupling>,
    /// Coming to rest; absent without particles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rest: Option<Rest>,
    /// How the particles lie at the end; absent where there is but one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order: Option<ParticleOrder>,
    /// The water's volume, where the scene asks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub water: Option<Water>,
    /// Regular waves; absent without a wave maker.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub waves: Option<Waves>,
    /// Weak compressibility; absent where water is incompressible.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compressibility: Option<Compressibility>,
    /// The similarity solution's numbers, for scenes that have one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub similarity: Option<SimilarityResult>,
    /// The force on the body by four rules, where the scene asks (THEORY GE8).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub force_rules: Vec<RuleResult>,
    /// Comparisons with references.
    pub comparison: Vec<Comparison>,
    /// Comparisons that the run does not reach, and why; absent when there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub not_compared: Vec<String>,
    /// Error bars of main numbers, from charts or a convergence study (THEORY GE16, GE17).
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub error_bars: ErrorBars,
    /// Results of the body's panels, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub panels: BTreeMap<String, PanelResult>,
    /// Results of a structure by its modes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modes: Option<ModesResult>,
    /// Gauges, by name.
    pub gauges: BTreeMap<String, GaugeResult>,
    /// The pressure solves; absent where an equation of state gives the pressure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projection: Option<Projection>,
    /// Bodies that touched each other, the floor or the walls; absent when none did.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub contacts: Vec<ContactResult>,
    /// Joints, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub joints: BTreeMap<String, JointResult>,
}

impl Summary {
    /// As the text of `summary.json`.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("every field of a summary has a JSON form")
    }

    /// True if the run completed and every judged comparison passes.
    pub fn passes(&self) -> bool {
        self.status.is_completed() && self.comparison.iter().all(Comparison::passes)
    }
}
