//! The model: nodes, elements, supports, joints, rigid bodies and loads.
//!
//! A portal frame on pinned feet, with a rigid mass of 5 kg on a link of its left corner:
//!
//! ```
//! use structure_fe::{Beam, Loads, Material, Section, Supports};
//!
//! let steel = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };
//! let nodes = vec![[0.0, 0.0], [0.0, 3.0], [4.0, 3.0], [4.0, 0.0]]; // [m]
//! let frame = Beam::uniform(nodes, &[[0, 1], [1, 2], [2, 3]], steel, Section::rectangular(0.1, 0.1))?;
//! let (frame, body) = frame.with_rigid_body([0.0, 3.5], 5.0, 0.1)?;
//! assert!((frame.mass() - (7850.0 * 0.01 * 10.0 + 5.0)).abs() < 1e-9);
//!
//! let mut supports = Supports::default();
//! supports.pin(0).pin(3).link(body, 1);
//! let mut loads = Loads::default();
//! loads.at_node(2, [1000.0, 0.0, 0.0]).along_element(1, [0.0, -500.0], [0.0, -500.0]);
//! # Ok::<(), structure_fe::Error>(())
//! ```

mod beam;
mod connector;
mod loads;
mod rigid_links;
mod supports;

pub(crate) use beam::add_ends;
pub use beam::{Beam, Element};
pub use loads::Loads;

pub use connector::Connector;
pub(crate) use connector::{Between, Connection, Rows};
pub(crate) use rigid_links::RigidLinks;
pub use supports::{Break, Rupture, Supports};
