//! Internal forces at the nodes and their tangents: elastic, viscous and, with consistent mass, inertia forces.

use super::{Arms, Kinematics, System};
use crate::element::{Chord, Damping, DiscreteGradient, EndsMatrix, Motion, PlasticStrains, Start, Weights};
use crate::element::{add_deformation_matrix, add_elastic_tangent, end_forces, response, viscous_forces};
use crate::field::{Field, combine};
use crate::linear_algebra::Bordered;
use crate::model::{Loads, add_ends};

impl System {
    /// Inertia with consistent mass, damping and elastic forces, the left-hand side of the equations of motion
    /// (THEORY BE11, BE12, BE13); `tangent`: replaces the matrix by the tangent with these weights.
    pub fn forces(
        &self,
        at: Kinematics,
        damping: &Damping,
        forces: &mut [[f64; 3]],
        mut tangent: Option<(Weights, &mut Bordered)>,
    ) {
        forces.fill([0.0; 3]);
        let weights = tangent.as_mut().map(|(weights, matrix)| {
            matrix.clear();
            *weights
        });
        let arms = if weights.is_some() { self.equations.links.arms_at(at.q) } else { Vec::new() };
        for (nodes, element) in self.beam.constants() {
            let ends = |field| self.beam.ends(nodes, field);
            let motion = Motion { q: ends(at.q), v: ends(at.v), a: ends(at.a) };
            let (force, local) = response(element, &motion, damping, weights);
            add_ends(forces, nodes, &force);
            if let (Some((_, matrix)), Some(local)) = (&mut tangent, local) {
                self.add_matrix(nodes, &local, [&arms, &arms], matrix);
            }
        }
        for (node, mass) in self.beam.points().iter().enumerate().filter(|(_, mass)| mass[0] > 0.0) {
            for dof in 0..3 {
                forces[node][dof] += mass[dof] * (at.a[node][dof] + damping.mass * at.v[node][dof]);
                if let (Some((weights, matrix)), Some(row)) = (&mut tangent, self.equations.number(node, dof)) {
                    matrix.add(row, row, mass[dof] * (weights.acceleration + damping.mass * weights.velocity));
                }
            }
        }
        for spring in &self.supports.springs {
            let (node, dof) = (spring.node, spring.dof as usize);
            forces[node][dof] += spring.stiffness * (at.q[node][dof] + damping.stiffness * at.v[node][dof]);
        }
        if let Some((weights, matrix)) = tangent {
            let factor = weights.displacement + damping.stiffness * weights.velocity;
            self.add_spring_stiffness(factor, [&arms, &arms], matrix);
        }
    }

    /// Elastic forces of beams, springs and connectors (THEORY BE11, BE27), with the return map from the strains `plastic`; `tangent`:
    /// adds that many times the tangent (BE11) to the matrix.
    pub fn elastic_forces(
        &self,
        q: &[[f64; 3]],
        plastic: &[PlasticStrains],
        forces: &mut [[f64; 3]],
        mut tangent: Option<(f64, Arms, &mut Bordered)>,
    ) {
        forces.fill([0.0; 3]);
        self.supports.add_spring_forces(q, forces);
        for (index, (nodes, element)) in self.beam.constants().enumerate() {
            let chord = Chord::new(element, &self.beam.ends(nodes, q));
            let layers = element.plastic.as_ref().zip(plastic.get(index));
            let yielded = layers.map(|(layers, plastic)| layers.corrections(element, &chord, plastic));
            let others = yielded.as_ref().map(|yielded| &yielded.forces);
            add_ends(forces, nodes, &chord.to_global(&chord.elastic_forces(element, others)));
            if let Some((factor, arms, matrix)) = &mut tangent {
                let mut local = EndsMatrix::ZERO;
                add_elastic_tangent(element, &chord, others.unwrap_or(&[0.0; 3]), *factor, &mut local);
                if let Some(yielded) = yielded {
                    add_deformation_matrix(&chord, &yielded.tangent, *factor, &mut local);
                }
                self.add_matrix(nodes, &chord.matrix_to_global(&local), *arms, matrix);
            }
        }
        if let Some((factor, arms, matrix)) = &mut tangent {
            self.add_spring_stiffness(*factor, *arms, matrix);
        }
        self.add_connector_forces_at(q, forces, tangent);
    }

    /// Updates the plastic strains by the return map at `q`.
    pub fn update_plasticity(&self, q: &[[f64; 3]], plastic: &mut [PlasticStrains]) {
        for ((nodes, element), strains) in self.beam.constants().zip(plastic) {
            if let Some(layers) = &element.plastic {
                layers.update(element, &Chord::new(element, &self.beam.ends(nodes, q)).deformation, strains);
            }
        }
    }

    /// Zero plastic strains; empty for an elastic model.
    pub fn no_plasticity(&self) -> Vec<PlasticStrains> {
        let elements = if self.beam.first_plastic_element().is_some() { self.beam.elements().len() } else { 0 };
        vec![PlasticStrains::NONE; elements]
    }

    /// The chords of the elements.
    pub fn chords(&self, q: &[[f64; 3]]) -> Vec<Chord> {
        self.beam.constants().map(|(nodes, element)| Chord::new(element, &self.beam.ends(nodes, q))).collect()
    }

