//! Loads: forces at the nodes and along the elements.

use crate::beam::{Beam, add_ends};
use crate::bordered::Bordered;
use crate::corotational::Chord;
use crate::element::Ends;
use crate::error::{Error, existing_node, finite};
use crate::system::System;

/// A load along an element, varying linearly, per length of the element.
#[derive(Debug, Clone, Copy, PartialEq)]
struct DistributedLoad {
    element: usize,
    start: [f64; 2],
    end: [f64; 2],
}

/// A pressure on the left-hand side of an element, varying linearly along it \[N/m\].
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pressure {
    element: usize,
    start: f64,
    end: f64,
}

/// One load case. Loads on the same node or element add up.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Loads {
    nodal: Vec<(usize, [f64; 3])>,
    distributed: Vec<DistributedLoad>,
    pressures: Vec<Pressure>,
}

impl Loads {
    /// Puts `[F_x, F_y, M]` \[N, N, N m\] on a node.
    pub fn at_node(&mut self, node: usize, force: [f64; 3]) -> &mut Self {
        self.nodal.push((node, force));
        self
    }

    /// Puts a load on an element that varies linearly from `start` at its first node to `end` at its
    /// second: `[q_x, q_y]` in the global axes, per length of the element \[N/m; N/m^2 on a strip\].
    pub fn along_element(&mut self, element: usize, start: [f64; 2], end: [f64; 2]) -> &mut Self {
        self.distributed.push(DistributedLoad { element, start, end });
        self
    }

    /// Presses on the left-hand side of an element, from `start` at its first node to `end` at its second
    /// \[N/m; Pa on a strip\]. It follows the element: always across it, and per length as it is
    /// (THEORY S14). Linear statics take the element as it was; positive pushes to the right.
    pub fn pressure_on_element(&mut self, element: usize, start: f64, end: f64) -> &mut Self {
        self.pressures.push(Pressure { element, start, end });
        self
    }

    pub(crate) fn check(&self, beam: &Beam) -> Result<(), Error> {
        for (index, (node, force)) in self.nodal.iter().enumerate() {
            existing_node("nodal load", index, *node, beam.nodes().len())?;
            finite("nodal load [N, N m]", index, force)?;
        }
        let elements = beam.elements().len();
        for (index, load) in self.distributed.iter().enumerate() {
            if load.element >= elements {
                return Err(Error::NoSuchElement { item: "distributed load", index, element: load.element, elements });
            }
            finite("distributed load [N/m]", index, &load.start)?;
            finite("distributed load [N/m]", index, &load.end)?;
        }
        for (index, load) in self.pressures.iter().enumerate() {
            if load.element >= elements {
                return Err(Error::NoSuchElement { item: "pressure", index, element: load.element, elements });
            }
            finite("pressure [N/m]", index, &[load.start, load.end])?;
        }
        Ok(())
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.nodal.is_empty() && self.distributed.is_empty() && self.pressures.is_empty()
    }

    /// What lies between this case and another, `share` of the way.
    pub(crate) fn blend(&self, other: &Self, share: f64) -> Self {
        let mut sum = Self::default();
        for (loads, factor) in [(self, 1.0 - share), (other, share)] {
            let scaled = |values: [f64; 2]| values.map(|value| factor * value);
            sum.nodal.extend(loads.nodal.iter().map(|&(node, force)| (node, force.map(|value| factor * value))));
            for load in &loads.distributed {
                let (start, end) = (scaled(load.start), scaled(load.end));
                sum.distributed.push(DistributedLoad { start, end, ..*load });
            }
            for load in &loads.pressures {
                let [start, end] = scaled([load.start, load.end]);
                sum.pressures.push(Pressure { start, end, ..*load });
            }
        }
        sum
    }

