//! Natural modes, dry and wet: K phi = omega^2 M phi (THEORY BE10).
//!
//! A cantilever of steel, 1 m long, in air and with an added mass of 20 kg at its tip:
//!
//! ```
//! use structure_fe::{AddedMass, Beam, Material, Section, Supports, natural_modes, wet_modes};
//!
//! let steel = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };
//! let beam = Beam::straight([0.0, 0.0], [1.0, 0.0], 10, steel, Section::rectangular(0.02, 0.05))?;
//! let mut supports = Supports::default();
//! supports.clamp(0);
//! let dry = natural_modes(&beam, &supports, 3)?;
//! let ratio = dry[1].angular_frequency / dry[0].angular_frequency;
//! assert!((ratio - (4.69409113_f64 / 1.87510407).powi(2)).abs() < 1e-2);
//!
//! let water = AddedMass { nodes: vec![10], block: vec![20.0, 0.0, 0.0, 0.0, 20.0, 0.0, 0.0, 0.0, 0.0] };
//! let wet = wet_modes(&beam, &supports, 1, &[water])?;
//! assert!(wet[0].angular_frequency < 0.5 * dry[0].angular_frequency);
//! # Ok::<(), structure_fe::Error>(())
//! ```

use crate::assembly::{Equations, SymmetricMatrix};
use crate::error::{Error, existing_node, finite};
use crate::field::Dof;
use crate::model::{Beam, Supports};
use faer::{Mat, Scale, Side};

/// The shift sigma as a fraction of the largest K_ii/M_ii, which estimates omega_max^2: the root of
/// the rounding unit, so that neither K nor sigma M is lost in their sum.
const SHIFT: f64 = 1e-8;

/// One natural mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Angular frequency omega \[rad/s\].
    pub angular_frequency: f64,
    /// Shape phi `[nodes][u, w, theta]` with modal mass phi^T M phi = 1 kg; its sign is arbitrary.
    pub shape: Vec<[f64; 3]>,
}

/// Added mass of a surrounding fluid: a block between nodes, row by row over their `[u, w, theta]`
/// \[kg, kg m, kg m^2\]. Rows are forces, columns accelerations; the symmetric part of the block is used.
#[derive(Debug, Clone, PartialEq)]
pub struct AddedMass {
    /// The nodes; they need not be adjacent.
    pub nodes: Vec<usize>,
    /// `[3 nodes][3 nodes]`, row by row.
    pub block: Vec<f64>,
}

impl AddedMass {
    fn check(&self, index: usize, nodes: usize) -> Result<(), Error> {
        for &node in &self.nodes {
            existing_node("added mass", index, node, nodes)?;
        }
        let width = 3 * self.nodes.len();
        if self.block.len() != width * width {
            let (given, expected) = (self.block.len(), width * width);
            return Err(Error::WrongLength { quantity: "a block of added mass", given, expected });
        }
        finite("entry", "added mass", index, &self.block)
    }

    /// phi^T A phi/2.
    fn kinetic_energy(&self, velocity: &[[f64; 3]]) -> f64 {
        let width = 3 * self.nodes.len();
        let at = |i: usize| velocity[self.nodes[i / 3]][i % 3];
        let entries = self.block.iter().enumerate();
        0.5 * entries.map(|(k, value)| value * at(k / width) * at(k % width)).sum::<f64>()
    }
}

/// The `count` lowest natural modes, by ascending frequency (fewer if the model has fewer unknowns).
///
/// The consistent mass makes every frequency an upper bound of the Euler-Bernoulli beam's, with an
/// error of order (kL/elements)^4. Supports may leave the model free: rigid motions come first, with
/// frequencies that are zero but for rounding.
///
/// The problem is solved as M phi = mu (K + sigma M) phi, mu = 1/(omega^2 + sigma): with K + sigma M = L L^T it is that
/// of the symmetric C = L^-1 M L^-T, whose largest, hence best determined, eigenvalues are the lowest modes; the shift
/// sigma admits rigid motions (Bathe 2014, ch. 10). Each frequency is then the Rayleigh quotient of its shape, from
/// energies, with an error of second order in that of the shape. C is dense: time grows with the cube of the unknowns,
/// so for a few hundred of them.
pub fn natural_modes(beam: &Beam, supports: &Supports, count: usize) -> Result<Vec<Mode>, Error> {
    wet_modes(beam, supports, count, &[])
}

