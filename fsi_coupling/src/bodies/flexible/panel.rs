//! Panels: the parts of a body's surface that bend.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use structure_fe::{
    BarSection, Beam, Connector, Dof, Element, Fibres, Material, Plasticity, Rupture, Section, Supports, Theory,
};

use crate::geometry::polyline::Polyline;

/// How an end of a panel is held by the body's rigid frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PanelEnd {
    /// Moves and turns with it.
    #[default]
    Clamped,
    /// Moves with it, and turns freely.
    Pinned,
    /// Moves with it across the panel, slides along it, and turns freely: no membrane force.
    Sliding,
    /// Moves with it across the panel, slides along it, and turns with it: clamped without membrane force.
    Guided,
    /// Not held.
    Free,
    /// On the plane of symmetry x = 0: moves along it and does not turn. Not held by the frame.
    Mirror,
}

/// What the third direction does to a panel (THEORY BE2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Plane {
    /// A wide plate, which cannot contract along the span: E/(1 − ν²).
    #[default]
    Strain,
    /// A narrow bar, which is free to contract: E.
    Stress,
}

/// A spring and a damper between an end of a panel and the frame: along the panel there, across it, and in rotation (THEORY BE27).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EndSpring {
    /// Stiffness, of a metre of width [N/m², N/m², N/rad]; 0 is no spring.
    pub stiffness: [f64; 3],
    /// Damping, of a metre of width [N s/m², N s/m², N s/rad]; 0 is no damper.
    pub damping: [f64; 3],
}

impl EndSpring {
    /// Whether it is there.
    pub fn acts(&self) -> bool {
        self.stiffness.iter().chain(&self.damping).any(|value| *value > 0.0)
    }
}

/// A panel: a strip of plate along a part of a body's outline, or of a thin wall's middle line.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelSpec {
    /// Name, as in output columns.
    pub name: String,
    /// Where it starts and ends on the line [m, body's frame]; along a closed outline counter-clockwise.
    pub span: [[f64; 2]; 2],
    /// Number of elements.
    pub elements: usize,
    /// Its own mesh, with as many bars as elements; `None` is a plate of equal elements.
    pub mesh: Option<PanelMesh>,
    /// Thickness [m]. Along an outline the water is on its outside, and the middle line half of it further in.
    pub thickness: f64,
    /// Plane strain or plane stress.
    pub plane: Plane,
    /// What it is made of.
    pub material: Material,
    /// Beam theory.
    pub theory: Theory,
    /// Yield by force and moment; Euler–Bernoulli theory only.
    pub plasticity: Option<Plasticity>,
    /// Strain of an outer fibre at which an end breaks off [-], if it may.
    pub rupture_strain: Option<f64>,
    /// Allowable stress, for the reserve factor [Pa].
    pub allowable_stress: Option<f64>,
    /// How its ends are held.
    pub ends: [PanelEnd; 2],
    /// Springs and dampers between its ends and the frame.
    pub end_springs: [EndSpring; 2],
    /// Places whose motion is reported, as shares of its length [-].
    pub watch: Vec<f64>,
}

/// A place nearer to a node than this share of the length of the element next to it is at the node [-]: elements of a curved panel meet at an angle, so
/// that it matters on which of them a place is.
const AT_NODE: f64 = 0.02;

/// Nodes and bars of a panel that is not a plate of equal elements, from its start to its end.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelMesh {
    /// Nodes [m, body's frame], on the bars' axis.
    pub nodes: Vec<[f64; 2]>,
    /// The bars between them.
    pub bars: Vec<PanelBar>,
}

/// A bar of a panel's mesh; its section has the properties of a metre of span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelBar {
    /// Young's modulus [Pa].
    pub youngs_modulus: f64,
    /// Mass over length and area, what is not structure included [kg/m³].
    pub density: f64,
    /// Cross-section, of a metre of span.
    pub section: BarSection,
}

impl PanelMesh {
    /// Shares at its nodes of a part of a line [-], that of the nearest place.
    fn shares(&self, line: &Polyline, [from, to]: [f64; 2]) -> Vec<f64> {
        let length = line.part(from, to).length();
        let mut before = 0.0;
        let share = |(k, node): (usize, &[f64; 2])| {
            let s = line.nearest(*node).0 - from;
            let s = if line.is_closed() && s < 0.0 { s + line.length() } else { s };
            before = match k {
                0 => 0.0,
                k if k == self.bars.len() => 1.0,
                _ => (s / length).clamp(before, 1.0),
            };
            before
        };
        self.nodes.iter().enumerate().map(share).collect()
    }

    fn element(&self, k: usize) -> (Material, Section) {
        let PanelBar { youngs_modulus, density, section } = self.bars[k];
        (Material { youngs_modulus, poissons_ratio: 0.0, density }, Section::bar(section))
    }
}

impl PanelSpec {
    /// Its cross-section, one metre wide.
    pub fn section(&self) -> Section {
        self.plane.section(self.thickness)
    }

    /// Its nodes [m, body's frame] and elements along a body's line.
    pub fn elements_along(&self, line: &Polyline) -> (Vec<[f64; 2]>, Vec<Element>) {
        let (mut nodes, mut elements) = (Vec::new(), Vec::new());
        Panel::along(line, self, &mut nodes, &mut elements);
        (nodes, elements)
    }
}

impl Plane {
    /// Modulus of bending and membrane [Pa].
    pub fn modulus(self, material: &Material) -> f64 {
        match self {
            Plane::Strain => material.youngs_modulus / (1.0 - material.poissons_ratio.powi(2)),
            Plane::Stress => material.youngs_modulus,
        }
    }

