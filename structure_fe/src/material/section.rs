//! The material, isotropic and linearly elastic; and the cross-section: a rectangle, free to contract sideways or held in plane strain (THEORY BE2).

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

/// A solid rectangular cross-section. [`Beam`](crate::Beam) checks its values.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Section(Profile);

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum Profile {
    /// No stress across the plane.
    Rectangular { thickness: f64, width: f64 },
    /// No strain across the plane.
    Strip { thickness: f64 },
}

impl Section {
    /// A bar of `thickness` h \[m\] in the plane and `width` b \[m\] across it.
    ///
    /// Area A = b h, second moment of area I = b h^3/12, modulus E. Forces of such a model are those
    /// of the whole bar \[N\]. Valid for a width not much larger than the thickness.
    pub fn rectangular(thickness: f64, width: f64) -> Self {
        Self(Profile::Rectangular { thickness, width })
    }

    /// A strip one metre wide of a wide plate of `thickness` h \[m\]: cylindrical bending.
    ///
    /// Plane strain stiffens the strip: bending stiffness D = E h^3/(12 (1 - nu^2)) \[N m\], membrane stiffness E h/(1
    /// - nu^2) \[N/m\] (Timoshenko & Woinowsky-Krieger 1959, ch. 1). Forces are per metre of span \[N/m\].
    pub fn strip(thickness: f64) -> Self {
        Self(Profile::Strip { thickness })
    }

    /// Thickness h in the plane \[m\].
    pub fn thickness(&self) -> f64 {
        let (Profile::Rectangular { thickness, .. } | Profile::Strip { thickness }) = self.0;
        thickness
    }

    /// Width b across the plane \[m\]; 1 m for a strip.
    pub fn width(&self) -> f64 {
        match self.0 {
            Profile::Rectangular { width, .. } => width,
            Profile::Strip { .. } => 1.0,
        }
    }

    /// Area A = b h \[m^2\].
    pub fn area(&self) -> f64 {
        self.width() * self.thickness()
    }

    /// Second moment of area I = b h^3/12 \[m^4\].
    pub fn second_moment(&self) -> f64 {
        self.width() * self.thickness().powi(3) / 12.0
    }

    /// Axial stiffness E A, of a strip E h/(1 - nu^2) times its width of one metre \[N\].
    pub fn axial_stiffness(&self, material: &Material) -> f64 {
        self.modulus(material) * self.area()
    }

    /// Bending stiffness E I, of a strip E h^3/(12 (1 - nu^2)) times its width of one metre \[N m^2\].
    pub fn bending_stiffness(&self, material: &Material) -> f64 {
        self.modulus(material) * self.second_moment()
    }

    /// Shear stiffness kappa G A with G = E/(2 (1 + nu)) and the `shear_correction` kappa \[N\].
    pub fn shear_stiffness(&self, material: &Material, shear_correction: f64) -> f64 {
        shear_correction * material.youngs_modulus / (2.0 * (1.0 + material.poissons_ratio)) * self.area()
    }

    /// Mass per length rho A \[kg/m\].
    pub fn mass_per_length(&self, material: &Material) -> f64 {
        material.density * self.area()
    }

    fn modulus(&self, material: &Material) -> f64 {
        match self.0 {
            Profile::Rectangular { .. } => material.youngs_modulus,
            Profile::Strip { .. } => material.youngs_modulus / (1.0 - material.poissons_ratio.powi(2)),
        }
    }

    pub(crate) fn check(&self, element: usize) -> Result<(), Error> {
        positive("thickness [m]", "element", element, self.thickness())?;
        positive("width [m]", "element", element, self.width())?;
        Ok(())
    }
}
