//! The results of a run: the numbers that a designer takes away, each with a band and a verdict (THEORY GE18 to GE20).
//!
//! A curve of particles contains the noise of rows that the body meets, and at first contact a water hammer of the numerical speed of
//! sound. Both last as long as the body takes to fall through a spacing or two. A peak is therefore a mean over the time of three
//! spacings; the largest value of a single step is given beside it, as `raw`.

mod averaging;
mod filtered;
mod judge;
mod observer;
mod running_integral;

pub use averaging::time_of_impact;
pub use filtered::{FilteredAcceleration, PASS_OVER_CLASS};
pub use observer::ResultsObserver;
pub(crate) use running_integral::{Extreme, RunningIntegral};

/// Why the acceleration of a body in the air is no result.
pub(crate) const OF_FREE_FALL: &str = "the largest acceleration is that of free fall before contact, and no result; the water decelerates the body by less than that";

/// The same where the force of the water is none either.
const OF_UNRESOLVED_FALL: &str =
    "the largest acceleration is that of free fall before contact, and the force of the water is not resolved";

/// Why the largest force of a body that enters is not resolved.
const OF_SUCTION: &str =
    "the largest force pulls the body into the water: air that comes in would make it smaller, and no case measures it";

/// Standard gravity [m/s²].
pub(crate) const STANDARD_GRAVITY: f64 = 9.80665;
