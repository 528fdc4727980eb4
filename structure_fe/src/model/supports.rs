//! Supports: fixed degrees of freedom and springs to the ground.

use crate::beam::Beam;
use crate::error::{Error, existing_node, positive};
use crate::rupture::Rupture;

/// A degree of freedom of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Dof {
    /// Displacement u along x \[m\].
    U = 0,
    /// Displacement w along y \[m\].
    W = 1,
    /// Rotation theta from x towards y \[rad\].
    Theta = 2,
}

impl std::fmt::Display for Dof {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        out.write_str(match self {
            Dof::U => "u",
            Dof::W => "w",
            Dof::Theta => "theta",
        })
    }
}

/// A linear spring between one degree of freedom and the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spring {
    pub node: usize,
    pub dof: Dof,
    /// \[N/m\], or \[N m/rad\] on a rotation.
    pub stiffness: f64,
}

/// How a model is held. Empty by default: free in space.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Supports {
    fixed: Vec<(usize, Dof)>,
    springs: Vec<Spring>,
    hinges: Vec<[usize; 2]>,
    /// Body, node, and whether the node turns with the body.
    ties: Vec<(usize, usize, bool)>,
    welds: Vec<[usize; 2]>,
    breakables: Vec<(usize, Rupture)>,
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

    /// Ties a degree of freedom to the ground by a spring \[N/m, or N m/rad on a rotation\].
    ///
    /// Springs on the same degree of freedom add up.
    pub fn spring(&mut self, node: usize, dof: Dof, stiffness: f64) -> &mut Self {
        self.springs.push(Spring { node, dof, stiffness });
        self
    }

    /// Ties the displacements of two nodes to each other and leaves their rotations free: a hinge between
    /// the elements that end at either. The nodes must be at the same place, and belong to elements of
    /// their own.
    pub fn hinge(&mut self, first: usize, second: usize) -> &mut Self {
        self.hinges.push([first, second]);
        self
    }

    /// Makes a node follow a [rigid body](Beam::with_rigid_body) at any rotation: u, w and theta.
    pub fn tie(&mut self, body: usize, node: usize) -> &mut Self {
        self.ties.push((body, node, true));
        self
    }

    /// Makes a node follow a [rigid body](Beam::with_rigid_body) at any rotation, but turn freely against it:
    /// u and w only.
    pub fn tie_pinned(&mut self, body: usize, node: usize) -> &mut Self {
        self.ties.push((body, node, false));
        self
    }

    /// Joins two nodes at the same place rigidly, for a joint that may [break](Supports::breakable).
    pub fn weld(&mut self, first: usize, second: usize) -> &mut Self {
        self.welds.push([first, second]);
        self
    }

    /// Lets a node break off, in motion by the trapezoidal rule: at the end of the step in which the `rupture` limit is
    /// passed all supports, ties, welds and hinges let go of it, and it is free from the next step on
    /// ([`State::ruptures`](crate::State::ruptures)). Springs stay. Other analyses take it as whole.
    pub fn breakable(&mut self, node: usize, rupture: Rupture) -> &mut Self {
        self.breakables.push((node, rupture));
        self
    }

    pub(crate) fn breakables(&self) -> &[(usize, Rupture)] {
        &self.breakables
    }

    /// Keeps what holds nodes that `keep` names, and between such nodes.
    pub(crate) fn retain(&mut self, keep: impl Fn(usize) -> bool) {
        self.fixed.retain(|&(node, _)| keep(node));
        self.hinges.retain(|hinge| hinge.iter().all(|&node| keep(node)));
        self.welds.retain(|weld| weld.iter().all(|&node| keep(node)));
        self.ties.retain(|&(_, node, _)| keep(node));
        self.breakables.retain(|&(node, _)| keep(node));
    }

    pub(crate) fn welds(&self) -> &[[usize; 2]] {
        &self.welds
    }

    /// Nodes that are at the same place: of hinges and welds.
    pub(crate) fn joints(&self) -> impl Iterator<Item = [usize; 2]> {
        self.hinges.iter().chain(&self.welds).copied()
    }

    /// Body, node, and whether the node turns with the body.
    pub(crate) fn ties(&self) -> &[(usize, usize, bool)] {
        &self.ties
    }

    pub(crate) fn hinges(&self) -> &[[usize; 2]] {
        &self.hinges
    }

    /// For each node the first of those that move with it, by hinges and welds; itself where there is none.
    pub(crate) fn leaders(&self, nodes: usize) -> Vec<usize> {
        Self::first_of_each(self.joints(), nodes)
    }

    /// For each node the first of those that turn with it, by welds; itself where there is none.
    pub(crate) fn turning_leaders(&self, nodes: usize) -> Vec<usize> {
        Self::first_of_each(self.welds.iter().copied(), nodes)
    }

    fn first_of_each(joints: impl Iterator<Item = [usize; 2]>, nodes: usize) -> Vec<usize> {
        let mut leader: Vec<usize> = (0..nodes).collect();
        let root = |leader: &[usize], mut node: usize| {
            while leader[node] != node {
                node = leader[node];
            }
            node
        };
        for joint in joints {
            let [a, b] = joint.map(|node| root(&leader, node));
            leader[a.max(b)] = a.min(b);
        }
        (0..nodes).map(|node| root(&leader, node)).collect()
    }

    /// Whether a degree of freedom is fixed, by itself or through a hinge.
    pub(crate) fn is_fixed(&self, node: usize, dof: Dof) -> bool {
        self.fixed.contains(&(node, dof))
    }

    pub(crate) fn fixed(&self) -> &[(usize, Dof)] {
        &self.fixed
    }

    pub(crate) fn springs(&self) -> &[Spring] {
        &self.springs
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
            existing_node("breakable node", index, node, nodes)?;
            rupture.check(index)?;
            let held = self.fixed.iter().any(|&(other, _)| other == node)
                || self.ties.iter().any(|&(_, other, _)| other == node)
                || self.joints().any(|joint| joint.contains(&node));
            if !held || beam.is_rigid_body(node) {
                return Err(Error::NothingBreaks { index, node });
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
        self.check_ties(beam)
    }

    fn check_ties(&self, beam: &Beam) -> Result<(), Error> {
        for (index, &(body, node, turns)) in self.ties.iter().enumerate() {
            existing_node("tie", index, body, beam.nodes().len())?;
            existing_node("tie", index, node, beam.nodes().len())?;
            let own = |&(other, dof): &(usize, Dof)| other == node && (turns || dof != Dof::Theta);
            let reason = if !beam.is_rigid_body(body) {
                Some("the first of the two is not a rigid body")
            } else if beam.is_rigid_body(node) {
                Some("the node is a rigid body itself")
            } else if self.ties[..index].iter().any(|&(_, other, _)| other == node) {
                Some("the node is tied already")
            } else if self.fixed.iter().any(own) {
                Some("the node has a support of its own; support the body")
            } else if self.joints().any(|joint| joint.contains(&node)) {
                Some("the node is part of a hinge; tie it pinned")
            } else {
                None
            };
            if let Some(reason) = reason {
                return Err(Error::BadTie { tie: index, body, node, reason });
            }
        }
        let bodies = |joint: &[usize; 2]| joint.iter().any(|&node| beam.is_rigid_body(node));
        if let Some((hinge, nodes)) = self.joints().enumerate().find(|(_, joint)| bodies(joint)) {
            return Err(Error::HingedBody { hinge, nodes });
        }
        Ok(())
    }
}
