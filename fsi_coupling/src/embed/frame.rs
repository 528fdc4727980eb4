//! The frame of a host's surface, for output and contact: it goes with the nodes.

use super::nodes::HostNodes;
use super::topology::{Topology, WetSurface};
use crate::bodies::rigid_motion::RigidMotion;
use crate::geometry::vector::{cross, dot, rotate};

/// The frame of a host's surface at t = 0. A surface that one node carries has a frame that moves rigidly with the node; any other
/// has the rigid motion that fits its wet nodes best (least squares about their mean).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HostFrame {
    /// Position of its origin [m].
    pub position: [f64; 2],
    /// Its angle [rad], counter-clockwise.
    pub angle: f64,
}

/// See [`HostFrame`].
#[derive(Clone)]
pub(super) struct MovingFrame {
    start: HostFrame,
    wet: Vec<usize>,
    /// Mean position of the wet nodes at t = 0, or that of the node that carries all [m].
    about: [f64; 2],
    /// From there to each wet node at t = 0 [m].
    arms: Vec<[f64; 2]>,
    /// The node that carries all, with its rotation at t = 0 [rad].
    carrier: Option<(usize, f64)>,
}

impl MovingFrame {
    /// Of a topology that has been checked; `nodes` are those at t = 0.
    pub fn new(topology: &Topology, nodes: &HostNodes, start: HostFrame) -> MovingFrame {
        let wet = topology.wet_nodes();
        let carrier = match (&topology.surfaces[..], &wet[..]) {
            (surfaces, [node]) if surfaces.iter().all(|s| matches!(s, WetSurface::Carried { .. })) => {
                Some((*node, nodes.rotation.get(*node).copied().unwrap_or(0.0)))
            }
            _ => None,
        };
        let about = mean(&topology.nodes, &wet);
        let arms = wet.iter().map(|&node| [0, 1].map(|k| topology.nodes[node][k] - about[k])).collect();
        MovingFrame { start, wet, about, arms, carrier }
    }

    /// True where the surface is rigid in its frame.
    pub fn is_rigid(&self) -> bool {
        self.carrier.is_some()
    }

    /// At t = 0.
    pub fn at_start(&self) -> RigidMotion {
        RigidMotion { position: self.start.position, angle: self.start.angle, ..RigidMotion::default() }
    }

    /// Where the frame is and how it moves, but for its acceleration, when the nodes move like this.
    pub fn at(&self, nodes: &HostNodes) -> RigidMotion {
        let (about, v) = (mean(&nodes.position, &self.wet), mean(&nodes.velocity, &self.wet));
        let (turn, spin) = match self.carrier {
            Some((node, before)) => (nodes.rotation[node] - before, nodes.spin[node]),
            None => self.best_turn(nodes, about, v),
        };
        let arm = rotate([0, 1].map(|k| self.start.position[k] - self.about[k]), turn);
        RigidMotion {
            position: [about[0] + arm[0], about[1] + arm[1]],
            angle: self.start.angle + turn,
            velocity: [v[0] - spin * arm[1], v[1] + spin * arm[0]],
            angular_velocity: spin,
            ..RigidMotion::default()
        }
    }

    /// Rotation [rad] and angular velocity [rad/s] of the rigid motion that fits the wet nodes best.
    fn best_turn(&self, nodes: &HostNodes, about: [f64; 2], velocity: [f64; 2]) -> (f64, f64) {
        let (mut along, mut across, mut swing, mut size) = (0.0, 0.0, 0.0, 0.0);
        for (&node, arm) in self.wet.iter().zip(&self.arms) {
            let r = [0, 1].map(|k| nodes.position[node][k] - about[k]);
            let v = [0, 1].map(|k| nodes.velocity[node][k] - velocity[k]);
            along += dot(*arm, r);
            across += cross(*arm, r);
            swing += cross(r, v);
            size += dot(r, r);
        }
        (across.atan2(along), swing / size)
    }
}

fn mean(values: &[[f64; 2]], of: &[usize]) -> [f64; 2] {
    match of {
        [one] => values[*one],
        _ => [0, 1].map(|k| of.iter().map(|&node| values[node][k]).sum::<f64>() / of.len() as f64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_carried_surface_turns_its_frame_and_others_do_not() {
        let corners = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let start = HostFrame { position: [0.5, 0.0], angle: 0.2 };
        let (one, rest) = (vec![[0.25, 0.0]], HostNodes::at_rest(vec![[0.25, 0.0]]).with_rotations());
        let frame = MovingFrame::new(&Topology::of(one).turning().carried(0, corners.clone()), &rest, start);
        let quarter = std::f64::consts::FRAC_PI_2;
        let nodes = HostNodes {
            position: vec![[1.0, 2.0]],
            velocity: vec![[0.0, -3.0]],
            rotation: vec![quarter],
            spin: vec![2.0],
        };
        let found = frame.at(&nodes);
        assert!(frame.is_rigid() && (found.angle - 0.2 - quarter).abs() < 1e-15);
        assert!((found.position[0] - 1.0).hypot(found.position[1] - 2.25) < 1e-15);
        assert!((found.velocity[0] + 0.5).hypot(found.velocity[1] + 3.0) < 1e-15);

        // the same turn of the corners themselves, and one of them a little off
        let turned = |at: &[f64; 2]| [1.0 - at[1], 2.0 + at[0] - 0.25];
        let mut moved = HostNodes::at_rest(corners.iter().map(turned).collect());
        moved.velocity = corners.iter().map(|at| [-2.0 * at[0] + 0.5, -3.0 - 2.0 * at[1]]).collect();
        let frame = MovingFrame::new(&Topology::of(corners.clone()).closed(0..3), &HostNodes::at_rest(corners), start);
        let found = frame.at(&moved);
        assert!(!frame.is_rigid() && (found.angle - 0.2 - quarter).abs() < 1e-15);
        assert!((found.position[0] - 1.0).hypot(found.position[1] - 2.25) < 1e-15);
        assert!((found.angular_velocity - 2.0).abs() < 1e-14);
        assert!((found.velocity[0] + 0.5).hypot(found.velocity[1] + 3.0) < 1e-14, "{found:?}");
    }
}
