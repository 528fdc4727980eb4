//! Errors of the embedding element: which key, node or particle, where, when.

use sph_core::StateError;

use crate::bodies::error::BodyError;
use crate::coupling::error::CouplingError;

/// Bad input, or a step that failed. Nothing of the element has changed when a step's input is refused; after
/// [`HostError::Step`] the element waits for `restore`.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HostError {
    /// A value of the specification.
    #[error("`{key}` = {given}: expected {expected}")]
    Value {
        /// Which value.
        key: &'static str,
        /// What was given.
        given: String,
        /// What is possible.
        expected: String,
    },
    /// The wet surface.
    #[error("topology, {place}: given {given}, expected {expected}")]
    Topology {
        /// Which node or surface.
        place: String,
        /// What was given.
        given: String,
        /// What is possible.
        expected: String,
    },
    /// The shape that the surfaces enclose.
    #[error("topology: {0}")]
    Shape(BodyError),
    /// The water at the start.
    #[error("the water cannot be built: {0}")]
    Build(CouplingError),
    /// An array of the host's of the wrong length.
    #[error("{array}: given {given} values, expected {expected}, one for each node")]
    Length {
        /// Which array.
        array: &'static str,
        /// Its length.
        given: usize,
        /// The number of nodes.
        expected: usize,
    },
    /// A node's motion.
    #[error("node {node} at t = {time:.6e} s: {quantity} {given}, expected {expected}")]
    Node {
        /// Which node.
        node: usize,
        /// What about it.
        quantity: &'static str,
        /// What was given.
        given: String,
        /// What is possible.
        expected: String,
        /// End of the step [s].
        time: f64,
    },
    /// The host's step.
    #[error("step of {given} s at t = {time:.6e} s, expected {expected}")]
    Duration {
        /// What was given [s].
        given: f64,
        /// What is possible.
        expected: String,
        /// Its start [s].
        time: f64,
    },
    /// The water, or the nodes' surface, broke down within a step.
    #[error("in the step from t = {start:.6e} s, {fluid_steps} fluid steps on{near}: {cause}", near = near(*.node))]
    Step {
        /// Which particle or place, where, when.
        cause: CouplingError,
        /// The node nearest to it, where the cause has a place.
        node: Option<usize>,
        /// Start of the host's step [s].
        start: f64,
        /// Steps that the water took before.
        fluid_steps: u32,
    },
    /// The step before failed, and the element was not restored.
    #[error("the element failed ({0}); restore() a saved state first")]
    Failed(String),
    /// Bytes that are not a state of this element; it has failed.
    #[error(transparent)]
    State(#[from] StateError),
    /// Nothing was saved.
    #[error("restore: given no saved state, expected a save() before")]
    NothingSaved,
}

fn near(node: Option<usize>) -> String {
    node.map_or(String::new(), |node| format!(", nearest node {node}"))
}
