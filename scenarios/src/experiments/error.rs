//! Why an experiment cannot be made.

use run::RunError;
use scene::SceneError;

/// An experiment that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum ExperimentError {
    /// A case or a stored result is unknown or wrong; the text has its kind, its name and what is expected.
    #[error("{0}")]
    Case(String),
    /// An option has a wrong value.
    #[error("{key} {given}: expected {expected}")]
    Input {
        /// The option.
        key: &'static str,
        /// The value given.
        given: String,
        /// The values allowed.
        expected: String,
    },
    /// A run ended early.
    #[error("the run at spacing {0} m and sound speed {1} m/s ended early: {2}")]
    Ended(f64, f64, String),
    /// A run was interrupted, at a spacing [m] and a time [s].
    #[error("interrupted at t = {1:.6} s of the run at spacing {0} m: the same command continues")]
    Interrupted(f64, f64),
    /// A scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A run could not be made.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A file could not be written.
    #[error("cannot write to {0}: {1}")]
    Write(String, std::io::Error),
}

impl ExperimentError {
    /// A path in `summary.json` at which no number stands.
    pub(crate) fn unknown_quantity(path: &str, known: &[String]) -> ExperimentError {
        let expected = format!("the path of a number in summary.json: {}", known.join(", "));
        ExperimentError::Input { key: "--quantity", given: path.to_string(), expected }
    }

    /// Results that a run does not quote.
    pub(crate) fn unknown_result(given: &[String], known: &[String]) -> ExperimentError {
        let expected = format!("results of the scene: {}", known.join(", "));
        ExperimentError::Input { key: "--quantity", given: given.join(", "), expected }
    }

    /// True if the input is at fault, not the run or the disk.
    pub fn is_input(&self) -> bool {
        match self {
            ExperimentError::Run(error) => error.is_input(),
            ExperimentError::Ended(..) | ExperimentError::Interrupted(..) | ExperimentError::Write(..) => false,
            _ => true,
        }
    }
}
