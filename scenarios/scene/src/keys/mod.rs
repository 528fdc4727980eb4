//! The settings of a scene: what a scene file says, what it may leave out, and what a run reads.
//!
//! Each field is declared here, in [`sph_core`] or in [`fsi_coupling`], and nowhere else: the schema, the reference page, the
//! checks and `scene.resolved.toml` follow from it (see [`settings`]).

mod body;
mod displacements;
mod fluid;
mod links;
mod modes;
mod observation;
mod panel;
mod rule;
mod sprung_mass;
mod tank;
mod waves;

use std::sync::LazyLock;

use schemars::JsonSchema;
use serde::de::Error as _;
use serde::{Deserialize, Serialize};
use settings::Schema;
use water_entry::EntryModel;

pub use body::line;
pub use body::{Axis, Body, Freedom, Motion, Moved, Oscillation, panel_length, panel_line};
pub(super) use body::{WET_HEIGHT, placed};
pub(crate) use displacements::parabola_rate;
pub use fluid::{IncompressibleFluid, SolverSettings, Water, WeaklyCompressibleFluid};
pub use fsi_coupling::geometry::layout::Lattice;
pub(crate) use links::TANK;
pub use links::{Joint, JointName, SolidContact};
pub use modes::{MILLIMETRE, MODES};
pub use modes::{Modes, NaturalMode};
pub use observation::{Compare, Gauge, GaugeFrame, Norm, Observe, Report};
pub use panel::{Panel, StructurePlane, StructureUnits, TheoryName};
pub use rule::Rule;
pub use sprung_mass::SprungMass;
pub use tank::{Block, Tank};
pub use waves::{Beach, WaveMaker};

use fsi_coupling::{Iteration, Scheme};
use sph_core::{Auto, FluidSettings};

/// The schema of a scene file.
pub fn schema() -> &'static Schema {
    static SCHEMA: LazyLock<Schema> = LazyLock::new(|| Schema::of::<Scene>("a scene"));
    &SCHEMA
}

/// A scene. Read from a file it has every value that a run needs, and it serialises to a scene file.
///
/// One frame of reference: the still-water surface is y = 0, the floor is y = −depth, x = 0 is the tank's middle.
/// SI units; angles in degrees; masses and loads per metre of span.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Scene {
    /// A word for file names and titles.
    pub name: String,
    /// What the scene shows, in one line.
    #[serde(default)]
    pub description: String,
    /// Source of its numbers.
    #[serde(default)]
    pub source: String,
    /// Model of the flow. auto: the cheapest whose measured error for `want` is at most `within` (THEORY EN9); von_karman,
    /// wagner, mlm, similarity: analytical models of a symmetric section's entry, in milliseconds; boundary_element: nonlinear potential flow
    /// about a wedge, a polygon, an arc or a curve, flat keels and wet chines too, and panels of keeled and round bottoms, in seconds; wcsph, incompressible:
    /// particles.
    #[schemars(with = "Auto<EntryModel>", extend("x-default" = "wcsph; the solver's where there is one"))]
    pub model: EntryModel,
    /// Reason for the model, where it was `auto`.
    #[serde(skip)]
    pub choice: Option<String>,
    /// Quantity for which model = "auto" is chosen.
    #[serde(default, skip_serializing)]
    #[schemars(extend("x-when" = "model = auto"))]
    pub want: QuantityOfInterest,
    /// Largest measured error of model = "auto" [-].
    #[serde(default = "usual::within", skip_serializing)]
    #[schemars(range(max = 1.0), extend("exclusiveMinimum" = 0, "x-when" = "model = auto"))]
    pub within: f64,
    /// Mirror plane. none: the whole tank is simulated; x: only x >= 0, with a mirror at x = 0. Absent with model = "auto": x
    /// where the scene is symmetric.
    #[serde(default)]
    pub symmetry: Symmetry,
    /// Acceleration of gravity [x, y] [m/s²].
    #[serde(default = "usual::gravity")]
    pub gravity: [f64; 2],
    /// Exact solution by which the scene is judged. wedge: the similarity solution of a wedge at constant speed (Dobrovolskaya
    /// 1969).
    pub similarity: Option<Similarity>,
    /// Duration and sampling.
    pub time: Time,
    /// Particle spacing.
    #[schemars(extend("x-default" = "by the model"))]
    pub resolution: Resolution,
    /// The solver, with the tables that it reads.
    #[serde(flatten)]
    pub solver: SolverSettings,
    /// The rectangle of water and its walls.
    #[schemars(extend("x-default" = "for an impact, out of reach of its echo"))]
    pub tank: Tank,
    /// The body in the water or above it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<Body>,
    /// Further bodies, rigid. Results and theories are those of body; every body has its columns.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<Body>,
    /// Contact of rigid bodies with each other, the floor and the walls.
    #[serde(default, skip_serializing_if = "SolidContact::is_default")]
    pub contact: SolidContact,
    /// Joints between bodies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<Joint>,
    /// Pressure gauges.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gauges: Vec<Gauge>,
    /// Curves to compare with.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub compare: Vec<Compare>,
    /// Curves that are sampled on request.
    #[serde(default)]
    pub observe: Observe,
    /// What a run reports beside its curves.
    #[serde(default)]
    pub report: Report,
    /// Numbers of the aircraft, for the loads that rules state. absent: none are stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rule: Option<Rule>,
    /// Coupling of water and body.
    #[schemars(extend("x-default" = "by the body"))]
    pub coupling: Coupling,
}

