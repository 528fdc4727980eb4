//! Supports and joints: fixed degrees of freedom, springs, hinges, welds, rigid links, connectors, breakable joints.

use super::connector::Connection;
use super::{Beam, Connector};
use crate::error::{Error, existing_node, positive};
use crate::field::Dof;
use crate::linear_algebra::connected_parts;
use serde::{Deserialize, Serialize};

/// A linear spring between one degree of freedom and the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spring {
    pub node: usize,
    pub dof: Dof,
    /// \[N/m\], or \[N m/rad\] on a rotation.
    pub stiffness: f64,
}

/// Supports and joints of a model. Empty by default: free in space.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Supports {
    pub(crate) fixed: Vec<(usize, Dof)>,
    pub(crate) springs: Vec<Spring>,
    pub(crate) hinges: Vec<[usize; 2]>,
    /// Body, node, and whether the node rotates with the body.
    pub(crate) links: Vec<(usize, usize, bool)>,
    pub(crate) welds: Vec<[usize; 2]>,
    pub(crate) breakables: Vec<(usize, Rupture)>,
    pub(crate) connections: Vec<Connection>,
}

impl Supports {
    /// Fixes one degree of freedom of a node at zero.
    pub fn fix(&mut self, node: usize, dof: Dof) -> &mut Self {
        self.fixed.push((node, dof));
        self
    }

    /// Fixes both displacements of a node: a hinge.
    pub fn pin(&mut self, node: usize) -> &mut Self {
        self.fix(node, Dof::U).fix(node, Dof::W)
    }

    /// Fixes displacements and rotation of a node.
    pub fn clamp(&mut self, node: usize) -> &mut Self {
        self.pin(node).fix(node, Dof::Theta)
    }

    /// Connects a degree of freedom to the ground by a spring \[N/m, or N m/rad on a rotation\].
    ///
    /// Springs on the same degree of freedom add up.
    pub fn spring(&mut self, node: usize, dof: Dof, stiffness: f64) -> &mut Self {
        self.springs.push(Spring { node, dof, stiffness });
        self
    }

    /// Joins the displacements of two nodes and leaves their rotations free: a hinge between the elements that end at
    /// either. The nodes must be at the same place, and belong to different elements.
    pub fn hinge(&mut self, first: usize, second: usize) -> &mut Self {
        self.hinges.push([first, second]);
        self
    }

    /// Links a node rigidly to a [rigid body](Beam::with_rigid_body), at any rotation: u, w and theta.
    pub fn link(&mut self, body: usize, node: usize) -> &mut Self {
        self.links.push((body, node, true));
        self
    }

    /// Links the displacements u, w of a node to a [rigid body](Beam::with_rigid_body), at any rotation; theta is free.
    pub fn link_pinned(&mut self, body: usize, node: usize) -> &mut Self {
        self.links.push((body, node, false));
        self
    }

    /// Connects a node to a [rigid body](Beam::with_rigid_body) by springs and dampers whose axes turn with the body: in
    /// [`natural_modes`](crate::natural_modes) and under the trapezoidal rule.
    pub fn connect(&mut self, body: usize, node: usize, connector: Connector) -> &mut Self {
        self.connections.push(Connection { body, node, connector });
        self
    }

    /// Joins two nodes at the same place rigidly, for a joint that may [break](Supports::breakable).
    pub fn weld(&mut self, first: usize, second: usize) -> &mut Self {
        self.welds.push([first, second]);
        self
    }

    /// Makes the joints of a node breakable under the trapezoidal rule: at the end of the step in which the `rupture`
    /// limit is exceeded all its supports, rigid links, welds and hinges are removed
    /// ([`State::ruptures`](crate::State::ruptures)). Springs and connectors stay. Linear analyses ignore the limit.
    pub fn breakable(&mut self, node: usize, rupture: Rupture) -> &mut Self {
        self.breakables.push((node, rupture));
        self
    }

    /// These supports without those of the `broken` nodes. Springs and connectors stay.
    pub(crate) fn without(&self, broken: &[usize]) -> Self {
        let whole = |node: &usize| !broken.contains(node);
        let mut left = self.clone();
        left.fixed.retain(|(node, _)| whole(node));
        left.hinges.retain(|hinge| hinge.iter().all(whole));
        left.welds.retain(|weld| weld.iter().all(whole));
        left.links.retain(|(_, node, _)| whole(node));
        left.breakables.retain(|(node, _)| whole(node));
        left
    }

    /// Pairs of nodes at the same place: hinges and welds.
    pub(crate) fn joints(&self) -> impl Iterator<Item = [usize; 2]> {
        self.hinges.iter().chain(&self.welds).copied()
    }

    /// For each node the first node with which it shares its displacements, by hinges and welds, or its rotation, by
    /// welds; the node itself if it shares none.
    pub(crate) fn leaders(&self, dof: Dof, nodes: usize) -> Vec<usize> {
        match dof {
            Dof::Theta => connected_parts(nodes, self.welds.iter().copied()),
            Dof::U | Dof::W => connected_parts(nodes, self.joints()),
        }
    }

    /// Whether a degree of freedom is fixed, by itself or through a hinge.
    pub(crate) fn is_fixed(&self, node: usize, dof: Dof) -> bool {
        self.fixed.contains(&(node, dof))
    }

