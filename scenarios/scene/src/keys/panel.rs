//! A flexible panel of a body.

use fsi_coupling::{EndSpring, PanelBar, PanelEnd, PanelMesh, PanelSpec, Plane};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use structure_fe::{BarSection, Material, Plasticity, Theory};

use crate::library::MaterialName;

/// A flexible part of the body's surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Panel {
    /// A word that starts its columns in the series.
    #[schemars(extend("x-default" = "panel1, ..."))]
    pub name: String,
    /// Start x, y in the body's frame, on the outline (a polyline's middle line) [m].
    #[schemars(extend("x-default" = "required without from_point"))]
    pub from: [f64; 2],
    /// End x, y; along an outline counter-clockwise, along a polyline in the order of its points [m].
    #[schemars(extend("x-default" = "required without to_point"))]
    pub to: [f64; 2],
    /// Start as the number of a point of body.outline or body.points, counted from 1; 12.5 is halfway from 12 to 13 [-]. From there the
    /// panel follows the order of the file, also where that is clockwise.
    #[serde(default, skip_serializing)]
    pub from_point: Option<f64>,
    /// End as the number of a point [-].
    #[serde(default, skip_serializing)]
    pub to_point: Option<f64>,
    /// Material by name, for youngs_modulus, poissons_ratio, density, yield_stress and allowable_stress where they are absent; with theory
    /// = timoshenko without yield_stress. `splashdown keywords material` lists the numbers.
    #[serde(default, skip_serializing)]
    pub material: Option<MaterialName>,
    /// Nastran bulk data file (.bdf, .dat, .nas) with a chain of CBAR, which become its elements, in place of elements, thickness,
    /// youngs_modulus, poissons_ratio, density and plane; SPC1 at its ends say `ends` where they are absent. Coordinates are those of the
    /// body's frame.
    #[serde(default, skip_serializing)]
    pub structure_file: Option<String>,
    /// Plane of the coordinates of structure_file that is x, y of the body's frame.
    #[serde(default, skip_serializing)]
    #[schemars(extend("x-when" = ".structure_file", "x-default" = "xy with structure_file"))]
    pub structure_plane: Option<StructurePlane>,
    /// Units of structure_file: metre, kilogram, second; or millimetre, tonne, second (N, MPa).
    #[serde(default, skip_serializing)]
    #[schemars(extend("x-when" = ".structure_file", "x-default" = "m_kg_s with structure_file"))]
    pub structure_units: Option<StructureUnits>,
    /// Span that a bar of structure_file stands for, such as the pitch of frames [m].
    #[serde(default, skip_serializing)]
    #[schemars(extend("exclusiveMinimum" = 0, "x-when" = ".structure_file", "x-default" = "1 with structure_file"))]
    pub structure_width: Option<f64>,
    /// Nodes x, y on the axis of its bars, body's frame, from its start to its end [m]. structure_file writes them. absent: a plate of
    /// equal elements.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-when" = ".bars"))]
    pub nodes: Option<Vec<[f64; 2]>>,
    /// Bars between the nodes, of a metre of span: Young's modulus, shear modulus, density, area, second moment of area, outer fibres
    /// right (below 0) and left of the axis [Pa, Pa, kg/m³, m²/m, m⁴/m, m, m]. absent: a plate.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-when" = ".nodes"))]
    pub bars: Option<Vec<[f64; 7]>>,
    /// Number of beam elements. Light, soft panels may break down where elements are much shorter than 1.5 spacings.
    #[schemars(range(min = 2, max = 2000), extend("x-default" = "24, none shorter than 2 spacings, at least 8"))]
    pub elements: usize,
    /// Thickness of the plate; along an outline its outside is wet [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thickness: f64,
    /// Young's modulus; the plate bends with E/(1 - nu²), in plane stress with E [Pa].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required without material"))]
    pub youngs_modulus: f64,
    /// Poisson's ratio [-].
    #[serde(default = "usual_poissons_ratio")]
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 0.5))]
    pub poissons_ratio: f64,
    /// Plane strain, of a wide plate between walls or in cylindrical bending; plane stress, of a bar that is free to contract.
    #[serde(default)]
    pub plane: Plane,
    /// Density of the plate [kg/m³].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required without material"))]
    pub density: f64,
    /// Supports of both ends on the rest of the body, each its own: clamped, pinned, free; sliding (pinned) and guided (clamped)
    /// are free along the panel, without membrane force; mirror is joined to its image, at x = 0 with symmetry = x.
    #[serde(default)]
    pub ends: [PanelEnd; 2],
    /// Springs between its ends and the rest of the body, along the panel, across it, in rotation [N/m², N/m², N/rad]. All at a free
    /// end, the last at a pinned or sliding one, the first two at a mirror. absent: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_springs: Option<[[f64; 3]; 2]>,
    /// Dampers there [N s/m², N s/m², N s/rad]. absent: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_dampers: Option<[[f64; 3]; 2]>,
    /// Beam theory.
    #[serde(default)]
    pub theory: TheoryName,
    /// Shares of its length at which motion, moment and strains are reported [-].
    #[serde(default = "usual_watch")]
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub watch: Vec<f64>,
    /// Yield stress of the tension test: the plate yields by force and moment together (von Mises) [Pa]. absent: elastic.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub yield_stress: Option<f64>,
    /// Stress over plastic strain beyond the yield stress, in the tension test [Pa].
    #[serde(default)]
    #[schemars(range(min = 0.0), extend("x-when" = ".yield_stress"))]
    pub hardening_modulus: f64,
    /// Strain of an outer fibre at a held end at which that end breaks off, and the run ends [-]. absent: never.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rupture_strain: Option<f64>,
    /// Allowable stress; the reserve factor is this over the largest stress [Pa].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "yield_stress"))]
    pub allowable_stress: Option<f64>,
}

