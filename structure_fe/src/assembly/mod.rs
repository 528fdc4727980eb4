//! Assembly: equation numbers, matrices, internal forces, and the recovery of section forces and reactions.

mod connector_forces;
mod damping_references;
mod equations;
mod internal_forces;
mod mass_damping;
mod recovery;
mod system;

pub(crate) use equations::{Arms, Equations, SymmetricMatrix};
pub use recovery::Fibres;
pub(crate) use recovery::{linear_section_forces, reactions};
pub(crate) use system::{Kinematics, System};
