//! Why a run cannot start, or cannot keep its results.

use fsi_coupling::CouplingError;
use fsi_coupling::entry_theory::OutOfRange;

use crate::observers::ObserveError;
use crate::reference::ReferenceError;

/// Why a run cannot start, or cannot keep its results.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The output folder holds a run already.
    #[error("{0} already holds a run ({1}): choose another --out, or --force to replace it")]
    Occupied(String, &'static str),
    /// A file or folder could not be written.
    #[error("cannot write {0}: {1}")]
    Write(String, std::io::Error),
    /// The output folder's name is that of a file.
    #[error("{0} is a file: choose another --out")]
    NotAFolder(String),
    /// An observer failed.
    #[error(transparent)]
    Observe(#[from] ObserveError),
    /// A reference that the scene names cannot be used.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// The scene cannot be built.
    #[error(transparent)]
    Build(#[from] CouplingError),
    /// The model does not apply to the scene.
    #[error("model = \"{0}\" holds for {1}")]
    Theory(&'static str, OutOfRange),
}

impl RunError {
    /// True if the user's input is at fault (exit 2), false if the run is (exit 1).
    pub fn is_input(&self) -> bool {
        !matches!(self, RunError::Write(..) | RunError::Observe(_))
    }
}
