//! A structure by its natural modes, on a rigid frame that moves (THEORY BE28, BE29).
//!
//! Frequencies, generalised masses and shapes come from any finite-element program; a file of them is all that this model needs. Its
//! unknowns are x, y and the rotation of the frame, and an amplitude for each mode. A free mass of 3 kg/m with one of 1 kg/m on a spring:
//!
//! ```
//! use structure_fe::modal::{Frame, ModalMode, ModalStructure, Step};
//!
//! let frame = Frame { mass: 3.0, inertia: 1.0, center_of_mass: [0.0; 2], held: [true, false, true] };
//! let mode = ModalMode { frequency: 10.0, mass: 1.0, damping_ratio: 0.0, shape: vec![[0.0, 1.0, 0.0]] };
//! let structure = ModalStructure::new(frame, vec![[0.0; 2]], vec![1.0], vec![mode])?;
//! let mut state = structure.at_rest([0.0; 2], 0.0);
//! state.amplitude[0] = 0.01;
//! for _ in 0..1000 {
//!     structure.step(&mut state, &[0.0; 4], &Step { dt: 1e-4, gravity: [0.0; 2], frame: None })?;
//! }
//! let momentum = structure.momentum(&state)[1];
//! assert!(momentum.abs() < 1e-14, "none came from outside: {momentum}");
//! // a period lasts √(3/4) of that of the mode alone
//! let phase = std::f64::consts::TAU * 10.0 * (4.0_f64 / 3.0).sqrt() * state.time;
//! assert!((state.amplitude[0] - 0.01 * phase.cos()).abs() < 1e-6);
//! # Ok::<(), structure_fe::Error>(())
//! ```

mod inertia;
mod mode;
mod step;
mod structure;

pub use mode::{Frame, ModalMode, ModalState};
pub use step::{Step, StepOutcome};
pub use structure::ModalStructure;
