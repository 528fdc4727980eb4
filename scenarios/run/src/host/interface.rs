//! What of a scene's body the host moves.

use std::str::FromStr;

use fsi_coupling::embed::{HostNodes, Topology};
use fsi_coupling::{RigidMotion, Shape};
use scene::Body;

use super::error::HostedError;

/// What of a scene's body the host moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interface {
    /// One node at the origin of the body's frame: x, y and angle. The body is rigid; loads are F_x, F_y and the moment about the node.
    Body,
    /// The corners of the body's outline, or the points of its polyline; the surface is straight between them.
    Nodes,
    /// The same with rotations: the surface bends between them by cubic shapes, and loads have moments (THEORY CO13).
    TurningNodes,
}

impl Interface {
    /// The names, in the order of the variants.
    pub const NAMES: [&'static str; 3] = ["body", "nodes", "turning_nodes"];

    /// Its name.
    pub fn name(self) -> &'static str {
        Interface::NAMES[self as usize]
    }

    /// The nodes of a body that starts like this, with the motion that they start with.
    pub(super) fn nodes(self, body: &Body, start: &RigidMotion) -> (Topology, HostNodes) {
        let outline = body.shape.outline();
        let corners: Vec<[f64; 2]> = outline.iter().map(|at| start.point(*at)).collect();
        if self == Interface::Body {
            let nodes = HostNodes {
                position: vec![start.position],
                velocity: vec![start.velocity],
                rotation: vec![start.angle],
                spin: vec![start.angular_velocity],
            };
            return (Topology::of(nodes.position.clone()).turning().carried(0, corners), nodes);
        }
        let (points, plate) = match &body.shape {
            Shape::Polyline { points, thickness } => (points, Some(*thickness)),
            _ => (&outline, None),
        };
        let position: Vec<[f64; 2]> = points.iter().map(|at| start.point(*at)).collect();
        let velocity = points.iter().map(|at| start.point_velocity(*at)).collect();
        let count = position.len();
        let topology = Topology::of(position.clone());
        let topology = match plate {
            Some(thickness) => topology.plate(0..count, thickness),
            None => topology.closed(0..count),
        };
        let nodes = HostNodes { position, velocity, ..HostNodes::default() };
        if self == Interface::Nodes {
            return (topology, nodes);
        }
        let nodes = HostNodes { rotation: vec![0.0; count], spin: vec![start.angular_velocity; count], ..nodes };
        (topology.turning(), nodes)
    }
}

impl FromStr for Interface {
    type Err = HostedError;

    fn from_str(name: &str) -> Result<Interface, HostedError> {
        let all = [Interface::Body, Interface::Nodes, Interface::TurningNodes];
        let unknown = || HostedError::Interface { given: name.to_string(), expected: Interface::NAMES.join(", ") };
        all.into_iter().find(|one| one.name() == name).ok_or_else(unknown)
    }
}
