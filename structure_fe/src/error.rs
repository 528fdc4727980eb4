//! What can be wrong with a model, a support set or a load.

use crate::supports::Dof;
use thiserror::Error;

/// Why a model cannot be built, factorised or solved. Every variant carries the numbers.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The connectivity is empty.
    #[error("the model has {nodes} nodes and no elements")]
    NoElements {
        /// Number of nodes given.
        nodes: usize,
    },
    /// An element, a support or a load names a node that does not exist.
    #[error("{item} {index} refers to node {node}, but the model has {nodes} nodes")]
    NoSuchNode {
        /// What refers to the node: "element", "support", "spring" or "nodal load".
        item: &'static str,
        /// Its index, in the order given.
        index: usize,
        /// The node asked for.
        node: usize,
        /// Number of nodes in the model.
        nodes: usize,
    },
    /// A distributed load, or a theory, names an element that does not exist.
    #[error("{item} {index} is on element {element}, but the model has {elements}")]
    NoSuchElement {
        /// What refers to the element: "distributed load", "pressure" or "theory".
        item: &'static str,
        /// Index of the load, in the order given.
        index: usize,
        /// The element asked for.
        element: usize,
        /// Number of elements in the model.
        elements: usize,
    },
    /// A node belongs to no element, so it has neither stiffness nor mass.
    #[error("node {node} belongs to no element")]
    UnattachedNode {
        /// The node.
        node: usize,
    },
    /// The two nodes of an element coincide.
    #[error(
        "element {element} between nodes {} and {} has no length: {length} m in a model of extent {extent} m",
        nodes[0], nodes[1]
    )]
    ZeroLengthElement {
        /// The element.
        element: usize,
        /// Its two nodes.
        nodes: [usize; 2],
        /// Its length \[m\].
        length: f64,
        /// Diagonal of the bounding box of the whole model \[m\].
        extent: f64,
    },
    /// A quantity that must be positive is zero, negative, infinite or not a number.
    #[error("{quantity} of {item} {index} is {value}; it must be positive and finite")]
    NotPositive {
        /// Name of the quantity, with its unit.
        quantity: &'static str,
        /// What has it: "element" or "spring".
        item: &'static str,
        /// Index of the item, in the order given.
        index: usize,
        /// The value given.
        value: f64,
    },
    /// Poisson's ratio outside the range of an isotropic elastic solid, -1 < nu <= 1/2.
    #[error("Poisson's ratio of element {element} is {value}; it must lie in (-1, 0.5]")]
    PoissonsRatio {
        /// The element.
        element: usize,
        /// The value given \[-\].
        value: f64,
    },
    /// A coordinate or a load is infinite or not a number.
    #[error("{quantity} {index} is {value}; it must be finite")]
    NotFinite {
        /// Name of the quantity, with its unit.
        quantity: &'static str,
        /// Its index, in the order given.
        index: usize,
        /// The value given.
        value: f64,
    },
    /// The stiffness matrix is not positive definite, because the supports leave a rigid motion free.
    #[error(
        "under-supported: the part of the model that contains node {node} is a mechanism, \
         free to move there by u = {:.3} m, w = {:.3} m, theta = {:.3} rad",
        motion[0], motion[1], motion[2]
    )]
    UnderSupported {
        /// First node of the part that is free to move.
        node: usize,
        /// The free rigid motion at that node, `[u, w, theta]` \[m, m, rad\], of arbitrary size.
        motion: [f64; 3],
    },
    /// The factorisation lost positive definiteness to rounding, although the supports suffice.
    #[error(
        "ill-conditioned: the stiffness matrix lost positive definiteness at pivot {pivot} of {unknowns}; \
         use fewer elements along a beam, or stiffnesses closer to each other"
    )]
    NotPositiveDefinite {
        /// The pivot that was not positive, in the order of elimination.
        pivot: usize,
        /// Number of unknowns.
        unknowns: usize,
    },
    /// Iterative refinement did not converge: rounding has eaten the factorisation.
    #[error(
        "ill-conditioned: with {unknowns} unknowns the solution still changes by {change:.1e} in the \
         energy norm after {refinements} refinements; use fewer elements along a beam, or stiffnesses \
         closer to each other"
    )]
    IllConditioned {
        /// Number of unknowns.
        unknowns: usize,
        /// Refinements made.
        refinements: usize,
        /// Last change of the solution relative to itself \[-\].
        change: f64,
    },
    /// A new stiffness was given for a model of another connectivity.
    #[error("element {element} connects other nodes than when the stiffness was analysed")]
    OtherConnectivity {
        /// First element that differs, or the smaller number of elements if one model has more.
        element: usize,
    },
    /// The two nodes of a hinge are not at the same place.
    #[error("hinge {hinge} ties nodes {} and {}, which are {gap} m apart; they must be at the same place", nodes[0], nodes[1])]
    HingeGap {
        /// Index of the hinge, in the order given.
        hinge: usize,
        /// Its two nodes.
        nodes: [usize; 2],
        /// Their distance \[m\].
        gap: f64,
    },
    /// A number outside the range in which it makes sense.
    #[error("{quantity} is {value}; it must lie in {expected}")]
    OutOfRange {
        /// Name of the quantity, with its unit.
        quantity: &'static str,
        /// The value given.
        value: f64,
        /// The range, in words.
        expected: &'static str,
    },
    /// A motion is prescribed where there is no support.
    #[error("a motion is prescribed for {dof} of node {node}, which is not fixed; fix it first")]
    NotSupported {
        /// The node.
        node: usize,
        /// The degree of freedom.
        dof: Dof,
    },
    /// A field over the nodes has not one entry per node.
    #[error("{quantity} has {given} entries, but the model has {nodes} nodes")]
    WrongLength {
        /// The field.
        quantity: &'static str,
        /// Its number of entries.
        given: usize,
        /// Number of nodes in the model.
        nodes: usize,
    },
    /// An element's end has turned against its chord beyond what its shapes describe.
    #[error(
        "element {element} is bent by {rotation:.2} rad against its chord, more than {limit} rad: take more elements, \
         or a smaller load"
    )]
    BentTooFar {
        /// The element.
        element: usize,
        /// The larger of its ends' rotations against the chord \[rad\].
        rotation: f64,
        /// The limit \[rad\].
        limit: f64,
    },
    /// The tangent stiffness has no inverse: a mechanism, or exactly a limit or bifurcation point.
    #[error(
        "the tangent stiffness is singular at {dof} of node {node}: the model is a mechanism there, \
         or stands at a limit point"
    )]
    SingularTangent {
        /// The node.
        node: usize,
        /// The degree of freedom.
        dof: Dof,
    },
    /// Newton's iteration of a load step did not converge.
    #[error(
        "load step {step}, factor {load_factor}: not converged after {iteration} iterations, residual \
         {residual:.3e} N at {dof} of node {node}; take more load steps, or the arc length where a load has a peak"
    )]
    NotConverged {
        /// The load step, from 1.
        step: usize,
        /// Iterations made.
        iteration: usize,
        /// Largest residual, moments over the model's extent \[N\].
        residual: f64,
        /// The load as a fraction of the whole \[-\].
        load_factor: f64,
        /// Where it is.
        node: usize,
        /// Its degree of freedom.
        dof: Dof,
    },
    /// Newton's iteration of a time step did not converge.
    #[error(
        "time step {dt:e} s from t = {time} s: not converged after {iteration} iterations, residual {residual:.3e} N \
         at {dof} of node {node}; take a smaller step"
    )]
    StepNotConverged {
        /// Time at the start of the step \[s\].
        time: f64,
        /// The step \[s\].
        dt: f64,
        /// Iterations made.
        iteration: usize,
        /// Largest residual, moments over the model's extent \[N\].
        residual: f64,
        /// Where it is.
        node: usize,
        /// Its degree of freedom.
        dof: Dof,
    },
    /// A tie between a node and a rigid body contradicts something else.
    #[error("tie {tie} of node {node} to body {body}: {reason}")]
    BadTie {
        /// Index of the tie, in the order given.
        tie: usize,
        /// The body's node.
        body: usize,
        /// The node that should follow it.
        node: usize,
        /// What is wrong.
        reason: &'static str,
    },
    /// A hinge at the node of a rigid body.
    #[error("hinge {hinge} joins nodes {} and {}, of which one is a rigid body; tie the other to it, pinned", nodes[0], nodes[1])]
    HingedBody {
        /// Index of the hinge, in the order given.
        hinge: usize,
        /// Its two nodes.
        nodes: [usize; 2],
    },
    /// A rigid body without mass, or moment of inertia, that is free to move.
    #[error(
        "the rigid body at node {node} has {quantity} = {value} in {dof}, in which it is free to move; give it some, or fix it"
    )]
    MasslessBody {
        /// The body's node.
        node: usize,
        /// The degree of freedom.
        dof: Dof,
        /// What it lacks, with its unit.
        quantity: &'static str,
        /// The value given.
        value: f64,
    },
    /// Rigid bodies are given to an integration that does not know them.
    #[error("{integration} does not move rigid bodies (node {node} is one); take Integration::Trapezoidal")]
    NoRigidBodies {
        /// The integration.
        integration: &'static str,
        /// The first body's node.
        node: usize,
    },
    /// An element of Timoshenko's theory is to yield.
    #[error("element {element} is to yield in bending, which only Euler-Bernoulli's elements can")]
    PlasticTheory {
        /// The element.
        element: usize,
    },
    /// Elements that yield are given to an analysis that does not know them.
    #[error("{analysis} does not know elements that yield (element {element} is one); take {instead}")]
    NoPlasticity {
        /// The analysis.
        analysis: &'static str,
        /// The first element that yields.
        element: usize,
        /// What knows them.
        instead: &'static str,
    },
    /// A node that nothing holds is to break, or a rigid body.
    #[error(
        "breakable node {index} is node {node}, which has neither support, tie, weld nor hinge to break, or is a rigid body"
    )]
    NothingBreaks {
        /// Index, in the order given.
        index: usize,
        /// The node.
        node: usize,
    },
    /// Nodes that may break are given to an integration that does not know them.
    #[error("{integration} breaks nothing (node {node} may break); take Integration::Trapezoidal")]
    NoRupture {
        /// The integration.
        integration: &'static str,
        /// The first node that may break.
        node: usize,
    },
    /// A block of added mass has not the entries of its nodes.
    #[error("added mass {index} has {given} entries over {nodes} nodes; it must have (3 nodes)^2")]
    WrongBlock {
        /// Index of the block, in the order given.
        index: usize,
        /// Entries given.
        given: usize,
        /// Nodes given.
        nodes: usize,
    },
    /// The linear algebra failed for a reason that is not the model's.
    #[error("linear algebra with {unknowns} unknowns failed: {reason}")]
    LinearAlgebra {
        /// Number of unknowns.
        unknowns: usize,
        /// What the library said.
        reason: String,
    },
}

/// `value` if it is positive and finite, else the error that says so.
pub(crate) fn positive(quantity: &'static str, item: &'static str, index: usize, value: f64) -> Result<f64, Error> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(Error::NotPositive { quantity, item, index, value }) }
}

/// Ok if all `values` are finite, else the error that names the first which is not.
pub(crate) fn finite(quantity: &'static str, index: usize, values: &[f64]) -> Result<(), Error> {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(&value) => Err(Error::NotFinite { quantity, index, value }),
    }
}

/// Ok if `node` is one of `nodes` nodes, else the error that says who asked for it.
pub(crate) fn existing_node(item: &'static str, index: usize, node: usize, nodes: usize) -> Result<(), Error> {
    if node < nodes { Ok(()) } else { Err(Error::NoSuchNode { item, index, node, nodes }) }
}
