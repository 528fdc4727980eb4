//! Ties: nodes that follow a rigid body.
//!
//! A tied node is at u_s = u_b + (R(theta_b) - 1) r, r its arm from the body's node \[m\], at any rotation
//! (THEORY S21). What acts on it acts on the body: the force, and its moment with the arm as turned.

use crate::beam::Beam;
use crate::supports::Supports;

/// A node that follows a rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tie {
    pub body: usize,
    pub node: usize,
    /// Whether the node turns with the body; else it is pinned to it.
    pub turns: bool,
    /// From the body's node to the node, before anything moves \[m\].
    pub arm: [f64; 2],
}

/// All ties of a model. Arms are given by tie, in the order of `all`.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ties {
    pub all: Vec<Tie>,
    of_node: Vec<Option<usize>>,
}

/// sin(x)/x.
pub(crate) fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-3 { 1.0 - x * x / 6.0 * (1.0 - x * x / 20.0) } else { x.sin() / x }
}

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (s, c) = angle.sin_cos();
    [c * x - s * y, s * x + c * y]
}

impl Ties {
    pub fn new(beam: &Beam, supports: &Supports) -> Self {
        let places = beam.nodes();
        let tie = |&(body, node, turns): &(usize, usize, bool)| {
            let arm = [0, 1].map(|axis| places[node][axis] - places[body][axis]);
            Tie { body, node, turns, arm }
        };
        let all: Vec<Tie> = supports.ties().iter().map(tie).collect();
        let mut of_node = vec![None; places.len()];
        for (index, tie) in all.iter().enumerate() {
            of_node[tie.node] = Some(index);
        }
        Self { all, of_node }
    }

    /// The tie of a node, if it has one.
    #[inline]
    pub fn of(&self, node: usize) -> Option<usize> {
        self.of_node[node]
    }

    /// Whether a degree of freedom follows a body.
    pub fn follows(&self, node: usize, dof: usize) -> bool {
        self.of(node).is_some_and(|index| dof < 2 || self.all[index].turns)
    }

    /// The arms before anything moves.
    pub fn arms(&self) -> Vec<[f64; 2]> {
        self.all.iter().map(|tie| tie.arm).collect()
    }

    /// The arms as turned by the bodies' rotations.
    pub fn arms_at(&self, q: &[[f64; 3]]) -> Vec<[f64; 2]> {
        self.all.iter().map(|tie| turned(tie.arm, q[tie.body][2])).collect()
    }

    /// The arms a with which (R(theta_1) - R(theta_0)) r = (theta_1 - theta_0) J a exactly, J the quarter
    /// turn: a force on the node does the same work as its moment a x F does on the body (THEORY S22).
    pub fn arms_between(&self, from: &[[f64; 3]], to: &[[f64; 3]]) -> Vec<[f64; 2]> {
        let arm = |tie: &Tie| {
            let (start, end) = (from[tie.body][2], to[tie.body][2]);
            let shortened = sinc(0.5 * (end - start));
            turned(tie.arm, 0.5 * (start + end)).map(|x| shortened * x)
        };
        self.all.iter().map(arm).collect()
    }

    /// Puts the tied nodes where their bodies are.
    pub fn follow(&self, q: &mut [[f64; 3]]) {
        for tie in &self.all {
            let [u, w, theta] = q[tie.body];
            // R - 1 by the half angle keeps the digits of small rotations.
            let (s, half) = (theta.sin(), (0.5 * theta).sin());
            let shrink = -2.0 * half * half;
            let [x, y] = tie.arm;
            let own = if tie.turns { theta } else { q[tie.node][2] };
            q[tie.node] = [u + shrink * x - s * y, w + s * x + shrink * y, own];
        }
    }

    /// The same for velocities, or for small displacements: linear in the body's rotation.
    pub fn follow_linearly(&self, arms: &[[f64; 2]], v: &mut [[f64; 3]]) {
        for (tie, [x, y]) in self.all.iter().zip(arms) {
            let [u, w, theta] = v[tie.body];
            let own = if tie.turns { theta } else { v[tie.node][2] };
            v[tie.node] = [u - theta * y, w + theta * x, own];
        }
    }

    /// The same for accelerations, which velocities bend towards the body's node.
    pub fn follow_acceleration(&self, arms: &[[f64; 2]], v: &[[f64; 3]], a: &mut [[f64; 3]]) {
        self.follow_linearly(arms, a);
        for (tie, arm) in self.all.iter().zip(arms) {
            let spin = v[tie.body][2];
            for axis in 0..2 {
                a[tie.node][axis] -= spin * spin * arm[axis];
            }
        }
    }

    /// Takes forces on tied nodes to their bodies.
    pub fn fold(&self, arms: &[[f64; 2]], forces: &mut [[f64; 3]]) {
        for (tie, [x, y]) in self.all.iter().zip(arms) {
            let [fx, fy, moment] = forces[tie.node];
            let own = if tie.turns { moment } else { 0.0 };
            let body = &mut forces[tie.body];
            *body = [body[0] + fx, body[1] + fy, body[2] + own + x * fy - y * fx];
            forces[tie.node] = [0.0, 0.0, moment - own];
        }
    }
}
