//! Plane frames of beam finite elements: statics, natural modes, motion in time. Double precision, SI units.
//!
//! Elements are Euler-Bernoulli's or Timoshenko's ([`Theory`]), with axial stiffness, three degrees of
//! freedom per node, at any orientation. The section is a bar, or a one metre wide strip of a plate in
//! cylindrical bending, in which case everything is per metre of span. Materials are linearly elastic.
//!
//! | | small displacements | any displacements and rotations, small strains |
//! |---|---|---|
//! | at rest | [`Statics`] | [`NonlinearStatics`]: load steps, or paths through peaks of the load |
//! | in motion | [`natural_modes`] | [`Dynamics`]: generalised-alpha, central differences, trapezoidal rule in momenta |
//!
//! Nodes may be tied to rigid bodies ([`Beam::with_rigid_body`], [`Supports::tie`]), free, guided or driven, which move
//! with the trapezoidal rule: panel and body are one set of equations.
//!
//! The crate knows nothing of fluids or files: it is useful alone. Whoever has loads hands them over as
//! forces at nodes, or as [`Loads`] along elements.
//!
//! A steel plate strip, clamped at one end, under one pascal:
//!
//! ```
//! use structure_fe::{Beam, Loads, Material, Section, Statics, Supports, natural_modes};
//!
//! let steel = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };
//! let plate = Section::strip(0.01);
//! let (length, elements) = (0.5, 8);
//! let beam = Beam::straight([0.0, 0.0], [length, 0.0], elements, steel, plate)?;
//! let mut supports = Supports::default();
//! supports.clamp(0);
//!
//! let mut loads = Loads::default();
//! for element in 0..elements {
//!     loads.along_element(element, [0.0, -1.0], [0.0, -1.0]);
//! }
//! let statics = Statics::new(beam, supports.clone())?;
//! let solution = statics.solve(&loads)?;
//! let exact = -length.powi(4) / (8.0 * plate.bending_stiffness(&steel));
//! assert!((solution.displacement[elements][1] / exact - 1.0).abs() < 1e-9);
//! assert!((solution.reactions[0][1] - length).abs() < 1e-9);
//!
//! let first = &natural_modes(statics.beam(), &supports, 1)?[0];
//! let exact = (1.87510407 / length).powi(2)
//!     * (plate.bending_stiffness(&steel) / plate.mass_per_length(&steel)).sqrt();
//! assert!((first.angular_frequency / exact - 1.0).abs() < 1e-5);
//! # Ok::<(), structure_fe::Error>(())
//! ```
//!
//! The same strip let go under a hundred pascals, for half a second:
//!
//! ```
//! use structure_fe::{Beam, Damping, Dynamics, Integration, Loads, Material, Section, Supports};
//!
//! let steel = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };
//! let beam = Beam::straight([0.0, 0.0], [0.5, 0.0], 8, steel, Section::strip(0.001))?;
//! let mut supports = Supports::default();
//! supports.clamp(0);
//! let mut loads = Loads::default();
//! for element in 0..8 {
//!     loads.pressure_on_element(element, 100.0, 100.0);
//! }
//!
//! let rule = Integration::GeneralisedAlpha { spectral_radius: 0.8 };
//! let mut dynamics = Dynamics::new(beam, supports, rule, Damping { mass: 1.0, stiffness: 1e-4 })?;
//! let mut state = dynamics.at_rest();
//! let load = loads.at_nodes(dynamics.beam(), &state.displacement)?;
//! dynamics.equilibrate(&mut state, &load)?;
//! for _ in 0..500 {
//!     // The pressure follows the strip: here with where it was at the start of the step.
//!     let load = loads.at_nodes(dynamics.beam(), &state.displacement)?;
//!     dynamics.step(&mut state, &load, 1e-3)?;
//! }
//! assert!((state.time - 0.5).abs() < 1e-9 && state.displacement[8][1] < 0.0);
//! let root = &dynamics.section_forces(&state)[0];
//! let stress = root.fibre_stress(&Section::strip(0.001), 0.0005);
//! assert!(root.moment < 0.0 && stress > 0.0, "the pressed side is in tension at the clamp");
//! # Ok::<(), structure_fe::Error>(())
//! ```

mod arc_length;
mod banded;
mod beam;
mod bordered;
mod central_difference;
mod corotational;
mod dynamics;
mod effective_inertia;
mod element;
mod element_mass;
mod envelope;
mod equations;
mod error;
mod gathered;
mod generalised_alpha;
mod handling;
mod inertia;
mod loads;
mod lumped;
mod material;
mod mean_forces;
mod mechanism;
mod modes;
mod nonlinear_statics;
mod ordering;
mod plastic;
mod restoring;
mod rupture;
mod section;
mod section_forces;
mod state;
mod statics;
mod supports;
mod system;
mod theory;
mod ties;
mod trapezoidal;

pub use arc_length::PathPoint;
pub use beam::{Beam, Element};
pub use dynamics::Dynamics;
pub use effective_inertia::EffectiveInertia;
pub use envelope::{EndEnvelope, Envelope, Range};
pub use error::Error;
pub use inertia::Damping;
pub use loads::Loads;
pub use material::Material;
pub use modes::{AddedMass, Mode, natural_modes, wet_modes};
pub use nonlinear_statics::NonlinearStatics;
pub use plastic::Plasticity;
pub use rupture::{Break, Rupture};
pub use section::Section;
pub use section_forces::SectionForces;
pub use state::{Integration, State, StepReport, SupportMotion};
pub use statics::{StaticSolution, Statics};
pub use supports::{Dof, Supports};
pub use theory::Theory;