    /// Elastic energy in the springs \[J\] of a displacement `[nodes][u, w, theta]`.
    ///
    /// # Panics
    /// If a spring's node has no entry in `displacement`.
    pub fn spring_energy(&self, displacement: &[[f64; 3]]) -> f64 {
        self.springs
            .iter()
            .map(|spring| 0.5 * spring.stiffness * displacement[spring.node][spring.dof as usize].powi(2))
            .sum()
    }

    /// Elastic energy in the connectors \[J\] at a small displacement.
    pub(crate) fn connector_energy(&self, beam: &Beam, small: &[[f64; 3]]) -> f64 {
        let still = vec![[0.0; 3]; small.len()];
        let of = |connection: &Connection| {
            let rows = connection.between(beam, &still, &still).rows;
            connection.energy(connection.rate(&rows, small))
        };
        self.connections.iter().map(of).sum()
    }

    /// Adds the forces k u of a displacement on the springs to `forces`, both `[nodes][3]`.
    pub(crate) fn add_spring_forces(&self, displacement: &[[f64; 3]], forces: &mut [[f64; 3]]) {
        for spring in &self.springs {
            let (node, dof) = (spring.node, spring.dof as usize);
            forces[node][dof] += spring.stiffness * displacement[node][dof];
        }
    }

    pub(crate) fn check(&self, beam: &Beam) -> Result<(), Error> {
        let nodes = beam.nodes().len();
        for (index, &(node, _)) in self.fixed.iter().enumerate() {
            existing_node("support", index, node, nodes)?;
        }
        for (index, spring) in self.springs.iter().enumerate() {
            existing_node("spring", index, spring.node, nodes)?;
            positive("stiffness [N/m, N m/rad]", "spring", index, spring.stiffness)?;
        }
        for (index, &(node, rupture)) in self.breakables.iter().enumerate() {
            existing_node("breakable joint", index, node, nodes)?;
            rupture.check(index)?;
            let held = self.fixed.iter().any(|&(other, _)| other == node)
                || self.links.iter().any(|&(_, other, _)| other == node)
                || self.joints().any(|joint| joint.contains(&node));
            if !held || beam.is_rigid_body(node) {
                let reason = "the node has no support, rigid link, weld or hinge that could break, or is a rigid body";
                return Err(Error::BadJoint { item: "breakable joint", index, node, reason });
            }
        }
        for (index, hinge) in self.joints().enumerate() {
            for node in hinge {
                existing_node("hinge", index, node, nodes)?;
            }
            let [a, b] = hinge.map(|node| beam.nodes()[node]);
            let gap = (a[0] - b[0]).hypot(a[1] - b[1]);
            if gap > 1e-9 * beam.extent() {
                return Err(Error::HingeGap { hinge: index, nodes: hinge, gap });
            }
        }
        for (index, connection) in self.connections.iter().enumerate() {
            connection.check(index, beam)?;
        }
        self.check_links(beam)
    }

    fn check_links(&self, beam: &Beam) -> Result<(), Error> {
        for (index, &(body, node, clamped)) in self.links.iter().enumerate() {
            existing_node("rigid link", index, body, beam.nodes().len())?;
            existing_node("rigid link", index, node, beam.nodes().len())?;
            let own = |&(other, dof): &(usize, Dof)| other == node && (clamped || dof != Dof::Theta);
            let reason = if !beam.is_rigid_body(body) {
                "the first of its two nodes is not a rigid body"
            } else if beam.is_rigid_body(node) {
                "the node is a rigid body itself"
            } else if self.links[..index].iter().any(|&(_, other, _)| other == node) {
                "the node is linked already"
            } else if self.fixed.iter().any(own) {
                "the node has a support of its own; support the body"
            } else if self.joints().any(|joint| joint.contains(&node)) {
                "the node is part of a hinge; use a pinned link"
            } else {
                continue;
            };
            return Err(Error::BadJoint { item: "rigid link", index, node, reason });
        }
        let body_of = |joint: [usize; 2]| joint.into_iter().find(|&node| beam.is_rigid_body(node));
        if let Some((index, node)) = self.joints().enumerate().find_map(|(index, joint)| Some((index, body_of(joint)?)))
        {
            let reason = "the node is a rigid body; use a pinned link to it";
            return Err(Error::BadJoint { item: "hinge", index, node, reason });
        }
        Ok(())
    }
}

/// The limit at which a node is [released](crate::Supports::breakable) by its supports and joints.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Rupture {
    /// A strain \[-\] of an outer fibre, of either sign, at the end of an element at the node.
    FibreStrain(f64),
    /// A rotation \[rad\], of either sign, relative to the partner of the node's hinge or pinned link.
    Rotation(f64),
}

/// A rupture that happened, at the end of a step: the node is free from the next step on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Break {
    /// The node.
    pub node: usize,
    /// When \[s\].
    pub time: f64,
    /// Where the node was \[m\].
    pub place: [f64; 2],
    /// The strain \[-\] or rotation \[rad\] that exceeded the limit.
    pub value: f64,
}

impl Rupture {
    pub(crate) fn check(&self, index: usize) -> Result<(), Error> {
        let (quantity, value) = match *self {
            Rupture::FibreStrain(limit) => ("rupture strain [-]", limit),
            Rupture::Rotation(limit) => ("rupture rotation [rad]", limit),
        };
        positive(quantity, "breakable joint", index, value).map(|_| ())
    }
}
