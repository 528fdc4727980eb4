//! A scene as written: every key optional, nothing filled in. The keys are described in [`keywords`](super::keywords).

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::SeqAccessDeserializer;
use serde::de::{IntoDeserializer, SeqAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::model::{
    Body, CouplingScheme, DensityEvolution, DensityFilter, DiffusionForm, Dissipation, EquationOfState, GaugeFrame,
    Integrator, Kernel, Lattice, Motion, Norm, Similarity, Symmetry, Turbulence, WallModel, WallSlip,
};
use super::model_panel::{Panel, TheoryName};
use super::resolve_model::ModelName;
use crate::model_hierarchy::Want;
use fsi_coupling::PanelEnd;
use fsi_coupling::Shape;
use sph_core::{Solver, ThesisSettings};

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SceneFile {
    pub name: Option<String>,
    pub description: Option<String>,
    pub source: Option<String>,
    pub model: Option<ModelName>,
    pub want: Option<Want>,
    pub within: Option<f64>,
    pub solver: Option<Solver>,
    pub symmetry: Option<Symmetry>,
    pub gravity: Option<[f64; 2]>,
    pub similarity: Option<Similarity>,
    pub time: TimeFile,
    pub resolution: ResolutionFile,
    pub fluid: FluidFile,
    pub tank: TankFile,
    pub body: Option<BodyFile>,
    pub gauges: Vec<GaugeFile>,
    pub compare: Vec<CompareFile>,
    pub observe: ObserveFile,
    pub report: ReportFile,
    pub coupling: CouplingFile,
    pub projection: ProjectionFile,
    pub thesis: Option<ThesisSettings>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ObserveFile {
    pub front: Option<bool>,
    pub level: Option<Vec<f64>>,
    pub volume: Option<bool>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ReportFile {
    pub force_rules: Option<bool>,
    pub log_budget: Option<f64>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CouplingFile {
    pub scheme: Option<CouplingScheme>,
    pub tolerance: Option<f64>,
    pub max_iterations: Option<u32>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ProjectionFile {
    pub tolerance: Option<f64>,
    pub most_iterations: Option<usize>,
    pub relaxation: Option<f64>,
    pub calming: Option<f64>,
    pub shift: Option<f64>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TimeFile {
    pub end: Option<f64>,
    pub sample_every: Option<f64>,
    pub frame_every: Option<f64>,
    pub step: Option<f64>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ResolutionFile {
    pub spacing: Option<f64>,
    pub growth: Option<f64>,
    #[serde(deserialize_with = "pair_or_auto")]
    pub fine_zone: Option<[f64; 2]>,
    pub lattice: Option<Lattice>,
    pub packing: Option<bool>,
    pub follow: Option<bool>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FluidFile {
    pub density: Option<f64>,
    #[serde(deserialize_with = "number_or_auto")]
    pub sound_speed: Option<f64>,
    pub compressibility_error: Option<f64>,
    pub eos_exponent: Option<f64>,
    pub kernel: Option<Kernel>,
    pub smoothing_ratio: Option<f64>,
    pub artificial_viscosity: Option<f64>,
    pub kinematic_viscosity: Option<f64>,
    pub density_diffusion: Option<f64>,
    pub shifting: Option<bool>,
    pub settling: Option<f64>,
    pub volume_correction: Option<bool>,
    pub wall_slip: Option<WallSlip>,
    pub wall_stretch: Option<bool>,
    pub ventilation: Option<bool>,
    pub integrator: Option<Integrator>,
    pub cfl: Option<f64>,
    pub verlet_correction_every: Option<u32>,
    pub density_filter: Option<DensityFilter>,
    pub density_filter_every: Option<u32>,
    pub xsph: Option<f64>,
    pub turbulence: Option<Turbulence>,
    pub equation_of_state: Option<EquationOfState>,
    pub temperature: Option<f64>,
    pub molar_mass: Option<f64>,
    pub density_evolution: Option<DensityEvolution>,
    pub density_diffusion_form: Option<DiffusionForm>,
    pub walls: Option<WallModel>,
    pub limit_pressure: Option<i64>,
    pub dissipation: Option<Dissipation>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TankFile {
    #[serde(deserialize_with = "number_or_auto")]
    pub width: Option<f64>,
    #[serde(deserialize_with = "number_or_auto")]
    pub depth: Option<f64>,
    pub height: Option<f64>,
    pub water_width: Option<f64>,
    pub surface_amplitude: Option<f64>,
    pub surface_mode: Option<u32>,
    pub surface_tilt_deg: Option<f64>,
    pub block_from: Option<[f64; 2]>,
    pub block_to: Option<[f64; 2]>,
    pub block_velocity: Option<[f64; 2]>,
}

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BodyFile {
    pub name: Option<String>,
    pub shape: Option<ShapeName>,
    pub deadrise_deg: Option<f64>,
    pub breadth: Option<f64>,
    pub side_height: Option<f64>,
    pub radius: Option<f64>,
    pub height: Option<f64>,
    pub points: Option<Vec<[f64; 2]>>,
    pub thickness: Option<f64>,
    pub mass: Option<f64>,
    pub inertia: Option<f64>,
    pub center_of_mass: Option<[f64; 2]>,
    pub motion: Option<MotionName>,
    pub free: Option<Vec<Axis>>,
    pub velocity: Option<[f64; 2]>,
    pub angular_velocity_deg_per_s: Option<f64>,
    #[serde(deserialize_with = "pair_or_touching")]
    pub position: Option<[f64; 2]>,
    pub angle_deg: Option<f64>,
    pub amplitude: Option<[f64; 2]>,
    pub period: Option<f64>,
    pub damping: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub panels: Vec<PanelFile>,
}

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PanelFile {
    pub name: Option<String>,
    pub from: Option<[f64; 2]>,
    pub to: Option<[f64; 2]>,
    pub elements: Option<usize>,
    pub thickness: Option<f64>,
    pub youngs_modulus: Option<f64>,
    pub poissons_ratio: Option<f64>,
    pub density: Option<f64>,
    pub ends: Option<[PanelEnd; 2]>,
    pub theory: Option<TheoryName>,
    pub watch: Option<Vec<f64>>,
    pub yield_stress: Option<f64>,
    pub hardening_modulus: Option<f64>,
    pub rupture_strain: Option<f64>,
    pub allowable_stress: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShapeName {
    Wedge,
    Arc,
    Box,
    Polygon,
    Polyline,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MotionName {
    #[default]
    Free,
    ConstantVelocity,
    Fixed,
    Oscillating,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    X,
    Y,
    Angle,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GaugeFile {
    pub name: Option<String>,
    pub on: Option<GaugeFrame>,
    pub at: Option<[f64; 2]>,
    pub length: Option<f64>,
    pub bandwidth: Option<f64>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CompareFile {
    pub reference: Option<String>,
    pub quantity: Option<String>,
    pub scale: Option<f64>,
    pub x: Option<String>,
    pub x_scale: Option<f64>,
    pub y: Option<String>,
    pub y_scale: Option<f64>,
    pub window: Option<[f64; 2]>,
    pub norm: Option<Norm>,
    pub tolerance: Option<f64>,
    pub threshold: Option<f64>,
}

fn number_or_auto<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    from.deserialize_any(ValueOrWord::new("auto", "a number or \"auto\""))
}

fn pair_or_auto<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[f64; 2]>, D::Error> {
    from.deserialize_any(ValueOrWord::new("auto", "two numbers or \"auto\""))
}

fn pair_or_touching<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[f64; 2]>, D::Error> {
    from.deserialize_any(ValueOrWord::new("touching", "two numbers or \"touching\""))
}

/// Reads a value, or a word that stands for leaving the key out.
struct ValueOrWord<T> {
    word: &'static str,
    expected: &'static str,
    value: PhantomData<T>,
}

impl<T> ValueOrWord<T> {
    fn new(word: &'static str, expected: &'static str) -> Self {
        ValueOrWord { word, expected, value: PhantomData }
    }
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for ValueOrWord<T> {
    type Value = Option<T>;

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.expected)
    }

    fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<Self::Value, E> {
        match word == self.word {
            true => Ok(None),
            false => Err(E::invalid_value(Unexpected::Str(word), &self)),
        }
    }

    fn visit_f64<E: serde::de::Error>(self, number: f64) -> Result<Self::Value, E> {
        T::deserialize(number.into_deserializer()).map(Some)
    }

    fn visit_i64<E: serde::de::Error>(self, number: i64) -> Result<Self::Value, E> {
        T::deserialize(number.into_deserializer()).map(Some)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<Self::Value, A::Error> {
        T::deserialize(SeqAccessDeserializer::new(items)).map(Some)
    }
}

impl From<Body> for BodyFile {
    fn from(body: Body) -> Self {
        let mut file = BodyFile {
            name: Some(body.name),
            center_of_mass: Some(body.center_of_mass),
            velocity: Some(body.velocity),
            angular_velocity_deg_per_s: Some(body.angular_velocity_deg_per_s),
            position: Some(body.position),
            angle_deg: Some(body.angle_deg),
            damping: (!body.panels.is_empty()).then_some(body.damping),
            panels: body.panels.into_iter().map(PanelFile::from).collect(),
            ..BodyFile::default()
        };
        file.write_shape(body.shape);
        file.write_motion(body.motion);
        file
    }
}

impl From<Panel> for PanelFile {
    fn from(panel: Panel) -> Self {
        PanelFile {
            name: Some(panel.name),
            from: Some(panel.from),
            to: Some(panel.to),
            elements: Some(panel.elements),
            thickness: Some(panel.thickness),
            youngs_modulus: Some(panel.youngs_modulus),
            poissons_ratio: Some(panel.poissons_ratio),
            density: Some(panel.density),
            ends: Some(panel.ends),
            theory: Some(panel.theory),
            watch: Some(panel.watch),
            yield_stress: panel.yield_stress,
            hardening_modulus: panel.yield_stress.map(|_| panel.hardening_modulus),
            rupture_strain: panel.rupture_strain,
            allowable_stress: panel.allowable_stress,
        }
    }
}

impl BodyFile {
    fn write_shape(&mut self, shape: Shape) {
        let name = match shape {
            Shape::Wedge { deadrise_deg, breadth, side_height } => {
                self.deadrise_deg = Some(deadrise_deg);
                self.breadth = Some(breadth);
                self.side_height = Some(side_height);
                ShapeName::Wedge
            }
            Shape::Arc { radius, breadth, side_height } => {
                self.radius = Some(radius);
                self.breadth = Some(breadth);
                self.side_height = Some(side_height);
                ShapeName::Arc
            }
            Shape::Box { breadth, height } => {
                self.breadth = Some(breadth);
                self.height = Some(height);
                ShapeName::Box
            }
            Shape::Polygon { points } => {
                self.points = Some(points);
                ShapeName::Polygon
            }
            Shape::Polyline { points, thickness } => {
                self.points = Some(points);
                self.thickness = Some(thickness);
                ShapeName::Polyline
            }
        };
        self.shape = Some(name);
    }

    fn write_motion(&mut self, motion: Motion) {
        let name = match motion {
            Motion::Free(freedom) => {
                let axes = [(freedom.x, Axis::X), (freedom.y, Axis::Y), (freedom.inertia.is_some(), Axis::Angle)];
                self.free = Some(axes.into_iter().filter(|a| a.0).map(|a| a.1).collect());
                self.mass = Some(freedom.mass);
                self.inertia = freedom.inertia;
                MotionName::Free
            }
            Motion::ConstantVelocity => MotionName::ConstantVelocity,
            Motion::Fixed => MotionName::Fixed,
            Motion::Oscillating(oscillation) => {
                self.amplitude = Some(oscillation.amplitude);
                self.period = Some(oscillation.period);
                MotionName::Oscillating
            }
        };
        self.motion = Some(name);
    }
}
