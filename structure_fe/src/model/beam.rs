//! The model: nodes, elements and their materials.

use crate::element::{ElementConstants, Ends, Theory};
use crate::error::{Error, existing_node, finite, positive};
use crate::field::{Field, sum};
use crate::material::{Material, PlasticBending, Plasticity, Section};

/// Elements shorter than this fraction of the model's extent count as having no length.
const SHORTEST_ELEMENT: f64 = 1e-12;

/// Remaining fraction of the axial stiffness of an element with an axial release \[-\].
const RELEASED: f64 = 1e-7;

/// One element, as given: the two nodes it joins rigidly, its material and its section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Element {
    /// Indices of the first and the second node.
    pub nodes: [usize; 2],
    /// Its material.
    pub material: Material,
    /// Its cross-section.
    pub section: Section,
}

/// Options of one element.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ElementOptions {
    pub theory: Theory,
    pub plasticity: Option<Plasticity>,
    pub axial_release: bool,
}

/// A plane frame of straight beam elements, rigidly joined at the nodes.
///
/// Nodes lie in a plane with axes x, y. A node has three degrees of freedom, `[u, w, theta]`:
/// displacement along x \[m\], along y \[m\], and rotation from x towards y \[rad\]. The forces
/// conjugate to them are `[F_x, F_y, M]` \[N, N, N m\]; all of them per metre of span if the
/// sections are [strips](Section::strip). Fields over the nodes are slices of shape `[nodes][3]`.
#[derive(Debug, Clone)]
pub struct Beam {
    pub(super) nodes: Vec<[f64; 2]>,
    elements: Vec<Element>,
    extent: f64,
    pub(super) options: Vec<ElementOptions>,
    pub(super) rotatory_inertia: bool,
    /// Mass and moment of inertia of the points at the nodes, `[nodes][m, m, J]` \[kg, kg, kg m^2\].
    pub(super) points: Field,
    /// Nodes that are rigid bodies.
    pub(super) bodies: Vec<usize>,
    constants: Vec<ElementConstants>,
}

impl Beam {
    /// A model of node coordinates `[x, y]` \[m\] and elements.
    pub fn new(nodes: Vec<[f64; 2]>, elements: Vec<Element>) -> Result<Self, Error> {
        if elements.is_empty() {
            return Err(Error::NoElements { nodes: nodes.len() });
        }
        for (index, node) in nodes.iter().enumerate() {
            finite("coordinate [m]", "node", index, node)?;
        }
        let mut attached = vec![false; nodes.len()];
        for (index, element) in elements.iter().enumerate() {
            for node in element.nodes {
                existing_node("element", index, node, nodes.len())?;
                attached[node] = true;
            }
        }
        let beam = Self {
            extent: extent(&nodes),
            options: vec![ElementOptions::default(); elements.len()],
            points: vec![[0.0; 3]; nodes.len()],
            nodes,
            elements,
            rotatory_inertia: false,
            bodies: Vec::new(),
            constants: Vec::new(),
        };
        let beam = beam.formulate()?;
        match attached.iter().position(|attached| !attached) {
            Some(node) => Err(Error::UnattachedNode { node }),
            None => Ok(beam),
        }
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
        self.constants[element].length
    }

    /// Unit vector from an element's first node to its second \[-\]. Its left-hand normal is `[-t_y, t_x]`.
    pub fn tangent(&self, element: usize) -> [f64; 2] {
        self.constants[element].tangent
    }

    /// Mass of the whole model \[kg\].
    pub fn mass(&self) -> f64 {
        let elements: f64 = self.constants.iter().map(|element| element.mass_per_length * element.length).sum();
        elements + self.points.iter().map(|[mass, ..]| mass).sum::<f64>()
    }

