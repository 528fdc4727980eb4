//! The state of a body with modes, and what it reports.

use serde::{Deserialize, Serialize};

use sph_core::state_bytes::{StateError, expect_count};
use structure_fe::modal::ModalState;

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

/// What a body with modes has borne so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ModalExtremes {
    /// Largest amplitude of each mode, by magnitude, and its time [s].
    pub amplitude: Vec<[f64; 2]>,
    /// At each node: largest displacement against the frame [m], and its time [s].
    pub displacement: Vec<[f64; 2]>,
    /// At each node: largest stress by magnitude [Pa], and its time [s]; empty where the modes have none.
    pub stress: Vec<[f64; 2]>,
}

/// Modes of a body now.
#[derive(Clone, Debug, PartialEq)]
pub struct ModesState {
    /// Amplitudes.
    pub amplitude: Vec<f64>,
    /// Displacements of the nodes against the frame, in its axes [m].
    pub displacement: Vec<[f64; 2]>,
    /// Stress at the nodes [Pa]; empty where the modes have none.
    pub stress: Vec<f64>,
    /// Load of the fluid on the nodes, in the frame's axes `[F_x, F_y, M]` [N/m, N/m, N].
    pub load: Vec<[f64; 3]>,
    /// What was largest so far.
    pub extremes: ModalExtremes,
}

impl ModesState {
    /// Largest stress at a node, by magnitude [Pa]; 0 where none is known.
    pub fn largest_stress(&self) -> f64 {
        self.stress.iter().fold(0.0, |most, stress| if stress.abs() > f64::abs(most) { *stress } else { most })
    }
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

impl ModalExtremes {
    /// Keep what is larger now, at a time [s].
    pub(crate) fn record(&mut self, amplitude: &[f64], displacement: &[[f64; 2]], stress: &[f64], time: f64) {
        let keep = |most: &mut [[f64; 2]], now: &mut dyn Iterator<Item = f64>| {
            for (most, value) in most.iter_mut().zip(now) {
                if value.abs() > most[0].abs() {
                    *most = [value, time];
                }
            }
        };
        keep(&mut self.amplitude, &mut amplitude.iter().copied());
        keep(&mut self.displacement, &mut displacement.iter().map(|[u, v]| u.hypot(*v)));
        keep(&mut self.stress, &mut stress.iter().copied());
    }
}
