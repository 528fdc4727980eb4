//! What a model may have beside its elements: theories, masses, rigid bodies, yielding.

use super::{Beam, existing_element, formulate};
use crate::error::{Error, existing_node, finite, positive};
use crate::plastic::{PlasticBending, Plasticity};
use crate::theory::Theory;

/// Axial stiffness left to an element that slides along itself [-].
const RELEASED: f64 = 1e-7;

impl Beam {
    /// The same model with every element of this theory (Euler-Bernoulli until told).
    pub fn with_theory(mut self, theory: Theory) -> Result<Self, Error> {
        self.theory = vec![theory; self.elements.len()];
        self.reformulate()
    }

    /// The same model with one element of this theory.
    pub fn with_theory_of(mut self, element: usize, theory: Theory) -> Result<Self, Error> {
        existing_element("theory", 0, element, self.elements.len())?;
        self.theory[element] = theory;
        self.reformulate()
    }

    /// The same model with an element that slides along itself: a roller at its end. It keeps a ten millionth of its axial
    /// stiffness, for an end that slides less than its own length.
    pub fn with_axial_release(mut self, element: usize) -> Result<Self, Error> {
        existing_element("axial release", 0, element, self.elements.len())?;
        self.sliding.push(element);
        self.reformulate()
    }

    /// The same model with rotatory inertia rho I per length (Rayleigh 1877), which is left out until told.
    pub fn with_rotatory_inertia(mut self) -> Result<Self, Error> {
        self.rotatory_inertia = true;
        self.reformulate()
    }

    /// The same model with every element yielding in bending, which none does until told.
    ///
    /// [`NonlinearStatics`](crate::NonlinearStatics) and the trapezoidal rule of [`Dynamics`](crate::Dynamics) know
    /// it; linear analyses are of the elastic model. Euler-Bernoulli's elements only.
    pub fn with_plasticity(mut self, plasticity: Plasticity) -> Result<Self, Error> {
        self.plasticity = vec![Some(plasticity); self.elements.len()];
        self.reformulate()
    }

    /// The same model with one element yielding in bending.
    pub fn with_plasticity_of(mut self, element: usize, plasticity: Plasticity) -> Result<Self, Error> {
        existing_element("plasticity", 0, element, self.elements.len())?;
        self.plasticity[element] = Some(plasticity);
        self.reformulate()
    }

    /// The first element that yields, if one does.
    pub(crate) fn first_that_yields(&self) -> Option<usize> {
        self.plasticity.iter().position(Option::is_some)
    }

    /// The same model with a point mass \[kg\] and its moment of inertia \[kg m^2\] added to a node.
    pub fn with_point_mass(mut self, node: usize, mass: f64, inertia: f64) -> Result<Self, Error> {
        existing_node("point mass", node, node, self.nodes.len())?;
        positive("mass [kg]", "node", node, mass)?;
        if !(inertia >= 0.0 && inertia.is_finite()) {
            let quantity = "moment of inertia [kg m^2] of the point mass at node";
            return Err(Error::NotPositive { quantity, item: "node", index: node, value: inertia });
        }
        for (sum, value) in self.points[node].iter_mut().zip([mass, mass, inertia]) {
            *sum += value;
        }
        Ok(self)
    }

    /// The same model with a rigid body, a node of its own that is returned with it: `mass` \[kg\] at `at`
    /// \[m\], moment of inertia about it \[kg m^2\]. [`Supports::tie`](crate::Supports::tie) makes nodes follow it.
    ///
    /// Without mass it must be supported in all that moves in time. Where u and w of a body are not both
    /// supported, [`Dynamics`](crate::Dynamics) puts its node at the common centre of mass of the body and of
    /// what is lumped at the nodes tied to it: read the place there, from the model it holds.
    pub fn with_rigid_body(mut self, at: [f64; 2], mass: f64, inertia: f64) -> Result<(Self, usize), Error> {
        let node = self.nodes.len();
        finite("coordinate [m] of node", node, &at)?;
        for (quantity, value) in
            [("mass [kg] of a rigid body", mass), ("moment of inertia [kg m^2] of a rigid body", inertia)]
        {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(Error::OutOfRange { quantity, value, expected: "[0, infinity)" });
            }
        }
        self.nodes.push(at);
        self.points.push([mass, mass, inertia]);
        self.bodies.push(node);
        Ok((self, node))
    }

    /// Nodes that are rigid bodies.
    pub fn rigid_bodies(&self) -> &[usize] {
        &self.bodies
    }

    pub(crate) fn is_rigid_body(&self, node: usize) -> bool {
        self.bodies.contains(&node)
    }

    /// The same model with a body's node elsewhere \[m\].
    pub(crate) fn move_body(&mut self, node: usize, to: [f64; 2]) {
        self.nodes[node] = to;
    }

    fn reformulate(mut self) -> Result<Self, Error> {
        let extent = self.extent;
        for (index, element) in self.elements.iter().enumerate() {
            self.formulation[index] =
                formulate(&self.nodes, extent, index, element, self.theory[index], self.rotatory_inertia)?;
            if self.sliding.contains(&index) {
                self.formulation[index].stiffness[0] *= RELEASED;
            }
            if let Some(plasticity) = self.plasticity[index] {
                plasticity.check(index)?;
                if self.theory[index] != Theory::EulerBernoulli {
                    return Err(Error::PlasticTheory { element: index });
                }
                let (section, length) = (&element.section, self.formulation[index].length);
                self.formulation[index].plastic = Some(PlasticBending {
                    stiffness: section.bending_stiffness(&element.material),
                    hardening: plasticity.hardening_modulus * section.second_moment(),
                    yield_moment: plasticity.yield_stress * section.second_moment() * 2.0 / section.thickness(),
                    length,
                });
            }
        }
        Ok(self)
    }
}
