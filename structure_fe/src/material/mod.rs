//! Materials and cross-sections: elastic constants, stiffness per length, yielding.
//!
//! A steel plate strip of 10 mm is 10 % stiffer in bending than a bar of the same rectangle, because plane strain
//! prevents its lateral contraction:
//!
//! ```
//! use structure_fe::{Material, Section};
//!
//! let steel = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };
//! let (strip, bar) = (Section::strip(0.01), Section::rectangular(0.01, 1.0));
//! let ratio = strip.bending_stiffness(&steel) / bar.bending_stiffness(&steel);
//! assert!((ratio - 1.0 / (1.0 - 0.3 * 0.3)).abs() < 1e-12);
//! assert!((strip.mass_per_length(&steel) - 78.5).abs() < 1e-12); // [kg/m], per metre of span
//! ```

mod layers;
mod plasticity;
mod section;

pub(crate) use layers::{LAYERS, Layers};
pub use plasticity::Plasticity;
pub(crate) use plasticity::YieldLaw;
pub use section::{BarSection, Material, Section};
