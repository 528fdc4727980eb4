//! Statics: linear analysis, large displacements by load steps, and equilibrium paths by the arc length.
//!
//! A cantilever bent by a moment at its tip into a quarter of a circle, which linear analysis cannot represent:
//!
//! ```
//! use structure_fe::{Beam, Loads, Material, NonlinearStatics, Section, Supports};
//! use std::f64::consts::FRAC_PI_2;
//!
//! let rubber = Material { youngs_modulus: 5e6, poissons_ratio: 0.0, density: 1100.0 };
//! let section = Section::rectangular(0.01, 0.02);
//! let beam = Beam::straight([0.0, 0.0], [1.0, 0.0], 16, rubber, section)?;
//! let mut supports = Supports::default();
//! supports.clamp(0);
//! let mut loads = Loads::default();
//! loads.at_node(16, [0.0, 0.0, FRAC_PI_2 * section.bending_stiffness(&rubber)]); // M = EI kappa
//!
//! let tip = NonlinearStatics::new(beam, supports)?.solve(&loads, 4)?.displacement[16];
//! let radius = 1.0 / FRAC_PI_2;
//! assert!((tip[0] - (radius - 1.0)).abs() < 1e-3 && (tip[1] - radius).abs() < 1e-3);
//! # Ok::<(), structure_fe::Error>(())
//! ```

mod arc_length;
mod linear;
mod mechanism;
mod nonlinear;

pub use arc_length::PathPoint;
pub use linear::{StaticSolution, Statics};
pub use nonlinear::NonlinearStatics;
