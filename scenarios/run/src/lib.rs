//! Runs of scenes: build the scene, step to its end, observe on the way, keep log, curves and summary.
//!
//! [`load`] reads a scene with all models of this program, [`run`] runs it: by particles ([`build`], [`observers`], [`log`], [`results`]) or by a
//! theory ([`model_hierarchy`]). [`Resumable`] continues a run, [`host`] lets another program move the scene's body. [`compare`] judges
//! against references, [`charted`] quotes errors from stored charts.
//!
//! Run a scene and read its summary, here by a theory (a run with particles differs in the model only):
//!
//! ```
//! use run::{RunOptions, load, run};
//!
//! let scene = load("wedge", &["model=wagner".to_string()])?.scene;
//! let summary = run(&scene, &RunOptions::default())?.summary;
//! let force = summary.peaks["wedge.fy_N_per_m"];
//! assert!(force.value > 0.0 && force.time_s <= scene.time.end);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod audit;
pub mod build;
pub mod charted;
pub mod checkpoint;
pub mod compare;
mod driver;
mod error;
pub mod error_bar;
pub mod evidence;
pub mod folder;
pub mod host;
mod initial_fluid;
mod link_results;
mod load;
pub mod log;
pub mod memory;
pub mod model_hierarchy;
mod modes;
pub mod numbers;
pub mod observers;
mod options;
mod panel;
mod particle_order;
pub mod power_law;
mod recorder;
mod recorder_state;
pub mod results;
mod resume;
mod stated;
pub mod stated_numbers;
pub mod summary;

pub use driver::run;
pub use error::RunError;
pub use folder::FILES;
pub use load::{load, load_beyond_limits, load_text};
pub use options::{Checkpoints, Outcome, Page, RunOptions, StartViewers};
pub use particle_order::ParticleOrder;
pub use resume::Resumable;
pub use summary::{Extremes, PanelEnvelope, PanelResult, Rupture};
