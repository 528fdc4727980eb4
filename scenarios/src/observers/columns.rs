//! The columns of `series.csv`: declared once, for the file, for the check of a scene, and for the theories.

use super::{Frame, body, front, gauges, level, volume};
use crate::scene::Scene;

/// Reads the values of a source's columns, in their order.
pub(super) type Reader = Box<dyn FnMut(&Frame<'_>) -> Vec<f64> + Send>;

/// Where columns come from.
pub(super) struct Source {
    /// Names of the columns that a scene asks for; a name ends with its unit.
    pub names: fn(&Scene) -> Vec<String>,
    /// Reader of these columns.
    pub reader: fn(&Scene) -> Reader,
}

/// All sources, in the order of the file. A new column is a source in a file of its own and a line here.
pub(super) const SOURCES: [Source; 5] = [body::SOURCE, gauges::SOURCE, front::SOURCE, level::SOURCE, volume::SOURCE];

/// Names of the columns of a scene; the first is `time_s`.
pub fn columns(scene: &Scene) -> Vec<String> {
    std::iter::once("time_s".to_string()).chain(SOURCES.iter().flat_map(|source| (source.names)(scene))).collect()
}
