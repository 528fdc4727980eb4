//! The model: nodes, elements and what they are made of.

use crate::element::{ElementConstants, Ends, Properties};
use crate::error::{Error, existing_node, finite, positive};
use crate::material::Material;
use crate::plastic::Plasticity;
use crate::section::Section;
use crate::theory::Theory;

/// Elements shorter than this fraction of the model's extent count as having no length.
const SHORTEST_ELEMENT: f64 = 1e-12;

/// One element, as given: the two nodes it joins rigidly and what it is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Element {
    /// Indices of the first and the second node.
    pub nodes: [usize; 2],
    /// Its material.
    pub material: Material,
    /// Its cross-section.
    pub section: Section,
}

/// A plane frame of straight beam elements, rigidly joined at the nodes.
///
/// Nodes lie in a plane with axes x, y. A node has three degrees of freedom, `[u, w, theta]`:
/// displacement along x \[m\], along y \[m\], and rotation from x towards y \[rad\]. The forces
/// conjugate to them are `[F_x, F_y, M]` \[N, N, N m\]; all of them per metre of span if the
/// sections are [strips](Section::strip). Fields over the nodes are slices of shape `[nodes][3]`.
#[derive(Debug, Clone)]
pub struct Beam {
    nodes: Vec<[f64; 2]>,
    elements: Vec<Element>,
    extent: f64,
    theory: Vec<Theory>,
    rotatory_inertia: bool,
    plasticity: Vec<Option<Plasticity>>,
    /// Mass and moment of inertia of the points at the nodes, `[nodes][m, m, J]` \[kg, kg, kg m^2\].
    points: Vec<[f64; 3]>,
    /// Nodes that are rigid bodies.
    bodies: Vec<usize>,
    /// Elements that slide along themselves.
    sliding: Vec<usize>,
    formulation: Vec<ElementConstants>,
}

impl Beam {
    /// A model of node coordinates `[x, y]` \[m\] and elements.
    pub fn new(nodes: Vec<[f64; 2]>, elements: Vec<Element>) -> Result<Self, Error> {
        if elements.is_empty() {
            return Err(Error::NoElements { nodes: nodes.len() });
        }
        for (index, node) in nodes.iter().enumerate() {
            finite("coordinate [m] of node", index, node)?;
        }
        let extent = extent(&nodes);
        let formulation = elements
            .iter()
            .enumerate()
            .map(|(index, element)| formulate(&nodes, extent, index, element, Theory::default(), false))
            .collect::<Result<_, _>>()?;
        let mut attached = vec![false; nodes.len()];
        for node in elements.iter().flat_map(|element| element.nodes) {
            attached[node] = true;
        }
        if let Some(node) = attached.iter().position(|attached| !attached) {
            return Err(Error::UnattachedNode { node });
        }
        let theory = vec![Theory::default(); elements.len()];
        let points = vec![[0.0; 3]; nodes.len()];
        let plasticity = vec![None; elements.len()];
        Ok(Self {
            nodes,
            elements,
            extent,
            theory,
            rotatory_inertia: false,
            plasticity,
            points,
            bodies: Vec::new(),
            sliding: Vec::new(),
            formulation,
        })
    }

    /// A model with one material and one section throughout.
    pub fn uniform(
        nodes: Vec<[f64; 2]>,
        connectivity: &[[usize; 2]],
        material: Material,
        section: Section,
    ) -> Result<Self, Error> {
        let elements = connectivity.iter().map(|&nodes| Element { nodes, material, section }).collect();
        Self::new(nodes, elements)
    }

    /// A straight beam of equal elements; node 0 is at `from`, node `elements` at `to` \[m\].
    pub fn straight(
        from: [f64; 2],
        to: [f64; 2],
        elements: usize,
        material: Material,
        section: Section,
    ) -> Result<Self, Error> {
        let nodes = (0..=elements)
            .map(|node| {
                let t = node as f64 / elements as f64;
                [0, 1].map(|axis| (1.0 - t) * from[axis] + t * to[axis])
            })
            .collect();
        let connectivity: Vec<_> = (0..elements).map(|element| [element, element + 1]).collect();
        Self::uniform(nodes, &connectivity, material, section)
    }

    /// Node coordinates `[x, y]` \[m\].
    pub fn nodes(&self) -> &[[f64; 2]] {
        &self.nodes
    }

    /// The elements, as given.
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// Length of an element \[m\].
    pub fn length(&self, element: usize) -> f64 {
        self.formulation[element].length
    }

    /// Unit vector from an element's first node to its second \[-\]. Its left-hand normal is `[-t_y, t_x]`.
    pub fn tangent(&self, element: usize) -> [f64; 2] {
        self.formulation[element].tangent
    }

    /// Mass of the whole model \[kg\].
    pub fn mass(&self) -> f64 {
        let elements: f64 = self.formulation.iter().map(|element| element.mass_per_length * element.length).sum();
        elements + self.points.iter().map(|[mass, ..]| mass).sum::<f64>()
    }

