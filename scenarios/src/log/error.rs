//! Why a log cannot be written.

use std::io;
use std::path::PathBuf;

use mcap::McapError;

/// Why a log cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The file cannot be opened for writing.
    #[error("cannot create the log {}: {source}", path.display())]
    Create {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The file cannot be written to; the log ends.
    #[error("cannot write the log {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The error of the container.
        source: McapError,
    },
    /// The log has ended, for a reason that was reported before.
    #[error("the log {} has ended", path.display())]
    Ended {
        /// The file.
        path: PathBuf,
    },
    /// A time that a log cannot carry: its clock counts from 0 s and ends before 2³² s.
    #[error("cannot log the time {time} s: it must lie in [0, 2^32) s")]
    Time {
        /// The time [s].
        time: f64,
    },
    /// Slices of one particle view that differ in length.
    #[error("{topic}: {found} values of {field} for {expected} particles")]
    Length {
        /// The topic the particles were meant for.
        topic: &'static str,
        /// The field of the view.
        field: &'static str,
        /// The number of particles, which is the number of their x coordinates.
        expected: usize,
        /// The length of the slice.
        found: usize,
    },
    /// A channel that is no topic for samples.
    #[error("cannot log samples to the channel \"{channel}\": {reason}")]
    Channel {
        /// The channel.
        channel: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// Names of a sample that the schema of its channel does not have.
    #[error("channel \"{channel}\": a sample names {found:?}, expected {expected:?}")]
    Names {
        /// The channel.
        channel: String,
        /// The names of its schema, each once.
        expected: Vec<String>,
        /// The names of the sample.
        found: Vec<String>,
    },
}
