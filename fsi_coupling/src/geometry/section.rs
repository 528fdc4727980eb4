//! The bottom of a shape, as theories of entry take it.

use water_entry::{OutOfRange, Section};

use super::shape::Shape;

/// The bottom of an upright body.
///
/// # Errors
/// A shape without a bottom that theories hold for.
pub fn section_of(shape: &Shape) -> Result<Section, OutOfRange> {
    match shape {
        Shape::Wedge { deadrise_deg, breadth, .. } => Section::wedge(*deadrise_deg, *breadth),
        Shape::Arc { radius, breadth, .. } => Section::arc(*radius, *breadth),
        Shape::Box { .. } => Err(OutOfRange::not_a_section("a flat bottom")),
        Shape::Polyline { .. } => Err(OutOfRange::not_a_section("an open plate")),
        Shape::Polygon { points } => Section::of_polygon(points),
    }
}
