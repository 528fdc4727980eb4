//! What bodies that bend share, whether by finite elements or by modes: the rigid frame, and the surface that follows the nodes (THEORY CO13–CO17).

pub(crate) mod beam_surface;
pub(crate) mod bending_surface;
mod deformed_outline;
pub mod frame;
pub(crate) mod surface_layout;
pub(crate) mod surface_map;
pub mod surface_mode;
