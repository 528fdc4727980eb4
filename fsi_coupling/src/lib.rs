//! The meeting room of fluid and structure: what a wetted body is, where its boundary particles are, and
//! how the fluid's forces go back to it.
//!
//! Read [`body`] (the contract), [`coupled`] (the step), then a body: [`rigid`] (rapier), [`prescribed`],
//! [`tank`]. [`shape`], [`outline`], [`sampling`], [`thin`] and [`fill`] turn shapes into particles.

pub mod beam_body;
pub mod beam_surface;
pub mod body;
mod contact;
pub mod coupled;
pub mod exchange;
pub mod fill;
pub mod force_rules;
pub mod nodal;
pub mod outline;
pub mod penetration;
pub mod polygon;
pub mod pose;
pub mod prescribed;
pub mod relaxation;
pub mod rigid;
pub mod rows;
pub mod sampling;
pub mod shape;
pub mod tank;
pub mod thin;

pub use beam_body::{BeamBody, BeamSpec};
pub use body::{BodyError, Energy, Ledger, Motion, Surface, WettedBody};
pub use coupled::{Coupled, CouplingError};
pub use exchange::{Agreement, Iteration, Scheme};
pub use outline::Outline;
pub use penetration::{Breach, Penetration};
pub use prescribed::PrescribedBody;
pub use rigid::{RigidBody2d, RigidSpec};
pub use rows::Arrangement;
pub use shape::Shape;
pub use tank::Tank;
pub use thin::Plate;
