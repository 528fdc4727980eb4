//! The results of a run: the numbers that a designer takes away, each with a band and a verdict (THEORY GE18 to GE20).
//!
//! A curve of particles contains the noise of rows that the body meets, and at first contact a water hammer of the numerical speed of
//! sound. Both last as long as the body takes to fall through a spacing or two. A peak is therefore a mean over the time of three
//! spacings; the largest value of a single step is given beside it, as `raw`.

mod air_pulse;
mod averaging;
mod bands;
mod blunt;
mod filtered;
mod judge;
mod observer;
mod panel;
mod running_integral;
mod taken_back;
mod tension;

pub use filtered::{FilteredAcceleration, PASS_OVER_CLASS};
pub use observer::ResultsObserver;
pub(crate) use running_integral::{Extreme, RunningIntegral};

use crate::vocabulary::{Verdict, Why};

/// Standard gravity [m/s²].
pub(crate) const STANDARD_GRAVITY: f64 = 9.80665;

/// Why a number is withheld.
const WIDE: &str = "its band is as large as itself";

/// A verdict, the band as a share where one is known, and why it is not `resolved`.
type Finding = (Verdict, Option<f64>, Option<Why>);
