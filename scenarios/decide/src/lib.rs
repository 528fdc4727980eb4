//! From numbers to decisions: many runs of one scene in this process, and what follows from them.
//!
//! [`Evaluator`] runs a scene with other values of its keys and keeps each answer. [`size`] finds the smallest value of a key with which results
//! stay allowed, [`fit`] the values with which a scene gives measured curves, [`scatter`] what a spread of inputs makes of the results.

pub mod evaluate;
pub mod fit;
pub mod latin_hypercube;
pub mod numbers;
pub mod scatter;
pub mod size;

pub use evaluate::{Answer, EvaluateError, Evaluator};
pub use numbers::Number;