/// Quantity of interest of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum QuantityOfInterest {
    /// The largest force.
    #[default]
    PeakForce,
    /// The largest pressure.
    PeakPressure,
    /// The force over time.
    History,
    /// Strains of panels.
    Strain,
    /// The body's motion.
    Motion,
}

impl QuantityOfInterest {
    /// As text.
    pub fn words(self) -> &'static str {
        match self {
            QuantityOfInterest::PeakForce => "the largest force",
            QuantityOfInterest::PeakPressure => "the largest pressure",
            QuantityOfInterest::History => "the force over time",
            QuantityOfInterest::Strain => "strains",
            QuantityOfInterest::Motion => "the motion",
        }
    }
}

/// Mirror plane of the flow.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Symmetry {
    /// The whole tank is simulated.
    #[default]
    None,
    /// Only x ≥ 0 is simulated; x = 0 is a mirror.
    X,
}

/// Exact solutions by which a scene can be judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Similarity {
    /// Entry of a wedge at constant speed without gravity (Dobrovolskaya 1969): the flow depends on x/(V t) only.
    Wedge,
}

/// Duration and sampling.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Time {
    /// Start of the simulated time, at or before 0 [s]. A body is where the scene says at t = 0; a run that starts before has it
    /// fly in, half a spacing higher (THEORY WA12). auto: an approach of two spacings for what enters weakly compressible water
    /// from less than two above it, else 0.
    #[schemars(with = "Auto<f64>", extend("x-default" = "auto"))]
    pub start: f64,
    /// End of the simulated time [s].
    #[schemars(extend(
        "exclusiveMinimum" = 0,
        "x-default" = "required; with model = \"auto\" of an entry: past the largest force"
    ))]
    pub end: f64,
    /// Interval between rows of the series [s].
    #[schemars(extend("x-default" = "end/500"))]
    pub sample_every: f64,
    /// Interval between frames of particles [s].
    #[schemars(extend("x-default" = "end/50"))]
    pub frame_every: f64,
    /// Length of every time step (INDAT ivar_dt 0, and dt), below the limit of fluid.cfl [s]. absent: each step (ivar_dt 1) is as
    /// long as fluid.cfl and the other limits allow.
    pub step: Option<f64>,
}

/// Particle spacing: `spacing` in the fine zone, growing away from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Resolution {
    /// Finest particle spacing dx (INDAT dx, dy, dz: one here) [m].
    #[schemars(extend(
        "exclusiveMinimum" = 0,
        "x-default" = "required; with model = \"auto\": from the work-precision charts; a theory needs none"
    ))]
    pub spacing: f64,
    /// Ratio of successive rows outside the fine zone; 1 is uniform [-].
    #[serde(default = "usual::growth")]
    #[schemars(range(min = 1.0, max = 2.0))]
    pub growth: f64,
    /// Half width from the body's middle (of several, midway between the ends of those that move) and depth below still water of the
    /// fine zone [m]. auto: it holds all spray roots to the end, or the whole tank without an impact.
    #[schemars(with = "Auto<[f64; 2]>", extend("x-default" = "auto"))]
    pub fine_zone: [f64; 2],
    /// Arrangement of particles in uniform water (INDAT lattice 1 | 2: SC | BCC). staggered: body-centred squares of side sqrt(2)
    /// dx, growth 1 only.
    #[serde(default)]
    pub lattice: Lattice,
    /// Packing of the water round the body before the run: as much as there is room for, evenly (Colagrossi et al. 2012).
    /// Not round a polyline.
    #[schemars(extend("x-default" = "false; true if incompressible with a body, and for a body under water"))]
    pub packing: bool,
    /// Refinement tracking: the fine zone grows with the draught of a body that enters the water, and coarse particles are split
    /// (THEORY WC21). For the weakly compressible solver with the symplectic integrator.
    #[schemars(extend(
        "x-default" = "true where it is possible, for a rigid body and an automatic fine zone; else false"
    ))]
    pub follow: bool,
}

