//! scenarios
pub mod report;
