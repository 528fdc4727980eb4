//! Loads: forces at the nodes and along the elements.

use crate::beam::{Beam, add_ends};
use crate::element::Ends;
use crate::error::{Error, existing_node, finite};

/// A load along an element, varying linearly, per length of the element.
#[derive(Debug, Clone, Copy, PartialEq)]
struct DistributedLoad {
    element: usize,
    start: [f64; 2],
    end: [f64; 2],
}

/// One load case. Loads on the same node or element add up.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Loads {
    nodal: Vec<(usize, [f64; 3])>,
    distributed: Vec<DistributedLoad>,
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
        Ok(())
    }

    /// Consistent end forces of the distributed loads, one entry per element, in the global axes.
    pub(crate) fn element_forces(&self, beam: &Beam) -> Vec<Ends> {
        let mut forces = vec![[0.0; 6]; beam.elements().len()];
        let formulation: Vec<_> = beam.formulated().map(|(_, element)| element).collect();
        for load in &self.distributed {
            let ends = formulation[load.element].load_forces(load.start, load.end);
            for (sum, end) in forces[load.element].iter_mut().zip(ends) {
                *sum += end;
            }
        }
        forces
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