/// Coupling of water and body in a step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Coupling {
    /// Coupling scheme (no INDAT switch: the thesis exchanges once per step). weak: one exchange per step; added_mass: body's
    /// acceleration and wall pressures are solved together, without iterations, for light bodies; iqn_ils: the step is
    /// repeated until both agree.
    #[schemars(extend(
        "x-default" = "weak; added_mass with body.panels, and for free bodies with solver = incompressible"
    ))]
    pub scheme: CouplingScheme,
    /// Relative mismatch of the body's acceleration at which an iterated step ends (THEORY CO8) [-].
    #[serde(default = "usual::coupling_tolerance")]
    #[schemars(range(min = 1e-12, max = 0.1), extend("x-when" = ".scheme = iqn_ils"))]
    pub tolerance: f64,
    /// Repetitions of a step after which a mismatch ends the run with an error [-].
    #[serde(default = "usual::max_iterations")]
    #[schemars(range(min = 1), extend("x-when" = ".scheme = iqn_ils"))]
    pub max_iterations: u32,
}

/// Coupling schemes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CouplingScheme {
    /// One exchange per step.
    #[default]
    Weak,
    /// Accelerations and wall pressures together, without iterations (THEORY CO5).
    AddedMass,
    /// Iterated, by quasi-Newton steps (THEORY CO9).
    IqnIls,
}

mod usual {
    pub fn within() -> f64 {
        0.05
    }
    pub fn gravity() -> [f64; 2] {
        [0.0, -9.81]
    }
    pub fn growth() -> f64 {
        1.1
    }
    pub fn coupling_tolerance() -> f64 {
        1e-6
    }
    pub fn max_iterations() -> u32 {
        50
    }
}

/// Acceleration of gravity where a scene does not give it [m/s²].
pub(super) const GRAVITY: fn() -> [f64; 2] = usual::gravity;

impl Scene {
    /// The scene as a scene file.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a scene holds nothing that TOML cannot say")
    }

    /// The scene that [`Scene::to_toml`] wrote. It is read as all scenes are, through JSON, so that the reading of TOML is compiled once.
    pub fn from_toml(text: &str) -> Result<Scene, toml::de::Error> {
        let table: toml::Table = text.parse()?;
        let value = serde_json::to_value(table).map_err(toml::de::Error::custom)?;
        Scene::deserialize(&value).map_err(toml::de::Error::custom)
    }

    /// All bodies: the first, then the further ones.
    pub fn all_bodies(&self) -> impl Iterator<Item = &Body> {
        self.body.iter().chain(&self.bodies)
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

impl CouplingScheme {
    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            CouplingScheme::Weak => "weak",
            CouplingScheme::AddedMass => "added_mass",
            CouplingScheme::IqnIls => "iqn_ils",
        }
    }
}

impl Coupling {
    /// The scheme of the coupled system.
    pub fn scheme(&self) -> Scheme {
        match self.scheme {
            CouplingScheme::Weak => Scheme::Weak,
            CouplingScheme::AddedMass => Scheme::AddedMass,
            CouplingScheme::IqnIls => {
                Scheme::IqnIls(Iteration { tolerance: self.tolerance, max_iterations: self.max_iterations })
            }
        }
    }
}

impl Scene {
    /// The water.
    pub fn water(&self) -> &FluidSettings {
        &self.solver.water().fluid
    }

    /// Speed of sound c₀ [m/s]; of a projection the one from which an automatic tank follows.
    pub fn sound_speed(&self) -> f64 {
        self.solver.sound_speed()
    }

    /// Courant number of the step limit [-].
    pub fn courant_number(&self) -> f64 {
        self.solver.courant_number()
    }
}
