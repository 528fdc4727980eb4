//! Observers: small, scheduled, borrowing immutably. They never change the system or shorten a step.

mod face_profile;
mod flow;
mod force_rules;
mod front;
mod gauge_record;
pub(crate) mod gauges;
mod ledger;
mod level;
mod log;
mod low_pass;
mod sensing;
mod series;
mod similarity;
mod volume;

use std::io;

use fsi_coupling::{Coupled, Penetration};
use sph_core::particles::totals::Totals;

use crate::log::LogError;

pub use flow::FlowPictures;
pub use force_rules::{ForceRules, RuleResult};
pub use front::FRONT;
pub use gauge_record::GaugeResult;
pub use gauges::{GaugeReader, Reading};
pub use ledger::EnergyLedger;
pub use level::columns as level_columns;
pub use log::LogObserver;
pub use low_pass::LowPass;
pub use series::Series;
pub use similarity::{SimilarityResult, SimilarityWindow};
pub use volume::VOLUME;

/// What an observer sees.
#[derive(Clone, Copy)]
pub struct Frame<'a> {
    /// The system after a step.
    pub system: &'a Coupled,
    /// Pressure of each gauge [Pa], in the scene's order.
    pub gauges: &'a [f64],
    /// What the fluid holds.
    pub held: &'a Totals,
    /// Fluid particles beyond a wall's surface.
    pub penetration: &'a Penetration,
    /// True where particles are due as well as curves.
    pub particles: bool,
}

impl Frame<'_> {
    /// Time [s].
    pub fn time(&self) -> f64 {
        self.system.fluid.time()
    }
}

/// An observer could not keep what it saw.
#[derive(Debug, thiserror::Error)]
pub enum ObserveError {
    /// A file could not be written.
    #[error("cannot write {path}: {source}")]
    Io {
        /// The file.
        path: String,
        /// Why.
        source: io::Error,
    },
    /// The log could not be written.
    #[error(transparent)]
    Log(#[from] LogError),
}

/// Something that watches a run.
pub trait Observer {
    /// See the system at a sample time.
    fn observe(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError>;
}
