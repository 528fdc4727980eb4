//! The words of a run's results, stated once: names with titles and units, quantities, verdicts, status, doubts.
//!
//! | to change | place |
//! |---|---|
//! | a result: its name in `summary.json`, its title, its unit | the table in `names` |
//! | a verdict or a status: its name in files, its words on pages ("coarse" of a resolved number: `report::COARSE`) | the tables in `verdict` and `status` |
//! | a column of the curves: its title, its unit | the tables in `columns` |
//!
//! What each value *is* for a run is decided by `run::results`, with the rules of `validity`.

mod bandwidth;
mod columns;
mod doubt;
mod names;
mod quantity;
mod results;
mod status;
mod verdict;
mod withdrawn;

pub use bandwidth::{BandwidthBy, CUTOFF};
pub use columns::{ColumnTitle, column_title};
pub use doubt::{Doubt, Doubts, Shallow, Why};
pub use names::{ResultId, ResultName};
pub use quantity::{Quantity, is_withheld};
pub use results::{Named, Results};
pub use status::Status;
pub use verdict::Verdict;

/// Why a number is withheld.
pub const WIDE: &str = "its band is as large as itself";

/// A verdict, the band as a share where one is known, and why it is not `resolved`.
pub type Finding = (Verdict, Option<f64>, Option<Why>);