/// The `count` lowest natural modes with `added` masses: for a plate in water if surface waves and compressibility are
/// negligible (THEORY BE24). Modal masses include them.
pub fn wet_modes(beam: &Beam, supports: &Supports, count: usize, added: &[AddedMass]) -> Result<Vec<Mode>, Error> {
    supports.check(beam)?;
    let equations = Equations::new(beam, supports);
    for &node in beam.rigid_bodies() {
        for dof in Dof::ALL {
            let quantity = if dof == Dof::Theta { "moment of inertia [kg m^2]" } else { "mass [kg]" };
            let value = beam.points()[node][dof as usize];
            if equations.number(node, dof as usize).is_some() && value == 0.0 {
                return Err(Error::MasslessBody { node, dof, quantity, value });
            }
        }
    }
    for (index, added) in added.iter().enumerate() {
        added.check(index, beam.nodes().len())?;
    }
    let unknowns = equations.count();
    let failed = |reason: String| Error::LinearAlgebra { unknowns, reason };

    let stiffness = symmetric(unknowns, &equations.stiffness(beam, supports));
    let mut mass = symmetric(unknowns, &equations.mass(beam));
    let arms = equations.links.arms();
    for AddedMass { nodes, block } in added {
        let width = 3 * nodes.len();
        for (k, value) in block.iter().enumerate() {
            let [i, j] = [k / width, k % width].map(|i| (nodes[i / 3], i % 3));
            for places in [[i, j], [j, i]] {
                equations.scatter_entry(places, 0.5 * value, [&arms, &arms], |row, column, value| {
                    mass[(row, column)] += value;
                });
            }
        }
    }
    let highest = (0..unknowns).map(|i| stiffness[(i, i)] / mass[(i, i)]).fold(0.0, f64::max);
    let shifted = stiffness + Scale(SHIFT * highest) * &mass;
    let factor = shifted.llt(Side::Lower).map_err(|error| failed(format!("K + sigma M: {error:?}")))?;
    let lower = factor.L();
    let mut half = mass;
    lower.solve_lower_triangular_in_place(half.as_mut());
    let mut standard = half.transpose().to_owned();
    lower.solve_lower_triangular_in_place(standard.as_mut());
    let eigen = standard.self_adjoint_eigen(Side::Lower).map_err(|error| failed(format!("eigenvalues: {error:?}")))?;
    let count = count.min(unknowns);
    let mut shapes = eigen.U().subcols(unknowns - count, count).to_owned();
    lower.transpose().solve_upper_triangular_in_place(shapes.as_mut());

    let shape_of = |column: faer::ColRef<f64>| {
        let mut shape = equations.extend(|equation| column[equation]);
        equations.links.set_velocity(&arms, &mut shape);
        shape
    };
    let mut modes: Vec<Mode> = shapes.col_iter().map(|shape| mode(beam, supports, added, shape_of(shape))).collect();
    modes.sort_by(|a, b| a.angular_frequency.total_cmp(&b.angular_frequency));
    Ok(modes)
}

/// The mode of a shape of any size: scaled to unit modal mass, its frequency from the energies.
fn mode(beam: &Beam, supports: &Supports, added: &[AddedMass], mut shape: Vec<[f64; 3]>) -> Mode {
    let of_added: f64 = added.iter().map(|added| added.kinetic_energy(&shape)).sum();
    let scale = (2.0 * (beam.kinetic_energy(&shape) + of_added)).sqrt().recip();
    for value in shape.as_flattened_mut() {
        *value *= scale;
    }
    let energy = beam.strain_energy(&shape) + supports.spring_energy(&shape) + supports.connector_energy(beam, &shape);
    Mode { angular_frequency: (2.0 * energy).sqrt(), shape }
}

/// The full symmetric matrix of the entries of its lower triangle.
fn symmetric(unknowns: usize, lower_triangle: &SymmetricMatrix) -> Mat<f64> {
    let mut matrix = Mat::zeros(unknowns, unknowns);
    for entry in lower_triangle {
        matrix[(entry.row, entry.col)] += entry.val;
        if entry.row != entry.col {
            matrix[(entry.col, entry.row)] += entry.val;
        }
    }
    matrix
}
