//! An aeroplane from sections: 2D+t (THEORY EN14–EN19).
//!
//! The fuselage enters planes of water that stand still and across its way; what a [`Section`](super::Section) bears in each is a
//! theory's [`Load`](super::Load). [`Fuselage`] is the hull, [`Hull`] what it bears, [`Landing`] its motion in the plane of symmetry.

mod fuselage;
mod hull;
mod landing;
mod monotone;
mod strip;

pub use fuselage::{Form, Fuselage, FuselageError, Keel, Station};
pub use hull::{Hull, SectionLoad};
pub use landing::{Aeroplane, Landing, LandingEnd, LandingResult, LandingState, Water, Wing};
pub use strip::{Attitude, ImpactingPart, KeelPoint, Strip};
