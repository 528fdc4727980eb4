//! The host's nodes at one instant.

use serde::{Deserialize, Serialize};

use super::error::HostError;

/// Where the nodes are and how they move, in the host's order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HostNodes {
    /// Positions [m].
    pub position: Vec<[f64; 2]>,
    /// Velocities [m/s].
    pub velocity: Vec<[f64; 2]>,
    /// Rotations [rad], counter-clockwise, from any zero; empty where the topology has none.
    #[serde(default)]
    pub rotation: Vec<f64>,
    /// Angular velocities [rad/s]; empty where the topology has no rotations.
    #[serde(default)]
    pub spin: Vec<f64>,
}

impl HostNodes {
    /// Nodes without rotations, at rest.
    pub fn at_rest(position: Vec<[f64; 2]>) -> HostNodes {
        HostNodes { velocity: vec![[0.0; 2]; position.len()], position, ..HostNodes::default() }
    }

    /// The same nodes with rotations, zero and at rest.
    pub fn with_rotations(self) -> HostNodes {
        let none = vec![0.0; self.position.len()];
        HostNodes { rotation: none.clone(), spin: none, ..self }
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// True when there is none.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// As many finite values as there are nodes.
    pub(super) fn check(&self, nodes: usize, rotations: bool, time: f64) -> Result<(), HostError> {
        let turning = if rotations { nodes } else { 0 };
        let lengths = [
            ("positions", self.position.len(), nodes),
            ("velocities", self.velocity.len(), nodes),
            ("rotations", self.rotation.len(), turning),
            ("angular velocities", self.spin.len(), turning),
        ];
        for (array, given, expected) in lengths {
            if given != expected {
                return Err(HostError::Length { array, given, expected });
            }
        }
        for node in 0..nodes {
            let pairs = [("position", self.position[node]), ("velocity", self.velocity[node])];
            let turns = self.rotation.get(node).zip(self.spin.get(node));
            let turns = turns.map(|(angle, spin)| ("rotation and angular velocity", [*angle, *spin]));
            for (quantity, value) in pairs.into_iter().chain(turns) {
                if !(value[0] + value[1]).is_finite() {
                    let (given, expected) = (format!("{value:?}"), "finite numbers".into());
                    return Err(HostError::Node { node, quantity, given, expected, time });
                }
            }
        }
        Ok(())
    }
}
