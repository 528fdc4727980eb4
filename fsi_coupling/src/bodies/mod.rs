//! Bodies in the water: the contract ([`body`]), and a rigid body, a body with prescribed motion, a flexible body, a body with modes and a tank.
//!
//! ```
//! use fsi_coupling::{Inspect, Outline, RigidBody2d, RigidSpec, Shape, WettedBody};
//!
//! # fn main() -> Result<(), fsi_coupling::BodyError> {
//! let mut body = RigidBody2d::new(RigidSpec {
//!     name: "box".into(),
//!     outline: Outline::of(&Shape::Box { breadth: 0.4, height: 0.2 })?,
//!     mass: 40.0,
//!     inertia: 0.67,
//!     center_of_mass: [0.0; 2],
//!     free: [true; 3],
//!     position: [0.0; 2],
//!     angle: 0.0,
//!     velocity: [0.0; 2],
//!     angular_velocity: 0.0,
//!     gravity: [0.0, -9.81],
//!     sprung: Vec::new(),
//!     half: false,
//! })?;
//! (0..100).try_for_each(|_| body.advance(0.001))?; // no load: free fall
//! let fallen = -body.motion().expect("a rigid body has a motion").position[1];
//! assert!((fallen - 0.5 * 9.81 * 0.1_f64.powi(2)).abs() < 1e-12);
//! # Ok(()) }
//! ```
//!
//! A new body is a file here that implements [`WettedBody`](body::WettedBody), [`Contact`](body::Contact),
//! [`Linked`](body::Linked) and [`Inspect`](body::Inspect), its line in this module and its name in `lib.rs`: three files.

pub mod bending;
pub mod body;
pub mod error;
pub mod flexible;
pub mod modal;
pub mod modes_state;
pub mod panel_state;
pub mod prescribed;
pub mod rigid;
pub mod rigid_interface;
pub mod rigid_motion;
pub mod rigid_spec;
pub mod rigid_surface;
pub mod sprung;
pub mod state;
pub mod tank;
