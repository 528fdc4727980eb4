//! The meeting room of fluid and structure: what a wetted body is, where its boundary particles are, and
//! how the fluid's forces go back to it.
//!
//! Read [`body`] (the contract), [`coupled`] (the step), then a body: [`rigid`] (rapier), [`prescribed`],
//! [`tank`], [`flexible_body`]. [`shape`], [`outline`], [`sampling`], [`thin`] and [`fill`] turn shapes into particles. [`host`] is the door for programs
//! that keep their own loop.

pub mod beam_surface;
pub mod body;
pub mod carrier;
#[cfg(test)]
mod column_tests;
mod contact;
pub mod coupled;
mod coupling_error;
pub mod course;
pub mod exchange;
pub mod exchange_ratio;
pub mod fill;
pub mod flexible;
pub mod flexible_body;
pub mod flexible_yield;
pub mod focus;
pub mod force_rules;
pub mod host;
mod moving;
pub mod nodal;
pub mod outline;
pub mod packing;
pub mod panel;
pub mod panel_state;
pub mod penetration;
pub mod polygon;
pub mod pose;
pub mod prescribed;
pub mod relaxation;
mod retry;
pub mod rigid;
pub mod rigid_yield;
pub mod rows;
pub mod sampling;
pub mod settings;
pub mod shape;
mod skin;
pub mod tank;
pub mod theory;
pub mod thin;
pub mod water_surface;
pub mod work_audit;

pub use body::{BodyError, Energy, Ledger, Motion, Surface, WettedBody};
pub use coupled::Coupled;
pub use coupling_error::CouplingError;
pub use exchange::{Agreement, Iteration, Scheme};
pub use exchange_ratio::{Beside, PanelExchange, exchange_ratio};
pub use flexible::{FlexibleSpec, Frame};
pub use flexible_body::FlexibleBody;
pub use focus::Focus;
pub use outline::Outline;
pub use panel::{PanelEnd, PanelSpec};
pub use panel_state::{PanelState, Watched, Worst};
pub use penetration::{Breach, Penetration};
pub use prescribed::PrescribedBody;
pub use rigid::{RigidBody2d, RigidSpec};
pub use rows::Arrangement;
pub use shape::Shape;
pub use tank::Tank;
pub use thin::Plate;
pub use work_audit::WorkAudit;
