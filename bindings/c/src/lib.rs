//! The C interface: water under the body of a host program written in C, C++, Fortran or anything that calls C.
//!
//! The reference is `include/splashdown.h`, which cbindgen writes from the functions here. This is the only crate with `unsafe`:
//! memory of the caller is read and written in [`buffers`]; everything else is [`run::host`].

// The names are those of C.
#![allow(non_camel_case_types)]
// Their documentation is that of the header, which states under "Memory" what pointers must point to.
#![allow(clippy::missing_safety_doc)]

mod border;
mod buffers;
mod handles;
mod library;
mod status;

mod scene;

mod element;
mod particles;
mod state;

#[cfg(test)]
mod cost_tests;
