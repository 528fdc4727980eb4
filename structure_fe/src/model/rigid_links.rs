//! Rigid links: nodes that follow a rigid body.
//!
//! A linked node has the displacement u_s = u_b + (R(theta_b) - 1) r, with its lever arm r from the body's node \[m\], at
//! any rotation (THEORY BE20). Forces on it act on the body: the force, and its moment with the rotated arm.

use super::{Beam, Supports};
use crate::element::{rotated, sinc};

/// A node that follows a rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RigidLink {
    pub body: usize,
    pub node: usize,
    /// Whether the node rotates with the body; otherwise it is pinned to it.
    pub clamped: bool,
    /// Lever arm from the body's node to the node, undeformed \[m\].
    pub arm: [f64; 2],
}

/// All rigid links of a model. Slices of lever arms have the order of `all`.
#[derive(Debug, Clone, Default)]
pub(crate) struct RigidLinks {
    pub all: Vec<RigidLink>,
    of_node: Vec<Option<usize>>,
}

impl RigidLinks {
    pub fn new(beam: &Beam, supports: &Supports) -> Self {
        let places = beam.nodes();
        let link = |&(body, node, clamped): &(usize, usize, bool)| {
            let arm = [0, 1].map(|axis| places[node][axis] - places[body][axis]);
            RigidLink { body, node, clamped, arm }
        };
        let all: Vec<RigidLink> = supports.links.iter().map(link).collect();
        let mut of_node = vec![None; places.len()];
        for (index, link) in all.iter().enumerate() {
            of_node[link.node] = Some(index);
        }
        Self { all, of_node }
    }

    /// The link of a node, if it has one.
    #[inline]
    pub fn of(&self, node: usize) -> Option<usize> {
        self.of_node[node]
    }

    /// Whether a degree of freedom follows a body.
    pub fn follows(&self, node: usize, dof: usize) -> bool {
        self.of(node).is_some_and(|index| dof < 2 || self.all[index].clamped)
    }

    /// The lever arms of the undeformed model.
    pub fn arms(&self) -> Vec<[f64; 2]> {
        self.all.iter().map(|link| link.arm).collect()
    }

    /// The lever arms rotated with the bodies.
    pub fn arms_at(&self, q: &[[f64; 3]]) -> Vec<[f64; 2]> {
        self.all.iter().map(|link| rotated(link.arm, q[link.body][2])).collect()
    }

    /// The arms a with which (R(theta_1) - R(theta_0)) r = (theta_1 - theta_0) J a exactly, J the quarter
    /// turn: a force on the node does the same work as its moment a x F does on the body (THEORY BE21).
    pub fn arms_between(&self, from: &[[f64; 3]], to: &[[f64; 3]]) -> Vec<[f64; 2]> {
        let arm = |link: &RigidLink| {
            let (start, end) = (from[link.body][2], to[link.body][2]);
            let shortened = sinc(0.5 * (end - start));
            rotated(link.arm, 0.5 * (start + end)).map(|x| shortened * x)
        };
        self.all.iter().map(arm).collect()
    }

    /// Sets the displacements of the linked nodes from those of their bodies.
    pub fn set_displacement(&self, q: &mut [[f64; 3]]) {
        for link in &self.all {
            let [u, w, theta] = q[link.body];
            // R - 1 by the half angle keeps the digits of small rotations.
            let (s, half) = (theta.sin(), (0.5 * theta).sin());
            let shrink = -2.0 * half * half;
            let [x, y] = link.arm;
            let own = if link.clamped { theta } else { q[link.node][2] };
            q[link.node] = [u + shrink * x - s * y, w + s * x + shrink * y, own];
        }
    }

    /// The same for velocities, or for small displacements: linear in the body's rotation.
    pub fn set_velocity(&self, arms: &[[f64; 2]], v: &mut [[f64; 3]]) {
        for (link, [x, y]) in self.all.iter().zip(arms) {
            let [u, w, theta] = v[link.body];
            let own = if link.clamped { theta } else { v[link.node][2] };
            v[link.node] = [u - theta * y, w + theta * x, own];
        }
    }

    /// The same for accelerations, with the centripetal part of the velocities `v`.
    pub fn set_acceleration(&self, arms: &[[f64; 2]], v: &[[f64; 3]], a: &mut [[f64; 3]]) {
        self.set_velocity(arms, a);
        for (link, arm) in self.all.iter().zip(arms) {
            let omega = v[link.body][2];
            for axis in 0..2 {
                a[link.node][axis] -= omega * omega * arm[axis];
            }
        }
    }

    /// Transfers forces on linked nodes to their bodies.
    pub fn transfer_forces(&self, arms: &[[f64; 2]], forces: &mut [[f64; 3]]) {
        for (link, [x, y]) in self.all.iter().zip(arms) {
            let [fx, fy, moment] = forces[link.node];
            let own = if link.clamped { moment } else { 0.0 };
            let body = &mut forces[link.body];
            *body = [body[0] + fx, body[1] + fy, body[2] + own + x * fy - y * fx];
            forces[link.node] = [0.0, 0.0, moment - own];
        }
    }
}
