//! The state of a flexible body.

use serde::{Deserialize, Serialize};
use sph_core::state_bytes::{StateError, expect_count};
use structure_fe::{Envelope, State};

/// Everything that a step changes.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct FlexibleState {
    pub nodes: State,
    /// Load of the fluid on the nodes: the mean over the step, and now.
    pub mean: Vec<[f64; 3]>,
    pub now: Vec<[f64; 3]>,
    /// Predicted positions of the boundary particles at the end of the last step [m]. The next step's velocities include the prediction's
    /// error, so that the fluid gets a path without jumps (CO16).
    pub predicted_positions: Vec<[f64; 2]>,
    /// Contact impulses on the nodes, which the next step applies.
    pub impulses: Vec<[f64; 3]>,
    /// Velocities of the nodes due to these impulses.
    pub impulse_velocities: Vec<[f64; 3]>,
    /// Length of the last step [s], as an estimate of the step that applies the impulses.
    pub dt: f64,
    /// Resultant force of the fluid now [N/m], and its moment about the tank's origin [N].
    pub force: [f64; 3],
    pub external: [f64; 2],
    pub work: f64,
    pub support: f64,
    pub dissipated: f64,
    /// Extremes of the panels' loads so far.
    pub envelope: Envelope,
}

impl FlexibleState {
    /// At the start.
    pub fn new(nodes: State, envelope: Envelope) -> FlexibleState {
        let still = vec![[0.0; 3]; nodes.displacement.len()];
        FlexibleState {
            nodes,
            mean: still.clone(),
            now: still.clone(),
            predicted_positions: Vec::new(),
            impulses: still.clone(),
            impulse_velocities: still,
            dt: 0.0,
            force: [0.0; 3],
            external: [0.0; 2],
            work: 0.0,
            support: 0.0,
            dissipated: 0.0,
            envelope,
        }
    }
}

impl FlexibleState {
    /// An error unless there are as many nodes and elements as in `like`, and `particles` of the boundary, or none.
    pub fn check(&self, like: &FlexibleState, particles: usize) -> Result<(), StateError> {
        let (nodes, n) = (&self.nodes, like.mean.len());
        let moving = [&nodes.displacement, &nodes.velocity, &nodes.acceleration, &nodes.integrated_acceleration];
        let loads = [&nodes.mean_reaction, &self.mean, &self.now, &self.impulses, &self.impulse_velocities];
        for field in moving.into_iter().chain(loads) {
            expect_count("nodes", field.len(), n)?;
        }
        let (found, expected) = (nodes.plastic.len(), like.nodes.plastic.len());
        expect_count("elements that yield", found, expected)?;
        expect_count("ruptures of nodes", nodes.ruptures.iter().filter(|r| r.node < n).count(), nodes.ruptures.len())?;
        expect_count("element ends", self.envelope.ends.len(), like.envelope.ends.len())?;
        expect_count("nodes", self.envelope.displacement.len(), like.envelope.displacement.len())?;
        match self.predicted_positions.len() {
            0 => Ok(()),
            found => expect_count("boundary particles", found, particles),
        }
    }
}
