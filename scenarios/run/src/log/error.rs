//! Why a log cannot be written.

use std::io;
use std::net::SocketAddr;
use std::path::PathBuf;

use mcap::McapError;

/// Why a log cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The file cannot be opened for writing.
    #[error("cannot create the log {path}: {1}", path = .0.display())]
    Create(PathBuf, #[source] io::Error),
    /// The file cannot be written to; the log ends.
    #[error("cannot write the log {path}: {cause}", path = .0.display(), cause = cause(.1))]
    Write(PathBuf, #[source] McapError),
    /// The server of a live view cannot listen at an address.
    #[error("cannot show the run live at {0}: {1}; expected a free address, as --live 127.0.0.1:8766")]
    Live(SocketAddr, String),
    /// A log that cannot be continued, and why.
    #[error("cannot continue the log {path}: {1}", path = .0.display())]
    Read(PathBuf, String),
    /// The log has ended, for a reason that was reported before.
    #[error("the log {path} has ended", path = .0.display())]
    Ended(PathBuf),
    /// A time [s] that a log cannot carry: its clock counts from 0 s and ends before 2³² s.
    #[error("cannot log the time {0} s: it must lie in [0, 2^32) s")]
    Time(f64),
    /// A channel that is no topic for samples, and what is wrong with it.
    #[error("cannot log samples to the channel \"{0}\": {1}")]
    Channel(String, &'static str),
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

/// What the system says, where it is the cause.
fn cause(error: &McapError) -> String {
    match error {
        McapError::Io(io) => io.to_string(),
        other => other.to_string(),
    }
}
