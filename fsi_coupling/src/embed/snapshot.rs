//! What an element looks like: plain data, for plots and logs.

use serde::{Deserialize, Serialize};

use super::nodes::HostNodes;

/// The water and the surface at one instant. Particles in the order of their identity, the same at every instant.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    /// Time [s].
    pub time: f64,
    /// Positions of the water's particles [m].
    pub position: Vec<[f64; 2]>,
    /// Their velocities [m/s].
    pub velocity: Vec<[f64; 2]>,
    /// Their pressures [Pa].
    pub pressure: Vec<f64>,
    /// Their spacings √(m/ρ₀) [m].
    pub spacing: Vec<f64>,
    /// The nodes' surfaces, each a closed line [m].
    pub surface: Vec<Vec<[f64; 2]>>,
    /// The nodes.
    pub nodes: HostNodes,
    /// Forces of the water on the nodes now, `[F_x, F_y, M]` [N/m, N/m, N].
    pub force: Vec<[f64; 3]>,
}
