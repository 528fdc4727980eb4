//! A run: build the scene, step to its end, observe on the way, keep log, curves, summary and report.

mod driver;
mod energy_balance;
mod error;
mod files;
mod outcome;
mod panel_result;
mod particle_order;
mod recorder;
pub mod summary;

pub use driver::run;
pub use error::RunError;
pub use files::FILES;
pub(crate) use files::refuse_occupied;
pub use outcome::{Outcome, RunOptions};
pub use panel_result::{Extremes, PanelResult, Rupture};
pub use particle_order::ParticleOrder;
