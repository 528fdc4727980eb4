//! `splashdown chart`: error against cost, for each way to compute a number.
//!
//! A chart is a TOML file in `scenarios/cases/charts`: a scene, numbers of its `summary.json` whose true values are known, and
//! families of runs, each of one solver or setting at growing effort. Every run is made on this machine and gives all
//! numbers. The stored JSON file redraws the chart without a run.

mod case;
mod laws;
mod measure;
mod measured;
mod page;
mod peers;

pub use case::{CHARTS, Case, Family, Quantity, Reading};
pub use laws::error_laws;
pub use measure::{measure, stored};
pub use measured::{Measured, Outcome, Point, Run, Seen, Trend};
pub use page::{page, svg, table};
