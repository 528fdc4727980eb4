//! Elastic and viscous forces apart from inertia, and their tangents: for rules with a lumped mass.

use crate::beam::add_ends;
use crate::bordered::Bordered;
use crate::corotational::{Chord, add_deformation_matrix, add_elastic_tangent, deformation_forces};
use crate::element::{ElementConstants, Ends, end_forces};
use crate::equations::Arms;
use crate::inertia::Damping;
use crate::mean_forces::{Start, mean_forces, mean_forces_and_tangent};
use crate::system::System;

/// The plastic curvatures of an element: none where nothing yields.
#[inline]
fn history(plastic: &[[f64; 2]], element: usize) -> [f64; 2] {
    plastic.get(element).copied().unwrap_or_default()
}

/// What yielding adds to the elastic forces (N, M_s, M_a), and to their tangent: ss, sa, aa.
#[inline]
fn yielding(element: &ElementConstants, chord: &Chord, before: [f64; 2]) -> [[f64; 3]; 2] {
    let Some(bending) = &element.plastic else { return [[0.0; 3]; 2] };
    let flow = bending.flow(&chord.deformation, before);
    [[0.0, flow.relief[0], flow.relief[1]], flow.softening]
}

/// End forces in the chord's axes, with what yielding adds.
#[inline]
pub(crate) fn relieved(element: &ElementConstants, chord: &Chord, relief: &[f64; 3]) -> Ends {
    let forces = deformation_forces(element, &chord.deformation);
    end_forces(&[forces[0], forces[1] + relief[1], forces[2] + relief[2]], chord.length)
}

impl System {
    /// Elastic forces of beams and springs (THEORY S10); `tangent`: adds that many times the tangent (S11) to the
    /// matrix, forces taken to the bodies with the first arms, displacements with the second.
    /// Elements that yield do so from the curvatures `plastic`.
    pub fn elastic_forces(
        &self,
        q: &[[f64; 3]],
        plastic: &[[f64; 2]],
        forces: &mut [[f64; 3]],
        tangent: Option<(f64, Arms, &mut Bordered)>,
    ) {
        forces.fill([0.0; 3]);
        self.supports.add_spring_forces(q, forces);
        let Some((factor, arms, matrix)) = tangent else {
            for (index, (nodes, element)) in self.beam.formulated().enumerate() {
                let chord = Chord::new(element, &self.beam.ends(nodes, q));
                let [relief, _] = yielding(element, &chord, history(plastic, index));
                add_ends(forces, nodes, &chord.to_global(&relieved(element, &chord, &relief)));
            }
            return;
        };
        for (index, (nodes, element)) in self.beam.formulated().enumerate() {
            let chord = Chord::new(element, &self.beam.ends(nodes, q));
            let [relief, softening] = yielding(element, &chord, history(plastic, index));
            add_ends(forces, nodes, &chord.to_global(&relieved(element, &chord, &relief)));
            let mut local = [[0.0; 6]; 6];
            add_elastic_tangent(element, &chord, &relief, factor, &mut local);
            if element.plastic.is_some() {
                let [ss, sa, aa] = softening;
                add_deformation_matrix(&chord, &[0.0, 0.0, 0.0, ss, sa, aa], factor, &mut local);
            }
            self.add_matrix(nodes, &chord.matrix_to_global(&local), arms, matrix);
        }
        self.add_stiffness_of_springs(factor, arms, matrix);
    }

    /// The plastic curvatures that the model has at `q`, of those it had before.
    pub fn flow(&self, q: &[[f64; 3]], plastic: &mut [[f64; 2]]) {
        for ((nodes, element), curvature) in self.beam.formulated().zip(plastic) {
            if let Some(bending) = &element.plastic {
                let chord = Chord::new(element, &self.beam.ends(nodes, q));
                *curvature = bending.flow(&chord.deformation, *curvature).curvature;
            }
        }
    }

    /// A history of plastic curvatures that has not begun; empty where nothing yields.
    pub fn unyielded(&self) -> Vec<[f64; 2]> {
        let elements = if self.beam.first_that_yields().is_some() { self.beam.elements().len() } else { 0 };
        vec![[0.0; 2]; elements]
    }

    /// The chords of the elements.
    pub fn chords(&self, q: &[[f64; 3]]) -> Vec<Chord> {
        self.beam.formulated().map(|(nodes, element)| Chord::new(element, &self.beam.ends(nodes, q))).collect()
    }

