//! Low-order models of water entry: from microseconds to seconds instead of minutes (THEORY EN2–EN9, EN20–EN24, EN30–EN41).
//!
//! [`Section`] is the bottom, [`EntryModel`] a model, [`Loads`] the load of a section at a draught, [`Entry`] its motion.
//! [`SimilarityFlow`] is the exact flow about a wedge at constant speed, [`EntryFlow`] the flow about one in any vertical motion,
//! [`FlowEntry`] that motion, [`AsymmetricFlow`] and [`RolledFlow`] the same of a wedge with two deadrises, [`ElasticWedge`] a wedge with flexible faces,
//! [`air_cushion`] the air under a flat bottom, [`ditching`] an aeroplane made of sections, [`planing`] a hull that planes, [`waves`] those of small height and their maker,
//! [`rules`] the loads that airworthiness rules state, [`finite_span`] the share of a load between free ends.
//!
//! Runnable examples, each with its reference, by `cargo run --release -p water_entry --example NAME`: `falling_wedge` by three theories,
//! `similarity_flow` of a wedge of 30 degrees, `two_deadrises` of a rolled wedge, `elastic_faces`, `air_cushion` under a flat plate,
//! `landing` of an aeroplane.
//!
//! ```
//! use water_entry::{EntryModel, Loads, Section};
//!
//! # fn main() -> Result<(), water_entry::OutOfRange> {
//! // a wedge of 30 degrees, 1 m wide, at a draught of 0.1 m and 2 m/s in water of 1000 kg/m3
//! let loads = Loads::new(EntryModel::Wagner, &Section::wedge(30.0, 1.0)?)?;
//! let force = 1000.0 * loads.at(0.1).slam * 2.0_f64.powi(2);
//! // Wagner (1932): F = rho V^2 h pi^3 / (4 tan^2 beta) [N/m]
//! let exact = 1000.0 * 4.0 * 0.1 * std::f64::consts::PI.powi(3) / (4.0 * 30.0_f64.to_radians().tan().powi(2));
//! assert!((force / exact - 1.0).abs() < 1e-6);
//! # Ok(()) }
//! ```

pub mod air_cushion;
mod asymmetric_similarity;
mod boundary_element;
pub mod curve;
pub mod ditching;
mod dobrovolskaya;
mod entry;
pub mod finite_span;
mod given_motion;
mod hydroelastic;
pub mod keel;
mod loads;
mod model;
pub mod planing;
mod range;
pub mod rules;
mod section;
mod similarity;
pub mod waves;

pub use asymmetric_similarity::{AsymmetricFlow, Balance, FaceFlow, NoFlow, NoPlateFlow, PlateFlow};
pub use boundary_element::{
    AlongBottom, BendingBottom, BendingStepError, BendingWater, BottomMotion, Deflection, EntryFlow, FlowEnded,
    FlowEntry, FlowHistory, FlowLoad, RolledEntry, RolledFlow, RolledInstant, RolledLoad, WaterOnBottom,
};
pub use entry::{Entry, Instant, SectionMotion};
pub use given_motion::GivenMotion;
pub use hydroelastic::{ElasticWedge, Held, WedgeState};
pub use loads::{Load, Loads};
pub use model::{BOUNDARY_ELEMENT_DEADRISES, EntryModel, OutOfRange};
pub use section::Section;
pub use similarity::{DEADRISES, SimilarityFlow};
