//! Sweeps: scenes or landings at many points, each a process and a folder of its own, and the table of what they give.
//!
//! A [`SweepFile`] names scenes, fixed overrides and axes. A [`Plan`] resolves every point and gives it a folder whose name is a
//! hash of the resolved scene and of the program's version, so that nothing is computed twice. An engine runs the points that have
//! no outcome: the local [`pool`], HyperQueue or Slurm ([`engines`]). [`Collected`] reads what they gave; [`write_results`] writes
//! `table.csv`, `worst.csv` and `sweep.html`.
//!
//! | file in the sweep's folder | content |
//! |---|---|
//! | `sweep.json` | the plan: points, their values and folders |
//! | `sweep.lock` | held by the coordinator while it runs |
//! | `points/ID/given.json` | scene and overrides of a point |
//! | `points/ID/point.lock` | held by the process that runs the point |
//! | `points/ID/point.json` | how it ended; a point without this file runs again |

mod axes;
mod collect;
pub mod engines;
mod error;
mod file;
mod folder;
mod heat_map;
mod keys;
mod outputs;
mod page;
mod plan;
pub mod pool;
mod program;
mod progress;
mod response;
mod surfaces;
mod table;
mod trends;
mod words;
mod worker;

pub use axes::Block;
pub use collect::{Collected, PointResult};
pub use error::SweepError;
pub use file::{Kind, SweepFile};
pub use folder::{Outcome, PointFolder, State, SweepFolder};
pub use keys::schema;
pub use outputs::write_results;
pub use plan::{Plan, Point, Task};
pub use program::Program;
pub use progress::Progress;
pub use table::{WorstCase, worst_cases};
pub use worker::run_point;
