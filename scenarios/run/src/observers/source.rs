//! A source of columns of `series.csv`.

use scene::Scene;

use crate::observers::Frame;

/// Reads the values of a source's columns, in their order.
pub(super) type Reader = Box<dyn FnMut(&Frame<'_>) -> Vec<f64> + Send>;

/// Where columns come from.
pub(super) struct Source {
    /// Names of the columns that a scene asks for; a name ends with its unit.
    pub names: fn(&Scene) -> Vec<String>,
    /// Reader of these columns.
    pub reader: fn(&Scene) -> Reader,
}
