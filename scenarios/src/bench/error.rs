//! Why a measurement failed.

use run::RunError;
use scene::SceneError;
use sph_core::Breakdown;

/// A measurement that could not be made.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// A block of fluid broke down.
    #[error(transparent)]
    Fluid(#[from] Breakdown),
    /// A scene is not right.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A run failed.
    #[error(transparent)]
    Run(#[from] RunError),
}
