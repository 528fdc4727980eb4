//! The weakly compressible scheme (THEORY E3–E17).

pub mod eos;
mod settings;
pub mod step_limit;
mod updates;

pub use settings::Settings;
