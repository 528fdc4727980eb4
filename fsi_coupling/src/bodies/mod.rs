//! Bodies in the water: the contract, and the bodies that keep it.

pub mod beam_surface;
pub mod body;
pub mod flexible;
pub mod prescribed;
pub mod rigid;
pub mod rigid_interface;
pub mod rigid_motion;
pub mod tank;
