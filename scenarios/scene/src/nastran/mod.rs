//! Nastran bulk data: plane beam models in and out.
//!
//! [`cards`] splits a text into cards and writes them, [`model`] is what cards of a beam model say, [`chain`] a line of bars in a plane
//! with its properties per metre of span. Format: MSC Nastran Quick Reference Guide, bulk data entries.

mod axes;
pub mod cards;
pub mod chain;
mod field;
pub mod model;
mod pbeam;
mod read;
mod sections;
mod supports;
mod write;

pub use axes::Axes;
pub use supports::Held;

/// What is wrong with a line of a bulk data file.
#[derive(Debug, Clone, PartialEq)]
pub struct CardError {
    /// Line, from 1.
    pub line: usize,
    /// What stands there.
    pub given: String,
    /// What is expected.
    pub expected: String,
}

impl CardError {
    fn new(line: usize, given: impl Into<String>, expected: impl Into<String>) -> CardError {
        CardError { line, given: given.into(), expected: expected.into() }
    }
}
