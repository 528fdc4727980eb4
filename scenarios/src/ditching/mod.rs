//! Ditching by 2D+t: landings of aeroplanes on water, from a file to a report (THEORY EN14–EN19).
//!
//! # Example
//! ```
//! use scenarios::ditching;
//!
//! let landed = ditching::follow(&ditching::load("mercure", &[])?);
//! assert!(landed.summary.az_g.value > 0.0);
//! # Ok::<(), scenarios::scene::SceneError>(())
//! ```
//!
//! A landing is a TOML file of its own kind; [`load`] reads it, [`run`] follows it and writes `series.csv`, `summary.json`,
//! `report.html` and `scene.resolved.toml`, [`section_scenes`] makes scenes of particles of its sections. [`schema`] has the keys.

mod check;
mod landed;
mod load;
mod model;
mod page;
mod run;
mod sections;
mod series;
mod summary;

pub use landed::{Landed, follow};
pub use load::{builtin, load, load_text};
pub use model::{AeroplaneKeys, LandingKeys, Scene, StationKeys, WaterKeys, WingKeys, schema};
pub use run::{FILES, run};
pub use sections::{SectionError, SectionResult, SectionScene, section_scenes};
pub use summary::{Peak, Summary};