    /// Elastic forces K u at the nodes, `[nodes][F_x, F_y, M]`, of a displacement `[nodes][u, w, theta]`.
    ///
    /// # Panics
    /// If `displacement` has not one entry per node.
    pub fn elastic_forces(&self, displacement: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut forces = vec![[0.0; 3]; self.nodes.len()];
        for (nodes, element) in self.constants() {
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
        self.constants().map(|(nodes, element)| element.strain_energy(&self.ends(nodes, displacement))).sum()
    }

    /// Kinetic energy v^T M v/2 \[J\] of a velocity `[nodes][du/dt, dw/dt, dtheta/dt]` \[m/s, m/s, rad/s\].
    ///
    /// # Panics
    /// If `velocity` has not one entry per node.
    pub fn kinetic_energy(&self, velocity: &[[f64; 3]]) -> f64 {
        let elements: f64 =
            self.constants().map(|(nodes, element)| element.kinetic_energy(&self.ends(nodes, velocity))).sum();
        elements + self.kinetic_energy_of_points(velocity)
    }

    /// Kinetic energy of the point masses \[J\].
    pub(crate) fn kinetic_energy_of_points(&self, velocity: &[[f64; 3]]) -> f64 {
        sum(&self.points, velocity, |mass, v| 0.5 * mass * v.powi(2))
    }

    /// Mass and moment of inertia of the points at the nodes, `[nodes][m, m, J]` \[kg, kg, kg m^2\].
    pub(crate) fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// Diagonal of the bounding box of the nodes \[m\].
    pub(crate) fn extent(&self) -> f64 {
        self.extent
    }

    /// The constants of the elements with the nodes they join.
    pub(crate) fn constants(&self) -> impl Iterator<Item = ([usize; 2], &ElementConstants)> {
        self.elements.iter().map(|element| element.nodes).zip(&self.constants)
    }

    /// The values of a field at the two ends of an element.
    pub(crate) fn ends(&self, [first, second]: [usize; 2], field: &[[f64; 3]]) -> Ends {
        assert_eq!(field.len(), self.nodes.len(), "one entry per node");
        let ([u1, w1, theta1], [u2, w2, theta2]) = (field[first], field[second]);
        Ends::new(u1, w1, theta1, u2, w2, theta2)
    }

    /// Computes the constants of all elements from their options.
    pub(super) fn formulate(mut self) -> Result<Self, Error> {
        self.constants = (0..self.elements.len()).map(|index| self.constants_of(index)).collect::<Result<_, _>>()?;
        Ok(self)
    }

    fn constants_of(&self, index: usize) -> Result<ElementConstants, Error> {
        let Element { nodes, material, section } = &self.elements[index];
        let ElementOptions { theory, plasticity, axial_release } = self.options[index];
        material.check(index)?;
        section.check(index)?;
        let [first, second] = nodes.map(|node| self.nodes[node]);
        let (dx, dy) = (second[0] - first[0], second[1] - first[1]);
        let (length, extent) = (dx.hypot(dy), self.extent);
        if length <= SHORTEST_ELEMENT * extent {
            return Err(Error::ZeroLengthElement { element: index, nodes: *nodes, length, extent });
        }
        if let Theory::Timoshenko { shear_correction } = theory {
            positive("shear correction [-]", "element", index, shear_correction)?;
        }
        let mut constants = ElementConstants::new(material, section, theory, self.rotatory_inertia, [dx, dy]);
        if axial_release {
            constants.stiffness[0] *= RELEASED;
        }
        if let Some(plasticity) = plasticity {
            plasticity.check(index)?;
            if theory != Theory::EulerBernoulli {
                let (analysis, feature, item) = ("Timoshenko's theory", "plasticity", "element");
                return Err(Error::Unsupported { analysis, feature, item, index, instead: "Theory::EulerBernoulli" });
            }
            constants.plastic = Some(PlasticBending {
                stiffness: section.bending_stiffness(material),
                hardening: plasticity.hardening_modulus * section.second_moment(),
                yield_moment: plasticity.yield_stress * section.second_moment() * 2.0 / section.thickness(),
                length,
            });
        }
        Ok(constants)
    }
}

/// Adds forces at the two ends of an element to a field over the nodes.
pub(crate) fn add_ends(field: &mut [[f64; 3]], nodes: [usize; 2], ends: &Ends) {
    for (end, node) in nodes.into_iter().enumerate() {
        for dof in 0..3 {
            field[node][dof] += ends[3 * end + dof];
        }
    }
}

/// Diagonal of the bounding box of the nodes \[m\].
fn extent(nodes: &[[f64; 2]]) -> f64 {
    let side = |axis: usize| {
        let along = nodes.iter().map(|node| node[axis]);
        along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
    };
    side(0).hypot(side(1))
}
