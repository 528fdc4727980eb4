//! The cross-section: a rectangle, free to contract sideways or held in plane strain.

use crate::error::{Error, positive};
use crate::material::Material;
use serde::{Deserialize, Serialize};

/// What the section does across the plane of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Lateral {
    /// No lateral stress: a slender bar, modulus E.
    Free,
    /// No lateral strain: a strip of a wide plate, modulus E/(1 - nu^2).
    Held,
}

/// A solid rectangular cross-section. Checked when a [`Beam`](crate::Beam) is built of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Section {
    thickness: f64,
    width: f64,
    lateral: Lateral,
}

impl Section {
    /// A bar of `thickness` h \[m\] in the plane and `width` b \[m\] across it.
    ///
    /// Area A = b h, second moment of area I = b h^3/12, modulus E. Forces of such a model are those
    /// of the whole bar \[N\]. Valid for a width not much larger than the thickness.
    pub fn rectangular(thickness: f64, width: f64) -> Self {
        Self {
            thickness,
            width,
            lateral: Lateral::Free,
        }
    }

    /// A strip one metre wide of a wide plate of `thickness` h \[m\]: cylindrical bending.
    ///
    /// Plane strain across the plane stiffens the strip: bending stiffness
    /// D = E h^3/(12 (1 - nu^2)) \[N m\], membrane stiffness E h/(1 - nu^2) \[N/m\]
    /// (Timoshenko & Woinowsky-Krieger 1959, ch. 1). Forces are per metre of span \[N/m\].
    pub fn strip(thickness: f64) -> Self {
        Self {
            thickness,
            width: 1.0,
            lateral: Lateral::Held,
        }
    }

    /// Thickness h in the plane \[m\].
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Area A = b h \[m^2\]; with b = 1 m for a strip.
    pub fn area(&self) -> f64 {
        self.width * self.thickness
    }

    /// Second moment of area I = b h^3/12 \[m^4\]; with b = 1 m for a strip.
    pub fn second_moment(&self) -> f64 {
        self.width * self.thickness.powi(3) / 12.0
    }

    /// Axial stiffness E A, of a strip E h/(1 - nu^2) \[N\].
    pub fn axial_stiffness(&self, material: &Material) -> f64 {
        self.modulus(material) * self.area()
    }

    /// Bending stiffness E I, of a strip D = E h^3/(12 (1 - nu^2)) \[N m^2\].
    pub fn bending_stiffness(&self, material: &Material) -> f64 {
        self.modulus(material) * self.second_moment()
    }

    /// Mass per length rho A \[kg/m\].
    pub fn mass_per_length(&self, material: &Material) -> f64 {
        material.density * self.area()
    }

    fn modulus(&self, material: &Material) -> f64 {
        match self.lateral {
            Lateral::Free => material.youngs_modulus,
            Lateral::Held => material.youngs_modulus / (1.0 - material.poissons_ratio.powi(2)),
        }
    }

    pub(crate) fn check(&self, element: usize) -> Result<(), Error> {
        positive("thickness [m]", "element", element, self.thickness)?;
        positive("width [m]", "element", element, self.width)?;
        Ok(())
    }
}
