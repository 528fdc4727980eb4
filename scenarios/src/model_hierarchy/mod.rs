//! The model hierarchy: one scene, models from microseconds to minutes (THEORY EN9).
//!
//! [`Theory`] solves a scene by an entry theory, `run` writes its files. [`assess`] gives cost, range of validity and measured
//! error of every theory; [`choose`] takes the cheapest model whose measured error is within a tolerance.
//!
//! # Example
//! ```
//! use scenarios::model_hierarchy::{QuantityOfInterest, assess};
//! use scenarios::scene;
//!
//! let scene = scene::load("wedge_constant", &[])?.scene;
//! let theories = assess(&scene, QuantityOfInterest::PeakForce);
//! assert!(theories.iter().any(|a| a.obstacle.is_none() && a.measured.is_some()));
//! # Ok::<(), scenarios::scene::SceneError>(())
//! ```

mod assess;
mod choose;
mod elastic_wedge;
mod measured;
mod rolled;
mod run;
mod theory;

pub use assess::{Assessment, assess};
pub use choose::{Choice, charted_number, choose};
pub use measured::{Measured, measured};
pub(crate) use run::{Followed, run};
pub use theory::Theory;

pub use crate::scene::QuantityOfInterest;

impl QuantityOfInterest {
    /// As text.
    pub fn words(self) -> &'static str {
        match self {
            QuantityOfInterest::PeakForce => "the largest force",
            QuantityOfInterest::PeakPressure => "the largest pressure",
            QuantityOfInterest::History => "the force over time",
            QuantityOfInterest::Strain => "strains",
            QuantityOfInterest::Motion => "the motion",
        }
    }
}
