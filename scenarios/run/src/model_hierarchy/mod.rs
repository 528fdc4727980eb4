//! The model hierarchy: one scene, models from microseconds to minutes (THEORY EN9).
//!
//! [`Theory`] solves a scene by an entry theory, `theory_run` writes its files. [`assess`] gives cost, range of validity and measured
//! error of every theory; [`choose`] takes the cheapest model whose measured error is within a tolerance.
//!
//! # Example
//! ```
//! use run::model_hierarchy::assess;
//! use scene::QuantityOfInterest;
//!
//! let scene = run::load("wedge_constant", &[])?.scene;
//! let theories = assess(&scene, QuantityOfInterest::PeakForce);
//! assert!(theories.iter().any(|a| a.obstacle.is_none() && a.measured.is_some()));
//! # Ok::<(), scene::SceneError>(())
//! ```

mod assess;
mod bending_flow;
mod choose;
mod curves;
mod elastic_wedge;
mod largest_mean;
mod measured;
mod measured_error;
mod rolled;
mod theory;
mod theory_run;
mod upright;

pub use assess::{Assessment, assess};
pub use choose::{charted_number, choose};
pub use measured::measured;
pub use measured_error::Measured;
pub use theory::Theory;
pub(crate) use theory_run::{Followed, run};
