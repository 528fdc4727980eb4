//! A scene as Python names it: a name or a path, and settings by key.

use std::path::Path;

use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyString, PyTuple};
use run::memory::available_memory;
use scene::Loaded;

use crate::call::refuse_fork;
use crate::errors;

/// Settings as the command line's `--set` has them, `key=value`.
pub fn assignments(set: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<String>> {
    let Some(set) = set else { return Ok(Vec::new()) };
    let assignment = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let name = key.cast::<PyString>().ok().map(|name| name.to_string()).filter(|name| !name.contains('='));
        let Some(name) = name else {
            return Err(errors::input(format!("set: key {key}: expected text such as \"resolution.spacing\"")));
        };
        let text = match value.cast::<PyString>() {
            Ok(text) => text.to_string(), // as in a shell: `30ms` and `weak` need no quotes
            Err(_) => literal(&value, DEEPEST).map_err(|expected| {
                let given = value.str().map_or_else(|_| "an object".into(), |given| given.to_string());
                errors::setting(set.py(), &name, &given, expected)
            })?,
        };
        Ok(format!("{name}={text}"))
    };
    set.iter().map(assignment).collect()
}

/// Lists in lists of a value, at most: one that holds itself has no end.
const DEEPEST: usize = 16;

/// A value as TOML has it, in which lists may be `depth` deep.
fn literal(value: &Bound<'_, PyAny>, depth: usize) -> Result<String, &'static str> {
    const EXPECTED: &str = "a finite number, a truth value, text, or a list of them";
    let inner = depth.checked_sub(1).ok_or("lists that are less deep")?;
    if let Ok(plain) = value.call_method0("tolist") {
        return literal(&plain, inner); // of NumPy
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(serde_json::Value::String(text.to_string()).to_string());
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let items = value.try_iter().map_err(|_| EXPECTED)?;
        let items = items.map(|item| item.map_err(|_| EXPECTED).and_then(|item| literal(&item, inner)));
        return Ok(format!("[{}]", items.collect::<Result<Vec<_>, _>>()?.join(", ")));
    }
    if value.is_instance_of::<PyBool>() {
        return value.is_truthy().map(|is| is.to_string()).map_err(|_| EXPECTED);
    }
    let whole = value.extract::<i64>().map(|number| number.to_string());
    let number = || value.extract::<f64>().ok().filter(|number| number.is_finite());
    whole.ok().or_else(|| number().map(|number| format!("{number:?}"))).ok_or(EXPECTED)
}

/// A path as text.
pub fn text(path: &Path) -> PyResult<&str> {
    path.to_str().ok_or_else(|| errors::input(format!("{}: expected a path in UTF-8", path.display())))
}

/// A scene by its name or path, resolved; one that does not fit in memory is refused.
pub fn load(py: Python<'_>, scene: &Path, sets: &[String]) -> PyResult<Loaded> {
    refuse_fork()?;
    let name = text(scene)?;
    let fitting = |loaded: Loaded| loaded.fits_in_memory(available_memory()).map(|()| loaded);
    let loaded = py.detach(|| run::load(name, sets).and_then(fitting));
    loaded.map_err(|error| errors::scene(py, &error))
}
