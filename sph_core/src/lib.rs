//! Two-dimensional smoothed particle hydrodynamics for free-surface impact, f64.
//!
//! The crate computes a fluid between *walls*: boundary particles that their owners move and that carry back the force of the
//! fluid. SI units, per metre of span; equations are numbered in the book's theory part.
//!
//! | read | for |
//! |---|---|
//! | [`Fluid`], [`Scheme`] | what is stepped, and what a scheme is |
//! | [`wcsph`], [`projection`] | the weakly compressible and the incompressible scheme |
//! | [`Domain`], [`Kernel`], [`Dissipation`] | what schemes share |
//! | [`walls`], [`contact`] | boundary particles; fluid particles beyond a wall's surface |
//! | [`Probe`], [`particles`], [`neighbours`] | pressures at a point; state, totals and neighbours of particles |
//! | [`parallel`], [`state_bytes`] | threads; checkpoints |
//! | `legacy` (a cargo feature, on by default) | schemes and options of 2010 |
//!
//! Inside, `interactions` has the terms of a pair, `forces` their sums on fluid and walls, `simd` four targets at once.
//!
//! `cargo run --release -p sph_core --example NAME` runs `still_water`, `dam_break`, `piston` (a wall that moves), `standing_wave`
//! (incompressible), `elliptic_drop` (kernels against an exact solution) and `checkpoint`.
//!
//! A dam break: water of 1 m by 1 m in the left half of a tank.
//!
//! ```
//! use sph_core::{Domain, Fluid, Seed, WallPoint, Walls, wcsph};
//!
//! const SPACING: f64 = 0.1;
//! let centre = |k: i32| (f64::from(k) + 0.5) * SPACING;
//!
//! let weight = 9.81 * 1000.0; // [N/m³]
//! let cells = (0..10).flat_map(|i| (0..10).map(move |j| (i, j)));
//! let seeds: Vec<Seed> = cells
//!     .map(|(i, j)| {
//!         let at = [centre(i), centre(j)];
//!         Seed { at, velocity: [0.0; 2], area: SPACING * SPACING, pressure: weight * (1.0 - at[1]) }
//!     })
//!     .collect();
//!
//! // three rows of boundary particles below the floor and behind both side walls
//! let mut points = Vec::new();
//! for row in 0..3 {
//!     let depth = centre(row);
//!     let point = |at, normal| WallPoint { at, normal, area: SPACING * SPACING, spacing: SPACING, depth, outline: Default::default(), midline: None };
//!     points.extend((-3..23).map(|i| point([centre(i), -depth], [0.0, 1.0])));
//!     points.extend((0..20).map(|j| point([-depth, centre(j)], [1.0, 0.0])));
//!     points.extend((0..20).map(|j| point([2.0 + depth, centre(j)], [-1.0, 0.0])));
//! }
//!
//! let domain = Domain { gravity: [0.0, -9.81], fastest_speed: 4.5, ..Domain::default() };
//! let mut fluid = Fluid::new(domain, &wcsph::Settings::default(), &seeds);
//! let mut walls = Walls::default();
//! walls.extend(&points, domain.fluid.smoothing_ratio);
//!
//! fluid.initialise(&mut walls)?;
//! while fluid.time() < 0.3 {
//!     let dt = fluid.stable_dt(&walls)?;
//!     fluid.step(&mut walls, dt)?;
//! }
//! let front = fluid.particles().x.iter().fold(0.0_f64, |front, &x| front.max(x));
//! assert!((1.2..1.9).contains(&front), "the front is at {front} m");
//! # Ok::<(), sph_core::Breakdown>(())
//! ```

mod auto;
pub mod contact;
mod damping_zone;
mod domain;
mod error;
mod fluid;
mod forces;
mod interactions;
mod kernel;
#[cfg(feature = "legacy")]
pub mod legacy;
mod memory;
pub mod neighbours;
pub mod parallel;
pub mod particles;
mod planes;
mod probe;
pub mod projection;
mod random;
mod refinement;
mod scheme;
mod simd;
pub mod state_bytes;
mod system;
mod team;
mod timers;
pub mod walls;
pub mod wcsph;

pub use auto::Auto;
pub use damping_zone::{Damped, DampingZone};
pub use domain::{Domain, FluidSettings, Slip, Solver};
pub use error::Breakdown;
pub use fluid::Fluid;
pub use interactions::dissipation::Dissipation;
pub use kernel::Kernel;
#[cfg(feature = "legacy")]
pub use legacy::{DensityEvolution, DensityFilter, IdealGas, Integrator, ThesisSettings, Turbulence, WallModel};
pub use particles::{Particles, Seed};
pub use planes::{Mirror, Periodic};
pub use probe::{FirstOrder, Probe};
pub use random::SplitMix64;
pub use refinement::RefinementZone;
pub use scheme::{Flow, Scheme, SchemeSettings};
pub use state_bytes::StateError;
pub use system::ParticleSystem;
pub use timers::{Phase, Timers};
pub use walls::interface::{InterfaceDynamics, WallInterface};
pub use walls::midline::{Passage, PlateMidline};
pub use walls::{WallForces, WallLayout, WallPoint, Walls, WallsMut};
