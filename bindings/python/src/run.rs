//! A run from its scene to its end, as the command `run` makes it.

use std::path::PathBuf;
use std::thread::available_parallelism;

use numpy::PyArray1;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use run::{Checkpoints, Outcome, RunOptions, run};
use scene::Scene;
use scene::vocabulary::Status;
use sph_core::parallel;

use crate::call::interruptible;
use crate::settings::{assignments, load};
use crate::{arrays, errors};

/// Threads for each core, at most, as of the command.
const MOST_THREADS: usize = 8;

/// Columns of the series: name and values.
pub type Columns<'py> = Vec<(String, Bound<'py, PyArray1<f64>>)>;

/// Run a scene; returns the text of summary.json, the resolved scene as TOML, and the columns of the series.
#[pyfunction]
#[pyo3(signature = (scene, set=None, out=None, threads=None, force=false))]
pub fn run_scene<'py>(
    py: Python<'py>,
    scene: PathBuf,
    set: Option<&Bound<'py, PyDict>>,
    out: Option<PathBuf>,
    threads: Option<usize>,
    force: bool,
) -> PyResult<(String, String, Columns<'py>)> {
    refuse_threads(threads)?;
    let loaded = load(py, &scene, &assignments(set)?)?;
    let ended = interruptible(py, |stop| {
        let options = RunOptions {
            page: Some(report::page_of_run),
            checkpoints: out.is_some().then(Checkpoints::default),
            out,
            force,
            interrupt: Some(stop),
            warnings: loaded.warnings.clone(),
            ..RunOptions::default()
        };
        let run = || run(&loaded.scene, &options);
        threads.map_or_else(run, |threads| parallel::on_threads(threads, run))
    })?;
    let outcome = ended.map_err(|error| errors::run(&error))?;
    if outcome.summary.status == Status::Interrupted {
        return Err(PyKeyboardInterrupt::new_err(()));
    }
    results(py, &outcome, &loaded.scene)
}

/// Summary, scene and series of a run.
pub fn results<'py>(py: Python<'py>, outcome: &Outcome, scene: &Scene) -> PyResult<(String, String, Columns<'py>)> {
    Ok((outcome.summary.to_json(), scene.to_toml(), columns(py, outcome)?))
}

/// Columns of the series of a run.
pub fn columns<'py>(py: Python<'py>, outcome: &Outcome) -> PyResult<Columns<'py>> {
    let names = outcome.series.columns().iter();
    let column = |name: &String| {
        let values = outcome.series.column(name).unwrap_or_default();
        Ok((name.clone(), arrays::values(py, values)?))
    };
    names.map(column).collect()
}

/// An error where a number of threads is not one that is started.
pub fn refuse_threads(threads: Option<usize>) -> PyResult<()> {
    let most = MOST_THREADS * available_parallelism().map_or(1, usize::from);
    match threads {
        Some(n) if n == 0 || n > most => {
            Err(errors::input(format!("threads = {n}: expected 1 to {most}, {MOST_THREADS} for each core")))
        }
        _ => Ok(()),
    }
}
