//! A body whose surface bends: panels of beam elements on a rigid frame (THEORY CO13–CO17).

pub mod body;
pub mod interface;
pub mod model;
pub mod panel;
pub mod panel_modes;
pub mod panel_state;
pub mod wet_period;
