//! Observers sample a run. They borrow the system immutably and never shorten a step.
//!
//! A new column of `series.csv` is a `Source` in a file of `columns/`, and its lines in `columns/mod.rs`.

mod columns;
mod face_profile;
mod force_rules;
mod gauge_record;
pub(crate) mod gauges;
mod harmonics;
mod history;
mod low_pass;
mod run_log;
mod run_view;
mod sensing;
mod series;
mod similarity;
mod source;
mod surface_impulse;
mod wave_loads;
mod wave_theory;
mod waves;

use std::io;

use fsi_coupling::{Coupled, Penetration};
use sph_core::particles::totals::Totals;

use crate::log::LogError;

pub use columns::{Water, body_values, columns};
pub(crate) use columns::{modal_values, panel_values};
pub use force_rules::{ForceRules, RuleResult};
pub use gauge_record::GaugeResult;
pub use gauges::GaugeReader;
pub use harmonics::Harmonics;
pub use history::{History, Rest, WorstPenetration};
pub use low_pass::{LowPass, phaseless};
pub(crate) use run_log::create_log;
pub use run_log::{LiveObserver, LogObserver};
pub use run_view::{LOADS, load_names};
pub use series::Series;
pub use similarity::FROM as SIMILARITY_FROM;
pub use similarity::{SimilarityResult, SimilarityWindow};
pub use wave_loads::BodyInWaves;
pub use wave_theory::{WaveTheory, wave_theory};
pub(crate) use waves::unlikely_waves;
pub use waves::{WaveGauge, Waves};

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
    /// True if particles are due as well as curves.
    pub particles: bool,
}

impl Frame<'_> {
    /// Time [s].
    pub fn time(&self) -> f64 {
        self.system.fluid.time()
    }
}

/// An observer could not store its result.
#[derive(Debug, thiserror::Error)]
pub enum ObserveError {
    /// A file could not be written.
    #[error("cannot write {0}: {1}")]
    Io(String, #[source] io::Error),
    /// The log could not be written.
    #[error(transparent)]
    Log(#[from] LogError),
}

/// Samples a run.
pub trait Observer {
    /// Sample the system.
    fn observe(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError>;
}

/// Mean and standard deviation.
pub(crate) fn mean_and_deviation(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    [mean, (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n).sqrt()]
}
