//! Steady planing of a prismatic V-hull with a transom (THEORY EN42–EN45).
//!
//! [`PlaningHull`] is the hull in its attitude and at its speed, [`Planing`] the load at a wetted length. The sections are those of a landing
//! ([`ditching`](super::ditching), EN17); the lift has the share of a wetted area of finite length, and the equation of a lifting surface of small
//! aspect ratio places it along the hull.
//!
//! ```
//! use water_entry::planing::{Immersion, PlaningHull};
//!
//! # fn main() -> Result<(), water_entry::planing::NotPlaning> {
//! let hull = PlaningHull { breadth: 1.0, deadrise_deg: 20.0, trim_deg: 6.0, speed: 25.0, density: 1000.0, gravity: 9.81 };
//! let planing = hull.planes(Immersion::WettedLength(2.0))?;
//! // Savitsky (1964): C_L = 0.0879 for a deadrise of 20 degrees at C_v = 8
//! assert!((planing.lift_coefficient / 0.0879 - 1.0).abs() < 0.1);
//! # Ok(()) }
//! ```

mod hull;
mod lifting_surface;
mod range;
mod steady;

pub use hull::{Immersion, NotPlaning, PlaningHull, Wetted};
pub use lifting_surface::LiftingSurface;
pub use range::{CENTRE_BAND, LIFT_BAND};
pub use steady::{Planing, PlaningSlice, finite_length};
