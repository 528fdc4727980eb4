//! Mass-proportional damping: of the motion against the rigid body that holds the node, or against the ground (THEORY BE13).

use super::System;
use crate::field::{Field, combine};
use crate::linear_algebra::Bordered;

/// Half rotations of a step below which tan(x)/x is 1 to rounding \[rad\].
const SMALL: f64 = 1e-8;

impl System {
    /// Whether all nodes are damped against the ground: a model without rigid bodies.
    pub fn is_damped_against_ground(&self) -> bool {
        self.damping_references.is_empty()
    }

    /// Lever arms from the bodies to the nodes that they hold, by node, over a step between two displacements \[m\]: with
    /// r the mean of both ends, a = r tan(x)/x, x half the body's rotation. A rigid motion then has the relative
    /// displacement zero, to rounding.
    pub fn damping_arms(&self, from: &[[f64; 3]], to: &[[f64; 3]]) -> Field {
        let (places, mut arms) = (self.beam.nodes(), vec![[0.0; 3]; from.len()]);
        for (node, body) in self.damping_references.held() {
            let half = 0.5 * (to[body][2] - from[body][2]);
            let longer = if half.abs() < SMALL { 1.0 } else { half.tan() / half };
            let at = |node: usize, k: usize| places[node][k] + 0.5 * (from[node][k] + to[node][k]);
            let [x, y] = [0, 1].map(|k| longer * (at(node, k) - at(body, k)));
            arms[node] = [x, y, 0.0];
        }
        arms
    }

    /// Forces `factor` m v of the velocities `v` against the references, with the reactions on the bodies; `arms` of
    /// [`System::damping_arms`].
    pub fn mass_damping_forces(&self, arms: &[[f64; 3]], v: &[[f64; 3]], mass: &[[f64; 3]], factor: f64) -> Field {
        if factor == 0.0 || self.is_damped_against_ground() {
            return combine(mass, v, |mass, v| factor * mass * v);
        }
        let mut forces = vec![[0.0; 3]; v.len()];
        for node in self.damping_references.grounded() {
            forces[node] = [0, 1, 2].map(|dof| factor * mass[node][dof] * v[node][dof]);
        }
        for (node, body) in self.damping_references.held() {
            let ([x, y, _], turning) = (arms[node], v[body][2]);
            let rigid = [v[body][0] - turning * y, v[body][1] + turning * x, turning];
            for dof in (0..3).filter(|&dof| !self.equations.links.follows(node, dof)) {
                let force = factor * mass[node][dof] * (v[node][dof] - rigid[dof]);
                forces[node][dof] += force;
                forces[body][dof] -= force;
                forces[body][2] -= [-y * force, x * force, 0.0][dof];
            }
        }
        forces
    }

    /// Adds the derivative of [`System::mass_damping_forces`] by velocity, in a model with rigid bodies.
    pub fn add_mass_damping(&self, arms: &[[f64; 3]], mass: &[[f64; 3]], factor: f64, matrix: &mut Bordered) {
        let number = |node: usize, dof: usize| self.equations.number(node, dof);
        for node in self.damping_references.grounded() {
            for dof in 0..3 {
                if let Some(row) = number(node, dof) {
                    matrix.add(row, row, factor * mass[node][dof]);
                }
            }
        }
        for (node, body) in self.damping_references.held() {
            let [x, y, _] = arms[node];
            for dof in (0..3).filter(|&dof| !self.equations.links.follows(node, dof)) {
                // the relative velocity: of the node, less the body's, less that of its rotation
                let by_rotation = [y, -x, 0.0][dof];
                let terms = [(number(node, dof), 1.0), (number(body, dof), -1.0), (number(body, 2), by_rotation)];
                for (row, by_row) in terms {
                    for (column, by_column) in terms {
                        if let (Some(row), Some(column)) = (row, column) {
                            matrix.add(row, column, factor * mass[node][dof] * by_row * by_column);
                        }
                    }
                }
            }
        }
    }
}
