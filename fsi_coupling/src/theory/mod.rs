//! Low-order models of water entry: microseconds in the place of minutes (THEORY LM1–LM11).
//!
//! [`Section`] is the bottom, [`Rung`] the ladder of models and their ranges, [`Loads`] what a section bears at a draught,
//! [`Entry`] its motion. [`SimilarityFlow`] is the exact flow about a wedge.

pub mod ditching;
mod dobrovolskaya;
mod entry;
mod loads;
mod rung;
mod section;
mod similarity;

pub use entry::{Course, Entry, Instant};
pub use loads::{Load, Loads};
pub use rung::{OutOfRange, Rung};
pub use section::Section;
pub use similarity::{DEADRISES, SimilarityFlow};
