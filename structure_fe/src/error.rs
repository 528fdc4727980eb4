//! What can be wrong with a model, a support set or a load.

use crate::field::Dof;
use thiserror::Error;

/// Why a model cannot be built, factorised or solved. Every variant carries the numbers of its message, which names them;
/// an `index` counts items in the order given.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the message of a variant names its fields")]
pub enum Error {
    /// The connectivity is empty.
    #[error("the model has {nodes} nodes and no elements; it must have at least one element")]
    NoElements { nodes: usize },
    /// An element, a support or a load names a node that does not exist.
    #[error("{item} {index} refers to node {node}, but the model has {nodes} nodes; the number must be below {nodes}")]
    NoSuchNode {
        /// What refers to the node: "element", "support", "spring" or "nodal load".
        item: &'static str,
        index: usize,
        node: usize,
        nodes: usize,
    },
    /// A distributed load, or an element option, names an element that does not exist.
    #[error(
        "{item} {index} is on element {element}, but the model has {elements} elements; the number must be below {elements}"
    )]
    NoSuchElement {
        /// What refers to the element: "distributed load", "pressure" or "theory".
        item: &'static str,
        index: usize,
        element: usize,
        elements: usize,
    },
    /// A node belongs to no element, so it has neither stiffness nor mass.
    #[error("node {node} belongs to no element; each node must be the end of an element, or be removed")]
    UnattachedNode { node: usize },
    /// The two nodes of an element coincide.
    #[error(
        "element {element} between nodes {} and {} has the length {length} m; \
         it must be longer than 1e-12 of the extent of the model, {extent} m",
        nodes[0], nodes[1]
    )]
    ZeroLengthElement { element: usize, nodes: [usize; 2], length: f64, extent: f64 },
    /// A property of an element, a support or a load is outside its range.
    #[error("{quantity} of {item} {index} is {value}; it must be {expected}")]
    BadProperty {
        quantity: &'static str,
        /// What has it: "element", "spring", "node", ...
        item: &'static str,
        index: usize,
        value: f64,
        expected: &'static str,
    },
    /// A property of the whole model or of an analysis is outside its range.
    #[error("{quantity} is {value}; it must lie in {expected}")]
    OutOfRange { quantity: &'static str, value: f64, expected: &'static str },
    /// A field over the nodes, or a block of added mass, has another number of entries than its nodes require.
    #[error("{quantity} has {given} entries; it must have {expected}")]
    WrongLength { quantity: &'static str, given: usize, expected: usize },
    /// A hinge, weld, rigid link or breakable joint contradicts another part of the model.
    #[error("{item} {index} at node {node}: {reason}")]
    BadJoint {
        /// What is wrong: "hinge", "rigid link", "connector" or "breakable joint".
        item: &'static str,
        index: usize,
        node: usize,
        reason: &'static str,
    },
    /// The two nodes of a hinge or a weld are not at the same place.
    #[error("hinge {hinge} joins nodes {} and {}, which are {gap} m apart; they must be at the same place", nodes[0], nodes[1])]
    HingeGap { hinge: usize, nodes: [usize; 2], gap: f64 },
    /// A motion is prescribed where there is no support.
    #[error("a motion is prescribed for {dof} of node {node}, which is not fixed; fix it first")]
    NotSupported { node: usize, dof: Dof },
    /// A rigid body without mass, or moment of inertia, that is free to move.
    #[error(
        "the rigid body at node {node} has {quantity} = {value}, but {dof} is free; it must be above 0, or {dof} fixed"
    )]
    MasslessBody { node: usize, dof: Dof, quantity: &'static str, value: f64 },
    /// The model has a feature that the analysis does not support.
    #[error("{analysis} does not support {feature} ({item} {index}); use {instead}")]
    Unsupported {
        analysis: &'static str,
        /// The feature: "rigid bodies", "connectors", "plasticity" or "rupture".
        feature: &'static str,
        /// What has the feature: "element" or "node".
        item: &'static str,
        index: usize,
        instead: &'static str,
    },
    /// The stiffness matrix is not positive definite, because the supports leave a rigid motion free.
    #[error(
        "under-supported: the part of the model that contains node {node} is a mechanism, \
         free to move there by u = {:.3} m, w = {:.3} m, theta = {:.3} rad; add supports or springs against this motion",
        motion[0], motion[1], motion[2]
    )]
    UnderSupported {
        node: usize,
        /// The free rigid motion at that node, `[u, w, theta]` \[m, m, rad\], of arbitrary size.
        motion: [f64; 3],
    },
    /// The factorisation lost positive definiteness to rounding, although the supports suffice.
    #[error(
        "ill-conditioned: the stiffness matrix lost positive definiteness at pivot {pivot} of {unknowns}; \
         use fewer elements along a beam, or stiffnesses closer to each other"
    )]
    NotPositiveDefinite { pivot: usize, unknowns: usize },
    /// Iterative refinement did not converge: the condition number exceeds the digits of the factorisation.
    #[error(
        "ill-conditioned: with {unknowns} unknowns the solution still changes by {change:.1e} in the \
         energy norm after {refinements} refinements; use fewer elements along a beam, or stiffnesses \
         closer to each other"
    )]
    IllConditioned { unknowns: usize, refinements: usize, change: f64 },
    /// A new stiffness was given for a model of another connectivity; `element` is the first that differs, or the smaller number.
    #[error("element {element} connects other nodes than in the model of the factorisation; it must connect the same")]
    OtherConnectivity { element: usize },
    /// The end of an element has rotated against its chord beyond the range of the shape functions.
    #[error(
        "element {element} is bent by {rotation:.2} rad against its chord, more than {limit} rad: use more elements, \
         or a smaller load"
    )]
    BentTooFar {
        element: usize,
        /// The larger of its ends' rotations against the chord \[rad\].
        rotation: f64,
        limit: f64,
    },
    /// The tangent stiffness has no inverse: a mechanism, or exactly a limit or bifurcation point.
    #[error(
        "the tangent stiffness is singular at {dof} of node {node}: the model is a mechanism there, \
         or stands at a limit point; add supports, or follow the path by the arc length"
    )]
    SingularTangent { node: usize, dof: Dof },
    /// Newton's method did not converge in a load step.
    #[error(
        "load step {step}, factor {load_factor}: not converged after {iteration} iterations, residual \
         {residual:.3e} N at {dof} of node {node}; use more load steps, or the arc length where a load has a peak"
    )]
    NotConverged {
        step: usize,
        iteration: usize,
        /// Largest residual, moments over the model's extent \[N\].
        residual: f64,
        load_factor: f64,
        node: usize,
        dof: Dof,
    },
    /// Newton's method did not converge in a time step.
    #[error(
        "time step {dt:e} s from t = {time} s: not converged after {iteration} iterations, residual {residual:.3e} N \
         at {dof} of node {node}; use a smaller step"
    )]
    StepNotConverged {
        time: f64,
        dt: f64,
        iteration: usize,
        /// Largest residual, moments over the model's extent \[N\].
        residual: f64,
        node: usize,
        dof: Dof,
    },
    /// A factorisation failed for a reason other than the model.
    #[error("linear algebra with {unknowns} unknowns failed: {reason}")]
    LinearAlgebra { unknowns: usize, reason: String },
}

