//! The columns of `series.csv`: declared once, for the file, for the check of a scene, and for the theories.

mod body;
mod energy;
mod front;
mod joints;
mod level;
mod volume;

use scene::Scene;

use super::gauges;
use super::source::Source;

pub use body::body_values;
pub(crate) use body::{modal_values, panel_values};
pub(super) use volume::VOLUME;
pub use volume::Water;

/// All sources, in the order of the file. A new column is a source in a file of its own, and its lines here.
pub(super) const SOURCES: [Source; 7] =
    [body::SOURCE, joints::SOURCE, gauges::SOURCE, front::SOURCE, level::SOURCE, volume::SOURCE, energy::SOURCE];

/// Names of the columns of a scene; the first is `time_s`.
pub fn columns(scene: &Scene) -> Vec<String> {
    std::iter::once("time_s".to_string()).chain(SOURCES.iter().flat_map(|source| (source.names)(scene))).collect()
}
