//! scenarios

pub mod scene;
