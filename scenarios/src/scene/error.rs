//! Why a scene cannot be run.

use std::io;
use std::sync::Arc;

use miette::{Diagnostic, NamedSource, SourceSpan};
use thiserror::Error;

/// Why a scene cannot be run: its first mistake, with the place, the key, what was given and what was expected.
#[derive(Debug, Error, Diagnostic)]
pub enum SceneError {
    /// Neither a built-in scene nor a file.
    #[error("`{name}` is neither a built-in scene nor a file")]
    Unknown {
        /// What was asked for.
        name: String,
        /// The scenes there are.
        #[help]
        help: String,
    },
    /// The file is there and cannot be read.
    #[error("cannot read the scene {path}: {cause}")]
    Unreadable {
        /// The file.
        path: String,
        /// What the system says.
        cause: io::Error,
    },
    /// A mistake in the file.
    #[error("{name}:{line}: {problem}")]
    File {
        /// The file, or the built-in scene.
        name: String,
        /// Line of the mistake, from 1.
        line: usize,
        /// The key, what was given and what was expected.
        problem: String,
        /// The text of the file.
        #[source_code]
        text: Arc<NamedSource<String>>,
        /// Where in the text.
        #[label("here")]
        span: SourceSpan,
        /// What the key means.
        #[help]
        help: Option<String>,
    },
    /// A mistake in a `--set` argument.
    #[error("--set {argument}: {problem}")]
    Set {
        /// The argument.
        argument: String,
        /// The key, what was given and what was expected.
        problem: String,
        /// What the key means.
        #[help]
        help: Option<String>,
    },
}
