//! How well the program's numbers agree with references, by quantity (THEORY GE28): points, bias and scatter.
//!
//! The points are those of `splashdown validate --all --store`, which are part of the program: a run's page quotes from them.

mod point;
mod quantity;
mod state;
mod statistics;

pub use point::{Nature, Pedigree, Point};
pub use quantity::Quantity;
pub use state::{Number, State};
pub use statistics::{LEAST_POINTS, Statistics};
