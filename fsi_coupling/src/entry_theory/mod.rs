//! Low-order models of water entry: microseconds in the place of minutes (THEORY EN2–EN9).
//!
//! [`Section`] is the bottom, [`Rung`] the ladder of models and their ranges, [`Loads`] what a section bears at a draught,
//! [`Entry`] its motion. [`SimilarityFlow`] is the exact flow about a wedge, [`ElasticWedge`] a wedge whose faces bend, [`ditching`] an
//! aeroplane made of sections.

pub mod ditching;
mod dobrovolskaya;
mod entry;
mod hydroelastic;
mod loads;
mod rung;
mod section;
mod similarity;

pub use entry::{Course, Entry, Instant};
pub use hydroelastic::{Bent, ElasticWedge, Held};
pub use loads::{Load, Loads};
pub use rung::{OutOfRange, Rung};
pub use section::Section;
pub use similarity::{DEADRISES, SimilarityFlow};