    /// Elastic forces K u at the nodes, `[nodes][F_x, F_y, M]`, of a displacement `[nodes][u, w, theta]`.
    ///
    /// # Panics
    /// If `displacement` has not one entry per node.
    pub fn elastic_forces(&self, displacement: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut forces = vec![[0.0; 3]; self.nodes.len()];
        for (nodes, element) in self.formulated() {
            let ends = element.elastic_forces(&self.ends(nodes, displacement));
            add_ends(&mut forces, nodes, &ends);
        }
        forces
    }

    /// Elastic energy u^T K u/2 \[J\] of a displacement `[nodes][u, w, theta]`.
    ///
    /// # Panics
    /// If `displacement` has not one entry per node.
    pub fn strain_energy(&self, displacement: &[[f64; 3]]) -> f64 {
        self.formulated().map(|(nodes, element)| element.strain_energy(&self.ends(nodes, displacement))).sum()
    }

    /// Kinetic energy v^T M v/2 \[J\] of a velocity `[nodes][du/dt, dw/dt, dtheta/dt]` \[m/s, m/s, rad/s\].
    ///
    /// # Panics
    /// If `velocity` has not one entry per node.
    pub fn kinetic_energy(&self, velocity: &[[f64; 3]]) -> f64 {
        let elements: f64 =
            self.formulated().map(|(nodes, element)| element.kinetic_energy(&self.ends(nodes, velocity))).sum();
        elements + self.kinetic_energy_of_points(velocity)
    }

    /// Kinetic energy of the point masses \[J\].
    pub(crate) fn kinetic_energy_of_points(&self, velocity: &[[f64; 3]]) -> f64 {
        let points = self.points.as_flattened().iter().zip(velocity.as_flattened());
        points.map(|(mass, v)| 0.5 * mass * v.powi(2)).sum()
    }

    /// Mass and moment of inertia of the points at the nodes, `[nodes][m, m, J]` \[kg, kg, kg m^2\].
    pub(crate) fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// Diagonal of the bounding box of the nodes \[m\].
    pub(crate) fn extent(&self) -> f64 {
        self.extent
    }

    /// The elements' formulations with the nodes they join.
    pub(crate) fn formulated(&self) -> impl Iterator<Item = ([usize; 2], &ElementConstants)> {
        let nodes = self.elements.iter().map(|element| element.nodes);
        nodes.zip(&self.formulation)
    }

    /// The values of a field at the two ends of an element.
    pub(crate) fn ends(&self, [first, second]: [usize; 2], field: &[[f64; 3]]) -> Ends {
        assert_eq!(field.len(), self.nodes.len(), "one entry per node");
        let ([u1, w1, theta1], [u2, w2, theta2]) = (field[first], field[second]);
        [u1, w1, theta1, u2, w2, theta2]
    }
}

#[path = "beam_additions.rs"]
mod additions;

/// Adds forces at the two ends of an element to a field over the nodes.
pub(crate) fn add_ends(field: &mut [[f64; 3]], nodes: [usize; 2], ends: &Ends) {
    for (node, end) in nodes.into_iter().zip(ends.chunks_exact(3)) {
        for dof in 0..3 {
            field[node][dof] += end[dof];
        }
    }
}

/// Ok if `element` is one of `elements` elements.
fn existing_element(item: &'static str, index: usize, element: usize, elements: usize) -> Result<(), Error> {
    if element < elements { Ok(()) } else { Err(Error::NoSuchElement { item, index, element, elements }) }
}

/// Diagonal of the bounding box of the nodes \[m\].
fn extent(nodes: &[[f64; 2]]) -> f64 {
    let side = |axis: usize| {
        let along = nodes.iter().map(|node| node[axis]);
        along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
    };
    side(0).hypot(side(1))
}

fn formulate(
    nodes: &[[f64; 2]],
    extent: f64,
    index: usize,
    element: &Element,
    theory: Theory,
    rotatory_inertia: bool,
) -> Result<ElementConstants, Error> {
    for node in element.nodes {
        existing_node("element", index, node, nodes.len())?;
    }
    let (material, section) = (&element.material, &element.section);
    material.check(index)?;
    section.check(index)?;
    let [first, second] = element.nodes.map(|node| nodes[node]);
    let (dx, dy) = (second[0] - first[0], second[1] - first[1]);
    let length = dx.hypot(dy);
    if length <= SHORTEST_ELEMENT * extent {
        return Err(Error::ZeroLengthElement { element: index, nodes: element.nodes, length, extent });
    }
    let shear_stiffness = match theory {
        Theory::EulerBernoulli => f64::INFINITY,
        Theory::Timoshenko { shear_correction } => {
            positive("shear correction [-]", "element", index, shear_correction)?;
            section.shear_stiffness(material, shear_correction)
        }
    };
    let properties = Properties {
        axial_stiffness: section.axial_stiffness(material),
        bending_stiffness: section.bending_stiffness(material),
        shear_stiffness,
        mass_per_length: section.mass_per_length(material),
        radius_squared: if rotatory_inertia { section.second_moment() / section.area() } else { 0.0 },
    };
    Ok(ElementConstants::new(&properties, [dx, dy]))
}
