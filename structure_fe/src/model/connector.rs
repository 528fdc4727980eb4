//! Connectors: springs and dampers between a rigid body and a node (THEORY BE27).
//!
//! The deformation d = (R(theta_b + alpha)^T p - R(alpha)^T p_0, theta_s - theta_b) is along and across an axis that turns with
//! the body, and the turn of the node against it; p is the vector from the body's node to the node.

use super::Beam;
use crate::element::{rotated, sinc};
use crate::error::{Error, existing_node, not_negative};

/// Stiffness and damping of a connector: along its axis, across it, and in rotation.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Connector {
    /// Angle of the axis in the undeformed model, from x towards y \[rad\]; it turns with the body.
    pub angle: f64,
    /// `[N/m, N/m, N m/rad]`; 0 is no spring.
    pub stiffness: [f64; 3],
    /// `[N s/m, N s/m, N m s/rad]`; 0 is no damper.
    pub damping: [f64; 3],
}

/// A connector with its body and its node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Connection {
    pub body: usize,
    pub node: usize,
    pub connector: Connector,
}

/// The change of the deformation is these rows times the change of (u, w, theta) of the node, then of the body.
pub(crate) type Rows = [[f64; 6]; 3];

/// Geometry of a connector between two displacements.
pub(crate) struct Between {
    pub rows: Rows,
    /// Lever arm of the forces about the body's node \[m\].
    pub arm: [f64; 2],
}

impl Connection {
    pub fn check(&self, index: usize, beam: &Beam) -> Result<(), Error> {
        let Self { body, node, connector } = *self;
        for node in [body, node] {
            existing_node("connector", index, node, beam.nodes().len())?;
        }
        let reason = if !beam.is_rigid_body(body) {
            "the first of its two nodes is not a rigid body"
        } else if beam.is_rigid_body(node) {
            "the node is a rigid body itself"
        } else {
            for value in connector.stiffness {
                not_negative("stiffness [N/m, N m/rad] of a connector", value)?;
            }
            for value in connector.damping {
                not_negative("damping [N s/m, N m s/rad] of a connector", value)?;
            }
            return Ok(());
        };
        Err(Error::BadJoint { item: "connector", index, node, reason })
    }

    /// Vector from the body's node to the node at a displacement \[m\].
    fn vector(&self, beam: &Beam, q: &[[f64; 3]]) -> [f64; 2] {
        let places = beam.nodes();
        [0, 1].map(|k| places[self.node][k] + q[self.node][k] - places[self.body][k] - q[self.body][k])
    }

    /// BE27: the deformation at a displacement \[m, m, rad\].
    pub fn deformation(&self, beam: &Beam, q: &[[f64; 3]]) -> [f64; 3] {
        let (places, turn) = (beam.nodes(), q[self.body][2]);
        let at_rest = [0, 1].map(|k| places[self.node][k] - places[self.body][k]);
        // R^T p - p_0 in the body's axes, by the half angle, which keeps the digits of small rotations
        let p = self.vector(beam, q);
        let (s, half) = (turn.sin(), (0.5 * turn).sin());
        let shrink = -2.0 * half * half;
        let moved = [p[0] - at_rest[0] + shrink * p[0] + s * p[1], p[1] - at_rest[1] - s * p[0] + shrink * p[1]];
        let [along, across] = rotated(moved, -self.connector.angle);
        [along, across, q[self.node][2] - turn]
    }

    /// BE27: rows with which the deformation changes from one displacement to another, exactly; its rate where both are the same.
    pub fn between(&self, beam: &Beam, from: &[[f64; 3]], to: &[[f64; 3]]) -> Between {
        let (start, end) = (from[self.body][2], to[self.body][2]);
        let half = 0.5 * (end - start);
        let (before, after) = (self.vector(beam, from), self.vector(beam, to));
        let longer = sinc(half) / half.cos();
        let arm = [0, 1].map(|k| longer * 0.5 * (before[k] + after[k]));
        let axis = rotated([half.cos(), 0.0], 0.5 * (start + end) + self.connector.angle);
        let row = |[x, y]: [f64; 2]| [x, y, 0.0, -x, -y, x * arm[1] - y * arm[0]];
        let turn = [0.0, 0.0, 1.0, 0.0, 0.0, -1.0];
        Between { rows: [row(axis), row([-axis[1], axis[0]]), turn], arm }
    }

    /// Elastic energy of a deformation \[J\].
    pub fn energy(&self, deformation: [f64; 3]) -> f64 {
        (0..3).map(|k| 0.5 * self.connector.stiffness[k] * deformation[k].powi(2)).sum()
    }

    /// Adds the forces B^T g of generalised forces g \[N, N, N m\] to a field.
    pub fn add_forces(&self, rows: &Rows, generalised: [f64; 3], forces: &mut [[f64; 3]]) {
        for (row, g) in rows.iter().zip(generalised) {
            for (k, entry) in row.iter().enumerate() {
                forces[if k < 3 { self.node } else { self.body }][k % 3] += entry * g;
            }
        }
    }

    /// B v of a field.
    pub fn rate(&self, rows: &Rows, v: &[[f64; 3]]) -> [f64; 3] {
        let values = [v[self.node], v[self.body]];
        rows.map(|row| row.iter().zip(values.as_flattened()).map(|(entry, v)| entry * v).sum())
    }
}
