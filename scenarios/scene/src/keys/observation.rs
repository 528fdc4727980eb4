//! Gauges, comparisons and further observations of a run.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Curves that are sampled on request.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Observe {
    /// Column front_m: length of the connected water along the floor, from its left end (GE12).
    pub front: bool,
    /// Places x of the columns level1_m, level2_m ...: height of the water there over still water, counted by volume, also what
    /// flies above; not below a body (GE10) [m].
    pub level: Vec<f64>,
    /// Column volume_m2, and water in the summary: volume below the water's surface, found from above; for tanks without a body
    /// (GE11).
    pub volume: bool,
    /// Columns kinetic_J_per_m, potential_J_per_m and elastic_J_per_m: energies of the water (CO28).
    pub energy: bool,
}

/// What a run reports beside its curves.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Report {
    /// Comparison of the force on the body by four rules (INDAT fex 1 | 2 | 3: FEX_2D, FEX_2D2, FEX_2D3; FEX_2D4 has no number).
    pub force_rules: bool,
    /// Upper limit of the size of log.mcap: frames of particles are left out, evenly over the run, curves and notes are not [MB].
    /// absent: every frame that is due (command line: --log-budget).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub log_budget: Option<f64>,
    /// Channel frequency class of the filter of the body's acceleration (60, 180, 600 or 1000 of SAE J211-1: a Butterworth low-pass of
    /// second order there and back, -3 dB at 1.65 times the class), for acceleration_filtered in the summary and the curve in the report
    /// [Hz]. absent: the curve is filtered at the cut-off of the peak acceleration.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub acceleration_cfc: Option<f64>,
    /// Bandwidth of the quoted peaks of force and acceleration: means over 0.443 of its inverse (THEORY GE18), such as twice the lowest
    /// frequency of the structure, or the 100 Hz of CFC 60 [Hz]. absent: that of the impact, 4.4 V/D with the draught D of the largest force,
    /// or 30 V/R of a round bottom; of the spacing where that is coarser.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bandwidth: Option<f64>,
    /// Length of the section between two free ends, for ends: the share of its loads in three dimensions (THEORY RU6) [m]. absent: no share is
    /// given; loads are per metre of an endless one.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: Option<f64>,
    /// Bandwidth of the quoted peak pressure [Hz]. absent: that of the spacing.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pressure_bandwidth: Option<f64>,
}

/// A pressure gauge.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Gauge {
    /// A word that starts its column in the series.
    pub name: String,
    /// Frame in which the gauge is fixed: the body's, or the tank's.
    #[serde(default)]
    pub on: GaugeFrame,
    /// Place x, y in that frame [m].
    pub at: [f64; 2],
    /// Length of its face, along the surface about its place and up to a corner, over which it shows the mean [m]. 0 is a point,
    /// which the kernel spreads over its support 2h all the same.
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub length: f64,
    /// Bandwidth of its low-pass (Butterworth, second order, -3 dB), which takes every step [Hz]. absent: unfiltered.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bandwidth: Option<f64>,
}

/// The frame in which a gauge is fixed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GaugeFrame {
    /// The body's frame.
    #[default]
    Body,
    /// The tank.
    Fixed,
}

/// A reference curve and how our curve is judged by it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Compare {
    /// CSV file, below the folder of references.
    pub reference: String,
    /// Column of the series, such as wedge.vy_m_per_s.
    pub quantity: String,
    /// Factor on our column [-].
    #[serde(default = "usual::factor")]
    pub scale: f64,
    /// The reference's column of times.
    pub x: String,
    /// Factor that turns it into seconds.
    #[serde(default = "usual::factor")]
    pub x_scale: f64,
    /// The reference's column of values.
    pub y: String,
    /// Factor that turns it into SI units.
    #[serde(default = "usual::factor")]
    pub y_scale: f64,
    /// Times compared, from and to, cut at the end of the run [s].
    #[schemars(extend("x-default" = "[0.0, end]"))]
    pub window: [f64; 2],
    /// Error norm. rms, max: in the quantity's unit; rms_over_first, rms_over_peak, peak (heights of the peaks), arrival (times
    /// of arrival), impulse (integrals over time), period (mean distances of zeros): relative.
    #[serde(default)]
    pub norm: Norm,
    /// Largest error that passes, in the norm's unit. absent: drawn, not judged.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance: Option<f64>,
    /// Share of its own peak in the window at which a curve has arrived, for the norm arrival [-].
    #[serde(default = "usual::threshold")]
    #[schemars(range(min = 0.01, max = 0.99))]
    pub threshold: f64,
}

/// The error of our curve y(t) against the reference's points (t_i, r_i) inside the window.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Norm {
    /// √(mean (y(t_i) − r_i)²), in the quantity's unit.
    Rms,
    /// `Rms` over |r| of the first point [-].
    RmsOverFirst,
    /// `Rms` over the largest |r_i| [-].
    #[default]
    RmsOverPeak,
    /// Largest |y(t_i) − r_i|, in the quantity's unit.
    Max,
    /// |max |y| − max |r_i|| over max |r_i| [-]: heights of the peaks, whenever they come.
    Peak,
    /// t/t_r − 1 [-]: the times at which each curve first exceeds a share of its own peak in the window (GE12).
    Arrival,
    /// ∫y dt/∫r dt − 1 [-], over the part of the window that both curves cover (GE12).
    Impulse,
    /// T/T_r − 1 [-]: mean distances of each curve's zeros, up and down, in the window (GE12).
    Period,
}

mod usual {
    pub fn factor() -> f64 {
        1.0
    }
    pub fn threshold() -> f64 {
        0.5
    }
}
