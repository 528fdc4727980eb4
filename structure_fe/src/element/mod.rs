//! The element formulation: constants, consistent mass, co-rotational kinematics, forces over a step, inertia.

mod constants;
mod corotational;
mod ends;
mod inertia;
mod mass;
mod mean_forces;
mod plastic;
mod section_forces;
mod yielding;

pub(crate) use constants::ElementConstants;
pub use constants::Theory;
pub(crate) use corotational::{Chord, add_deformation_matrix, add_elastic_tangent, deformation_forces, strain_energy};
pub(crate) use ends::{Ends, EndsMatrix, end_forces, rotated, sinc};
pub use inertia::Damping;
pub(crate) use inertia::{Motion, Weights, momentum, response, viscous_forces};
pub(crate) use mean_forces::{DiscreteGradient, Start};
pub(crate) use plastic::PlasticElement;
pub use plastic::PlasticStrains;
pub use section_forces::SectionForces;
pub(crate) use yielding::{YieldStep, in_chord};
