//! Shapes, and how they become particles: outlines, boundary particles, thin plates, the layout of the water.

pub mod layout;
pub mod outline;
pub mod packing;
pub mod polygon;
pub mod polyline;
pub mod rows;
pub mod sampling;
pub mod shape;
pub mod thin_plate;
pub mod water_surface;
