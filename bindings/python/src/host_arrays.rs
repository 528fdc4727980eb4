//! The host's arrays, read and written in place: C-contiguous, of float64, of the shape that the nodes have.

use fsi_coupling::embed::HostNodes;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::errors;

/// Reads the nodes at the end of a step. Without rotations they keep those they have, and do not turn. After an error they are partly
/// read.
pub fn read_nodes(
    nodes: &mut HostNodes,
    [position, velocity]: [&Bound<'_, PyAny>; 2],
    turns: [Option<&Bound<'_, PyAny>>; 2],
) -> PyResult<()> {
    read_pairs("position", position, &mut nodes.position)?;
    read_pairs("velocity", velocity, &mut nodes.velocity)?;
    match turns {
        [Some(rotation), Some(spin)] => {
            read_numbers("rotation", rotation, &mut nodes.rotation)?;
            read_numbers("spin", spin, &mut nodes.spin)
        }
        [None, None] => {
            nodes.spin.fill(0.0);
            Ok(())
        }
        _ => Err(errors::input("rotation and spin: expected both or neither")),
    }
}

/// Reads what is given of the nodes' velocities at the start.
pub fn read_start(
    nodes: &mut HostNodes,
    velocity: Option<&Bound<'_, PyAny>>,
    spin: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    velocity.map_or(Ok(()), |given| read_pairs("velocity", given, &mut nodes.velocity))?;
    spin.map_or(Ok(()), |given| read_numbers("spin", given, &mut nodes.spin))
}

fn read_pairs(name: &str, given: &Bound<'_, PyAny>, values: &mut [[f64; 2]]) -> PyResult<()> {
    let expected = format!("({}, 2)", values.len());
    let refused = || refused(name, given, &expected);
    let array = given.cast::<PyArray2<f64>>().map_err(|_| refused())?;
    if array.shape() != [values.len(), 2] || !array.is_c_contiguous() {
        return Err(refused());
    }
    let array = array.try_readonly().map_err(|_| in_use(name))?;
    let (pairs, _) = array.as_slice().map_err(|_| refused())?.as_chunks::<2>();
    values.copy_from_slice(pairs);
    Ok(())
}

fn read_numbers(name: &str, given: &Bound<'_, PyAny>, values: &mut [f64]) -> PyResult<()> {
    let expected = format!("({},)", values.len());
    let refused = || refused(name, given, &expected);
    let array = given.cast::<PyArray1<f64>>().map_err(|_| refused())?;
    if array.shape() != [values.len()] || !array.is_c_contiguous() {
        return Err(refused());
    }
    let array = array.try_readonly().map_err(|_| in_use(name))?;
    values.copy_from_slice(array.as_slice().map_err(|_| refused())?);
    Ok(())
}

/// An error unless the forces of `nodes` nodes can be written to the array.
pub fn check_forces(out: &Bound<'_, PyAny>, nodes: usize) -> PyResult<()> {
    let refused = || refused("out", out, &format!("({nodes}, 3), writable"));
    let array = out.cast::<PyArray2<f64>>().map_err(|_| refused())?;
    if array.shape() != [nodes, 3] || !array.is_c_contiguous() {
        return Err(refused());
    }
    array.try_readwrite().map(|_| ()).map_err(|_| refused())
}

/// Writes the forces to an array that was checked.
pub fn write_forces(out: &Bound<'_, PyAny>, forces: &[[f64; 3]]) -> PyResult<()> {
    let changed = || errors::input("out: the array was changed during the step");
    let array = out.cast::<PyArray2<f64>>().map_err(|_| changed())?;
    let mut array = array.try_readwrite().map_err(|_| changed())?;
    let values = array.as_slice_mut().map_err(|_| changed())?;
    if values.len() != forces.as_flattened().len() {
        return Err(changed());
    }
    values.copy_from_slice(forces.as_flattened());
    Ok(())
}

fn in_use(name: &str) -> PyErr {
    errors::input(format!("{name}: the array is being written by another thread"))
}

/// What was given instead of an array of this shape.
fn refused(name: &str, given: &Bound<'_, PyAny>, expected: &str) -> PyErr {
    let word = |attribute: &str| given.getattr(attribute).map(|value| value.to_string());
    let given = match (word("dtype"), word("shape")) {
        (Ok(dtype), Ok(shape)) => format!("an array of {dtype}, {shape}"),
        _ => given.get_type().to_string(),
    };
    errors::input(format!("{name}: given {given}, expected a C-contiguous array of float64, {expected}"))
}
