//! Natural modes: K phi = omega^2 M phi.

use crate::beam::Beam;
use crate::equations::{Entry, Equations};
use crate::error::{Error, existing_node, finite};
use crate::supports::{Dof, Supports};
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

/// Mass that something around the model adds to it, a fluid for one: a block between nodes, row by row over their
/// `[u, w, theta]` \[kg, kg m, kg m^2\]. Rows are forces, columns accelerations; of an unsymmetric one the mean with
/// its transpose counts.
#[derive(Debug, Clone, PartialEq)]
pub struct AddedMass {
    /// The nodes, at any distance from each other.
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
            return Err(Error::WrongBlock { index, given: self.block.len(), nodes: self.nodes.len() });
        }
        finite("added mass", index, &self.block)
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
/// The problem is solved as M phi = mu (K + sigma M) phi, mu = 1/(omega^2 + sigma): with
/// K + sigma M = L L^T it is that of the symmetric C = L^-1 M L^-T, whose largest, hence best
/// determined, eigenvalues are the lowest modes; the shift sigma admits rigid motions (Bathe 2014,
/// ch. 10). Each frequency is then the Rayleigh quotient of its shape, from energies, with an error
/// of second order in that of the shape. C is dense: time grows with the cube of the unknowns, so
/// for a few hundred of them.
pub fn natural_modes(beam: &Beam, supports: &Supports, count: usize) -> Result<Vec<Mode>, Error> {
    wet_modes(beam, supports, count, &[])
}

/// The `count` lowest natural modes with `added` masses: of a plate in water, where the surface's waves and the
/// water's compressibility do not matter (THEORY S25). Modal masses include them.
pub fn wet_modes(beam: &Beam, supports: &Supports, count: usize, added: &[AddedMass]) -> Result<Vec<Mode>, Error> {
    supports.check(beam)?;
    let equations = Equations::new(beam, supports);
    for &node in beam.rigid_bodies() {
        for (dof, quantity) in
            [(Dof::U, "mass [kg]"), (Dof::W, "mass [kg]"), (Dof::Theta, "moment of inertia [kg m^2]")]
        {
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
    let mass = symmetric(unknowns, &equations.mass(beam));
    let arms = equations.ties.arms();
    let mut mass = mass;
    for AddedMass { nodes, block } in added {
        let width = 3 * nodes.len();
        for (k, value) in block.iter().enumerate() {
            let [i, j] = [k / width, k % width].map(|i| (nodes[i / 3], i % 3));
            for places in [(i, j), (j, i)] {
                equations.spread(places, 0.5 * value, [&arms, &arms], |row, column, value| {
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
        equations.ties.follow_linearly(&arms, &mut shape);
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
    let energy = beam.strain_energy(&shape) + supports.spring_energy(&shape);
    Mode { angular_frequency: (2.0 * energy).sqrt(), shape }
}

/// The full symmetric matrix of the entries of its lower triangle.
fn symmetric(unknowns: usize, lower_triangle: &[Entry]) -> Mat<f64> {
    let mut matrix = Mat::zeros(unknowns, unknowns);
    for entry in lower_triangle {
        matrix[(entry.row, entry.column)] += entry.value;
        if entry.row != entry.column {
            matrix[(entry.column, entry.row)] += entry.value;
        }
    }
    matrix
}
