//! Coupling of the fluid with bodies: what a wetted body is, where its boundary particles are, and how the fluid's forces
//! act on it.
//!
//! [`geometry`] turns shapes into particles, [`bodies`] has the contract of a body and the bodies, [`coupling`] the step of fluid and
//! bodies together, [`embed`] the element for programs with a time loop of their own.
//!
//! Runnable examples, by `cargo run --release -p fsi_coupling --example NAME`: `wedge_drop` against a theory, `floating_box` and its draught,
//! `joined_bodies` on a slider with a spring, `flexible_panel` under water, `host_element` around the nodes of another program; and
//! `landing_host`, a program for landing dynamics that controls its own step.
//!
//! A wedge falls into a tank of water:
//! ```
//! use fsi_coupling::geometry::layout::{Basin, Layout};
//! use fsi_coupling::{Coupled, CouplingError, Outline, RigidBody2d, RigidSpec, Scheme, Shape, Tank};
//! use sph_core::{Domain, Fluid, Seed, wcsph};
//!
//! # fn main() -> Result<(), CouplingError> {
//! let (x, floor, spacing, gravity) = ([-0.5, 0.5], -0.4, 0.04, [0.0, -9.81]);
//! let layout = Layout::new(Basin { x, y: [floor, 0.0], fine_x: x, fine_depth: 0.4, spacing, growth: 1.0 });
//! let domain = Domain { gravity, fastest_speed: 3.0, ..Domain::default() };
//! let mut seeds = Vec::new();
//! layout.for_each(|cell| {
//!     let pressure = domain.fluid.density * gravity[1] * cell.at[1];
//!     seeds.push(Seed { at: cell.at, velocity: [0.0; 2], area: cell.area(), pressure });
//! });
//! let fluid = Fluid::new(domain, &wcsph::Settings::default(), &seeds);
//!
//! let wedge = RigidBody2d::new(RigidSpec {
//!     name: "wedge".into(),
//!     outline: Outline::of(&Shape::Wedge { deadrise_deg: 30.0, breadth: 0.4, side_height: 0.2 })?,
//!     mass: 40.0, // per metre of span
//!     inertia: 0.0,
//!     center_of_mass: [0.0, 0.15],
//!     free: [false, true, false],
//!     position: [0.0, 0.02],
//!     angle: 0.0,
//!     velocity: [0.0, -1.0],
//!     angular_velocity: 0.0,
//!     gravity,
//!     half: false,
//!     sprung: Vec::new(),
//! })?;
//! let tank = Tank::new(layout, x, floor, 0.3, false);
//! let mut system = Coupled::new(fluid, vec![Box::new(wedge), Box::new(tank)], Scheme::Weak, spacing)?;
//! while system.fluid.time() < 0.1 {
//!     system.step(system.stable_dt()?)?;
//! }
//! let motion = system.bodies().find_map(|body| body.motion()).expect("the wedge");
//! assert!(motion.velocity[1] > -1.0 - 9.81 * 0.1, "the water decelerates the wedge");
//! assert!(system.momentum_audit().worst < 1e-10, "momentum is conserved");
//! # Ok(()) }
//! ```

pub mod bodies;
pub mod coupling;
pub mod embed;
pub mod geometry;

pub use bodies::bending::frame::Frame;
pub use bodies::bending::surface_mode::SurfaceMode;
pub use bodies::body::{Body, Contact, Inspect, Linked, WettedBody};
pub use bodies::error::BodyError;
pub use bodies::flexible::body::FlexibleBody;
pub use bodies::flexible::model::FlexibleSpec;
pub use bodies::flexible::panel::{EndSpring, PanelBar, PanelEnd, PanelMesh, PanelSpec, Plane};
pub use bodies::flexible::panel_modes::PanelModes;
pub use bodies::flexible::wet_period::{first_wet_period, natural_frequencies};
pub use bodies::modal::body::ModalBody;
pub use bodies::modal::spec::ModalSpec;
pub use bodies::modes_state::{ModalExtremes, ModesState};
pub use bodies::panel_state::{PanelState, Station, Watched, Worst};
pub use bodies::prescribed::{Law, PrescribedBody};
pub use bodies::rigid::RigidBody2d;
pub use bodies::rigid_motion::RigidMotion;
pub use bodies::rigid_spec::RigidSpec;
pub use bodies::sprung::{SprungSpec, SprungState};
pub use bodies::state::{ContactImpulse, Energy, Momentum, Motion, Solid, SurfacePoint};
pub use bodies::tank::Tank;
pub use coupling::bending_entry::{BendingEntry, BendingEntryError, BottomPressure};
pub use coupling::coupled::{Coupled, RefinementRule};
pub use coupling::error::CouplingError;
pub use coupling::links::joint::{JointKind, JointSpec, JointState};
pub use coupling::links::{ContactLaw, TouchRecord};
pub use coupling::penetration::{Breach, Penetration};
pub use coupling::placed_bodies::{PlacedBodies, WorkAudit};
pub use coupling::quasi_newton::QuasiNewton;
pub use coupling::relaxation_zone::RelaxationZone;
pub use coupling::scheme::{CouplingStatistics, Iteration, Scheme};
pub use coupling::stability_estimate::{Beside, PanelExchange, exchange_ratio};
pub use geometry::outline::Outline;
pub use geometry::plate::Plate;
pub use geometry::rows::WallRows;
pub use geometry::section::section_of;
pub use geometry::shape::Shape;
