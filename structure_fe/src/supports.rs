//! Supports: fixed degrees of freedom and springs to the ground.

use crate::beam::Beam;
use crate::error::{Error, existing_node, positive};

/// A degree of freedom of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dof {
    /// Displacement u along x \[m\].
    U = 0,
    /// Displacement w along y \[m\].
    W = 1,
    /// Rotation theta from x towards y \[rad\].
    Theta = 2,
}

/// A linear spring between one degree of freedom and the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spring {
    pub node: usize,
    pub dof: Dof,
    /// \[N/m\], or \[N m/rad\] on a rotation.
    pub stiffness: f64,
}

/// How a model is held. Empty by default: free in space.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Supports {
    fixed: Vec<(usize, Dof)>,
    springs: Vec<Spring>,
}

impl Supports {
    /// Fixes one degree of freedom of a node at zero.
    pub fn fix(&mut self, node: usize, dof: Dof) -> &mut Self {
        self.fixed.push((node, dof));
        self
    }

    /// Fixes both displacements of a node: a hinge.
    pub fn pin(&mut self, node: usize) -> &mut Self {
        self.fix(node, Dof::U).fix(node, Dof::W)
    }

    /// Fixes displacements and rotation of a node.
    pub fn clamp(&mut self, node: usize) -> &mut Self {
        self.pin(node).fix(node, Dof::Theta)
    }

    /// Ties a degree of freedom to the ground by a spring \[N/m, or N m/rad on a rotation\].
    ///
    /// Springs on the same degree of freedom add up.
    pub fn spring(&mut self, node: usize, dof: Dof, stiffness: f64) -> &mut Self {
        self.springs.push(Spring { node, dof, stiffness });
        self
    }

    pub(crate) fn fixed(&self) -> &[(usize, Dof)] {
        &self.fixed
    }

    pub(crate) fn springs(&self) -> &[Spring] {
        &self.springs
    }

    /// Elastic energy in the springs \[J\] of a displacement `[nodes][u, w, theta]`.
    ///
    /// # Panics
    /// If a spring's node has no entry in `displacement`.
    pub fn spring_energy(&self, displacement: &[[f64; 3]]) -> f64 {
        self.springs
            .iter()
            .map(|spring| 0.5 * spring.stiffness * displacement[spring.node][spring.dof as usize].powi(2))
            .sum()
    }

    /// Adds the forces k u of a displacement on the springs to `forces`, both `[nodes][3]`.
    pub(crate) fn add_spring_forces(&self, displacement: &[[f64; 3]], forces: &mut [[f64; 3]]) {
        for spring in &self.springs {
            let (node, dof) = (spring.node, spring.dof as usize);
            forces[node][dof] += spring.stiffness * displacement[node][dof];
        }
    }

    pub(crate) fn check(&self, beam: &Beam) -> Result<(), Error> {
        let nodes = beam.nodes().len();
        for (index, &(node, _)) in self.fixed.iter().enumerate() {
            existing_node("support", index, node, nodes)?;
        }
        for (index, spring) in self.springs.iter().enumerate() {
            existing_node("spring", index, spring.node, nodes)?;
            positive("stiffness [N/m, N m/rad]", "spring", index, spring.stiffness)?;
        }
        Ok(())
    }
}
