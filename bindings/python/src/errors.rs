//! The package's exceptions, and what becomes which.

use miette::Diagnostic;
use pyo3::create_exception;
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use run::RunError;
use scene::SceneError;

create_exception!(
    splashdown,
    InputError,
    PyValueError,
    "What was given is wrong: a scene, a key, an array. The message says what was expected. Of a scene's mistake there are the \
     attributes file, line, key, given, expected and help, None where there is none."
);
create_exception!(
    splashdown,
    StepError,
    PyRuntimeError,
    "A run or a step failed, or the object failed before. Of a run that failed the attribute run has what was computed, else None."
);

/// Attributes of InputError for a mistake in a scene.
pub const SCENE_KEYS: [&str; 6] = ["file", "line", "key", "given", "expected", "help"];

/// What was given is wrong.
pub fn input(text: impl ToString) -> PyErr {
    InputError::new_err(text.to_string())
}

/// A value of a key that no scene has.
pub fn setting(py: Python<'_>, key: &str, given: &str, expected: &str) -> PyErr {
    let raised = input(format!("set: {key} = {given}: expected {expected}"));
    let of = raised.value(py);
    let named = [("key", key), ("given", given), ("expected", expected)];
    match named.into_iter().try_for_each(|(name, text)| of.setattr(name, text)) {
        Ok(()) => raised,
        Err(error) => error,
    }
}

/// A step that failed.
pub fn step(text: impl ToString) -> PyErr {
    StepError::new_err(text.to_string())
}

/// A mistake in a scene, with its place.
pub fn scene(py: Python<'_>, error: &SceneError) -> PyErr {
    let help = error.help().map_or(String::new(), |help| format!("\n{help}"));
    let raised = input(format!("{error}{help}"));
    let mistake = error.to_json();
    for key in SCENE_KEYS {
        let value = mistake.get(key).unwrap_or(&serde_json::Value::Null);
        let set = match (value.as_str(), value.as_u64()) {
            (Some(text), _) => raised.value(py).setattr(key, text),
            (None, Some(number)) => raised.value(py).setattr(key, number),
            (None, None) => raised.value(py).setattr(key, py.None()),
        };
        if let Err(error) = set {
            return error;
        }
    }
    raised
}

/// A run that cannot start, or cannot keep its results.
pub fn run(error: &RunError) -> PyErr {
    match error {
        RunError::Write(..) => file(error),
        _ if error.is_input() => input(error),
        _ => step(error),
    }
}

/// A file that cannot be written.
pub fn file(text: impl ToString) -> PyErr {
    PyOSError::new_err(text.to_string())
}
