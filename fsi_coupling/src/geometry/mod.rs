//! Shapes and the particles made from them: outlines, boundary particles, thin plates, the layout of the water.
//!
//! ```
//! use fsi_coupling::geometry::sampling::sample;
//! use fsi_coupling::{Outline, Shape, WallRows};
//!
//! # fn main() -> Result<(), fsi_coupling::geometry::error::OutlineError> {
//! let wedge = Outline::of(&Shape::Wedge { deadrise_deg: 30.0, breadth: 1.0, side_height: 0.2 })?;
//! assert!((wedge.signed_distance([0.0, -0.1]) - 0.1).abs() < 1e-12, "0.1 m below the keel");
//! let particles = sample(&wedge, &WallRows::filled(0.02, 3), false);
//! assert!(particles.iter().all(|p| wedge.signed_distance(p.at) < 0.0), "boundary particles are inside the body");
//! # Ok(()) }
//! ```

pub mod error;
pub mod hermite;
pub mod layout;
pub mod outline;
mod outline_shares;
pub mod packing;
pub mod plate;
pub mod plate_sampling;
pub mod polygon;
pub mod polyline;
pub mod rows;
pub mod sampling;
pub mod section;
pub mod shape;
pub mod underside;
pub mod vector;
pub mod water_surface;
