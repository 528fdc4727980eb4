//! Why a run cannot start, or cannot keep its results.

use std::error::Error;

use fsi_coupling::CouplingError;
use scene::reference::ReferenceError;
use sph_core::Breakdown;
use water_entry::OutOfRange;

use crate::checkpoint::CheckpointError;
use crate::log::LogError;
use crate::observers::ObserveError;

/// Why a run cannot start, or cannot keep its results.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The output folder holds a run already.
    #[error("{0} already holds a run ({1}): choose another folder, or replace it (--force)")]
    Occupied(String, &'static str),
    /// A file or folder could not be written.
    #[error("cannot write {0}: {1}")]
    Write(String, std::io::Error),
    /// Another process writes to the folder.
    #[error("{0}: another run writes there: wait for it, or choose another folder")]
    Held(String),
    /// The output folder's name is that of a file.
    #[error("{0} is a file: choose another folder")]
    NotAFolder(String),
    /// An observer failed.
    #[error(transparent)]
    Observe(#[from] ObserveError),
    /// The files of the run cannot be read back for its report.
    #[error("{0}")]
    Report(Box<dyn Error + Send + Sync>),
    /// A reference that the scene names cannot be used.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// The scene cannot be built.
    #[error("{}", at_start(.0))]
    Build(#[from] CouplingError),
    /// A run that cannot be resumed.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// Checkpoints of a model that has no steps.
    #[error("model = \"{0}\" has no steps to keep checkpoints of: expected a model of particles")]
    NoSteps(&'static str),
    /// The model does not apply to the scene.
    #[error("model = \"{0}\" holds for {1}")]
    Theory(&'static str, OutOfRange),
}

/// An error of the first moment, with the keys that make it.
fn at_start(error: &CouplingError) -> String {
    match error {
        CouplingError::Fluid(Breakdown::Density { .. }) => format!(
            "{error}; the water cannot start so: expected a larger `fluid.sound_speed`, or `fluid.density_evolution` = \"continuity\""
        ),
        other => other.to_string(),
    }
}

impl RunError {
    /// True if the user's input is at fault (exit 2), false if the run is (exit 1).
    pub fn is_input(&self) -> bool {
        match self {
            RunError::Write(..) | RunError::Report(_) => false,
            RunError::Observe(why) => matches!(why, ObserveError::Log(LogError::Live(..) | LogError::Read(..))),
            _ => true,
        }
    }
}
