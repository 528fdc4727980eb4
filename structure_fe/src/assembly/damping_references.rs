//! What the mass-proportional damping of a node measures its velocity against (THEORY BE13).

use crate::linear_algebra::connected_parts;
use crate::model::{Beam, Supports};

/// What a node's velocity is measured against.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Reference {
    /// The ground: a part that only the ground holds.
    Ground,
    /// The rigid motion of a body that its part is linked or connected to.
    Body(usize),
    /// Nothing: a body, and a part that has broken off.
    Undamped,
}

/// The references of all nodes; empty in a model without rigid bodies, which is damped against the ground.
#[derive(Debug, Clone, Default)]
pub(crate) struct DampingReferences(Vec<Reference>);

impl DampingReferences {
    pub fn new(beam: &Beam, supports: &Supports) -> Self {
        if beam.rigid_bodies().is_empty() {
            return Self::default();
        }
        let nodes = beam.nodes().len();
        let joined = beam.elements().iter().map(|element| element.nodes).chain(supports.joints());
        let part = connected_parts(nodes, joined);
        let mut references = vec![Reference::Undamped; nodes];
        let grounded = supports.fixed.iter().map(|&(node, _)| node).chain(supports.springs.iter().map(|s| s.node));
        grounded.for_each(|node| references[part[node]] = Reference::Ground);
        // the first link counts, then the first connector
        supports.connections.iter().rev().for_each(|c| references[part[c.node]] = Reference::Body(c.body));
        supports.links.iter().rev().for_each(|&(body, node, _)| references[part[node]] = Reference::Body(body));
        let of = |node: usize| if beam.is_rigid_body(node) { Reference::Undamped } else { references[part[node]] };
        Self((0..nodes).map(of).collect())
    }

    /// Whether all nodes are damped against the ground: a model without rigid bodies.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Nodes with the bodies that hold them.
    pub fn held(&self) -> impl Iterator<Item = (usize, usize)> {
        let body = |reference: &Reference| if let Reference::Body(body) = reference { Some(*body) } else { None };
        self.0.iter().enumerate().filter_map(move |(node, reference)| Some((node, body(reference)?)))
    }

    /// Nodes that the ground holds, in a model with rigid bodies.
    pub fn grounded(&self) -> impl Iterator<Item = usize> {
        self.0.iter().enumerate().filter(|(_, reference)| **reference == Reference::Ground).map(|(node, _)| node)
    }
}
