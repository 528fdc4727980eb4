//! Scenes: what is in the water, how finely, for how long.
//!
//! A scene is a TOML file. [`load`] reads one as written, with every key optional, and resolves it to a [`Scene`]: plain
//! data with every number known. Whatever is wrong becomes a [`SceneError`] with file, line, key, what was given and
//! what was expected; whatever is doubtful becomes a warning in plain words. [`keys`] declares every key, and [`schema`] lists them.
//!
//! ```
//! use scenarios::scene::load;
//!
//! let steeper = load("wedge", &["body.deadrise_deg=40".to_string()])?;
//! assert!(steeper.scene.to_toml().contains("deadrise_deg = 40.0"));
//! # Ok::<(), scenarios::scene::SceneError>(())
//! ```

mod air_warnings;
mod approach;
mod as_written;
mod auto;
mod bottom;
mod check;
mod data_file;
pub(crate) mod draft;
mod entries;
mod entry_warnings;
mod error;
mod estimate;
mod exchange;
mod force_limits;
mod gauge_warnings;
mod impact;
mod incompressible;
mod keel;
pub mod keys;
#[cfg_attr(not(feature = "legacy"), path = "without_legacy.rs")]
mod legacy;
mod library;
mod load;
pub(crate) mod mistaken_file;
mod modes_file;
mod motion_file;
mod narrow_gaps;
mod outline;
mod plausible;
mod prepare;
mod references;
mod resolve;
mod resolve_body;
mod resolve_links;
mod resolve_modes;
pub(crate) mod source;
mod spring_steps;
mod stations;
mod structure_file;
mod symmetric;
mod table_file;
mod under_water;
mod unusual;
mod warnings;
mod waves;
mod wet_period;

pub(crate) use air_warnings::LEAST_HALF_BREADTH;
pub(crate) use approach::{LEAST_GAP, START_GAP};
pub use auto::{ACOUSTIC_REACH, auto_fine_zone, auto_reach, auto_sound_speed, fastest_speed};
pub use bottom::{Bottom, LEAST_DEADRISE_DEG};
pub use error::SceneError;
pub use estimate::{BYTES_PER_PARTICLE, memory_estimate, particle_estimate};
pub use exchange::{ExchangeRatio, panel_exchanges};
pub(crate) use force_limits::{limit_of_forces, presses_on_walls};
pub use fsi_coupling::{PanelEnd, Shape};
pub(crate) use impact::FITTED_MACH;
pub use impact::{
    Entry, FLAT_CONTACT, LARGEST_COMPRESSIBILITY_ERROR, LEAST_DRAUGHT, LEAST_SOUND_RATIO, compressibility_error,
    jet_reach, known_compressibility_error, sound_speed_for,
};
pub(crate) use incompressible::share_of_walls;
pub use keys::{
    Axis, Beach, Block, Body, Compare, Coupling, CouplingScheme, Freedom, Gauge, GaugeFrame, Modes, Motion, Moved,
    NaturalMode, Norm, Observe, Oscillation, Panel, QuantityOfInterest, Report, Resolution, Scene, Similarity,
    SolverSettings, SprungMass, Symmetry, Tank, TheoryName, Time, WaveMaker, panel_length, panel_line, schema,
};
pub(crate) use keys::{MILLIMETRE, MODES, line};
pub use legacy::Integrator;
pub(crate) use legacy::thesis_work;
pub use library::{MATERIALS, MaterialName, MaterialProperties, WATER_TABLE, WaterName, WaterProperties};
pub use load::{Loaded, all_warnings, builtin, load, load_beyond_limits, load_text};
pub use outline::OutlineReport;
pub(crate) use resolve::MOST_ROWS;
pub use source::apply_set;
pub use sph_core::{Kernel, Slip as WallSlip};
pub(crate) use spring_steps::{longest_spring_step, spec as sprung_spec};
pub(crate) use unusual::Unusual;
pub use warnings::warnings;
pub use water_entry::EntryModel;
pub(crate) use waves::{early_end as waves_end_early, full_waves_by};
pub use wet_period::longest_step;
pub(crate) use wet_period::resonant_panels;
