//! What goes wrong between a host and its water.

use fsi_coupling::embed::HostError;
use fsi_coupling::{BodyError, CouplingError};
use scene::SceneError;

use crate::RunError;
use crate::observers::ObserveError;

/// What kind of error it is: what a host does about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// The scene, a length or a value was wrong: nothing has changed.
    Input,
    /// A step failed: return to a saved state, or drop the run.
    Step,
    /// A call after a failed step.
    Failed,
    /// Nothing was saved to return to.
    NothingSaved,
    /// Bytes that are no state of this run, which has failed.
    State,
    /// A file could not be written.
    File,
}

/// What goes wrong between a host and its water.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HostedError {
    /// The scene cannot be run.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The scene cannot be hosted.
    #[error("scene `{scene}`: {given}; expected {expected}")]
    Unfit {
        /// Its name.
        scene: String,
        /// What stands against it.
        given: String,
        /// What is possible.
        expected: String,
    },
    /// The water does not fit in memory.
    #[error(
        "{particles} particles of water need {bytes} bytes: expected a spacing that fits in {most} bytes of memory"
    )]
    Memory {
        /// Particles of the water.
        particles: usize,
        /// What the run needs, estimated.
        bytes: u64,
        /// What there is.
        most: u64,
    },
    /// No interface has this name.
    #[error("interface `{given}`: expected one of {expected}")]
    Interface {
        /// What was given.
        given: String,
        /// The names there are.
        expected: String,
    },
    /// The element refused a call, or failed.
    #[error(transparent)]
    Element(#[from] HostError),
    /// The records of the run.
    #[error(transparent)]
    Records(#[from] RunError),
    /// Bytes for a run that keeps records: these cannot be taken back.
    #[error("a run with records cannot take a state of bytes: open the scene without records")]
    Recorded,
}

impl HostedError {
    /// What kind of error it is.
    pub fn kind(&self) -> ErrorKind {
        match self {
            HostedError::Scene(_)
            | HostedError::Unfit { .. }
            | HostedError::Memory { .. }
            | HostedError::Interface { .. }
            | HostedError::Recorded => ErrorKind::Input,
            HostedError::Records(error) if error.is_input() => ErrorKind::Input,
            HostedError::Records(_) => ErrorKind::File,
            HostedError::Element(error) => match error {
                HostError::Step { .. } => ErrorKind::Step,
                HostError::Failed(_) => ErrorKind::Failed,
                HostError::NothingSaved => ErrorKind::NothingSaved,
                HostError::State(_) => ErrorKind::State,
                _ => ErrorKind::Input,
            },
        }
    }
}

impl From<CouplingError> for HostedError {
    fn from(error: CouplingError) -> HostedError {
        HostedError::Element(HostError::Build(error))
    }
}

impl From<BodyError> for HostedError {
    fn from(error: BodyError) -> HostedError {
        HostedError::Element(HostError::Shape(error))
    }
}

impl From<ObserveError> for HostedError {
    fn from(error: ObserveError) -> HostedError {
        HostedError::Records(error.into())
    }
}
