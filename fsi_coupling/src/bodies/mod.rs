//! Bodies in the water: the contract ([`body`]), and a rigid body, a body with prescribed motion, a flexible body and a tank.

pub mod beam_surface;
pub mod body;
pub mod error;
pub mod flexible;
pub mod prescribed;
pub mod rigid;
pub mod rigid_interface;
pub mod rigid_motion;
pub mod rigid_surface;
pub mod state;
pub mod tank;
