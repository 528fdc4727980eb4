//! `summary.json`: the contract that other programs read.

use std::collections::BTreeMap;

use fsi_coupling::Breach;
use serde::Serialize;
use sph_core::{Phase, Timers};

use crate::compare::Comparison;
use crate::error_bar::ErrorBars;
use crate::observe::{GaugeResult, RuleResult, SimilarityResult};
use crate::panel_result::PanelResult;
use crate::scene::CouplingScheme;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Reached its end time.
    Completed,
    /// Broke down; `message` says what, where, when.
    Failed,
    /// Ended by the user.
    Interrupted,
}

/// Numbers of particles.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Particles {
    /// Fluid particles simulated.
    pub fluid: usize,
    /// Wall particles simulated.
    pub wall: usize,
}

/// The extreme of a series column.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Peak {
    /// Value of largest magnitude, in the column's unit.
    pub value: f64,
    /// When [s].
    pub time_s: f64,
}

/// What became of the water's motion: for scenes that should come, or stay, to rest.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Rest {
    /// Largest kinetic energy of the fluid at any sample [J/m].
    pub kinetic_peak_j_per_m: f64,
    /// Mean kinetic energy of the fluid over the last fifth of the run [J/m].
    pub kinetic_end_j_per_m: f64,
    /// Mean rise of the fluid's centre of mass over the last fifth of the run [m].
    pub center_rise_m: f64,
    /// Largest deviation from that mean in the last fifth [m].
    pub center_swing_m: f64,
}

/// How the particles lie at the end: those that pair, or clump, are nearer than a spacing.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Order {
    /// Least distance between two particles, over the mean of their spacings [-].
    pub nearest_least: f64,
    /// Median over the particles of the distance to the nearest, over the same [-].
    pub nearest_median: f64,
}

/// What became of the water's volume by the place of its surface (THEORY GE11).
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Water {
    /// Volume per metre of span at the start [m²].
    pub volume_start_m2: f64,
    /// Change of the volume to its mean over the last fifth of the run, over the start's [-].
    pub volume_drift: f64,
    /// Largest change at any sample, over the start's [-].
    pub volume_drift_worst: f64,
}

/// The fluid particle found deepest beyond a wall's surface.
#[derive(Clone, Debug, Serialize)]
pub struct WorstPenetration {
    /// The particle.
    pub particle: u32,
    /// Whose wall; empty for the plane of symmetry.
    pub wall: String,
    /// Where [m].
    pub x_m: f64,
    /// Where [m].
    pub y_m: f64,
    /// How deep beyond the surface [m].
    pub depth_m: f64,
    /// When [s].
    pub time_s: f64,
    /// When the first particle was found beyond a wall [s].
    pub first_s: f64,
}

impl WorstPenetration {
    /// A breach seen at `time_s` [s], in a run whose first was seen at `first_s` [s].
    pub fn new(breach: &Breach, time_s: f64, first_s: f64) -> WorstPenetration {
        let Breach { id, at: [x_m, y_m], depth, ref owner } = *breach;
        WorstPenetration { particle: id, wall: owner.clone(), x_m, y_m, depth_m: depth, time_s, first_s }
    }
}

impl std::fmt::Display for WorstPenetration {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let wall = if self.wall.is_empty() { "the plane of symmetry" } else { &self.wall };
        write!(
            f,
            "water beyond a wall since t = {:.5} s; deepest: particle {} at ({:.5}, {:.5}) m, {:.2e} m beyond `{wall}` at \
             t = {:.5} s",
            self.first_s, self.particle, self.x_m, self.y_m, self.depth_m, self.time_s
        )
    }
}

/// Conservation over the run (THEORY CO27, CO28).
#[derive(Clone, Debug, Default, Serialize)]
pub struct Audit {
    /// Worst momentum gap of a step over the momentum held and exchanged [-].
    pub momentum: f64,
    /// Energy that left the balance over the largest energy exchanged [-]; negative: dissipated.
    pub energy: f64,
    /// Of the work that the water did on the body, what did not arrive, over the work exchanged (THEORY CO17) [-].
    pub work: f64,
    /// What the body's own energies lack of the work done on it, over the work exchanged [-]: elastic bodies.
    pub structure: f64,
    /// Change of the fluid's volume Σm/ρ over its start value [-].
    pub volume: f64,
    /// Most fluid particles found beyond a wall's surface at any sample.
    pub penetrated: usize,
    /// The worst of them; absent when there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst_penetration: Option<WorstPenetration>,
    /// How often a particle was stopped that would have gone through a thin plate (THEORY WA11); absent when never.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopped_at_plate: Option<u64>,
}

/// How well water and body agreed on the body's acceleration.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Coupling {
    /// The scheme, as in the scene.
    pub scheme: CouplingScheme,
    /// Times that the fluid took a step, mean over the steps [-].
    pub iterations_mean: f64,
    /// Most of these in a step.
    pub iterations_max: u32,
    /// Largest mismatch of a step between the acceleration that the water saw and the one it caused, relative
    /// (THEORY CO8) [-].
    pub residual_worst: f64,
}

/// Weak compressibility: what the sound speed cost.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Compressibility {
    /// Sound speed [m/s].
    pub sound_speed_m_per_s: f64,
    /// Fastest particle over sound speed, largest at any sample [-].
    pub mach_reached: f64,
    /// Estimated share of the force lost to compressibility (THEORY WC17) [-]; `null` without an impact.
    pub force_error_estimate: Option<f64>,
    /// Factor on the force that takes this share back, 1/(1 − share) (THEORY GE15) [-]; `null` without an impact. No other
    /// number of the summary is corrected.
    pub force_corrected: Option<f64>,
}

/// The pressure's equation over the run.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Projection {
    /// Iterations of all solves, mean over the steps [-].
    pub iterations_mean: f64,
    /// Solves.
    pub solves: u64,
    /// Rows pinned by the unilateral condition, in the last step; absent where there is none.
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
    /// Frames that were due and are not in it, since the budget had no room for them.
    pub frames_left_out: u64,
    /// Size that it was to stay below [MB]; absent where there was none.
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

/// Everything a script may want to know of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// How the run ended.
    pub status: Status,
    /// What went wrong, if anything did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<String>,
    /// The model that was run: a theory, `wcsph`, or the name of an incompressible solver.
    pub model: &'static str,
    /// Why this model, where it was left to the program.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub choice: Option<String>,
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
    /// Where the wall time went, by part of the run.
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
    /// How well water and body agreed; absent without particles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coupling: Option<Coupling>,
    /// Coming to rest; absent without particles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rest: Option<Rest>,
    /// How the particles lie at the end; absent where there is but one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order: Option<Order>,
    /// The water's volume, where the scene asks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub water: Option<Water>,
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
    /// What main numbers may be off by, where charts or a convergence study tell (THEORY GE16, GE17).
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub error_bars: ErrorBars,
    /// What the body's panels have borne, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub panels: BTreeMap<String, PanelResult>,
    /// Gauges, by name.
    pub gauges: BTreeMap<String, GaugeResult>,
    /// The pressure's equation; absent where an equation of state gives the pressure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projection: Option<Projection>,
}

impl Summary {
    /// As the text of `summary.json`.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a summary holds nothing that JSON cannot say")
    }

    /// True if the run completed and every judged comparison passes.
    pub fn passes(&self) -> bool {
        self.status == Status::Completed && self.comparison.iter().all(Comparison::passes)
    }
}