/// Planes of a model.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StructurePlane {
    /// x and y.
    #[default]
    Xy,
    /// x and z.
    Xz,
    /// y and z.
    Yz,
}

/// Units of a model.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StructureUnits {
    /// Metre, kilogram, second: N, Pa.
    #[default]
    MKgS,
    /// Millimetre, tonne, second: N, MPa.
    MmTS,
}

/// Beam theories.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TheoryName {
    /// Sections stay normal to the axis.
    #[default]
    EulerBernoulli,
    /// Sections shear.
    Timoshenko,
}

fn usual_poissons_ratio() -> f64 {
    0.3
}

fn usual_watch() -> Vec<f64> {
    vec![0.5]
}
impl Panel {
    /// As the coupled system takes it.
    pub fn spec(&self) -> PanelSpec {
        PanelSpec {
            name: self.name.clone(),
            span: [self.from, self.to],
            elements: self.elements,
            mesh: self.mesh(),
            thickness: self.thickness,
            plane: self.plane,
            material: self.material(),
            theory: match self.theory {
                TheoryName::EulerBernoulli => Theory::EulerBernoulli,
                TheoryName::Timoshenko => Theory::TIMOSHENKO,
            },
            ends: self.ends,
            end_springs: self.end_springs(),
            watch: self.watch.clone(),
            plasticity: self.plasticity(),
            rupture_strain: self.rupture_strain,
            allowable_stress: self.allowable_stress,
        }
    }

    /// Its own nodes and bars.
    fn mesh(&self) -> Option<PanelMesh> {
        let (nodes, bars) = self.nodes.as_ref().zip(self.bars.as_ref())?;
        let bar = |&[youngs_modulus, shear_modulus, density, area, second_moment, right, left]: &[f64; 7]| PanelBar {
            youngs_modulus,
            density,
            section: BarSection { area, second_moment, shear_modulus, fibres: [right, left] },
        };
        Some(PanelMesh { nodes: nodes.clone(), bars: bars.iter().map(bar).collect() })
    }

    /// What connects its ends to the rest of the body besides their supports.
    pub fn end_springs(&self) -> [EndSpring; 2] {
        let (stiffness, damping) = (self.end_springs.unwrap_or_default(), self.end_dampers.unwrap_or_default());
        [0, 1].map(|end| EndSpring { stiffness: stiffness[end], damping: damping[end] })
    }

    fn plasticity(&self) -> Option<Plasticity> {
        Some(Plasticity { yield_stress: self.yield_stress?, hardening_modulus: self.hardening_modulus })
    }

    /// What it is made of.
    pub fn material(&self) -> Material {
        Material { youngs_modulus: self.youngs_modulus, poissons_ratio: self.poissons_ratio, density: self.density }
    }

    /// Names of its columns in the series.
    pub fn columns(&self) -> Vec<String> {
        let of = |share: &f64| WATCHED.map(|unit| format!("{}.at{}.{unit}", self.name, percent(*share)));
        self.watch.iter().flat_map(of).chain([format!("{}.stress_Pa", self.name)]).collect()
    }
}

/// Columns of a place that is watched.
const WATCHED: [&str; 6] = ["dx_m", "dy_m", "deflection_m", "moment_N", "strain_left", "strain_right"];

/// A share as a whole or broken per cent: 50, 12.5.
fn percent(share: f64) -> f64 {
    (1e6 * share).round() / 1e4
}