/// `value` if it is positive and finite.
pub(crate) fn positive(quantity: &'static str, item: &'static str, index: usize, value: f64) -> Result<f64, Error> {
    let expected = "positive and finite";
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(Error::BadProperty { quantity, item, index, value, expected })
    }
}

/// Ok if a `value` of the whole model or of an analysis is valid.
pub(crate) fn require(valid: bool, quantity: &'static str, value: f64, expected: &'static str) -> Result<(), Error> {
    if valid { Ok(()) } else { Err(Error::OutOfRange { quantity, value, expected }) }
}

/// Ok if a `value` of the whole model or of an analysis is positive.
pub(crate) fn above_zero(quantity: &'static str, value: f64) -> Result<(), Error> {
    require(value > 0.0 && value.is_finite(), quantity, value, "(0, infinity)")
}

/// Ok if a `value` of the whole model or of an analysis is not negative.
pub(crate) fn not_negative(quantity: &'static str, value: f64) -> Result<(), Error> {
    require(value >= 0.0 && value.is_finite(), quantity, value, "[0, infinity)")
}

/// Ok if all `values` are finite, else the error with the first that is not.
pub(crate) fn finite(quantity: &'static str, item: &'static str, index: usize, values: &[f64]) -> Result<(), Error> {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(&value) => Err(Error::BadProperty { quantity, item, index, value, expected: "finite" }),
    }
}

/// Ok if `node` is one of `nodes` nodes.
pub(crate) fn existing_node(item: &'static str, index: usize, node: usize, nodes: usize) -> Result<(), Error> {
    if node < nodes { Ok(()) } else { Err(Error::NoSuchNode { item, index, node, nodes }) }
}

/// Ok if `element` is one of `elements` elements.
pub(crate) fn existing_element(item: &'static str, index: usize, element: usize, elements: usize) -> Result<(), Error> {
    if element < elements { Ok(()) } else { Err(Error::NoSuchElement { item, index, element, elements }) }
}
