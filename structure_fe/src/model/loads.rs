//! Loads: forces at the nodes and along the elements.

use super::{Beam, add_ends};
use crate::element::{Chord, ElementConstants, Ends};
use crate::error::{Error, existing_element, existing_node, finite};
use crate::field::Field;

/// A load along an element that varies linearly from `start` to `end` \[N/m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LineLoad<T> {
    pub element: usize,
    start: T,
    end: T,
}

impl LineLoad<f64> {
    /// End forces of a pressure on the left-hand side of the undeformed element, in its axes.
    pub fn local_forces(&self, element: &ElementConstants) -> Ends {
        element.local_load_forces([0.0, -self.start], [0.0, -self.end])
    }
}

/// One load case. Loads on the same node or element add up.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Loads {
    nodal: Vec<(usize, [f64; 3])>,
    distributed: Vec<LineLoad<[f64; 2]>>,
    pressures: Vec<LineLoad<f64>>,
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
        self.distributed.push(LineLoad { element, start, end });
        self
    }

    /// Puts a pressure on the left-hand side of an element, from `start` at its first node to `end` at its second
    /// \[N/m; Pa on a strip\]. It follows the element: normal to it, per deformed length (THEORY BE14). Linear statics
    /// use the undeformed element; positive pushes to the right.
    pub fn pressure_on_element(&mut self, element: usize, start: f64, end: f64) -> &mut Self {
        self.pressures.push(LineLoad { element, start, end });
        self
    }

    pub(crate) fn check(&self, beam: &Beam) -> Result<(), Error> {
        let (nodes, elements) = (beam.nodes().len(), beam.elements().len());
        for (index, (node, force)) in self.nodal.iter().enumerate() {
            existing_node("nodal load", index, *node, nodes)?;
            finite("force [N, N m]", "nodal load", index, force)?;
        }
        for (index, load) in self.distributed.iter().enumerate() {
            existing_element("distributed load", index, load.element, elements)?;
            finite("intensity [N/m]", "distributed load", index, [load.start, load.end].as_flattened())?;
        }
        for (index, load) in self.pressures.iter().enumerate() {
            existing_element("pressure", index, load.element, elements)?;
            finite("intensity [N/m]", "pressure", index, &[load.start, load.end])?;
        }
        Ok(())
    }

    pub(crate) fn pressures(&self) -> &[LineLoad<f64>] {
        &self.pressures
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.nodal.is_empty() && self.distributed.is_empty() && self.pressures.is_empty()
    }

    /// Linear interpolation between this load case (`share` 0) and another (1).
    pub(crate) fn blend(&self, other: &Self, share: f64) -> Self {
        let mut sum = Self::default();
        for (loads, factor) in [(self, 1.0 - share), (other, share)] {
            for (node, force) in &loads.nodal {
                sum.at_node(*node, force.map(|value| factor * value));
            }
            for load in &loads.distributed {
                let [start, end] = [load.start, load.end].map(|load| load.map(|value| factor * value));
                sum.along_element(load.element, start, end);
            }
            for load in &loads.pressures {
                sum.pressure_on_element(load.element, factor * load.start, factor * load.end);
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
        let mut forces = vec![Ends::ZERO; beam.elements().len()];
        let constants: Vec<_> = beam.constants().map(|(_, element)| element).collect();
        for load in &self.distributed {
            forces[load.element] += constants[load.element].load_forces(load.start, load.end);
        }
        for load in &self.pressures {
            let element = constants[load.element];
            let ends = beam.ends(beam.elements()[load.element].nodes, displacement);
            let chord = Chord::new(element, &ends);
            let mut local = load.local_forces(element);
            let stretch = chord.length / element.length;
            for (force, power) in local.0.iter_mut().zip([1, 1, 2, 1, 1, 2]) {
                *force *= stretch.powi(power);
            }
            forces[load.element] += chord.to_global(&local);
        }
        forces
    }

    /// All loads as nodal forces `[nodes][F_x, F_y, M]` that do the same work on the elements' shapes.
    pub(crate) fn nodal_forces(&self, beam: &Beam, element_forces: &[Ends]) -> Field {
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
