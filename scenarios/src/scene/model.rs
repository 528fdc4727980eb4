//! The resolved scene: plain data, every number known.

pub use fsi_coupling::geometry::layout::Lattice;
use serde::{Deserialize, Serialize};

pub use super::model_coupling::{Coupling, CouplingScheme};
pub use super::model_fluid::{
    DensityEvolution, DensityFilter, DiffusionForm, Dissipation, EquationOfState, Fluid, IdealGas, Integrator, Kernel,
    Turbulence, WallModel, WallSlip,
};

use super::auto::fastest_speed;
use super::file::BodyFile;
use super::impact::Entry;
pub use super::model_panel::Panel;
pub use super::model_projection::Projection;
use fsi_coupling::Shape;
pub use fsi_coupling::entry_theory::EntryModel;
use fsi_coupling::geometry::polygon;
pub use sph_core::{Solver, ThesisSettings};

/// A scene as it is run. It serialises to TOML with the keys of a scene file, and that text loads to the same scene.
///
/// One frame of reference: the still-water surface is y = 0, the floor is y = −depth, x = 0 is the tank's middle.
/// SI units; angles in degrees; masses and loads per metre of span.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scene {
    /// A word for file names and titles.
    pub name: String,
    /// What the scene shows, in one line.
    pub description: String,
    /// Where its numbers come from.
    pub source: String,
    /// The model: a theory of entry, or particles.
    pub model: EntryModel,
    /// Why this model, where it was left to the program.
    #[serde(skip)]
    pub choice: Option<String>,
    /// What gives the pressure of particles.
    pub solver: Solver,
    /// Mirror plane.
    pub symmetry: Symmetry,
    /// Acceleration of gravity [m/s²], shape (2).
    pub gravity: [f64; 2],
    /// The exact solution this scene has, if any.
    pub similarity: Option<Similarity>,
    /// Duration and sampling.
    pub time: Time,
    /// Particle spacing.
    pub resolution: Resolution,
    /// The water and the numerical scheme.
    pub fluid: Fluid,
    /// The rectangle of water and its walls.
    pub tank: Tank,
    /// The body in the water or above it.
    pub body: Option<Body>,
    /// Pressure gauges.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gauges: Vec<Gauge>,
    /// Curves to compare with.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub compare: Vec<Compare>,
    /// Curves that are sampled only where a scene asks for them.
    pub observe: Observe,
    /// What a run observes beside its curves.
    pub report: Report,
    /// How water and body agree on a step.
    pub coupling: Coupling,
    /// The projection, where pressures come from one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projection: Option<Projection>,
    /// The thesis's projection, where pressures come from that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thesis: Option<ThesisSettings>,
}

/// Curves that are sampled only where a scene asks for them.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Observe {
    /// The column `front_m`: length of the connected water along the floor (V5).
    pub front: bool,
    /// Places x [m] of the columns `level1_m`, `level2_m` …: height of the water there (Q3).
    pub level: Vec<f64>,
    /// The column `volume_m2`: volume of the water by the place of its surface (Q7).
    pub volume: bool,
}

/// What a run observes beside its curves.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Report {
    /// Compare the force on the body by four rules.
    pub force_rules: bool,
    /// Size that the log stays below [MB], with fewer frames of particles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log_budget: Option<f64>,
}

/// Mirror plane of the flow.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Symmetry {
    /// The whole tank is simulated.
    #[default]
    None,
    /// Only x ≥ 0 is simulated; x = 0 is a mirror.
    X,
}

/// Exact solutions that a scene can be judged by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Similarity {
    /// Entry of a wedge at constant speed without gravity (Dobrovolskaya 1969): the flow depends on x/(V t) only.
    Wedge,
}

/// Duration and sampling.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Time {
    /// End of the simulated time, which starts at 0 [s].
    pub end: f64,
    /// Interval between rows of the series [s].
    pub sample_every: f64,
    /// Interval between frames of particles [s].
    pub frame_every: f64,
    /// Length of every step [s]; without it each step is as long as is stable.
    pub step: Option<f64>,
}

/// Particle spacing: `spacing` in the fine zone, growing away from it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Resolution {
    /// Finest spacing dx [m].
    pub spacing: f64,
    /// Ratio of successive rows outside the fine zone; 1 is uniform.
    pub growth: f64,
    /// Half width, from the body's middle, and depth below still water of the fine zone [m], shape (2).
    pub fine_zone: [f64; 2],
    /// How particles lie in uniform water.
    pub lattice: Lattice,
    /// Pack the water round the body before the run (Q6).
    pub packing: bool,
    /// The fine zone grows with the draught instead of holding the last spray root from the start (E26).
    pub follow: bool,
}

