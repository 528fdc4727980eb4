//! scenarios

pub mod log;
