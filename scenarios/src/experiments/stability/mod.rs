//! `splashdown stability`: where a method is stable, inaccurate or fails over two parameters, against a theoretical boundary.
//!
//! A map is a TOML file in `scenarios/cases/maps`: a scene, two axes, bounds of inaccuracy and failure, and a [`Boundary`]. Every
//! point is a run on one thread, so the bits of a map do not depend on the number of runs side by side. `--point X,Y` repeats
//! one run.

mod acoustics;
mod boundary;
mod lattice;
mod map;
mod measured;
mod page;
mod picture;
mod points;

pub use boundary::Boundary;
pub use map::{Axis, Bound, Choice, Key, MAPS, Map};
pub use measured::{Measured, Point, Verdict, stored};
pub use page::{page, table};
pub use picture::svg;
pub use points::{boundary_ratio, point, run_map};
