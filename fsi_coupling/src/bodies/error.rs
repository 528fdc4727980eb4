//! Why a body cannot be built or cannot continue.

use crate::geometry::error::OutlineError;

/// A body that cannot be built or cannot continue.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the message of a variant names its fields")]
pub enum BodyError {
    /// The corners do not make an outline.
    #[error(transparent)]
    Outline(#[from] OutlineError),
    /// Mass or inertia that is not positive and finite.
    #[error("body `{name}`: {quantity} is {given}, expected a positive finite number")]
    Inertia {
        name: String,
        /// `mass` or `inertia`.
        quantity: &'static str,
        /// The value given, in SI units.
        given: f64,
    },
    /// The structure's equations cannot be set up or solved.
    #[error("body `{name}`: {reason}")]
    Structure { name: String, reason: String },
    /// A step too long for a mass on its spring.
    #[error(
        "body `{name}`: a step of {step:.3e} s is too long for `{mass}` on its spring; expected at most {longest:.3e} s"
    )]
    Spring { name: String, mass: String, step: f64, longest: f64 },
    /// The motion is not finite.
    #[error("body `{name}`: its motion at t = {time:.6e} s is not finite; expected finite forces and a shorter step")]
    NotFinite { name: String, time: f64 },
}

impl BodyError {
    /// An error of the body's finite-element model.
    pub(crate) fn structure(name: &str, error: &structure_fe::Error) -> BodyError {
        BodyError::Structure { name: name.into(), reason: error.to_string() }
    }
}
