//! Extremes of a modal structure over a run.

use fsi_coupling::ModesState;
use scene::Modes;
use serde::Serialize;

/// Extremes of a structure by its modes over every step.
#[derive(Clone, Debug, Serialize)]
pub struct ModesResult {
    /// Natural frequencies [Hz].
    pub frequency_hz: Vec<f64>,
    /// Largest amplitude of each mode, with its sign [m].
    pub peak_amplitude_m: Vec<f64>,
    /// Their times [s].
    pub time_of_peak_amplitude_s: Vec<f64>,
    /// Amplitudes at the end of the run [m].
    pub amplitude_at_end_m: Vec<f64>,
    /// Nodes x, y at rest, body's frame [m].
    pub node_m: Vec<[f64; 2]>,
    /// Largest displacement of each node against the rest of the body [m].
    pub peak_displacement_m: Vec<f64>,
    /// Their times [s].
    pub time_of_peak_displacement_s: Vec<f64>,
    /// Largest stress of each node by magnitude, with its sign [Pa]; absent where the modes have none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub peak_stress_pa: Vec<f64>,
    /// Their times [s].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub time_of_peak_stress_s: Vec<f64>,
}

impl ModesResult {
    /// Of modes and what they have done so far.
    pub fn new(modal: &Modes, state: &ModesState) -> ModesResult {
        let column = |rows: &[[f64; 2]], k: usize| rows.iter().map(|row| row[k]).collect();
        let most = &state.extremes;
        ModesResult {
            frequency_hz: modal.modes.iter().map(|mode| mode.frequency).collect(),
            peak_amplitude_m: column(&most.amplitude, 0),
            time_of_peak_amplitude_s: column(&most.amplitude, 1),
            amplitude_at_end_m: state.amplitude.clone(),
            node_m: modal.nodes.clone(),
            peak_displacement_m: column(&most.displacement, 0),
            time_of_peak_displacement_s: column(&most.displacement, 1),
            peak_stress_pa: column(&most.stress, 0),
            time_of_peak_stress_s: column(&most.stress, 1),
        }
    }
}
