//! Waves of small height on water of constant depth, and the piston that makes them.

pub mod floating;
pub mod incident_wave;
pub mod linear_wave;
pub mod piston_motion;
pub mod separation;
