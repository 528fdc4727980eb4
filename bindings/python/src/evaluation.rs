//! A scene with values of its keys, resolved once: what names its run, and the run without files.

use std::path::PathBuf;

use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use run::{RunOptions, run};
use scene::Loaded;
use scene::vocabulary::Status;
use sph_core::parallel;

use crate::call::interruptible;
use crate::errors;
use crate::run::{Columns, columns, refuse_threads};
use crate::settings::{assignments, load};

/// A resolved scene.
#[pyclass(frozen, module = "splashdown._core")]
pub struct Resolved(Loaded);

#[pymethods]
impl Resolved {
    #[new]
    #[pyo3(signature = (scene, set=None))]
    fn new(py: Python<'_>, scene: PathBuf, set: Option<&Bound<'_, PyDict>>) -> PyResult<Resolved> {
        Ok(Resolved(load(py, &scene, &assignments(set)?)?))
    }

    /// A hash of the scene, of the files that it names and of the program's version, as of the points of a sweep.
    #[getter]
    fn identity(&self, py: Python<'_>) -> String {
        py.detach(|| self.0.identity())
    }

    /// True where a theory runs the scene: on one thread.
    #[getter]
    fn is_theory(&self) -> bool {
        self.0.scene.model.is_theory()
    }

    /// Run it; returns the text of summary.json and the columns of the series. Nothing is written. StepError where it fails.
    #[pyo3(signature = (threads=None))]
    fn run<'py>(&self, py: Python<'py>, threads: Option<usize>) -> PyResult<(String, Columns<'py>)> {
        refuse_threads(threads)?;
        let threads = threads.filter(|_| !self.is_theory());
        let ended = interruptible(py, |stop| {
            let options =
                RunOptions { interrupt: Some(stop), warnings: self.0.warnings.clone(), ..RunOptions::default() };
            let run = || run(&self.0.scene, &options);
            threads.map_or_else(run, |threads| parallel::on_threads(threads, run))
        })?;
        let outcome = ended.map_err(|error| errors::run(&error))?;
        match outcome.summary.status {
            Status::Interrupted => Err(PyKeyboardInterrupt::new_err(())),
            Status::Failed => Err(errors::step(outcome.summary.message.as_deref().unwrap_or("the run failed"))),
            _ => Ok((outcome.summary.to_json(), columns(py, &outcome)?)),
        }
    }
}
