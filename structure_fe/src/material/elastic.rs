//! The material: isotropic and linearly elastic.

use crate::error::{Error, positive};
use serde::{Deserialize, Serialize};

/// An isotropic, linearly elastic material. [`Beam`](crate::Beam) checks its values.
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
        let (quantity, item, value) = ("Poisson's ratio [-]", "element", self.poissons_ratio);
        if value > -1.0 && value <= 0.5 {
            return Ok(());
        }
        Err(Error::BadProperty { quantity, item, index: element, value, expected: "in (-1, 0.5]" })
    }
}
