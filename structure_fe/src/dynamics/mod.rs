//! Motion in time at large displacements: integration rules, rupture, envelopes, and the interface to coupling schemes.
//!
//! A rubber strip falls with the rigid body that it is clamped to; momentum is conserved to rounding:
//!
//! ```
//! use structure_fe::{Beam, Damping, Dynamics, Integration, Material, Section, Supports};
//!
//! let rubber = Material { youngs_modulus: 5e6, poissons_ratio: 0.45, density: 1100.0 };
//! let strip = Beam::straight([0.0, 0.0], [0.5, 0.0], 10, rubber, Section::strip(0.01))?;
//! let (model, body) = strip.with_rigid_body([-0.1, 0.0], 20.0, 0.3)?;
//! let mut supports = Supports::default();
//! supports.link(body, 0);
//!
//! let rule = Integration::Trapezoidal { spectral_radius: 0.8 };
//! let mut dynamics = Dynamics::new(model, supports, rule, Damping::default())?;
//! let (mut state, weight) = (dynamics.at_rest(), dynamics.gravity_load([0.0, -9.81]));
//! dynamics.equilibrate(&mut state, &weight)?;
//! for _ in 0..50 {
//!     dynamics.step(&mut state, &weight, 1e-3)?;
//! }
//! let exact = -9.81 * 0.05 * dynamics.beam().mass();
//! assert!((dynamics.momentum(&state)[1] / exact - 1.0).abs() < 1e-9);
//! # Ok::<(), structure_fe::Error>(())
//! ```

mod effective_inertia;
mod envelope;
mod generalised_alpha;
mod lumped_mass;
mod moving_model;
mod newton;
mod solver;
mod state;
mod trapezoidal;

pub use effective_inertia::EffectiveInertia;
pub use envelope::{EndEnvelope, Envelope, Range};
pub use solver::Dynamics;
pub use state::{Integration, State, StepReport, SupportMotion};
