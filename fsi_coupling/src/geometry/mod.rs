//! Shapes and the particles made from them: outlines, boundary particles, thin plates, the layout of the water.

pub mod error;
pub mod layout;
pub mod outline;
pub mod packing;
pub mod plate;
pub mod plate_sampling;
pub mod polygon;
pub mod polyline;
pub mod rows;
pub mod sampling;
pub mod shape;
pub mod vector;
pub mod water_surface;
