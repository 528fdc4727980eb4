//! Cross-crate evidence, in four kinds that are kept apart.
//!
//! - `verification`: exact answers and observed orders of convergence.
//! - `validation`: experiments and others' solutions, as data for `splashdown validate`.
//! - `regression`: frozen counters of our own runs, which say nothing about physics.
//! - `stability`: known failures of the method, each asserted, with its remedy.
//!
//! A fifth, `contract`, drives the `splashdown` command as its users do. This library holds what the kinds share:
//! coarse [`systems`] to step, a wedge of a host's nodes ([`host_wedge`]), [`bare`] fluids without bodies, a hand-made [`load`] to push
//! bodies with, a plain [`landing`], a [`light`] box, linear theory of [`heave`], small [`statistics`], and whether tests
//! take their [`long`] variants.

#[path = "support/bare.rs"]
pub mod bare;
#[path = "support/column.rs"]
pub mod column;
#[path = "support/heave.rs"]
pub mod heave;
#[path = "support/host_wedge.rs"]
pub mod host_wedge;
#[path = "support/landing.rs"]
pub mod landing;
#[path = "support/light.rs"]
pub mod light;
#[path = "support/load.rs"]
pub mod load;
#[path = "support/long.rs"]
pub mod long;
#[path = "support/parameters.rs"]
pub mod parameters;
#[path = "support/plates.rs"]
pub mod plates;
#[path = "support/statistics.rs"]
pub mod statistics;
#[path = "support/strip.rs"]
pub mod strip;
#[path = "support/surfacing.rs"]
pub mod surfacing;
#[path = "support/systems.rs"]
pub mod systems;

/// The code of the guide, compiled and run as it is printed.
#[cfg(doctest)]
mod guide {
    #[doc = include_str!("../docs/src/guide/embedding.md")]
    mod embedding {}
    #[doc = include_str!("../docs/src/guide/library.md")]
    mod library {}
}
