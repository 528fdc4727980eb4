//! The resolved scene: plain data, every number known.

pub use fsi_coupling::fill::Lattice;
use serde::{Deserialize, Serialize};
pub use sph_core::{Integrator, Kernel, Slip as WallSlip, WallModel};

use super::auto::fastest_speed;
use super::file::BodyFile;
use super::impact::Entry;
use fsi_coupling::Shape;
use fsi_coupling::polygon;

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
    /// What a run observes beside its curves.
    pub report: Report,
}

/// What a run observes beside its curves.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Report {
    /// Compare the force on the body by four rules.
    pub force_rules: bool,
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
}

/// The water and the numerical scheme.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fluid {
    /// Density of the undisturbed water ρ [kg/m³].
    pub density: f64,
    /// Speed of sound c₀ [m/s].
    pub sound_speed: f64,
    /// Share of the force that compressibility may cost [-]; sets an "auto" speed of sound.
    pub compressibility_error: f64,
    /// Exponent γ of Tait's equation of state [-]; 1 is linear.
    pub eos_exponent: f64,
    /// Smoothing kernel.
    pub kernel: Kernel,
    /// Smoothing length over spacing, h/dx [-]; the kernel's support is 2h.
    pub smoothing_ratio: f64,
    /// Coefficient α of artificial viscosity [-].
    pub artificial_viscosity: f64,
    /// Kinematic viscosity ν [m²/s].
    pub kinematic_viscosity: f64,
    /// Coefficient δ of density diffusion [-].
    pub density_diffusion: f64,
    /// Particle shifting.
    pub shifting: bool,
    /// Particle volumes corrected for the drift that shifting leaves beside walls.
    pub volume_correction: bool,
    /// Tangential condition on walls.
    pub wall_slip: WallSlip,
    /// Time integration.
    pub integrator: Integrator,
    /// Step limit: dt ≤ cfl·h/(c₀ + |v|) [-].
    pub cfl: f64,
    /// How walls keep the water out.
    pub walls: WallModel,
    /// Dynamic walls' pressure at the start: 0 none, 1 that of the water beside them.
    pub limit_pressure: i64,
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
}

/// A rigid body.
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
        fastest_speed(entry.as_ref(), self.body.as_ref(), self.gravity, self.tank.depth)
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

    /// Bound of the speed of its points at t = 0 [m/s]: |v| + |ω| r, with the farthest vertex at r from the centre of mass.
    pub fn fastest_point(&self) -> f64 {
        let [cx, cy] = self.center_of_mass;
        let outline = self.shape.outline();
        let arms = outline.iter().map(|p| (p[0] - cx).hypot(p[1] - cy));
        let spin = self.angular_velocity_deg_per_s.to_radians().abs();
        self.velocity[0].hypot(self.velocity[1]) + spin * arms.fold(0.0, f64::max)
    }

    /// x midway between the body's left and right ends at t = 0 [m].
    pub fn middle(&self) -> f64 {
        let [min, max] = polygon::bounding_box(&self.placed_outline());
        0.5 * (min[0] + max[0])
    }
}