/// The rectangle of water and its walls.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tank {
    /// Full inner width, from −width/2 to width/2 [m].
    pub width: f64,
    /// Depth of still water [m].
    pub depth: f64,
    /// Height of the side walls above the floor [m].
    pub height: f64,
    /// Width of the water at rest, measured from the left wall [m]; less than `width` for a dam break.
    pub water_width: f64,
    /// Amplitude of the wave that the water starts with [m] (THEORY Q1).
    pub surface_amplitude: f64,
    /// Its half waves between the tank's walls.
    pub surface_mode: u32,
    /// Tilt of the surface that the water starts with, upwards to the right [deg] (THEORY Q1).
    pub surface_tilt_deg: f64,
    /// A block of water in the air at t = 0 (THEORY Q2).
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub block: Option<Block>,
}

/// A rectangle of water in the air, that falls or flies on (THEORY Q2).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Block {
    /// Its lower left corner [m], shape (2).
    #[serde(rename = "block_from")]
    pub from: [f64; 2],
    /// Its upper right corner [m], shape (2).
    #[serde(rename = "block_to")]
    pub to: [f64; 2],
    /// Its velocity [m/s], shape (2).
    #[serde(rename = "block_velocity")]
    pub velocity: [f64; 2],
}

/// A body: rigid but for its panels.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(into = "BodyFile")]
pub struct Body {
    /// A word that starts its columns in the series.
    pub name: String,
    /// Outline, in the body's frame.
    pub shape: Shape,
    /// How it moves.
    pub motion: Motion,
    /// Centre of mass in the body's frame [m], shape (2).
    pub center_of_mass: [f64; 2],
    /// Velocity of the centre of mass at t = 0 [m/s], shape (2).
    pub velocity: [f64; 2],
    /// Angular velocity at t = 0, counter-clockwise [deg/s].
    pub angular_velocity_deg_per_s: f64,
    /// Position of the body frame's origin at t = 0 [m], shape (2).
    pub position: [f64; 2],
    /// Rotation of the body's frame at t = 0, counter-clockwise [deg].
    pub angle_deg: f64,
    /// Rayleigh damping of its panels by mass [1/s] and by stiffness [s], shape (2).
    pub damping: [f64; 2],
    /// The parts of its surface that bend.
    pub panels: Vec<Panel>,
}

/// How a body moves.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// By its weight and the water's load.
    Free(Freedom),
    /// On at its initial velocity, whatever the load.
    ConstantVelocity,
    /// Not at all.
    Fixed,
    /// To and fro (V4).
    Oscillating(Oscillation),
}

/// A prescribed motion to and fro: x(t) = x₀ + A r(t) sin(2π t/T), eased in by r over the first period (V4).
#[derive(Debug, Clone, PartialEq)]
pub struct Oscillation {
    /// Amplitude A [m], shape (2).
    pub amplitude: [f64; 2],
    /// Period T [s].
    pub period: f64,
}

/// Inertia and free directions of a free body.
#[derive(Debug, Clone, PartialEq)]
pub struct Freedom {
    /// Mass of the whole body, also when half of it is simulated [kg/m].
    pub mass: f64,
    /// Free to move along x.
    pub x: bool,
    /// Free to move along y.
    pub y: bool,
    /// Moment of inertia about the centre of mass [kg m²/m]; present exactly when the body is free to rotate.
    pub inertia: Option<f64>,
}

/// A pressure gauge.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Gauge {
    /// A word that starts its column in the series.
    pub name: String,
    /// The frame it is fixed in.
    pub on: GaugeFrame,
    /// Its place in that frame [m], shape (2).
    pub at: [f64; 2],
    /// Length of its face [m]; 0 is a point.
    pub length: f64,
    /// Bandwidth of its low-pass [Hz]; `None` shows every frequency.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bandwidth: Option<f64>,
}

/// The frame a gauge is fixed in.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GaugeFrame {
    /// The body's frame.
    #[default]
    Body,
    /// The tank.
    Fixed,
}

/// A reference curve and how our curve is judged by it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Compare {
    /// Path of a CSV file below the folder of references.
    pub reference: String,
    /// Column of our series.
    pub quantity: String,
    /// Factor on our column [-].
    pub scale: f64,
    /// The reference's column of times.
    pub x: String,
    /// Factor that turns it into seconds.
    pub x_scale: f64,
    /// The reference's column of values.
    pub y: String,
    /// Factor that turns it into SI units.
    pub y_scale: f64,
    /// Times compared, from and to [s], shape (2); cut at the end of the run.
    pub window: [f64; 2],
    /// What the error is.
    pub norm: Norm,
    /// Largest error that passes; without it the curve is drawn and not judged.
    pub tolerance: Option<f64>,
    /// Share of a curve's peak at which it has arrived, for the norm `arrival` [-].
    pub threshold: f64,
}

