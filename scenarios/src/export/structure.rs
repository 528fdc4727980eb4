//! A panel as a Nastran beam model, and what places its loads: its nodes and tributary lengths.

use fsi_coupling::PanelEnd;
use scene::nastran::model::{Bar, BeamModel, Constraint, Grid, Isotropic, Orientation, Property};
use scene::{Panel, Scene, line};
use structure_fe::{Element, Theory};

/// Numbers of the cards of a panel begin with its place among the panels times this.
pub(super) const NUMBERS: i64 = 100_000;

/// A panel's mesh at rest.
pub(super) struct PanelModel<'a> {
    /// The panel.
    pub panel: &'a Panel,
    /// Number before that of its first card.
    pub base: i64,
    /// Nodes [m, body's frame].
    pub nodes: Vec<[f64; 2]>,
    /// Elements between them.
    pub elements: Vec<Element>,
    /// Name of scene and body.
    of: String,
}

impl PanelModel<'_> {
    /// The panels of a scene.
    pub fn of(scene: &Scene) -> Vec<PanelModel<'_>> {
        let Some(body) = &scene.body else { return Vec::new() };
        let line = line(&body.shape);
        let model = |(k, panel)| {
            let spec = Panel::spec(panel);
            let (nodes, elements) = spec.elements_along(&line);
            let of = format!("panel {} of body {}, scene {}", panel.name, body.name, scene.name);
            PanelModel { panel, base: NUMBERS * k as i64, nodes, elements, of }
        };
        body.panels.iter().enumerate().map(|(k, panel)| model((k, panel))).collect()
    }

    fn length(&self, k: usize) -> f64 {
        let [a, b] = [self.nodes[k], self.nodes[k + 1]];
        (b[0] - a[0]).hypot(b[1] - a[1])
    }

    /// Unit normal of a bar to its left [-]: on an outline into the body.
    pub fn left(&self, k: usize) -> [f64; 2] {
        let ([a, b], length) = ([self.nodes[k], self.nodes[k + 1]], self.length(k));
        [(a[1] - b[1]) / length, (b[0] - a[0]) / length]
    }

    /// Bars beside a node.
    fn beside(&self, node: usize) -> std::ops::Range<usize> {
        node.saturating_sub(1)..(node + 1).min(self.elements.len())
    }

    /// Half the length of the bars beside a node [m].
    pub fn tributary(&self, node: usize) -> f64 {
        self.beside(node).map(|k| 0.5 * self.length(k)).sum()
    }

    /// Distance of a node from the first one along the bars [m].
    pub fn along(&self, node: usize) -> f64 {
        (0..node).fold(0.0, |sum, k| sum + self.length(k))
    }

    /// Force to the left per length at a node [Pa], under the force on it [N/m]: the pressure of the water, of both sides where both are
    /// wet.
    pub fn pressure(&self, node: usize, [fx, fy]: [f64; 2]) -> f64 {
        let sum = self.beside(node).fold([0.0; 2], |sum, k| {
            let ([x, y], length) = (self.left(k), self.length(k));
            [sum[0] + length * x, sum[1] + length * y]
        });
        let size = sum[0].hypot(sum[1]);
        (fx * sum[0] + fy * sum[1]) / size / self.tributary(node)
    }

    /// Number of a node's card.
    pub fn grid(&self, node: usize) -> i64 {
        self.base + node as i64 + 1
    }

    /// Comments at the beginning of a file.
    pub fn heading(&self, what: &str) -> Vec<String> {
        vec![
            format!("splashdown {}: {what} of {}", env!("CARGO_PKG_VERSION"), self.of),
            "Units m, kg, s, N, Pa; x and y of the body's frame; a bar is a metre of span.".into(),
        ]
    }

    /// Its cards.
    pub fn beam_model(&self) -> BeamModel {
        let panel = self.panel;
        let mut heading = self.heading("structure");
        let [from, to] = [panel.from, panel.to];
        heading.extend([
            format!("On the line of the body from = [{}, {}] to = [{}, {}].", from[0], from[1], to[0], to[1]),
            "E is that of bending: of a plate in plane strain E/(1 - nu^2). I2 = I1; 3, 4 and 5 are held.".into(),
            "The supports stand for the rest of the body, which moves.".into(),
        ]);
        if panel.end_springs.is_some() || panel.end_dampers.is_some() {
            heading.push("Springs and dampers of its ends are not written.".into());
        }
        let grid =
            |(k, [x, y]): (usize, &[f64; 2])| Grid { id: self.grid(k), at: [*x, *y, 0.0], held: "345".into(), line: 0 };
        let mut model = BeamModel {
            heading,
            grids: self.nodes.iter().enumerate().map(grid).collect(),
            constraints: self.constraints(),
            ..BeamModel::default()
        };
        for k in 0..self.elements.len() {
            let property = self.property(k, &mut model);
            // a direction: its last digits would follow those of the nodes
            let [x, y] = self.left(k).map(|part| (1e6 * part).round() / 1e6 + 0.0);
            let released = |end: usize, last: bool| {
                let slides = matches!(panel.ends[end], PanelEnd::Sliding | PanelEnd::Guided);
                String::from(if last && slides { "1" } else { "" })
            };
            model.bars.push(Bar {
                id: self.base + k as i64 + 1,
                property,
                grids: [self.grid(k), self.grid(k + 1)],
                orientation: Orientation::Vector([x, y, 0.0]),
                released: [released(0, k == 0), released(1, k + 1 == self.elements.len())],
                line: 0,
            });
        }
        model
    }

    /// Number of the section of a bar, with its material; new ones are added to the model.
    fn property(&self, k: usize, model: &mut BeamModel) -> i64 {
        let Element { material, section, .. } = self.elements[k];
        let (area, second_moment) = (section.area(), section.second_moment());
        let [right, left] = section.fibres();
        let of_rectangle = match self.panel.spec().theory {
            Theory::EulerBernoulli => 0.0,
            Theory::Timoshenko { shear_correction } => shear_correction,
        };
        let isotropic = Isotropic {
            id: self.base + model.materials.len() as i64 + 1,
            youngs_modulus: section.bending_stiffness(&material) / second_moment,
            shear_modulus: section.shear_stiffness(&material, 1.0) / area,
            density: material.density,
            allowable_stress: self.panel.allowable_stress,
            line: 0,
        };
        let same = model.materials.iter().find(|known| Isotropic { id: known.id, ..isotropic.clone() } == **known);
        let material = same.map_or(isotropic.id, |known| known.id);
        if material == isotropic.id {
            model.materials.push(isotropic);
        }
        let property = Property {
            id: self.base + model.properties.len() as i64 + 1,
            material,
            area,
            second_moments: [second_moment; 2],
            extra_mass: 0.0,
            stress_points: [[left, 0.0], [right, 0.0], [0.0; 2], [0.0; 2]],
            shear_factors: [of_rectangle; 2],
            line: 0,
        };
        let same = model.properties.iter().find(|known| Property { id: known.id, ..property.clone() } == **known);
        let id = same.map_or(property.id, |known| known.id);
        if id == property.id {
            model.properties.push(property);
        }
        id
    }

    /// Supports of its ends.
    fn constraints(&self) -> Vec<Constraint> {
        let ends = self.panel.ends.iter().zip([self.grid(0), self.grid(self.nodes.len() - 1)]);
        let held = ends.filter_map(|(end, grid)| {
            let components = match end {
                PanelEnd::Clamped | PanelEnd::Guided => "126",
                PanelEnd::Pinned | PanelEnd::Sliding => "12",
                PanelEnd::Mirror => "16",
                PanelEnd::Free => return None,
            };
            Some(Constraint { set: 1, components: components.into(), grids: vec![grid], line: 0 })
        });
        held.collect()
    }
}
