//! Everything that a step of a body with modes changes.

use serde::{Deserialize, Serialize};
use sph_core::state_bytes::{StateError, expect_count};
use structure_fe::modal::ModalState;

use crate::bodies::modes_state::ModalExtremes;

/// Everything that a step changes.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct ModalBodyState {
    pub motion: ModalState,
    /// Displacements, velocities and accelerations of the nodes, the frame last.
    pub displacement: Vec<[f64; 3]>,
    pub velocity: Vec<[f64; 3]>,
    pub acceleration: Vec<[f64; 3]>,
    /// Load of the fluid on the nodes: the mean over the step, and now.
    pub mean: Vec<[f64; 3]>,
    pub now: Vec<[f64; 3]>,
    /// Predicted positions of the boundary particles at the end of the last step [m] (CO16).
    pub predicted_positions: Vec<[f64; 2]>,
    /// Contact impulses on the nodes, which the next step applies, and the velocities due to them.
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
    pub extremes: ModalExtremes,
}

impl ModalBodyState {
    /// At the start.
    pub fn new(motion: ModalState, nodes: usize, with_stress: bool) -> ModalBodyState {
        let (still, none) = (vec![[0.0; 3]; nodes + 1], |n: usize| vec![[0.0; 2]; n]);
        let extremes = ModalExtremes {
            amplitude: none(motion.amplitude.len()),
            displacement: none(nodes),
            stress: none(if with_stress { nodes } else { 0 }),
        };
        ModalBodyState {
            motion,
            displacement: still.clone(),
            velocity: still.clone(),
            acceleration: still.clone(),
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

    /// An error unless there are as many unknowns and nodes as in `like`, and `particles` of the boundary, or none.
    pub fn check(&self, like: &ModalBodyState, particles: usize) -> Result<(), StateError> {
        let unknowns = like.motion.velocity.len();
        expect_count("modes", self.motion.amplitude.len(), like.motion.amplitude.len())?;
        expect_count("modes", self.extremes.amplitude.len(), like.extremes.amplitude.len())?;
        expect_count("unknowns", self.motion.velocity.len(), unknowns)?;
        expect_count("unknowns", self.motion.acceleration.len(), unknowns)?;
        let fields = [&self.displacement, &self.velocity, &self.acceleration, &self.mean, &self.now];
        for field in fields.into_iter().chain([&self.impulses, &self.impulse_velocities]) {
            expect_count("nodes", field.len(), like.mean.len())?;
        }
        expect_count("nodes", self.extremes.displacement.len(), like.extremes.displacement.len())?;
        expect_count("stresses", self.extremes.stress.len(), like.extremes.stress.len())?;
        match self.predicted_positions.len() {
            0 => Ok(()),
            found => expect_count("boundary particles", found, particles),
        }
    }
}
