//! What bodies that bend share, whether by finite elements or by modes: the body with its rigid frame and state, the surface that follows the
//! nodes, the interface to coupling schemes (THEORY CO13–CO18).

pub(crate) mod beam_surface;
pub(crate) mod bending_surface;
pub mod body;
mod deformed_outline;
pub mod frame;
pub(crate) mod interface;
pub(crate) mod model;
pub(crate) mod state;
pub(crate) mod surface_layout;
pub(crate) mod surface_map;
pub mod surface_mode;