    /// Cross-section of a plate of a thickness [m], one metre wide.
    pub fn section(self, thickness: f64) -> Section {
        match self {
            Plane::Strain => Section::strip(thickness),
            Plane::Stress => Section::rectangular(thickness, 1.0),
        }
    }
}

/// A panel with its elements in the model of the body.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    pub spec: PanelSpec,
    /// Running lengths of its ends along the body's line [m].
    pub reach: [f64; 2],
    /// Its elements.
    pub elements: std::ops::Range<usize>,
    /// Its nodes.
    pub nodes: std::ops::Range<usize>,
    /// Shares of its length at its nodes [-]; none with equal elements.
    shares: Vec<f64>,
}

impl Panel {
    /// The panel along a line; its nodes [m, body's frame] and elements are added to the model's.
    pub fn along(line: &Polyline, spec: &PanelSpec, nodes: &mut Vec<[f64; 2]>, elements: &mut Vec<Element>) -> Panel {
        let reach = spec.span.map(|end| line.nearest(end).0);
        let part = line.part(reach[0], reach[1]);
        let inwards = if line.is_closed() { 0.5 * spec.thickness } else { 0.0 };
        let (first, first_element) = (nodes.len(), elements.len());
        match &spec.mesh {
            Some(mesh) => nodes.extend(&mesh.nodes),
            None => nodes.extend((0..=spec.elements).map(|k| {
                let s = part.length() * k as f64 / spec.elements as f64;
                let (at, left) = (part.at(s), part.left(s));
                [0, 1].map(|i| at[i] + inwards * left[i])
            })),
        }
        for k in 0..spec.elements {
            let plate = || (spec.material, spec.section());
            let (material, section) = spec.mesh.as_ref().map_or_else(plate, |mesh| mesh.element(k));
            elements.push(Element { nodes: [first + k, first + k + 1], material, section });
        }
        let shares = spec.mesh.as_ref().map_or(Vec::new(), |mesh| mesh.shares(line, reach));
        let (elements, nodes) = (first_element..elements.len(), first..nodes.len());
        Panel { spec: spec.clone(), reach, elements, nodes, shares }
    }

    /// Tie its ends to the frame's node in a model.
    pub fn hold(&self, frame: usize, beam: &Beam, supports: &mut Supports) {
        let (first, last) = (self.nodes.start, self.nodes.end - 1);
        for (spring, [from, to, node]) in
            self.spec.end_springs.iter().zip([[first, first + 1, first], [last - 1, last, last]])
        {
            let [x, y] = [0, 1].map(|k| beam.nodes()[to][k] - beam.nodes()[from][k]);
            let EndSpring { stiffness, damping } = *spring;
            if spring.acts() {
                supports.connect(frame, node, Connector { angle: y.atan2(x), stiffness, damping });
            }
        }
        for (end, node) in self.spec.ends.iter().zip([first, last]) {
            match end {
                PanelEnd::Clamped | PanelEnd::Guided => supports.link(frame, node),
                PanelEnd::Pinned | PanelEnd::Sliding => supports.link_pinned(frame, node),
                PanelEnd::Free => supports,
                PanelEnd::Mirror => supports.fix(node, Dof::U).fix(node, Dof::Theta),
            };
            let held = !matches!(end, PanelEnd::Free | PanelEnd::Mirror);
            if let Some(strain) = self.spec.rupture_strain.filter(|_| held) {
                supports.breakable(node, Rupture::FibreStrain(strain));
            }
        }
    }

    /// Theory of its elements, and ends that slide.
    pub fn formulate(&self, mut beam: Beam) -> Result<Beam, structure_fe::Error> {
        for element in self.elements.clone() {
            beam = beam.with_theory_of(element, self.spec.theory)?;
            if let Some(plasticity) = self.spec.plasticity {
                beam = beam.with_plasticity_of(element, plasticity)?;
            }
        }
        for (end, element) in self.spec.ends.iter().zip([self.elements.start, self.elements.end - 1]) {
            if matches!(end, PanelEnd::Sliding | PanelEnd::Guided) {
                beam = beam.with_axial_release(element)?;
            }
        }
        Ok(beam)
    }

    /// The element and the share of it [-] at a share of the panel's length.
    pub fn element_at(&self, share: f64) -> (usize, f64) {
        if !self.shares.is_empty() {
            let near = |k: usize| AT_NODE * (self.shares[k] - self.shares[k - 1]);
            let reached = |k: &usize| self.shares[*k] - near(*k) <= share;
            let k = (1..self.elements.len()).take_while(reached).count();
            let [from, to] = [self.shares[k], self.shares[k + 1]];
            let t = if to > from { ((share - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
            return (self.elements.start + k, t);
        }
        let along = share.clamp(0.0, 1.0) * self.spec.elements as f64;
        let element = (along.floor() as usize).min(self.spec.elements - 1);
        (self.elements.start + element, along - element as f64)
    }

    /// Largest stress of an outer fibre at the ends of its elements, by magnitude [Pa]; `fibres` are the whole model's.
    pub fn stress(&self, fibres: &[Fibres]) -> f64 {
        let ends = &fibres[2 * self.elements.start..2 * self.elements.end];
        // of each end the left fibre first: of two as large the first counts
        let each = ends.iter().flat_map(|Fibres { stress: [right, left], .. }| [*left, *right]);
        each.fold(0.0, |most, stress| if stress.abs() > f64::abs(most) { stress } else { most })
    }
}