    /// All loads as forces at the nodes, `[nodes][F_x, F_y, M]` \[N, N, N m\], of the model displaced by
    /// `[nodes][u, w, theta]`: forces keep their directions, pressures follow the elements.
    ///
    /// # Panics
    /// If `displacement` has not one entry per node.
    pub fn at_nodes(&self, beam: &Beam, displacement: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, Error> {
        self.check(beam)?;
        Ok(self.nodal_forces(beam, &self.element_forces_at(beam, displacement)))
    }

    /// Consistent end forces of the distributed loads, one entry per element, in the global axes.
    pub(crate) fn element_forces(&self, beam: &Beam) -> Vec<Ends> {
        self.element_forces_at(beam, &vec![[0.0; 3]; beam.nodes().len()])
    }

    /// The same of a displaced model.
    pub(crate) fn element_forces_at(&self, beam: &Beam, displacement: &[[f64; 3]]) -> Vec<Ends> {
        let mut forces = vec![[0.0; 6]; beam.elements().len()];
        let formulation: Vec<_> = beam.formulated().map(|(_, element)| element).collect();
        for load in &self.distributed {
            let ends = formulation[load.element].load_forces(load.start, load.end);
            for (sum, end) in forces[load.element].iter_mut().zip(ends) {
                *sum += end;
            }
        }
        for load in &self.pressures {
            let element = formulation[load.element];
            let ends = beam.ends(beam.elements()[load.element].nodes, displacement);
            let chord = Chord::new(element, &ends);
            let mut local = element.local_load_forces([0.0, -load.start], [0.0, -load.end]);
            let stretch = chord.length / element.length;
            for (force, power) in local.iter_mut().zip([1, 1, 2, 1, 1, 2]) {
                *force *= stretch.powi(power);
            }
            for (sum, end) in forces[load.element].iter_mut().zip(chord.to_global(&local)) {
                *sum += end;
            }
        }
        forces
    }

    /// Adds to `matrix` what the pressures' turning takes from the stiffness, -factor dF/dq (THEORY S14).
    ///
    /// Forces are linear in the chord's vector, moments go with its square; not symmetric.
    pub(crate) fn subtract_tangent(
        &self,
        system: &System,
        displacement: &[[f64; 3]],
        factor: f64,
        matrix: &mut Bordered,
    ) {
        let formulation: Vec<_> = system.beam.formulated().collect();
        let arms = system.equations.ties.arms_at(displacement);
        for load in &self.pressures {
            let (nodes, element) = formulation[load.element];
            let chord = Chord::new(element, &system.beam.ends(nodes, displacement));
            let local = element.local_load_forces([0.0, -load.start], [0.0, -load.end]);
            let mut slopes = [[0.0; 6]; 6];
            let [c, s] = chord.direction;
            for end in [0, 3] {
                // F = f (-Y, X)/L of the chord's vector (X, Y), M = m (X^2 + Y^2)/L^2.
                let force = factor * local[end + 1] / element.length;
                let moment = factor * local[end + 2] * 2.0 * chord.length / element.length.powi(2);
                let by_x = [0.0, force, moment * c];
                let by_y = [-force, 0.0, moment * s];
                for dof in 0..3 {
                    for (column, slope) in [(0, -by_x[dof]), (1, -by_y[dof]), (3, by_x[dof]), (4, by_y[dof])] {
                        slopes[end + dof][column] = -slope;
                    }
                }
            }
            system.add_matrix(nodes, &slopes, [&arms, &arms], matrix);
        }
    }

    /// All loads as nodal forces `[nodes][F_x, F_y, M]` that do the same work on the elements' shapes.
    pub(crate) fn nodal_forces(&self, beam: &Beam, element_forces: &[Ends]) -> Vec<[f64; 3]> {
        let mut forces = vec![[0.0; 3]; beam.nodes().len()];
        for (node, force) in &self.nodal {
            for dof in 0..3 {
                forces[*node][dof] += force[dof];
            }
        }
        for (element, ends) in beam.elements().iter().zip(element_forces) {
            add_ends(&mut forces, element.nodes, ends);
        }
        forces
    }
}
