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

use serde::{Deserialize, Serialize};

/// What is asked of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Want {
    /// The largest force.
    #[default]
    PeakForce,
    /// The largest pressure.
    PeakPressure,
    /// The force over time.
    History,
    /// Strains of panels.
    Strain,
    /// The body's motion.
    Motion,
}

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
