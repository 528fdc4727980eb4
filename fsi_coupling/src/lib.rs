//! Coupling of the fluid with bodies: what a wetted body is, where its boundary particles are, and how the fluid's forces
//! act on it.
//!
//! [`geometry`] turns shapes into particles, [`bodies`] has the contract of a body and the bodies, [`coupling`] the step of fluid and
//! bodies together, [`entry_theory`] analytical models of water entry, [`embed`] the element for programs with a time loop
//! of their own, [`settings`] structs of settings that document and check themselves.

pub mod bodies;
pub mod coupling;
pub mod embed;
pub mod entry_theory;
pub mod geometry;
pub mod settings;

pub use bodies::body::{Body, Contact, Inspect, WettedBody};
pub use bodies::error::BodyError;
pub use bodies::flexible::body::FlexibleBody;
pub use bodies::flexible::model::{FlexibleSpec, Frame};
pub use bodies::flexible::panel::{PanelEnd, PanelSpec};
pub use bodies::flexible::panel_state::{PanelState, Watched, Worst};
pub use bodies::prescribed::PrescribedBody;
pub use bodies::rigid::{RigidBody2d, RigidSpec};
pub use bodies::rigid_motion::RigidMotion;
pub use bodies::state::{ContactImpulse, Energy, Momentum, Motion, SurfacePoint};
pub use bodies::tank::Tank;
pub use coupling::coupled::Coupled;
pub use coupling::error::CouplingError;
pub use coupling::penetration::{Breach, Penetration};
pub use coupling::placed_bodies::PlacedBodies;
pub use coupling::refinement::RefinementRule;
pub use coupling::scheme::{CouplingStatistics, Iteration, Scheme};
pub use coupling::stability_estimate::{Beside, PanelExchange, exchange_ratio};
pub use coupling::work_audit::WorkAudit;
pub use geometry::outline::Outline;
pub use geometry::plate::Plate;
pub use geometry::rows::{Arrangement, WallRows};
pub use geometry::shape::Shape;
