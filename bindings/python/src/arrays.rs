//! Arrays for NumPy: made once from the solver's state, moved without a copy, and read-only.

use numpy::{Element, IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A vector as a read-only array of one axis; NumPy takes the memory over.
pub fn values<T: Element>(py: Python<'_>, values: Vec<T>) -> PyResult<Bound<'_, PyArray1<T>>> {
    frozen(values.into_pyarray(py))
}

/// Pairs as a read-only array of shape (n, 2).
pub fn pairs(py: Python<'_>, pairs: Vec<[f64; 2]>) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let shape = [pairs.len(), 2];
    frozen(pairs.into_flattened().into_pyarray(py).reshape(shape)?)
}

/// The array, from now on read-only.
fn frozen<'py, A>(array: Bound<'py, A>) -> PyResult<Bound<'py, A>> {
    array.as_any().call_method1("setflags", (false,))?;
    Ok(array)
}

/// Particles of one instant, in the order of their identity.
#[derive(Default)]
pub struct Particles {
    /// Positions [m].
    pub position: Vec<[f64; 2]>,
    /// Velocities [m/s].
    pub velocity: Vec<[f64; 2]>,
    /// Pressures [Pa].
    pub pressure: Vec<f64>,
    /// Densities [kg/m³].
    pub density: Vec<f64>,
    /// Spacings [m].
    pub spacing: Vec<f64>,
}

impl Particles {
    /// Room for `n` particles.
    pub fn of_length(n: usize) -> Particles {
        Particles {
            position: vec![[0.0; 2]; n],
            velocity: vec![[0.0; 2]; n],
            pressure: vec![0.0; n],
            density: vec![0.0; n],
            spacing: vec![0.0; n],
        }
    }

    /// As arrays by name.
    pub fn into_dict(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let dict = PyDict::new(py);
        dict.set_item("position", pairs(py, self.position)?)?;
        dict.set_item("velocity", pairs(py, self.velocity)?)?;
        dict.set_item("pressure", values(py, self.pressure)?)?;
        dict.set_item("density", values(py, self.density)?)?;
        dict.set_item("spacing", values(py, self.spacing)?)?;
        Ok(dict)
    }
}
