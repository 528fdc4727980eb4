//! A body whose surface bends: panels of beam elements on a rigid frame (THEORY CO13–CO17).

pub mod body;
mod deformed_outline;
pub mod interface;
pub mod model;
pub mod panel;
pub mod panel_state;
mod state;
pub mod surface_map;
pub mod wet_period;
