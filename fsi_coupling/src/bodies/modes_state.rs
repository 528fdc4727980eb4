//! What a body with modes does now, and the extremes of a run so far.

use serde::{Deserialize, Serialize};

/// Extremes of a body with modes so far.
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
