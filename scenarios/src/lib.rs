//! Scenes, runs, observers and reports: the library of the `splashdown` command.
//!
//! [`scene`] reads a scene, [`build`] makes fluid and bodies of it, [`run`] steps them while [`observers`] sample,
//! [`compare`] judges against [`reference`] data, [`report`] writes the page. [`model_hierarchy`] runs a scene by a
//! theory, [`experiments`] makes and judges many runs, [`sweep`] runs a scene at many points in processes of their own, [`ditching`]
//! lands aeroplanes by their sections, [`bench`] measures the speed on this machine, [`host`] lets another program move a scene's body. [`cli`] parses arguments and prints.
//!
//! Run a scene and read its summary, here by a theory (a run with particles differs in the model only):
//!
//! ```
//! use scenarios::run::{RunOptions, run};
//! use scenarios::scene;
//!
//! let scene = scene::load("wedge", &["model=wagner".to_string()])?.scene;
//! let summary = run(&scene, &RunOptions::default())?.summary;
//! let force = summary.peaks["wedge.fy_N_per_m"];
//! assert!(force.value > 0.0 && force.time_s <= scene.time.end);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod bench;
mod bounded_text;
pub mod build;
pub mod charted;
pub mod cli;
pub mod compare;
mod data_table;
pub mod ditching;
mod embedded;
pub mod error_bar;
pub mod experiments;
pub mod export;
pub mod follow;
pub mod host;
mod initial_fluid;
pub mod log;
pub mod model_hierarchy;
pub mod nastran;
pub mod numbers;
pub mod observers;
mod power_law;
pub mod preflight;
pub mod reference;
pub mod reference_page;
pub mod report;
pub mod results;
pub mod run;
pub mod scene;
mod spelling;
pub mod sweep;
pub mod templates;
#[cfg(feature = "legacy")]
pub mod thesis_files;
