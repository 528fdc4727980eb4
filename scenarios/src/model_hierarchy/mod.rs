//! The ladder: one scene, many models, from microseconds to minutes (THEORY LM11).
//!
//! [`Theory`] follows a scene's body by a formula, [`run`] writes the files of a run from it, [`rungs`] says of every model what
//! it costs, whether it can do the scene, and how far off it was where it was measured; [`choose`] takes the cheapest that is
//! near enough.

mod assess;
mod choose;
mod elastic_wedge;
mod measured;
mod run;
mod theory;

pub use assess::{Assessment, assess};
pub use choose::{Choice, charted_number, choose};
pub use measured::{Measured, measured};
pub(crate) use run::run;
pub use theory::Theory;

pub use crate::scene::Want;

impl Want {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Want::PeakForce => "the largest force",
            Want::PeakPressure => "the largest pressure",
            Want::History => "the force over time",
            Want::Strain => "strains",
            Want::Motion => "the motion",
        }
    }
}
