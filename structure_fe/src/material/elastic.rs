//! The material: isotropic and linearly elastic.

use crate::error::{Error, positive};
use serde::{Deserialize, Serialize};

/// An isotropic, linearly elastic material. Checked when a [`Beam`](crate::Beam) is built of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E \[Pa\], positive.
    pub youngs_modulus: f64,
    /// Poisson's ratio nu \[-\], in (-1, 1/2]. Only [`Section::strip`](crate::Section::strip) uses it.
    pub poissons_ratio: f64,
    /// Density rho \[kg/m^3\], positive.
    pub density: f64,
}

impl Material {
    pub(crate) fn check(&self, element: usize) -> Result<(), Error> {
        positive("Young's modulus [Pa]", "element", element, self.youngs_modulus)?;
        positive("density [kg/m^3]", "element", element, self.density)?;
        if self.poissons_ratio > -1.0 && self.poissons_ratio <= 0.5 {
            Ok(())
        } else {
            Err(Error::PoissonsRatio { element, value: self.poissons_ratio })
        }
    }
}
