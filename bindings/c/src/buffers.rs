//! Memory of the caller: numbers, texts and structures are copied in and out; no reference to them is kept or made.

use std::ffi::{CStr, c_char};

use fsi_coupling::embed::HostNodes;

use crate::status::Failure;
use crate::status::splashdown_status::{SPLASHDOWN_LENGTH, SPLASHDOWN_NOT_UTF8, SPLASHDOWN_NULL};

/// An error unless `pointer` can point to a `T`.
pub(crate) fn expect<T>(name: &str, pointer: *const T) -> Result<(), Failure> {
    let refused = |given: &str| {
        let message = format!("{name}: given {given}, expected a pointer to memory of the caller");
        Err(Failure::new(SPLASHDOWN_NULL, message))
    };
    match pointer {
        _ if pointer.is_null() => refused("NULL"),
        _ if !pointer.is_aligned() => refused("an address that is not aligned"),
        _ => Ok(()),
    }
}

/// An error unless a caller that gives `given` of `name` gives `expected`.
pub(crate) fn expect_length(name: &str, given: usize, expected: usize) -> Result<(), Failure> {
    if given == expected {
        return Ok(());
    }
    Err(Failure::new(SPLASHDOWN_LENGTH, format!("{name}: given {given}, expected {expected}")))
}

/// An error unless a buffer of `given` [what `name` says] holds `needed`.
pub(crate) fn expect_room(name: &str, given: usize, needed: usize) -> Result<(), Failure> {
    if given >= needed {
        return Ok(());
    }
    Err(Failure::new(SPLASHDOWN_LENGTH, format!("{name}: given {given}, expected at least {needed}")))
}

/// Copy the caller's values into all of `into`.
///
/// # Safety
/// `from` is NULL or points to as many readable values as `into` has.
pub(crate) unsafe fn read<T: Copy>(name: &str, from: *const T, into: &mut [T]) -> Result<(), Failure> {
    expect(name, from)?;
    // SAFETY: both sides have the length; `into` is borrowed alone, so that it does not overlap memory of the caller.
    unsafe { std::ptr::copy_nonoverlapping(from, into.as_mut_ptr(), into.len()) };
    Ok(())
}

/// Copy `values` to the caller: nothing is written to NULL.
///
/// # Safety
/// `to` is NULL, or aligned and points to as many writable values as there are.
pub(crate) unsafe fn write<T: Copy>(values: &[T], to: *mut T) {
    if !to.is_null() {
        // SAFETY: both sides have the length; `values` is memory of this library, which the caller has no pointer to.
        unsafe { std::ptr::copy_nonoverlapping(values.as_ptr(), to, values.len()) };
    }
}

/// Copy one value to the caller.
///
/// # Safety
/// `to` is NULL or points to memory for one `T`.
pub(crate) unsafe fn write_one<T>(name: &str, value: T, to: *mut T) -> Result<(), Failure> {
    expect(name, to)?;
    // SAFETY: not NULL, aligned, and for one value by the contract of the caller.
    unsafe { to.write(value) };
    Ok(())
}

/// Text of the caller, up to its zero.
///
/// # Safety
/// `text` is NULL or points to bytes that end with a zero.
pub(crate) unsafe fn text(name: &str, text: *const c_char) -> Result<String, Failure> {
    expect(name, text)?;
    // SAFETY: not NULL, and ended by a zero by the contract of the caller.
    let bytes = unsafe { CStr::from_ptr(text) };
    let refused = |error: std::str::Utf8Error| {
        let given = bytes.to_string_lossy();
        let at = error.valid_up_to();
        Failure::new(SPLASHDOWN_NOT_UTF8, format!("{name}: given `{given}`, expected UTF-8; byte {at} is not"))
    };
    bytes.to_str().map(str::to_string).map_err(refused)
}

/// Copy `text` to the caller, cut where it does not fit and ended by a zero; the bytes that it needs with its zero.
///
/// # Safety
/// `buffer` is NULL or points to `length` writable bytes.
pub(crate) unsafe fn write_cut(text: &str, buffer: *mut c_char, length: usize) -> usize {
    if !buffer.is_null() && length > 0 {
        let fits = (0..length).rev().find(|&bytes| text.is_char_boundary(bytes)).unwrap_or(0);
        // SAFETY: `fits` and the zero after it are within `length`.
        unsafe {
            std::ptr::copy_nonoverlapping(text.as_ptr(), buffer.cast(), fits);
            buffer.add(fits).write(0);
        }
    }
    text.len() + 1
}

/// Names of the arrays of nodes, in the order in which every function takes them.
const NODES: [&str; 4] = ["positions", "velocities", "rotations", "spins"];

/// An error where an array of rotations or spins is given and nodes have none.
fn expect_no_rotations<T>(arrays: [*const T; 4], nodes: &HostNodes) -> Result<(), Failure> {
    let given = [2, 3].into_iter().find(|&k| nodes.rotation.is_empty() && !arrays[k].is_null());
    given.map_or(Ok(()), |k| {
        let message =
            format!("{}: given an array, expected NULL: the nodes of this interface have no rotations", NODES[k]);
        Err(Failure::new(SPLASHDOWN_LENGTH, message))
    })
}

/// Copy the caller's `n` nodes into all of `nodes`.
///
/// # Safety
/// Positions and velocities are NULL or of 2n values, rotations and spins NULL or of n values.
pub(crate) unsafe fn read_nodes(arrays: [*const f64; 4], n: usize, nodes: &mut HostNodes) -> Result<(), Failure> {
    expect_length("n, nodes", n, nodes.len())?;
    expect_no_rotations(arrays, nodes)?;
    let into: [&mut [f64]; 4] =
        [nodes.position.as_flattened_mut(), nodes.velocity.as_flattened_mut(), &mut nodes.rotation, &mut nodes.spin];
    for ((name, from), into) in NODES.into_iter().zip(arrays).zip(into) {
        if !into.is_empty() {
            // SAFETY: `into` has the length that belongs to n, which is that of the caller's array.
            unsafe { read(name, from, into)? };
        }
    }
    Ok(())
}

/// Copy nodes to arrays of the caller for `n` nodes; those that are NULL are not wanted.
///
/// # Safety
/// Positions and velocities are NULL or of 2n values, rotations and spins NULL or of n values.
pub(crate) unsafe fn write_nodes(nodes: &HostNodes, arrays: [*mut f64; 4], n: usize) -> Result<(), Failure> {
    expect_length("n, nodes", n, nodes.len())?;
    expect_no_rotations(arrays.map(<*mut f64>::cast_const), nodes)?;
    for (name, array) in NODES.into_iter().zip(arrays).filter(|(_, array)| !array.is_null()) {
        expect(name, array)?;
    }
    let values: [&[f64]; 4] =
        [nodes.position.as_flattened(), nodes.velocity.as_flattened(), &nodes.rotation, &nodes.spin];
    for (values, array) in values.into_iter().zip(arrays) {
        // SAFETY: aligned, and of the length that belongs to n.
        unsafe { write(values, array) };
    }
    Ok(())
}
