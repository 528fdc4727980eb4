//! Why a coupled run stops.

use sph_core::Breakdown;

use crate::bodies::error::BodyError;
use crate::geometry::error::OutlineError;

/// A coupled run cannot be set up or cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the message of a variant names its fields")]
pub enum CouplingError {
    /// The fluid broke down.
    #[error(transparent)]
    Fluid(#[from] Breakdown),
    /// A body broke down.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// A body that bends ran into another's wall, or two bodies with prescribed motion met: such contact is not modelled.
    #[error(
        "body `{body}` ran into `{wall}` at ({x:.6}, {y:.6}) m, t = {time:.6e} s: contact is modelled between rigid \
         bodies, one of them free; give it more room or end the run earlier"
    )]
    Collision { body: String, wall: String, x: f64, y: f64, time: f64 },
    /// A joint on a body that is not rigid.
    #[error("joint `{joint}`: given the body `{body}`, which is not rigid, expected rigid bodies")]
    Joint { joint: String, body: String },
    /// The outline of a body.
    #[error(transparent)]
    Outline(#[from] OutlineError),
    /// The bodies leave no room for water.
    #[error(
        "no fluid: the tank and the body leave no room for a particle; expected a larger tank, a smaller body or a finer spacing"
    )]
    NoFluid,
    /// The iteration of a step did not converge.
    #[error(
        "coupling: after {iterations} iterations at t = {time:.6e} s fluid and bodies disagree by {residual:.3e} of the \
         acceleration, tolerance {tolerance:.1e}: try coupling.scheme = \"added_mass\", or more iterations"
    )]
    NotConverged {
        iterations: u32,
        /// Residual (THEORY CO8) [-].
        residual: f64,
        tolerance: f64,
        /// Start of the step [s].
        time: f64,
    },
}
