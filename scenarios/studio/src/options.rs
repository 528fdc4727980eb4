//! What a studio is given.

use std::ffi::OsString;
use std::path::PathBuf;

/// What a studio is given.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Folder of the scene's files; runs lie in `runs` below it.
    pub folder: PathBuf,
    /// Port; with 0 the system chooses one.
    pub port: u16,
    /// The scene's text at the start.
    pub text: String,
    /// Name of the file that a download of the scene gets.
    pub file: String,
    /// Names and texts of scenes to begin with.
    pub examples: Vec<(String, String)>,
    /// Starts this program as a process of its own.
    pub program: Vec<OsString>,
}