    /// Elastic forces of beams, springs and connectors over a step from the chords `from` and the displacement `before` to `q`, with
    /// the `weight` of its end (THEORY BE21); returns their work beyond the change of the elastic energy \[J\].
    /// `tangent`: adds the derivative by `q` to the matrix.
    pub fn mean_elastic_forces(
        &self,
        (from, before): (&[Chord], &[[f64; 3]]),
        q: &[[f64; 3]],
        plastic: &[PlasticStrains],
        weight: f64,
        forces: &mut [[f64; 3]],
        mut tangent: Option<(Arms, &mut Bordered)>,
    ) -> f64 {
        forces.fill([0.0; 3]);
        let mut dissipated = 0.0;
        for spring in &self.supports.springs {
            let (node, dof) = (spring.node, spring.dof as usize);
            let (start, end) = (before[node][dof], q[node][dof]);
            forces[node][dof] += spring.stiffness * ((1.0 - weight) * start + weight * end);
            dissipated += (weight - 0.5) * spring.stiffness * (end - start).powi(2);
        }
        for (index, ((nodes, element), &from)) in self.beam.constants().zip(from).enumerate() {
            let (before, ends) = (self.beam.ends(nodes, before), self.beam.ends(nodes, q));
            let start = Start { from, before: &before, plastic: plastic.get(index) };
            let step = DiscreteGradient::new(element, start, &ends, weight);
            let mean = step.forces();
            add_ends(forces, nodes, &mean.forces);
            dissipated += mean.dissipated;
            if let Some((arms, matrix)) = &mut tangent {
                self.add_matrix(nodes, &step.tangent(), *arms, matrix);
            }
        }
        if let Some((arms, matrix)) = &mut tangent {
            self.add_spring_stiffness(weight, *arms, matrix);
        }
        dissipated + self.add_connector_forces([before, q], weight, forces, tangent)
    }

    /// Damping forces with a lumped `mass` (THEORY BE13) and of connectors (BE27), of velocities `v` over a step between the displacements `from`
    /// and `to`.
    pub fn viscous_forces(
        &self,
        [from, to]: [&[[f64; 3]]; 2],
        v: &[[f64; 3]],
        damping: &Damping,
        mass: &[[f64; 3]],
    ) -> Field {
        let arms = if damping.mass > 0.0 { self.damping_arms(from, to) } else { Vec::new() };
        let mut forces = self.mass_damping_forces(&arms, v, mass, damping.mass);
        if damping.stiffness > 0.0 {
            let middle = combine(from, to, |from, to| 0.5 * (from + to));
            for (nodes, element) in self.beam.constants() {
                let chord = Chord::new(element, &self.beam.ends(nodes, &middle));
                let viscous = viscous_forces(element, &chord, &chord.to_local(&self.beam.ends(nodes, v)), damping);
                add_ends(&mut forces, nodes, &chord.to_global(&end_forces(&viscous, chord.length)));
            }
            for spring in &self.supports.springs {
                let dof = spring.dof as usize;
                forces[spring.node][dof] += damping.stiffness * spring.stiffness * v[spring.node][dof];
            }
        }
        self.add_damper_forces([from, to], v, damping.stiffness, &mut forces);
        forces
    }

    /// Adds `factor` times the derivative of the stiffness-proportional damping and of the dampers by velocity.
    pub fn add_viscosity(&self, q: &[[f64; 3]], damping: &Damping, factor: f64, arms: Arms, matrix: &mut Bordered) {
        self.add_damper_tangent(q, damping.stiffness, factor, arms, matrix);
        if damping.stiffness > 0.0 {
            let factor = factor * damping.stiffness;
            for (nodes, element) in self.beam.constants() {
                let chord = Chord::new(element, &self.beam.ends(nodes, q));
                let [axial, arc, ess] = element.stiffness;
                let mut local = EndsMatrix::ZERO;
                add_deformation_matrix(&chord, &[axial, 0.0, 0.0, arc, 0.0, ess], factor, &mut local);
                self.add_matrix(nodes, &chord.matrix_to_global(&local), arms, matrix);
            }
            self.add_spring_stiffness(factor, arms, matrix);
        }
    }

    /// Subtracts `factor` times the derivative of the pressure loads by the displacement (THEORY BE14); not symmetric.
    ///
    /// Forces are linear in the chord vector, moments quadratic.
    pub fn subtract_pressure_tangent(&self, loads: &Loads, q: &[[f64; 3]], factor: f64, matrix: &mut Bordered) {
        let constants: Vec<_> = self.beam.constants().collect();
        let arms = self.equations.links.arms_at(q);
        for pressure in loads.pressures() {
            let (nodes, element) = constants[pressure.element];
            let chord = Chord::new(element, &self.beam.ends(nodes, q));
            let local = pressure.local_forces(element);
            let mut tangent = EndsMatrix::ZERO;
            let [c, s] = chord.direction;
            for end in [0, 3] {
                // F = f (-Y, X)/L of the chord vector (X, Y), M = m (X^2 + Y^2)/L^2.
                let force = factor * local[end + 1] / element.length;
                let moment = factor * local[end + 2] * 2.0 * chord.length / element.length.powi(2);
                let by_x = [0.0, force, moment * c];
                let by_y = [-force, 0.0, moment * s];
                for dof in 0..3 {
                    for (column, slope) in [(0, -by_x[dof]), (1, -by_y[dof]), (3, by_x[dof]), (4, by_y[dof])] {
                        tangent[(end + dof, column)] = -slope;
                    }
                }
            }
            self.add_matrix(nodes, &tangent, [&arms, &arms], matrix);
        }
    }
}