/// The error of our curve y(t) against the reference's points (t_i, r_i) inside the window.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
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
    /// t/t_r − 1 [-]: the times at which each curve first exceeds a share of its own peak in the window (V6).
    Arrival,
    /// ∫y dt/∫r dt − 1 [-], over the part of the window that both curves cover (V6).
    Impulse,
    /// T/T_r − 1 [-]: mean distances of each curve's zeros, up and down, in the window (Q4).
    Period,
}

impl Scene {
    /// The scene as a scene file.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a scene holds nothing that TOML cannot say")
    }

    /// How the body meets the water; `None` where nothing falls or moves down into it.
    pub fn entry(&self) -> Option<Entry> {
        let body = self.body.as_ref()?;
        Entry::of(body, self.gravity, self.fluid.density, self.time.end)
    }

    /// Fastest speed of the flow that is known before the run [m/s].
    pub fn fastest_speed(&self) -> f64 {
        let entry = self.entry();
        fastest_speed(entry.as_ref(), self.body.as_ref(), self.gravity, self.tank.fall()) + self.tank.block_speed()
    }

    /// Speed by which the steps of a projection are limited before anything moves [m/s]: the fastest that is known, but of the
    /// root of a spray no more than four times the body's, which a round body's exceeds at first touch.
    pub fn projection_speed(&self) -> f64 {
        const ROOT_OVER_BODY: f64 = 4.0;
        let fastest = self.fastest_speed();
        self.entry().map_or(fastest, |entry| fastest.min(ROOT_OVER_BODY * entry.speed))
    }

    /// x of the fine zone's middle [m]: the body's, or the tank's where there is no body.
    pub fn fine_zone_center(&self) -> f64 {
        self.body.as_ref().map_or(0.0, Body::middle)
    }

    /// Largest x or y distance of the point from the fine zone [m], shape (2) to scalar; 0 inside it and above it.
    ///
    /// Rows that grow by `growth` make the spacing there dx + (growth − 1)·distance.
    pub fn distance_from_fine_zone(&self, at: [f64; 2]) -> f64 {
        let [half_width, depth] = self.resolution.fine_zone;
        let beside = (at[0] - self.fine_zone_center()).abs() - half_width;
        let below = -at[1] - depth;
        beside.max(below).max(0.0)
    }

    /// Sides of the simulated water at rest, `[left, right]` [m].
    pub fn water_sides(&self) -> [f64; 2] {
        let half = 0.5 * self.tank.width;
        match self.symmetry {
            Symmetry::None => [-half, self.tank.water_width - half],
            Symmetry::X => [0.0, half],
        }
    }
}

impl Body {
    /// Outline at t = 0 in the tank's frame [m], shape (n, 2), counter-clockwise.
    pub fn placed_outline(&self) -> Vec<[f64; 2]> {
        let outline = self.shape.outline();
        outline.into_iter().map(|p| self.to_tank(p)).collect()
    }

    /// A point of the body's frame in the tank's frame, at t = 0 [m].
    pub fn to_tank(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.angle_deg.to_radians().sin_cos();
        let [x0, y0] = self.position;
        [x0 + x * cos - y * sin, y0 + x * sin + y * cos]
    }

    /// Bound of the speed of its points at t = 0 [m/s]: |v| + |ω| r, with the farthest vertex at r from the centre of mass;
    /// of an oscillating body 2π A/T at any time.
    pub fn fastest_point(&self) -> f64 {
        let [cx, cy] = self.center_of_mass;
        let outline = self.shape.outline();
        let arms = outline.iter().map(|p| (p[0] - cx).hypot(p[1] - cy));
        let spin = self.angular_velocity_deg_per_s.to_radians().abs();
        let oscillation = match &self.motion {
            Motion::Oscillating(Oscillation { amplitude: [x, y], period }) => {
                std::f64::consts::TAU * x.hypot(*y) / period
            }
            _ => 0.0,
        };
        self.velocity[0].hypot(self.velocity[1]) + spin * arms.fold(0.0, f64::max) + oscillation
    }

    /// Depth of its lowest point below the still surface at t = 0 [m]; negative above it.
    pub fn draught(&self) -> f64 {
        let [min, _] = polygon::bounding_box(&self.placed_outline());
        -min[1]
    }

    /// x midway between the body's left and right ends at t = 0 [m].
    pub fn middle(&self) -> f64 {
        let [min, max] = polygon::bounding_box(&self.placed_outline());
        0.5 * (min[0] + max[0])
    }
}
