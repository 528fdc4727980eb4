//! Why a scene cannot be run.

use std::io;
use std::sync::Arc;

use miette::{Diagnostic, NamedSource, SourceSpan};
use serde_json::{Value, json};
use settings::Problem;
use thiserror::Error;

/// Why a scene cannot be run: its first mistake, with the place, the key, what was given and what was expected.
#[derive(Debug, Error, Diagnostic)]
pub enum SceneError {
    /// Neither a built-in scene nor a file.
    #[error("`{name}` is neither a built-in {kind} nor a file{}", near.as_ref().map_or(String::new(), |near| format!(": did you mean `{near}`?")))]
    Unknown {
        /// What was asked for.
        name: String,
        /// What it should be, as `scene` or `landing`.
        kind: &'static str,
        /// The built-in one with the nearest name.
        near: Option<String>,
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
    /// A folder, or a file of another kind.
    #[error("`{path}` is {what}: expected {expected}")]
    Mistaken {
        /// The path.
        path: String,
        /// What it is.
        what: &'static str,
        /// What is expected.
        expected: &'static str,
        /// The command that takes it.
        #[help]
        help: String,
    },
    /// A mistake in the file.
    #[error("{name}:{line}: {problem}")]
    File {
        /// The file, or the built-in scene.
        name: String,
        /// Line of the mistake, from 1.
        line: usize,
        /// The key, what was given and what was expected.
        problem: Box<Problem>,
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
        problem: Box<Problem>,
        /// What the key means.
        #[help]
        help: Option<String>,
    },
}

impl SceneError {
    /// The error as an object of JSON: message, file, line, key, given, expected, help; null where there is none.
    pub fn to_json(&self) -> Value {
        let message = self.to_string();
        match self {
            SceneError::Unknown { name, kind, near, help } => {
                let expected = near.as_ref().map(|near| format!("a {kind}, such as `{near}`"));
                json!({"message": message, "file": null, "line": null, "key": null, "given": name,
                       "expected": expected.unwrap_or_else(|| format!("a built-in {kind} or a file")), "help": help})
            }
            SceneError::Unreadable { path, .. } => {
                json!({"message": message, "file": path, "line": null, "key": null, "given": null,
                       "expected": "a file that can be read", "help": null})
            }
            SceneError::Mistaken { path, what, expected, help } => {
                json!({"message": message, "file": path, "line": null, "key": null, "given": what,
                       "expected": expected, "help": help})
            }
            SceneError::File { name, line, problem, help, .. } => {
                let at = problem.line.as_ref();
                let (file, line) = at.map_or((name, *line), |at| (&at.file, at.line));
                let mut error = with_problem(message, problem, help);
                (error["file"], error["line"]) = (json!(file), json!(line));
                error
            }
            SceneError::Set { problem, help, .. } => {
                let mut error = with_problem(message, problem, help);
                if let Some(at) = &problem.line {
                    (error["file"], error["line"]) = (json!(at.file), json!(at.line));
                }
                error
            }
        }
    }
}

fn with_problem(message: String, problem: &Problem, help: &Option<String>) -> Value {
    let some = |text: &str| Some(text.to_string()).filter(|text| !text.is_empty());
    json!({"message": message, "file": null, "line": null, "key": some(&problem.key), "given": problem.given,
           "expected": some(&problem.expected), "help": help})
}
