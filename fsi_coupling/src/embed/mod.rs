//! The embedding element: a region of water inside a host program, which keeps its own time loop and step.
//!
//! Four phases, each of which consumes the one before, so that a wrong order does not compile:
//!
//! | phase | call | what happens |
//! |---|---|---|
//! | specify | [`FluidElementSpec`] | every number about the water |
//! | size | [`FluidElementSpec::size`] | particles, bytes, step, warnings; allocates nothing that grows with the water |
//! | build | [`SizedElement::build`] | the water at t = 0; the only phase that allocates |
//! | contribute | [`FluidElement::contribute`] | the water follows the nodes through one step of the host, and pushes them |
//!
//! ```
//! use fsi_coupling::embed::{FluidElementSpec, HostNodes, HostStep, Topology};
//!
//! # fn main() -> Result<(), fsi_coupling::embed::HostError> {
//! // a box 0.4 m wide whose four corners are the host's nodes, 0.1 m deep in still water
//! let corners = vec![[-0.2, -0.1], [0.2, -0.1], [0.2, 0.2], [-0.2, 0.2]];
//! let topology = Topology::of(corners.clone()).closed([0, 1, 2, 3]);
//! let spec = FluidElementSpec { fastest_speed: Some(1.0), ..FluidElementSpec::new(0.05, 0.6, 0.4) };
//! let sized = spec.size(&topology)?;
//! println!("{} particles of water, {} bytes", sized.fluid_particles(), sized.bytes());
//!
//! let mut nodes = HostNodes::at_rest(corners);
//! let mut element = sized.build(&nodes)?;
//! let mut forces = vec![[0.0; 3]; 4];
//! for _ in 0..5 {
//!     nodes.velocity.fill([0.0, -0.2]);
//!     nodes.position.iter_mut().for_each(|at| at[1] -= 0.2 * 0.002);
//!     let given = element.contribute(HostStep { dt: 0.002, nodes: &nodes }, &mut forces)?;
//!     assert!(given.fluid_steps >= 1);
//! }
//! assert!(forces.iter().map(|f| f[1]).sum::<f64>() > 300.0, "it floats, more or less");
//! # Ok(()) }
//! ```
//!
//! An element that was not sized cannot be built, and one that was not built pushes nothing:
//! ```compile_fail,E0599
//! # use fsi_coupling::embed::{FluidElementSpec, HostNodes};
//! # let (spec, nodes) = (FluidElementSpec::new(0.05, 0.6, 0.4), HostNodes::at_rest(vec![]));
//! let element = spec.build(&nodes);
//! ```
//! ```compile_fail,E0599
//! # use fsi_coupling::embed::{FluidElementSpec, HostNodes, HostStep, Topology};
//! # let (spec, nodes) = (FluidElementSpec::new(0.05, 0.6, 0.4), HostNodes::at_rest(vec![]));
//! let mut sized = spec.size(&Topology::of(vec![])).unwrap();
//! sized.contribute(HostStep { dt: 0.1, nodes: &nodes }, &mut []);
//! ```
//! Nor is it built twice, or sized again once it is built:
//! ```compile_fail,E0382
//! # use fsi_coupling::embed::{FluidElementSpec, HostNodes, Topology};
//! # let (spec, nodes) = (FluidElementSpec::new(0.05, 0.6, 0.4), HostNodes::at_rest(vec![]));
//! let sized = spec.size(&Topology::of(vec![])).unwrap();
//! let (one, two) = (sized.build(&nodes), sized.build(&nodes));
//! ```
//! ```compile_fail,E0382
//! # use fsi_coupling::embed::{FluidElementSpec, Topology};
//! # let spec = FluidElementSpec::new(0.05, 0.6, 0.4);
//! let topology = Topology::of(vec![]);
//! let (one, two) = (spec.size(&topology), spec.size(&topology));
//! ```
//!
//! Inside, the host's nodes are one more [`WettedBody`](crate::WettedBody) (`body`), stepped by [`Coupled`](crate::Coupled).
//! Equations (THEORY CO29–CO32); a host program in `examples/landing_host.rs`.

mod added_mass;
mod body;
mod element;
mod error;
mod exchange;
mod frame;
mod node_map;
mod nodes;
mod sized;
mod spec;
mod surface;
mod topology;

pub use added_mass::AddedMass;
pub use element::{Contribution, ElementLimits, FluidElement, HostStep, Snapshot, shortest_step};
pub use error::HostError;
pub use frame::HostFrame;
pub use nodes::HostNodes;
pub use sized::SizedElement;
pub use spec::{ElementScheme, FluidElementSpec};
pub use surface::{HostLink, HostSurface, HostSurfaceSpec};
pub use topology::{Side, Topology, WetSurface};
