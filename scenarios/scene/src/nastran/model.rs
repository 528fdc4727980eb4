//! A beam model: what its cards say, in their units.

/// A grid point: GRID.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Its number.
    pub id: i64,
    /// Where it is.
    pub at: [f64; 3],
    /// Components that are held for good, such as "345".
    pub held: String,
    /// Line of its card.
    pub line: usize,
}

/// What directs the first plane of a bar.
#[derive(Debug, Clone, PartialEq)]
pub enum Orientation {
    /// A vector from its first end.
    Vector([f64; 3]),
    /// A grid point.
    Grid(i64),
}

/// A bar: CBAR or CBEAM.
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    /// Its number.
    pub id: i64,
    /// Number of its property.
    pub property: i64,
    /// Grid points of its ends.
    pub grids: [i64; 2],
    /// Direction of its first plane.
    pub orientation: Orientation,
    /// Components that its ends do not transmit, such as "1".
    pub released: [String; 2],
    /// Line of its card.
    pub line: usize,
}

/// A section: PBAR, PBARL or PBEAM.
#[derive(Debug, Clone, PartialEq)]
pub struct Property {
    /// Its number.
    pub id: i64,
    /// Number of its material.
    pub material: i64,
    /// Area.
    pub area: f64,
    /// Second moments of area for bending in the first and the second plane.
    pub second_moments: [f64; 2],
    /// Mass per length that is not structure.
    pub extra_mass: f64,
    /// Places in the first and second direction where stress is recovered: C, D, E, F.
    pub stress_points: [[f64; 2]; 4],
    /// Shear factors of both planes; 0 is without shear.
    pub shear_factors: [f64; 2],
    /// Line of its card.
    pub line: usize,
}

/// A material: MAT1.
#[derive(Debug, Clone, PartialEq)]
pub struct Isotropic {
    /// Its number.
    pub id: i64,
    /// Young's modulus.
    pub youngs_modulus: f64,
    /// Shear modulus.
    pub shear_modulus: f64,
    /// Density.
    pub density: f64,
    /// Allowable stress: the smaller of those in tension and in compression.
    pub allowable_stress: Option<f64>,
    /// Line of its card.
    pub line: usize,
}

/// Components of grid points that are held: SPC1, SPC.
#[derive(Debug, Clone, PartialEq)]
pub struct Constraint {
    /// Number of the set.
    pub set: i64,
    /// Components, such as "126".
    pub components: String,
    /// Grid points.
    pub grids: Vec<i64>,
    /// Line of its card.
    pub line: usize,
}

/// The cards of a beam model, in their order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BeamModel {
    /// Comments at its beginning, without `$`.
    pub heading: Vec<String>,
    /// Grid points.
    pub grids: Vec<Grid>,
    /// Bars.
    pub bars: Vec<Bar>,
    /// Sections.
    pub properties: Vec<Property>,
    /// Materials.
    pub materials: Vec<Isotropic>,
    /// Constraints.
    pub constraints: Vec<Constraint>,
    /// Number of lines.
    pub lines: usize,
    /// What was left out, in sentences.
    pub notes: Vec<String>,
}
