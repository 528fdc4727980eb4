//! What a studio is given, and what all requests share.

use std::ffi::OsString;
use std::path::PathBuf;

use crate::flow::Flows;
use crate::grid::Grids;
use crate::guard::Guard;
use crate::runs::Runs;

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

/// What all requests share.
pub struct Shared {
    pub guard: Guard,
    pub options: Options,
    pub runs: Runs,
    pub flows: Flows,
    pub grids: Grids,
}
