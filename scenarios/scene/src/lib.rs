//! Scenes: what is in the water, how finely, for how long.
//!
//! A scene is a TOML file. A [`Loader`] reads one as written, with every key optional, and resolves it to a [`Scene`]: plain
//! data with every number known. Whatever is wrong becomes a [`SceneError`] with file, line, key, what was given and
//! what was expected; whatever is doubtful becomes a warning in plain words. [`keys`] declares every key, and [`schema`] lists them.
//!
//! What a scene may ask of the models that run it stands in [`Models`]: a [`Loader`] is made with them. The crate `run` has one with all models of
//! this program, `run::load`.

mod as_written;
mod auto;
mod bottom;
mod bounded_text;
mod check;
mod cost;
mod data_file;
pub mod draft;
pub mod embedded;
mod entries;
mod error;
mod estimate;
mod follow;
mod identity;
mod ignored;
mod impact;
pub mod keys;
mod layout;
mod legacy;
mod library;
pub mod load;
pub mod mistaken_file;
mod models;
mod modes_file;
mod motion_file;
pub mod nastran;
mod outline;
#[cfg(test)]
mod particles_tests;
mod prepare;
pub mod reference;
mod references;
mod resolve;
mod resolve_body;
mod resolve_links;
mod resolve_modes;
pub mod source;
mod spelling;
mod stations;
mod structure_file;
mod symmetric;
mod table_file;
mod unusual;
pub mod validity;
pub mod vocabulary;

pub use auto::fastest_speed;
pub use bottom::Bottom;
pub use bounded_text::read_text;
pub use cost::{core_seconds, cost_of_step, estimated_steps, step_at_start};
pub use embedded::{contents, texts};
pub use error::SceneError;
pub use estimate::{BYTES_PER_PARTICLE, memory_estimate, particle_estimate};
pub use follow::{Follower, with_end};
pub use fsi_coupling::{PanelEnd, Shape};
pub use identity::identity;
pub use impact::{Entry, jet_reach};
pub use keys::{
    Axis, Beach, Block, Body, Compare, Coupling, CouplingScheme, Freedom, Gauge, GaugeFrame, Modes, Motion, Moved,
    NaturalMode, Norm, Observe, Oscillation, Panel, QuantityOfInterest, Report, Resolution, Rule, Scene, Similarity,
    SolverSettings, SprungMass, Symmetry, Tank, TheoryName, Time, WaveMaker, panel_length, panel_line, schema,
};
pub use keys::{MILLIMETRE, MODES, line};
pub use layout::{domain, layout, rows};
pub use legacy::Integrator;
pub use legacy::thesis_work;
pub use library::{MATERIALS, MaterialName, MaterialProperties, WATER_TABLE, WaterName, WaterProperties};
pub use load::{Loaded, Loader, all_warnings, builtin};
pub use models::{Choice, Models};
pub use outline::{OutlineReport, outline_of_section};
#[cfg(test)]
pub(crate) use particles_tests::{load, load_text};
pub use resolve::MOST_ROWS;
pub use source::apply_set;
pub use spelling::nearest;
pub use sph_core::Kernel;
pub use unusual::Unusual;
pub use validity::compressibility::{compressibility_error, known_compressibility_error};
pub use validity::exchange::{ExchangeRatio, panel_exchanges};
pub use validity::limits::{limit_of_forces, presses_on_walls};
pub use validity::projection::share_of_walls;
pub use validity::resolution::LEAST_DRAUGHT;
pub use validity::springs::spec as sprung_spec;
pub use validity::warnings;
pub use validity::waves::{early_end as waves_end_early, full_waves_by};
pub use validity::wet_period::longest_step;
pub use validity::wet_period::resonant_panels;
pub use water_entry::EntryModel;
