//! Why a sweep cannot be made.

use std::io;
use std::path::Path;

use scene::SceneError;

/// Why a sweep cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// A mistake in the sweep file or in a scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Another input is wrong; the text says what was given and what is expected.
    #[error("{0}")]
    Input(String),
    /// A process or an engine failed.
    #[error("{0}")]
    Failed(String),
    /// A file could not be written.
    #[error("cannot write {0}: {1}")]
    Write(String, io::Error),
}

impl SweepError {
    /// A file that could not be written.
    pub(super) fn write(path: &Path, error: io::Error) -> SweepError {
        SweepError::Write(path.display().to_string(), error)
    }
}
