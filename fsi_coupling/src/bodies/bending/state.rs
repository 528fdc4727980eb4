//! The state of a body that bends.

use serde::{Deserialize, Serialize};
use sph_core::state_bytes::{StateError, expect_count};

/// Everything that a step changes. Stored runs hold its fields in this order.
#[derive(Clone, Serialize, Deserialize)]
pub struct BendingState<M, E> {
    pub motion: M,
    /// Load of the fluid on the nodes: the mean over the step, and now.
    pub mean: Vec<[f64; 3]>,
    pub now: Vec<[f64; 3]>,
    /// Predicted positions of the boundary particles at the end of the last step [m]. The next step's velocities include the prediction's
    /// error, so that the fluid gets a path without jumps (CO16).
    pub predicted_positions: Vec<[f64; 2]>,
    /// Contact impulses on the nodes, which the next step applies, and the velocities of the nodes due to them.
    pub impulses: Vec<[f64; 3]>,
    pub impulse_velocities: Vec<[f64; 3]>,
    /// Length of the last step [s], as an estimate of the step that applies the impulses.
    pub dt: f64,
    /// Resultant force of the fluid now [N/m], and its moment about the tank's origin [N].
    pub force: [f64; 3],
    pub external: [f64; 2],
    pub work: f64,
    pub support: f64,
    pub dissipated: f64,
    /// What was largest so far.
    pub extremes: E,
}

impl<M, E> BendingState<M, E> {
    /// Without load, of a number of nodes.
    pub fn new(motion: M, nodes: usize, extremes: E) -> BendingState<M, E> {
        let still = vec![[0.0; 3]; nodes];
        BendingState {
            motion,
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
            extremes,
        }
    }

    /// An error unless there are as many nodes as in `like`, and `particles` of the boundary, or none.
    pub fn check(&self, like: &BendingState<M, E>, particles: usize) -> Result<(), StateError> {
        for field in [&self.mean, &self.now, &self.impulses, &self.impulse_velocities] {
            expect_count("nodes", field.len(), like.mean.len())?;
        }
        match self.predicted_positions.len() {
            0 => Ok(()),
            found => expect_count("boundary particles", found, particles),
        }
    }
}