    /// Elastic forces of beams and springs over a step that leads from the chords `from` and the displacement `before`
    /// to `q`, with the `weight` of its end (THEORY S22); returns what they take beyond the change of the elastic energy
    /// \[J\]. `tangent` as above, with the derivative by `q`.
    pub fn mean_elastic_forces(
        &self,
        (from, before): (&[Chord], &[[f64; 3]]),
        q: &[[f64; 3]],
        plastic: &[[f64; 2]],
        weight: f64,
        forces: &mut [[f64; 3]],
        tangent: Option<(Arms, &mut Bordered)>,
    ) -> f64 {
        forces.fill([0.0; 3]);
        let mut dissipated = 0.0;
        for spring in self.supports.springs() {
            let (node, dof) = (spring.node, spring.dof as usize);
            let (start, end) = (before[node][dof], q[node][dof]);
            forces[node][dof] += spring.stiffness * ((1.0 - weight) * start + weight * end);
            dissipated += (weight - 0.5) * spring.stiffness * (end - start).powi(2);
        }
        let elements = self.beam.formulated().zip(from).enumerate();
        let Some((arms, matrix)) = tangent else {
            for (index, ((nodes, element), &from)) in elements {
                let (before, ends) = (self.beam.ends(nodes, before), self.beam.ends(nodes, q));
                let start = Start { from, before: &before, plastic: history(plastic, index) };
                let mean = mean_forces(element, start, &ends, weight);
                add_ends(forces, nodes, &mean.forces);
                dissipated += mean.dissipated;
            }
            return dissipated;
        };
        for (index, ((nodes, element), &from)) in elements {
            let (before, ends) = (self.beam.ends(nodes, before), self.beam.ends(nodes, q));
            let start = Start { from, before: &before, plastic: history(plastic, index) };
            let (mean, local) = mean_forces_and_tangent(element, start, &ends, weight, 1.0);
            add_ends(forces, nodes, &mean.forces);
            dissipated += mean.dissipated;
            self.add_matrix(nodes, &local, arms, matrix);
        }
        self.add_stiffness_of_springs(weight, arms, matrix);
        dissipated
    }

    /// Forces of the damping (THEORY S13), with a lumped `mass`, of velocities `v` where the model is at `q`.
    pub fn viscous_forces(
        &self,
        q: &[[f64; 3]],
        v: &[[f64; 3]],
        damping: &Damping,
        mass: &[[f64; 3]],
    ) -> Vec<[f64; 3]> {
        let each = mass.iter().zip(v);
        let mut forces: Vec<[f64; 3]> =
            each.map(|(mass, v)| [0, 1, 2].map(|dof| damping.mass * mass[dof] * v[dof])).collect();
        if damping.stiffness > 0.0 {
            for (nodes, element) in self.beam.formulated() {
                let chord = Chord::new(element, &self.beam.ends(nodes, q));
                let rates = chord.deformation_rates(&chord.to_local(&self.beam.ends(nodes, v)));
                let viscous = [0, 1, 2].map(|i| damping.stiffness * element.stiffness[i] * rates[i]);
                add_ends(&mut forces, nodes, &chord.to_global(&end_forces(&viscous, chord.length)));
            }
            for spring in self.supports.springs() {
                let dof = spring.dof as usize;
                forces[spring.node][dof] += damping.stiffness * spring.stiffness * v[spring.node][dof];
            }
        }
        forces
    }

    /// Adds `factor` times the damping's derivative by velocity, but for the part of the mass.
    pub fn add_viscosity(&self, q: &[[f64; 3]], damping: &Damping, factor: f64, arms: Arms, matrix: &mut Bordered) {
        if damping.stiffness > 0.0 {
            let factor = factor * damping.stiffness;
            for (nodes, element) in self.beam.formulated() {
                let chord = Chord::new(element, &self.beam.ends(nodes, q));
                let [axial, arc, ess] = element.stiffness;
                let mut local = [[0.0; 6]; 6];
                add_deformation_matrix(&chord, &[axial, 0.0, 0.0, arc, 0.0, ess], factor, &mut local);
                self.add_matrix(nodes, &chord.matrix_to_global(&local), arms, matrix);
            }
            self.add_stiffness_of_springs(factor, arms, matrix);
        }
    }
}
