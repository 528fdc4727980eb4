//! Scenes: what is in the water, how finely, for how long.
//!
//! A scene is a TOML file. [`load`] reads one as written, with every key optional, and resolves it to a [`Scene`]: plain
//! data with every number known. Whatever is wrong becomes a [`SceneError`] with file, line, key, what was given and
//! what was expected; whatever is doubtful becomes a warning in plain words. [`keywords`] declares every key.
//!
//! ```
//! use scenarios::scene::load;
//!
//! let steeper = load("wedge", &["body.deadrise_deg=40".to_string()])?;
//! assert!(steeper.scene.to_toml().contains("deadrise_deg = 40.0"));
//! # Ok::<(), scenarios::scene::SceneError>(())
//! ```

mod auto;
mod builtin;
mod check;
mod chine;
mod error;
mod estimate;
mod exchange;
mod file;
mod impact;
mod keywords;
mod limits;
mod load;
mod model;
mod model_coupling;
mod model_fluid;
mod model_panel;
mod model_projection;
mod overrides;
mod panels;
pub(crate) mod problem;
mod read;
mod resolve;
mod resolve_body;
mod resolve_model;
mod resolve_panel;
mod resolve_projection;
mod resolve_resolution;
mod resolve_thesis;
pub(crate) mod source;
mod start;
mod warnings;

pub use auto::{ACOUSTIC_REACH, LEAST_SOUND_RATIO, auto_fine_zone, auto_reach, auto_sound_speed, fastest_speed};
pub use builtin::builtin;
pub use chine::jet_reach;
pub use error::SceneError;
pub use estimate::{BYTES_PER_PARTICLE, memory_estimate, particle_estimate};
pub use exchange::{ExchangeRatio, panel_exchanges};
pub use fsi_coupling::PanelEnd;
pub use fsi_coupling::Shape;
pub use impact::{
    Bottom, Entry, LARGEST_COMPRESSIBILITY_ERROR, LEAST_DEADRISE_DEG, compressibility_error,
    known_compressibility_error, sound_speed_for,
};
pub use keywords::{Keyword, keywords};
pub use load::{Loaded, load, load_beyond_limits, load_text};
pub use model::{
    Block, Body, Compare, Coupling, CouplingScheme, DiffusionForm, EntryModel, EquationOfState, Fluid, Freedom, Gauge,
    GaugeFrame, Integrator, Kernel, Motion, Norm, Observe, Oscillation, Resolution, Scene, Similarity, Symmetry, Tank,
    Time, WallSlip,
};
pub use model_panel::{Panel, TheoryName};
pub use overrides::apply_set;
pub use panels::panel_length;
pub(crate) use problem::significant;
pub use warnings::warnings;
