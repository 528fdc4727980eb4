//! `splashdown chart`: what an answer costs, and how wrong it is, for each way to get it.
//!
//! A chart is a TOML file in `scenarios/cases/charts`: a scene, numbers of its `summary.json` whose true values are known, and
//! families of runs, each of one solver or setting at growing effort. Every run is made on this machine and gives all
//! numbers; its JSON draws the chart again without a run.

mod case;
mod fits;
mod measure;
mod measured;
mod page;
mod peers;
mod power_law;

use crate::scene::SceneError;

pub use case::{Case, Family, Quantity, Reading, Setting, cases, select};
pub use fits::{ChartFit, Kind, ShareOf, charted_error, error_bars, fits, spacing_within};
pub use measure::{measure, stored};
pub use measured::{Measured, Outcome, Point, Run, Seen, Trend};
pub use page::{page, svg, table};
pub use peers::{Given, Peer, PeerPoint, peers};
pub use power_law::PowerLaw;

/// A chart that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum ChartError {
    /// No case of that name.
    #[error("no chart `{0}`; there are: {1}")]
    Unknown(String, String),
    /// A case's file is wrong.
    #[error("chart `{0}`: {1}")]
    Case(String, String),
    /// A stored chart cannot be read.
    #[error("{0}: {1}; expected the JSON file of a chart that was measured")]
    Stored(String, String),
    /// A chart to take up again was measured under other conditions.
    #[error("--resume: {name} was measured as {before}; expected {now}, so that costs compare")]
    Conditions {
        /// The chart.
        name: String,
        /// How it was measured.
        before: String,
        /// How it would be.
        now: String,
    },
    /// The case's scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A chart cannot be kept.
    #[error("cannot write to {0}: {1}")]
    Write(String, std::io::Error),
}
