//! The command `splashdown`, and the list of scenes.

use std::ffi::OsString;
use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::settings::{assignments, load};

/// The command `splashdown` with these arguments; returns its exit code. `program` is the command line that starts it as a process
/// of its own: the points of a sweep are such processes.
#[pyfunction]
pub fn execute(py: Python<'_>, arguments: Vec<OsString>, program: Vec<OsString>) -> u8 {
    py.detach(|| scenarios::cli::execute(&arguments, &program))
}

/// Names of the built-in scenes.
#[pyfunction]
pub fn scenes() -> Vec<&'static str> {
    scene::builtin().iter().map(|(name, _)| *name).collect()
}

/// Resolve a scene without running it; returns it as TOML, and the warnings about it.
///
/// Raises InputError as run() does.
#[pyfunction]
#[pyo3(signature = (scene, set=None))]
pub fn check(py: Python<'_>, scene: PathBuf, set: Option<&Bound<'_, PyDict>>) -> PyResult<(String, Vec<String>)> {
    let loaded = load(py, &scene, &assignments(set)?)?;
    Ok((loaded.scene.to_toml(), loaded.warnings))
}
