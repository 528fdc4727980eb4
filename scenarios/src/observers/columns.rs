//! The columns of `series.csv`: declared once, for the file, for the check of a scene, and for the theories.

use super::source::Source;
use super::{body, front, gauges, level, volume};
use crate::scene::Scene;

/// All sources, in the order of the file. A new column is a source in a file of its own and a line here.
pub(super) const SOURCES: [Source; 5] = [body::SOURCE, gauges::SOURCE, front::SOURCE, level::SOURCE, volume::SOURCE];

/// Names of the columns of a scene; the first is `time_s`.
pub fn columns(scene: &Scene) -> Vec<String> {
    std::iter::once("time_s".to_string()).chain(SOURCES.iter().flat_map(|source| (source.names)(scene))).collect()
}
