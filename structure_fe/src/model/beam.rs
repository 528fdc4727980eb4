//! The model: nodes, elements and their materials; options: beam theory, rotatory inertia, plasticity, axial releases, point
//! masses, rigid bodies.

use crate::element::{ElementConstants, Ends, PlasticElement, Theory};
use crate::error::{Error, existing_element, existing_node, finite, not_negative, positive};
use crate::field::{Field, sum};
use crate::material::{Material, Plasticity, Section};

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
struct ElementOptions {
    theory: Theory,
    plasticity: Option<Plasticity>,
    axial_release: bool,
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
    options: Vec<ElementOptions>,
    rotatory_inertia: bool,
    /// Mass and moment of inertia of the points at the nodes, `[nodes][m, m, J]` \[kg, kg, kg m^2\].
    points: Field,
    /// Nodes that are rigid bodies.
    bodies: Vec<usize>,
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
        Ends([u1, w1, theta1, u2, w2, theta2])
    }

    /// Computes the constants of all elements from their options.
    fn formulate(mut self) -> Result<Self, Error> {
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
            let layers = PlasticElement::new((material, section), &plasticity, length, axial_release);
            constants.plastic = Some(layers.ok_or(Error::BadProperty {
                quantity: "second moment of area [m^4]",
                item: "element",
                index,
                value: section.second_moment(),
                expected: "at most the area times the distances of both outer fibres, and both above 0, in a bar that yields",
            })?);
        }
        Ok(constants)
    }
}

impl Beam {
    /// The same model with this theory for every element (default: Euler-Bernoulli).
    pub fn with_theory(self, theory: Theory) -> Result<Self, Error> {
        self.with_options(.., |options| options.theory = theory)
    }

    /// The same model with this theory for one element.
    pub fn with_theory_of(self, element: usize, theory: Theory) -> Result<Self, Error> {
        self.with_options_of("theory", element, |options| options.theory = theory)
    }

    /// The same model with an element released along its axis: a roller at its end. It keeps a ten millionth of its
    /// axial stiffness; for an end that slides less than the element's length.
    pub fn with_axial_release(self, element: usize) -> Result<Self, Error> {
        self.with_options_of("axial release", element, |options| options.axial_release = true)
    }

    /// The same model with every element yielding by force and moment together (THEORY BE25).
    ///
    /// [`NonlinearStatics`](crate::NonlinearStatics) and the trapezoidal rule of [`Dynamics`](crate::Dynamics) support
    /// it; linear analyses use the elastic model. Euler-Bernoulli's elements only.
    pub fn with_plasticity(self, plasticity: Plasticity) -> Result<Self, Error> {
        self.with_options(.., |options| options.plasticity = Some(plasticity))
    }

    /// The same model with one element yielding.
    pub fn with_plasticity_of(self, element: usize, plasticity: Plasticity) -> Result<Self, Error> {
        self.with_options_of("plasticity", element, |options| options.plasticity = Some(plasticity))
    }

    fn with_options_of(
        self,
        item: &'static str,
        element: usize,
        change: impl Fn(&mut ElementOptions),
    ) -> Result<Self, Error> {
        existing_element(item, 0, element, self.options.len())?;
        self.with_options(element..=element, change)
    }

    fn with_options(
        mut self,
        elements: impl std::slice::SliceIndex<[ElementOptions], Output = [ElementOptions]>,
        change: impl Fn(&mut ElementOptions),
    ) -> Result<Self, Error> {
        self.options[elements].iter_mut().for_each(change);
        self.formulate()
    }

    /// The same model with rotatory inertia rho I per length (Rayleigh 1877; default: without).
    pub fn with_rotatory_inertia(mut self) -> Result<Self, Error> {
        self.rotatory_inertia = true;
        self.formulate()
    }

    /// The first element that can yield, if there is one.
    pub(crate) fn first_plastic_element(&self) -> Option<usize> {
        self.options.iter().position(|options| options.plasticity.is_some())
    }

    /// The same model with a point mass \[kg\] and its moment of inertia \[kg m^2\] added to a node.
    pub fn with_point_mass(mut self, node: usize, mass: f64, inertia: f64) -> Result<Self, Error> {
        existing_node("point mass", node, node, self.nodes.len())?;
        positive("mass [kg]", "node", node, mass)?;
        not_negative("moment of inertia [kg m^2] of the point mass", inertia)?;
        for (sum, value) in self.points[node].iter_mut().zip([mass, mass, inertia]) {
            *sum += value;
        }
        Ok(self)
    }

    /// The same model with a rigid body, as a further node that is returned with it: `mass` \[kg\] at `at` \[m\], moment
    /// of inertia about it \[kg m^2\]. [`Supports::link`](crate::Supports::link) makes nodes follow it.
    ///
    /// A body without mass must be supported in [`Dynamics`](crate::Dynamics). If u and w of a body are not both
    /// supported, [`Dynamics`](crate::Dynamics) moves its node to the common centre of mass of the body and of the
    /// masses lumped at its linked nodes: read the position from [`Dynamics::beam`](crate::Dynamics::beam).
    pub fn with_rigid_body(mut self, at: [f64; 2], mass: f64, inertia: f64) -> Result<(Self, usize), Error> {
        let node = self.nodes.len();
        finite("coordinate [m]", "node", node, &at)?;
        not_negative("mass [kg] of a rigid body", mass)?;
        not_negative("moment of inertia [kg m^2] of a rigid body", inertia)?;
        self.nodes.push(at);
        self.points.push([mass, mass, inertia]);
        self.bodies.push(node);
        Ok((self, node))
    }

    /// Nodes that are rigid bodies.
    pub fn rigid_bodies(&self) -> &[usize] {
        &self.bodies
    }

    pub(crate) fn is_rigid_body(&self, node: usize) -> bool {
        self.bodies.contains(&node)
    }

    /// Moves the node of a rigid body to another place \[m\].
    pub(crate) fn move_body(&mut self, node: usize, to: [f64; 2]) {
        self.nodes[node] = to;
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
