//! Options of a model: beam theory, rotatory inertia, plasticity, axial releases, point masses, rigid bodies.

use super::Beam;
use super::beam::ElementOptions;
use crate::element::Theory;
use crate::error::{Error, existing_element, existing_node, finite, not_negative, positive};
use crate::material::Plasticity;

impl Beam {
    /// The same model with this theory for every element (default: Euler-Bernoulli).
    pub fn with_theory(self, theory: Theory) -> Result<Self, Error> {
        self.with_options(.., |options| options.theory = theory)
    }

    /// The same model with this theory for one element.
    pub fn with_theory_of(self, element: usize, theory: Theory) -> Result<Self, Error> {
        self.with_options_of("theory", element, |options| options.theory = theory)
    }

    /// The same model with an element released along its axis: a roller at its end. It keeps a ten millionth of its
    /// axial stiffness; for an end that slides less than the element's length.
    pub fn with_axial_release(self, element: usize) -> Result<Self, Error> {
        self.with_options_of("axial release", element, |options| options.axial_release = true)
    }

    /// The same model with every element yielding in bending.
    ///
    /// [`NonlinearStatics`](crate::NonlinearStatics) and the trapezoidal rule of [`Dynamics`](crate::Dynamics) support
    /// it; linear analyses use the elastic model. Euler-Bernoulli's elements only.
    pub fn with_plasticity(self, plasticity: Plasticity) -> Result<Self, Error> {
        self.with_options(.., |options| options.plasticity = Some(plasticity))
    }

    /// The same model with one element yielding in bending.
    pub fn with_plasticity_of(self, element: usize, plasticity: Plasticity) -> Result<Self, Error> {
        self.with_options_of("plasticity", element, |options| options.plasticity = Some(plasticity))
    }

    fn with_options_of(
        self,
        item: &'static str,
        element: usize,
        change: impl Fn(&mut ElementOptions),
    ) -> Result<Self, Error> {
        existing_element(item, 0, element, self.options.len())?;
        self.with_options(element..=element, change)
    }

    fn with_options(
        mut self,
        elements: impl std::slice::SliceIndex<[ElementOptions], Output = [ElementOptions]>,
        change: impl Fn(&mut ElementOptions),
    ) -> Result<Self, Error> {
        self.options[elements].iter_mut().for_each(change);
        self.formulate()
    }

    /// The same model with rotatory inertia rho I per length (Rayleigh 1877; default: without).
    pub fn with_rotatory_inertia(mut self) -> Result<Self, Error> {
        self.rotatory_inertia = true;
        self.formulate()
    }

    /// The first element that can yield, if there is one.
    pub(crate) fn first_plastic_element(&self) -> Option<usize> {
        self.options.iter().position(|options| options.plasticity.is_some())
    }

    /// The same model with a point mass \[kg\] and its moment of inertia \[kg m^2\] added to a node.
    pub fn with_point_mass(mut self, node: usize, mass: f64, inertia: f64) -> Result<Self, Error> {
        existing_node("point mass", node, node, self.nodes.len())?;
        positive("mass [kg]", "node", node, mass)?;
        not_negative("moment of inertia [kg m^2] of the point mass", inertia)?;
        for (sum, value) in self.points[node].iter_mut().zip([mass, mass, inertia]) {
            *sum += value;
        }
        Ok(self)
    }

    /// The same model with a rigid body, as a further node that is returned with it: `mass` \[kg\] at `at` \[m\], moment
    /// of inertia about it \[kg m^2\]. [`Supports::link`](crate::Supports::link) makes nodes follow it.
    ///
    /// A body without mass must be supported in [`Dynamics`](crate::Dynamics). If u and w of a body are not both
    /// supported, [`Dynamics`](crate::Dynamics) moves its node to the common centre of mass of the body and of the
    /// masses lumped at its linked nodes: read the position from [`Dynamics::beam`](crate::Dynamics::beam).
    pub fn with_rigid_body(mut self, at: [f64; 2], mass: f64, inertia: f64) -> Result<(Self, usize), Error> {
        let node = self.nodes.len();
        finite("coordinate [m]", "node", node, &at)?;
        not_negative("mass [kg] of a rigid body", mass)?;
        not_negative("moment of inertia [kg m^2] of a rigid body", inertia)?;
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

    /// Moves the node of a rigid body to another place \[m\].
    pub(crate) fn move_body(&mut self, node: usize, to: [f64; 2]) {
        self.nodes[node] = to;
    }
}
