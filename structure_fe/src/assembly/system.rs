//! The equations of a model at large displacements: numbering, matrix layout, and measures of vectors over them.

use super::damping_references::DampingReferences;
use super::{Arms, Equations};
use crate::element::EndsMatrix;
use crate::error::Error;
use crate::field::Dof;
use crate::linear_algebra::{Bordered, narrow_band};
use crate::model::{Beam, Supports};

/// A supported model at large displacements, with its equation numbers and the width of their band.
#[derive(Debug, Clone)]
pub(crate) struct System {
    pub beam: Beam,
    pub supports: Supports,
    pub equations: Equations,
    pub(super) damping_references: DampingReferences,
    half_band: usize,
}

/// Displacement, velocity and acceleration of the model, `[nodes][u, w, theta]`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kinematics<'a> {
    pub q: &'a [[f64; 3]],
    pub v: &'a [[f64; 3]],
    pub a: &'a [[f64; 3]],
}

impl System {
    pub fn new(beam: Beam, supports: Supports) -> Result<Self, Error> {
        supports.check(&beam)?;
        let links = beam.elements().iter().map(|element| element.nodes).chain(supports.joints());
        let order = narrow_band(beam.nodes().len(), links);
        let equations = Equations::in_order(order.into_iter(), &beam, &supports);
        let half_band = beam.elements().iter().map(|element| equations.band(element.nodes)).max().unwrap_or(0);
        let damping_references = DampingReferences::new(&beam, &supports);
        Ok(Self { beam, supports, equations, damping_references, half_band })
    }

    /// A zero matrix over the equations.
    pub fn matrix(&self) -> Bordered {
        let inner = self.equations.inner();
        Bordered::new(inner, self.half_band, self.equations.count() - inner)
    }

    /// Adds an element's matrix; the arms are those of [`Equations::scatter_entry`].
    #[inline]
    pub fn add_matrix(&self, nodes: [usize; 2], local: &EndsMatrix, arms: Arms, matrix: &mut Bordered) {
        self.equations.scatter(nodes, local, arms, |row, column, value| matrix.add(row, column, value));
    }

    /// Adds `factor` times the stiffness of the springs.
    pub fn add_spring_stiffness(&self, factor: f64, arms: Arms, matrix: &mut Bordered) {
        for spring in &self.supports.springs {
            let place = (spring.node, spring.dof as usize);
            self.equations.scatter_entry([place, place], factor * spring.stiffness, arms, |row, column, value| {
                matrix.add(row, column, value);
            });
        }
    }

    /// Adds `factor` a . F on the body's rotation: minus the derivative of the moments of `forces` on linked nodes by the
    /// rotation of the lever arms (THEORY BE20).
    pub fn add_arm_rotation(&self, forces: &[[f64; 3]], arms: &[[f64; 2]], factor: f64, matrix: &mut Bordered) {
        for (link, arm) in self.equations.links.all.iter().zip(arms) {
            if let Some(row) = self.equations.number(link.body, 2) {
                let force = forces[link.node];
                matrix.add(row, row, factor * (arm[0] * force[0] + arm[1] * force[1]));
            }
        }
    }

    /// Adds `factor * values` to the free entries of a displacement and sets the linked nodes.
    pub fn displace(&self, factor: f64, values: &[f64], q: &mut [[f64; 3]]) {
        self.equations.add(factor, values, q);
        self.equations.links.set_displacement(q);
    }

    /// Norm of a change of the displacements \[-\]: its largest entry, lengths over the model's extent.
    pub fn size(&self, change: &[f64]) -> f64 {
        let extent = self.beam.extent();
        change.iter().enumerate().fold(0.0, |largest: f64, (equation, change)| {
            let (_, dof) = self.equations.place(equation);
            let scaled = if dof == Dof::Theta { change.abs() } else { change.abs() / extent };
            // `max` would drop a value that is not a number.
            if scaled.is_nan() { f64::NAN } else { largest.max(scaled) }
        })
    }

    /// Norm of the difference of two displacements \[-\], as above.
    pub fn size_of_difference(&self, a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
        let scale = self.beam.extent().recip();
        a.iter().zip(b).fold(0.0, |largest: f64, (a, b)| {
            let moved = (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
            largest.max(moved * scale).max((a[2] - b[2]).abs())
        })
    }

    /// The largest entry of a residual \[N\], moments over the model's extent, with its node and degree of freedom.
    pub fn worst(&self, residual: &[f64]) -> (f64, usize, Dof) {
        let extent = self.beam.extent();
        let mut worst = (0.0, 0, Dof::U);
        for (equation, value) in residual.iter().enumerate() {
            let (node, dof) = self.equations.place(equation);
            let size = if dof == Dof::Theta { value.abs() / extent } else { value.abs() };
            if size.is_nan() || size >= worst.0 {
                worst = (size, node, dof);
                if size.is_nan() {
                    break;
                }
            }
        }
        worst
    }
}

#[cfg(test)]
mod tests {
    use super::System;
    use crate::material::{Material, Section};
    use crate::model::{Beam, Supports};

    const MATERIAL: Material = Material { youngs_modulus: 70e9, poissons_ratio: 0.33, density: 2700.0 };

    /// Half-bandwidth and width of the border: the work of a factorisation is their square times the number of unknowns.
    fn widths(beam: Beam, supports: Supports) -> [usize; 2] {
        let system = System::new(beam, supports).unwrap();
        [system.half_band, system.equations.count() - system.equations.inner()]
    }

    /// A dense matrix would grow with the beam.
    #[test]
    fn the_band_of_a_beam_has_the_same_width_for_any_number_of_elements() {
        for elements in [100, 1000] {
            let beam = Beam::straight([0.0, 0.0], [1.0, 0.0], elements, MATERIAL, Section::strip(0.005)).unwrap();
            let mut supports = Supports::default();
            supports.clamp(0);
            assert_eq!(widths(beam, supports), [5, 0], "{elements} elements");
        }
    }

    /// A body inside the band would make it as wide as the beam.
    #[test]
    fn ties_to_a_body_all_along_do_not_widen_the_band() {
        for elements in [100, 1000] {
            let skin = Beam::straight([0.0, 0.0], [1.0, 0.0], elements, MATERIAL, Section::strip(0.005)).unwrap();
            let (model, body) = skin.with_rigid_body([0.5, 0.3], 50.0, 5.0).unwrap();
            let mut supports = Supports::default();
            for node in (0..=elements).step_by(5) {
                supports.link(body, node);
            }
            assert_eq!(widths(model, supports), [5, 3], "{elements} elements");
        }
    }
}
