//! INDAT and IPART, the files of Pilorget's solver (2010): `splashdown import` and `export --indat --ipart`.
//!
//! The thesis names the 38 parameters of INDAT in their order (appendix 2) and says what a line of IPART holds: position, velocity,
//! pressure, density, temperature and sound velocity. It does not say how lines are laid out, nor in which order particles stand.
//! Chosen here: a value per line, with its name as a comment; ten numbers per particle; fixed limit particles first, then mobile ones,
//! then the fluid.

mod body_of;
mod indat;
mod ipart;
mod scene_of;
mod write_scene;

pub use indat::Indat;
pub use ipart::{Ipart, Particle};
pub use scene_of::{Imported, scene_of};
pub use write_scene::files_of;

use settings::DataLine;

/// A line of INDAT or IPART that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}:{}: {given}: expected {expected}", at.file, at.line)]
pub struct ThesisFileError {
    /// The file and the line.
    pub at: DataLine,
    /// What stands there.
    pub given: String,
    /// What is expected.
    pub expected: String,
}

fn wrong(file: &str, line: usize, given: impl Into<String>, expected: impl Into<String>) -> ThesisFileError {
    ThesisFileError { at: DataLine { file: file.into(), line }, given: given.into(), expected: expected.into() }
}

/// A number as Fortran writes it, 1.0D-3 too.
fn number(text: &str) -> Option<f64> {
    let plain = text.replace(['d', 'D'], "e");
    plain.parse().ok().filter(|value: &f64| value.is_finite() && value.abs() <= scene::source::LARGEST_NUMBER)
}
