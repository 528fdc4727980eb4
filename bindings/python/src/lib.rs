//! The compiled half of the Python package `splashdown`: scenes are run, stepped and moved here; `splashdown/*.py` has what is
//! only a matter of files.
//!
//! Long calls release the interpreter's lock. Arrays that leave are made for the caller: nothing that Python holds changes later.

mod arrays;
mod call;
mod command;
mod errors;
mod evaluation;
mod folder;
mod host;
mod host_arrays;
mod run;
mod settings;
mod simulation;

/// The compiled half of the package.
#[pyo3::pymodule]
mod _core {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::command::{check, execute, scenes};
    #[pymodule_export]
    use crate::errors::{InputError, StepError};
    #[pymodule_export]
    use crate::evaluation::Resolved;
    #[pymodule_export]
    use crate::folder::{Log, toml_to_json};
    #[pymodule_export]
    use crate::host::{Contribution, Host};
    #[pymodule_export]
    use crate::run::run_scene;
    #[pymodule_export]
    use crate::simulation::Simulation;

    /// Sets the version of the program, and the attributes of exceptions that have none of their own.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        let py = module.py();
        for key in crate::errors::SCENE_KEYS {
            py.get_type::<crate::errors::InputError>().setattr(key, py.None())?;
        }
        py.get_type::<crate::errors::StepError>().setattr("run", py.None())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
