//! The material, isotropic and linearly elastic; and the cross-section: a rectangle, free to contract sideways or held in plane strain (THEORY BE2),
//! or a bar of any profile by its properties.

use crate::error::{Error, not_negative, positive};
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

/// A cross-section. [`Beam`](crate::Beam) checks its values.
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
    /// Any profile, free to contract sideways.
    Bar(BarSection),
}

/// Properties of the cross-section of a bar, which bends in a plane of symmetry of its profile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BarSection {
    /// Area A \[m^2\].
    pub area: f64,
    /// Second moment of area I for bending in the plane \[m^4\].
    pub second_moment: f64,
    /// Shear modulus G \[Pa\]; only Timoshenko's theory uses it.
    pub shear_modulus: f64,
    /// Distances of the outer fibres from the axis, to the left of it: of the right one, zero or negative, and of the left one, zero or
    /// positive \[m\].
    pub fibres: [f64; 2],
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

    /// A bar of any profile, with modulus E. Forces of such a model are those of what its properties stand for: the whole bar, or a metre
    /// of span of a stiffened plate.
    pub fn bar(properties: BarSection) -> Self {
        Self(Profile::Bar(properties))
    }

    /// Depth between the outer fibres in the plane, of a rectangle its thickness h \[m\].
    pub fn thickness(&self) -> f64 {
        match self.0 {
            Profile::Rectangular { thickness, .. } | Profile::Strip { thickness } => thickness,
            Profile::Bar(BarSection { fibres: [right, left], .. }) => left - right,
        }
    }

    /// Distances of the outer fibres to the left of the axis: of the right one and of the left one, -h/2 and h/2 of a rectangle \[m\].
    pub fn fibres(&self) -> [f64; 2] {
        match self.0 {
            Profile::Rectangular { thickness, .. } | Profile::Strip { thickness } => {
                [-0.5 * thickness, 0.5 * thickness]
            }
            Profile::Bar(BarSection { fibres, .. }) => fibres,
        }
    }

    /// Area A, of a rectangle b h \[m^2\].
    pub fn area(&self) -> f64 {
        match self.0 {
            Profile::Rectangular { thickness, width } => width * thickness,
            Profile::Strip { thickness } => thickness,
            Profile::Bar(BarSection { area, .. }) => area,
        }
    }

    /// Second moment of area I, of a rectangle b h^3/12 \[m^4\].
    pub fn second_moment(&self) -> f64 {
        match self.0 {
            Profile::Rectangular { thickness, width } => width * thickness.powi(3) / 12.0,
            Profile::Strip { thickness } => thickness.powi(3) / 12.0,
            Profile::Bar(BarSection { second_moment, .. }) => second_moment,
        }
    }

    /// Axial stiffness E A, of a strip E h/(1 - nu^2) times its width of one metre \[N\].
    pub fn axial_stiffness(&self, material: &Material) -> f64 {
        self.modulus(material) * self.area()
    }

    /// Bending stiffness E I, of a strip E h^3/(12 (1 - nu^2)) times its width of one metre \[N m^2\].
    pub fn bending_stiffness(&self, material: &Material) -> f64 {
        self.modulus(material) * self.second_moment()
    }

    /// Shear stiffness kappa G A with G = E/(2 (1 + nu)), of a bar its own G, and the `shear_correction` kappa \[N\].
    pub fn shear_stiffness(&self, material: &Material, shear_correction: f64) -> f64 {
        let shear_modulus = match self.0 {
            Profile::Bar(BarSection { shear_modulus, .. }) => shear_modulus,
            _ => material.youngs_modulus / (2.0 * (1.0 + material.poissons_ratio)),
        };
        shear_correction * shear_modulus * self.area()
    }

    /// Mass per length rho A \[kg/m\].
    pub fn mass_per_length(&self, material: &Material) -> f64 {
        material.density * self.area()
    }

    pub(crate) fn is_strip(&self) -> bool {
        matches!(self.0, Profile::Strip { .. })
    }

    pub(crate) fn is_rectangle(&self) -> bool {
        !matches!(self.0, Profile::Bar(_))
    }

    pub(crate) fn modulus(&self, material: &Material) -> f64 {
        match self.0 {
            Profile::Rectangular { .. } | Profile::Bar(_) => material.youngs_modulus,
            Profile::Strip { .. } => material.youngs_modulus / (1.0 - material.poissons_ratio.powi(2)),
        }
    }

    pub(crate) fn check(&self, element: usize) -> Result<(), Error> {
        match self.0 {
            Profile::Bar(BarSection { area, second_moment, shear_modulus, fibres: [right, left] }) => {
                positive("area [m^2]", "element", element, area)?;
                positive("second moment of area [m^4]", "element", element, second_moment)?;
                positive("shear modulus [Pa]", "element", element, shear_modulus)?;
                not_negative("distance of the right fibre [m]", -right)?;
                not_negative("distance of the left fibre [m]", left)?;
                positive("depth between the outer fibres [m]", "element", element, left - right)?;
            }
            Profile::Rectangular { thickness, width } => {
                positive("thickness [m]", "element", element, thickness)?;
                positive("width [m]", "element", element, width)?;
            }
            Profile::Strip { thickness } => {
                positive("thickness [m]", "element", element, thickness)?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: Material = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };

    #[test]
    fn a_bar_with_the_properties_of_a_rectangle_is_one() {
        let (rectangle, shear_modulus) = (Section::rectangular(0.02, 0.05), STEEL.youngs_modulus / 2.6);
        let (area, second_moment) = (rectangle.area(), rectangle.second_moment());
        let bar = Section::bar(BarSection { area, second_moment, shear_modulus, fibres: [-0.01, 0.01] });
        assert!(bar.check(0).is_ok());
        assert_eq!((bar.thickness(), bar.fibres()), (rectangle.thickness(), rectangle.fibres()));
        assert_eq!(bar.bending_stiffness(&STEEL), rectangle.bending_stiffness(&STEEL));
        assert_eq!(bar.axial_stiffness(&STEEL), rectangle.axial_stiffness(&STEEL));
        assert_eq!(bar.mass_per_length(&STEEL), rectangle.mass_per_length(&STEEL));
        let [bar, rectangle] = [bar, rectangle].map(|section| section.shear_stiffness(&STEEL, 5.0 / 6.0));
        assert!((bar / rectangle - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_bar_without_depth_or_area_is_refused() {
        let sound = BarSection { area: 1e-3, second_moment: 1e-8, shear_modulus: 8e10, fibres: [-0.01, 0.02] };
        for wrong in [
            BarSection { area: 0.0, ..sound },
            BarSection { second_moment: -1e-8, ..sound },
            BarSection { shear_modulus: f64::NAN, ..sound },
            BarSection { fibres: [0.0, 0.0], ..sound },
            BarSection { fibres: [0.01, 0.02], ..sound },
        ] {
            assert!(Section::bar(wrong).check(0).is_err(), "{wrong:?}");
        }
    }
}
