//! An aeroplane from sections: 2D+t (THEORY EN14–EN19, EN25–EN29, EN36–EN38, EN54–EN59).
//!
//! The fuselage enters planes of water across its way, which move with the swell; the load of a [`Section`](super::Section) in each is a
//! theory's [`Load`](super::Load). [`Fuselage`] is the shape, [`Hull`] its loads, [`Landing`] its motion in the plane of symmetry.

mod aeroplane;
mod afloat;
mod attitude;
mod balance;
mod bending;
mod flooding;
mod form;
mod fuselage;
mod hull;
mod irregular;
mod landing;
mod loft;
mod masses;
mod monotone;
mod motion;
mod outline;
mod parts;
mod plane_history;
mod pressure;
mod section_forces;
mod strip;
mod struts;
mod surface_motion;
mod swell;
mod touchdown;

pub use aeroplane::{Aeroplane, Water, Wing};
pub use afloat::{Volume, Waterline};
pub use attitude::{Attitude, FREEDOMS, MODES, STRUTS};
pub use bending::Bending;
pub use flooding::{Afloat, FloatingState, Flooding, Opening};
pub use form::Form;
pub use fuselage::{Fuselage, FuselageError, Keel, OF_LANDINGS, Station};
pub use hull::{Hull, SectionLoad};
pub use irregular::{Components, Jonswap};
pub use landing::{FlightMoment, Landing, LandingEnd, LandingResult, LandingState};
pub use masses::Masses;
pub use outline::HalfSection;
pub use parts::{Nacelle, Panel, PointForce, Rib, Surface, planing_coefficient};
pub use plane_history::{PlaneHistory, PlaneMoment};
pub use pressure::{GirthPressure, GirthRange, PressureMap, Window};
pub use section_forces::SectionForce;
pub use strip::{Bottom, ImpactingPart, KeelPoint, Strip};
pub use struts::{Strut, StrutLoad, StrutSpring};
pub use surface_motion::SurfaceMotion;
pub use swell::Swell;
pub use touchdown::Touchdown;
