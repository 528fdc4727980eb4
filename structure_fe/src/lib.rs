//! Plane frames of beam finite elements: statics, natural modes, motion in time. Double precision, SI units.
//!
//! Elements are Euler-Bernoulli's or Timoshenko's ([`Theory`]), with axial stiffness, three degrees of
//! freedom per node, at any orientation. The section is a bar, or a one metre wide strip of a plate in
//! cylindrical bending, in which case everything is per metre of span. Materials are linearly elastic, and can
//! yield ([`Beam::with_plasticity`]); joints can break ([`Supports::breakable`]).
//!
//! | | small displacements | any displacements and rotations, small strains |
//! |---|---|---|
//! | at rest | [`Statics`] | [`NonlinearStatics`]: load steps, or paths through peaks of the load |
//! | in motion | [`natural_modes`], [`wet_modes`] | [`Dynamics`]: generalised-alpha, central differences, trapezoidal rule in momenta |
//!
//! Rigid links join nodes to rigid bodies ([`Beam::with_rigid_body`], [`Supports::link`]), free, guided or driven, under
//! the trapezoidal rule: panel and body are one set of equations.
//!
//! The crate does not depend on fluids or files. Loads are forces at nodes, or [`Loads`] along elements.
//!
//! Modules from bottom to top: [`material`], element (formulation), [`model`], assembly, then [`statics`], [`modes`] and
//! [`dynamics`].
//!
//! Runnable examples, each against theory, by `cargo run --release -p structure_fe --example NAME`: `natural_modes` of a clamped
//! strip, `panel_under_pressure` with its membrane force, `impulse_on_a_beam` with damping, `collapse_load` by plastic hinges,
//! `panel_from_modes` of another program; `step_cost` gives the seconds of a time step.
//!
//! A cantilever and its modes: a steel plate strip under one pascal:
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
//! A thinner strip under a suddenly applied pressure of a hundred pascals, for half a second:
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
//!     // The pressure follows the strip, with its position at the start of the step.
//!     let load = loads.at_nodes(dynamics.beam(), &state.displacement)?;
//!     dynamics.step(&mut state, &load, 1e-3)?;
//! }
//! assert!((state.time - 0.5).abs() < 1e-9 && state.displacement[8][1] < 0.0);
//! let root = &dynamics.section_forces(&state)[0];
//! let stress = root.fibre_stress(&Section::strip(0.001), 0.0005);
//! assert!(root.moment < 0.0 && stress > 0.0, "the loaded side is in tension at the clamp");
//! # Ok::<(), structure_fe::Error>(())
//! ```

mod assembly;
pub mod dynamics;
mod element;
mod error;
mod field;
mod linear_algebra;
pub mod material;
pub mod modal;
pub mod model;
pub mod modes;
pub mod statics;

pub use assembly::Fibres;
pub use dynamics::SupportMotion;
pub use dynamics::{Dynamics, EffectiveInertia, EndEnvelope, Envelope, Integration, Range, State, StepReport};
pub use element::{Damping, PlasticStrains, SectionForces, Theory};
pub use error::Error;
pub use field::Dof;
pub use material::{BarSection, Material, Plasticity, Section};
pub use model::{Beam, Break, Connector, Element, Loads, Rupture, Supports};
pub use modes::{AddedMass, Mode, natural_modes, wet_modes};
pub use statics::{NonlinearStatics, PathPoint, StaticSolution, Statics};
