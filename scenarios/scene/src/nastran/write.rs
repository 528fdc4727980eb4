//! From a beam model to its text, in fields of 16 columns.

use Value::{Blank, Real, Whole};

use super::cards::{Value, comment, written};
use super::model::{Bar, BeamModel, Constraint, Grid, Isotropic, Orientation, Property};

impl BeamModel {
    /// The model as a bulk data file.
    pub fn written(&self) -> String {
        let comments = self.heading.iter().map(|line| comment(line));
        let parts = [
            comments.collect(),
            self.grids.iter().map(grid).collect(),
            self.bars.iter().map(bar).collect(),
            self.properties.iter().map(property).collect(),
            self.materials.iter().map(isotropic).collect(),
            self.constraints.iter().map(constraint).collect::<String>(),
        ];
        parts.concat()
    }
}

fn word(text: &str) -> Value {
    if text.is_empty() { Blank } else { Value::Word(text.to_string()) }
}

/// A real number, or nothing for zero.
fn unless_zero(value: f64) -> Value {
    if value == 0.0 { Blank } else { Real(value) }
}

fn grid(grid: &Grid) -> String {
    let [x, y, z] = grid.at.map(Real);
    written("GRID", &[Whole(grid.id), Blank, x, y, z, Blank, word(&grid.held)])
}

fn bar(bar: &Bar) -> String {
    let [a, b] = bar.grids.map(Whole);
    let [x, y, z] = match bar.orientation {
        Orientation::Vector(vector) => vector.map(Real),
        Orientation::Grid(grid) => [Whole(grid), Blank, Blank],
    };
    let [pa, pb] = [0, 1].map(|end| word(&bar.released[end]));
    written("CBAR", &[Whole(bar.id), Whole(bar.property), a, b, x, y, z, Blank, pa, pb])
}

fn property(section: &Property) -> String {
    let Property { id, material, area, second_moments: [i1, i2], extra_mass, .. } = *section;
    let first = [Whole(id), Whole(material), Real(area), Real(i1), Real(i2), Blank, unless_zero(extra_mass), Blank];
    let points = section.stress_points.iter().flatten().map(|value| unless_zero(*value));
    let shear = section.shear_factors.iter().map(|value| unless_zero(*value));
    written("PBAR", &first.into_iter().chain(points).chain(shear).collect::<Vec<_>>())
}

fn isotropic(material: &Isotropic) -> String {
    let Isotropic { id, youngs_modulus, shear_modulus, density, allowable_stress, .. } = *material;
    let mut fields = vec![Whole(id), Real(youngs_modulus), Real(shear_modulus), Blank, Real(density)];
    if let Some(limit) = allowable_stress {
        fields.extend([Blank, Blank, Blank, Real(limit), Real(limit)]);
    }
    written("MAT1", &fields)
}

fn constraint(constraint: &Constraint) -> String {
    let Constraint { set, components, grids, .. } = constraint;
    let head = [Whole(*set), word(components)];
    let consecutive = grids.windows(2).all(|pair| pair[1] == pair[0] + 1);
    let fields: Vec<Value> = match grids[..] {
        [first, _, .., last] if consecutive => {
            head.into_iter().chain([Whole(first), Value::Word("THRU".into()), Whole(last)]).collect()
        }
        _ => head.into_iter().chain(grids.iter().map(|grid| Whole(*grid))).collect(),
    };
    written("SPC1", &fields)
}
