//! What a modal structure is made of, and its motion.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

/// The rigid frame of a structure.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Mass \[kg/m\], without that of the nodes.
    pub mass: f64,
    /// Moment of inertia about its centre of mass \[kg m²/m\].
    pub inertia: f64,
    /// Centre of mass from the frame's origin, in its axes \[m\].
    pub center_of_mass: [f64; 2],
    /// Which of x, y, rotation do not follow the loads: a guide holds them, or a motion is prescribed.
    pub held: [bool; 3],
}

/// A natural mode of a structure whose frame is at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalMode {
    /// Natural frequency \[Hz\].
    pub frequency: f64,
    /// Generalised mass \[kg/m\].
    pub mass: f64,
    /// Damping over the critical one \[-\].
    pub damping_ratio: f64,
    /// Displacement and rotation of the nodes at unit amplitude, in the frame's axes: `[nodes][u, v, turn]`.
    pub shape: Vec<[f64; 3]>,
}

/// Motion of a modal structure. From a copy of it a rejected step can be repeated with the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModalState {
    /// The frame: x, y of its origin \[m\] and its angle \[rad\].
    pub frame: [f64; 3],
    /// Amplitudes of the modes.
    pub amplitude: Vec<f64>,
    /// Velocities of the unknowns: x, y, rotation, amplitudes.
    pub velocity: Vec<f64>,
    /// Their accelerations.
    pub acceleration: Vec<f64>,
    /// Time \[s\].
    pub time: f64,
}

impl ModalMode {
    /// m ω² \[N/m²\].
    pub fn stiffness(&self) -> f64 {
        self.mass * (TAU * self.frequency).powi(2)
    }

    /// 2 ζ m ω \[N s/m²\].
    pub fn damping(&self) -> f64 {
        2.0 * self.damping_ratio * self.mass * TAU * self.frequency
    }
}

/// A vector turned by an angle [rad].
pub(super) fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}
