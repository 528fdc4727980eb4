//! The host's nodes at one instant, and how they move within a step of the host (THEORY CO29).

use serde::{Deserialize, Serialize};

use sph_core::state_bytes::{StateError, expect_count};

use super::error::HostError;
use crate::geometry::hermite::{hermite, hermite_rate};

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

/// A smooth path of all nodes from one instant to the next.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Path {
    start: HostNodes,
    end: HostNodes,
    duration: f64,
}

impl Path {
    /// Nodes that stay where they are, and keep their velocities: before the first step.
    pub fn resting(nodes: &HostNodes) -> Path {
        Path { start: nodes.clone(), end: nodes.clone(), duration: 0.0 }
    }

    /// From where this path ends to `end`, `duration` [s] later.
    pub fn onward(&self, end: &HostNodes, duration: f64) -> Path {
        Path { start: self.end.clone(), end: end.clone(), duration }
    }

    /// An error unless its nodes are as many as those of `like`, with rotations or without.
    pub fn check_like(&self, like: &Path) -> Result<(), StateError> {
        let lengths = |path: &Path| {
            [&path.start, &path.end].map(|at| [at.position.len(), at.velocity.len(), at.rotation.len(), at.spin.len()])
        };
        for (found, expected) in lengths(self).as_flattened().iter().zip(lengths(like).as_flattened()) {
            expect_count("nodes", *found, *expected)?;
        }
        Ok(())
    }

    /// Where it ends.
    pub fn end(&self) -> &HostNodes {
        &self.end
    }

    /// Length of the step [s].
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// CO29: the nodes `elapsed` [s] from the start of the step; the cubics go on beyond its ends.
    pub fn at(&self, elapsed: f64) -> HostNodes {
        let (a, b, duration) = (&self.start, &self.end, self.duration);
        if duration <= 0.0 {
            return b.clone();
        }
        let s = elapsed / duration;
        let (shape, slope) = (hermite(s, duration), hermite_rate(s, duration));
        let mix = |w: &[f64; 4], x0: f64, v0: f64, x1: f64, v1: f64| w[0] * x0 + w[1] * v0 + w[2] * x1 + w[3] * v1;
        let pairs = |w: &[f64; 4]| {
            let of =
                |n: usize, k: usize| mix(w, a.position[n][k], a.velocity[n][k], b.position[n][k], b.velocity[n][k]);
            (0..a.len()).map(|n| [of(n, 0), of(n, 1)]).collect()
        };
        let turns = |w: &[f64; 4]| {
            let of = |n: usize| mix(w, a.rotation[n], a.spin[n], b.rotation[n], b.spin[n]);
            (0..a.rotation.len()).map(of).collect()
        };
        HostNodes { position: pairs(&shape), velocity: pairs(&slope), rotation: turns(&shape), spin: turns(&slope) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A motion that is cubic in time is met exactly, with its velocity, inside the step and beyond it.
    #[test]
    fn a_cubic_motion_is_its_own_path() {
        let law = |t: f64| {
            let (x, v) = (1.0 - 2.0 * t + 3.0 * t * t - 0.5 * t * t * t, -2.0 + 6.0 * t - 1.5 * t * t);
            HostNodes {
                position: vec![[x, -2.0 * x]],
                velocity: vec![[v, -2.0 * v]],
                rotation: vec![0.3 * x],
                spin: vec![0.3 * v],
            }
        };
        let path = Path::resting(&law(0.4)).onward(&law(1.1), 0.7);
        for t in [0.4, 0.5, 0.83, 1.1, 1.2] {
            let (found, exact) = (path.at(t - 0.4), law(t));
            for (a, b) in [
                (found.position[0][0], exact.position[0][0]),
                (found.position[0][1], exact.position[0][1]),
                (found.velocity[0][1], exact.velocity[0][1]),
                (found.rotation[0], exact.rotation[0]),
                (found.spin[0], exact.spin[0]),
            ] {
                assert!((a - b).abs() < 1e-13, "t = {t}: {a} {b}");
            }
        }
        assert_eq!(path.at(0.7).position, law(1.1).position, "to the bit at its end");
    }
}
