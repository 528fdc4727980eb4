//! What the page reads of `summary.json`.
//!
//! Every field may be missing: a run that was killed has no summary, an older one has fewer fields, and a number that is not finite is
//! `null` in JSON.

use std::collections::BTreeMap;

use run::stated_numbers::{FiniteLength, RuleLoad};
use scene::vocabulary::{Doubts, Results, Status};
use serde::Deserialize;

/// A summary, as far as the page shows it; names and units are those of [`Summary`](run::summary::Summary).
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Record {
    pub status: Option<Status>,
    pub message: Option<String>,
    pub results: Results,
    pub ends: Option<FiniteLength>,
    pub rule_loads: Vec<RuleLoad>,
    #[serde(flatten)]
    pub doubts: Doubts,
    pub warnings: Vec<String>,
    pub model: String,
    pub choice: Option<String>,
    pub host: Option<String>,
    pub version: String,
    pub particles: Particles,
    pub steps: u64,
    pub time_end_s: Option<f64>,
    pub wall_time_s: Option<f64>,
    pub particle_updates_per_s: Option<f64>,
    pub threads: u64,
    pub phases: BTreeMap<String, Phase>,
    pub log: Option<Log>,
    pub audit: Option<Audit>,
    pub compressibility: Option<Compressibility>,
    pub projection: Option<Projection>,
    pub similarity: Option<Similarity>,
    pub force_rules: Vec<Rule>,
    pub comparison: Vec<Comparison>,
    pub not_compared: Vec<String>,
    pub error_bars: BTreeMap<String, Bar>,
    pub panels: BTreeMap<String, Panel>,
    pub gauges: BTreeMap<String, Gauge>,
    pub acceleration_filtered: Option<Filtered>,
    pub waves: Waves,
}

impl Record {
    /// How the run ended.
    pub fn status(&self) -> Status {
        self.status.unwrap_or(Status::NotFinished)
    }
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Particles {
    pub fluid: u64,
    pub wall: u64,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Phase {
    pub seconds: Option<f64>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Log {
    pub bytes: u64,
    pub frames: u64,
    pub frames_left_out: u64,
    pub budget_megabytes: Option<f64>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Audit {
    pub momentum: Option<f64>,
    pub energy: Option<f64>,
    pub work: Option<f64>,
    pub structure: Option<f64>,
    pub surface: Option<f64>,
    pub volume: Option<f64>,
    pub penetrated: u64,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Compressibility {
    pub sound_speed_m_per_s: Option<f64>,
    pub mach_reached: Option<f64>,
    pub force_error_estimate: Option<f64>,
    pub force_corrected: Option<f64>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Projection {
    pub iterations_mean: Option<f64>,
    pub solves: u64,
    pub pinned_last: Option<u64>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Similarity {
    pub profile: Vec<[Option<f64>; 2]>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Rule {
    pub rule: String,
    pub force_n_per_m: [Option<f64>; 2],
    pub force_y_sd_n_per_m: Option<f64>,
    pub moment_n: Option<f64>,
    pub impulse_n_s_per_m: [Option<f64>; 2],
    pub force_difference: Option<f64>,
    pub impulse_difference: Option<f64>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Comparison {
    pub reference: String,
    pub quantity: String,
    pub ours: Option<f64>,
    pub theirs: Option<f64>,
    pub error: Option<f64>,
    pub tolerance: Option<f64>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Bar {
    pub value: Option<f64>,
    pub extrapolated: Option<f64>,
    pub band: Option<f64>,
    pub order: Option<f64>,
    pub verdict: String,
    pub method: String,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Panel {
    pub normal_n_per_m: Extremes,
    pub shear_n_per_m: Extremes,
    pub moment_n: Extremes,
    pub stress_pa: Extremes,
    pub strain: Extremes,
    pub reserve_factor: Option<f64>,
    pub yielded: bool,
    pub plastic_curvature_per_m: Option<f64>,
    pub ruptures: Vec<Rupture>,
    pub envelope: Envelope,
}

/// Extremes at each station of a panel.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Envelope {
    pub station_m: Vec<Option<f64>>,
    pub normal_n_per_m: Vec<Extremes>,
    pub shear_n_per_m: Vec<Extremes>,
    pub moment_n: Vec<Extremes>,
    pub stress_pa: Vec<Extremes>,
    pub reserve_factor: Vec<Option<f64>>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Extremes {
    pub least: Option<f64>,
    pub least_at_s: Option<f64>,
    pub most: Option<f64>,
    pub most_at_s: Option<f64>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Rupture {
    pub time_s: Option<f64>,
    pub x_m: Option<f64>,
    pub y_m: Option<f64>,
    pub strain: Option<f64>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Gauge {
    pub peak_pa: Option<f64>,
    pub peak_time_s: Option<f64>,
    pub rise_time_s: Option<f64>,
    pub impulse_pa_s: Option<f64>,
    pub length_m: Option<f64>,
    pub bandwidth_hz: Option<f64>,
}

/// The waves of a wave maker.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Waves {
    pub bodies: Vec<BodyInWaves>,
}

/// A body in them: loads and motions by the names of their columns.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct BodyInWaves {
    pub body: String,
    pub window_s: [f64; 2],
    pub periods: u64,
    pub incident_m: Option<f64>,
    pub reflected_m: Option<f64>,
    pub transmitted_m: Option<f64>,
    #[serde(rename = "fx_N_per_m")]
    pub fx: Harmonics,
    #[serde(rename = "fy_N_per_m")]
    pub fy: Harmonics,
    #[serde(rename = "moment_N")]
    pub moment: Harmonics,
    pub x_m: Harmonics,
    pub y_m: Harmonics,
    pub angle_deg: Harmonics,
}

/// Mean and harmonics, each with its interval.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Harmonics {
    pub mean: f64,
    pub mean_plus_minus: f64,
    pub first: f64,
    pub first_plus_minus: f64,
    pub second: f64,
    pub second_plus_minus: f64,
    pub mean_band: Option<f64>,
    pub first_band: Option<f64>,
    pub second_band: Option<f64>,
    pub per_amplitude: Option<PerAmplitude>,
}

/// The same over powers of the incident amplitude.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct PerAmplitude {
    pub mean: f64,
    pub first: f64,
    pub second: f64,
    pub first_by_theory: Option<f64>,
    pub mean_by_theory: Option<f64>,
}

/// The filtered acceleration.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Filtered {
    pub cfc: Option<f64>,
    pub peak_g: Option<f64>,
    pub time_s: Option<f64>,
}
