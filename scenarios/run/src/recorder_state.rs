//! What the observers of a run hold, as bytes, to continue the run in another process.

use std::path::Path;

use serde::{Deserialize, Serialize};
use sph_core::state_bytes::{StateError, decode, encode, expect_count};

use super::recorder::Recorder;
use super::summary::Peak;
use crate::observers::{History, LogObserver, ObserveError};

/// All observers but the log.
#[derive(Serialize, Deserialize)]
struct Stored {
    gauges: Vec<u8>,
    results: Vec<u8>,
    similarity: Option<Vec<u8>>,
    force_rules: Option<Vec<u8>>,
    history: History,
    rows: Vec<Vec<f64>>,
    /// Name, value and time [s] of the body's extremes.
    extremes: Vec<(String, f64, f64)>,
    /// When sample and frame are due [s].
    due: [f64; 2],
    reported_until: f64,
    crossing_reported: bool,
}

/// What the observers hold but rows and log, at a moment to which a host may return.
pub(crate) struct Mark(Vec<u8>);

impl Recorder {
    /// Accept what was observed so far, and hold back from the files what comes: `discard` returns to this moment.
    pub fn hold(&mut self) -> Result<Mark, ObserveError> {
        self.series.hold()?;
        self.log.as_mut().map_or(Ok(()), LogObserver::hold)?;
        Ok(Mark(self.encoded(Vec::new())))
    }

    /// Return to a moment that was marked.
    pub fn discard(&mut self, mark: &Mark) -> Result<(), StateError> {
        self.series.discard();
        if let Some(log) = &mut self.log {
            log.discard();
        }
        self.restore_bytes(&mark.0).map(|_| ())
    }

    /// All that the observers hold but the log.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encoded(self.series.rows().to_vec())
    }

    fn encoded(&self, rows: Vec<Vec<f64>>) -> Vec<u8> {
        let extreme = |(name, peak): &(String, Peak)| (name.clone(), peak.value, peak.time_s);
        encode(&Stored {
            gauges: self.gauges.to_bytes(),
            results: self.results.to_bytes(),
            similarity: self.similarity.as_ref().map(|window| window.to_bytes()),
            force_rules: self.force_rules.as_ref().map(|rules| rules.to_bytes()),
            history: self.history.clone(),
            rows,
            extremes: self.extremes.iter().map(extreme).collect(),
            due: [self.next_sample, self.next_frame],
            reported_until: self.reported_until,
            crossing_reported: self.crossing_reported,
        })
    }

    /// Take what observers of the same scene held; the rows of the series, which are written later.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<Vec<Vec<f64>>, StateError> {
        let stored: Stored = decode("the observers", bytes)?;
        self.gauges.restore_bytes(&stored.gauges)?;
        self.results.restore_bytes(&stored.results)?;
        let parts = [self.similarity.is_some(), self.force_rules.is_some()].map(usize::from);
        expect_count("similarity windows", usize::from(stored.similarity.is_some()), parts[0])?;
        expect_count("observers of force rules", usize::from(stored.force_rules.is_some()), parts[1])?;
        if let Some((window, bytes)) = self.similarity.as_mut().zip(stored.similarity) {
            window.restore_bytes(&bytes)?;
        }
        if let Some((rules, bytes)) = self.force_rules.as_mut().zip(stored.force_rules) {
            rules.restore_bytes(&bytes)?;
        }
        for row in &stored.rows {
            expect_count("columns of the series", row.len(), self.series.columns().len())?;
        }
        let peak = |(name, value, time_s): (String, f64, f64)| (name, Peak { value, time_s, verdict: None });
        self.extremes = stored.extremes.into_iter().map(peak).collect();
        [self.next_sample, self.next_frame] = stored.due;
        self.history = stored.history;
        (self.reported_until, self.crossing_reported) = (stored.reported_until, stored.crossing_reported);
        Ok(stored.rows)
    }

    /// Take the rows of the series; with a `path`, a new file is written next to it and replaces it.
    pub fn restore_series(&mut self, rows: Vec<Vec<f64>>, path: Option<&Path>) -> Result<(), ObserveError> {
        let part = path.map(|path| path.with_extension("csv.part"));
        self.series.restore(rows, part.as_deref())?;
        let Some((path, part)) = path.zip(part) else { return Ok(()) };
        std::fs::rename(part, path).map_err(|source| ObserveError::Io(path.display().to_string(), source))
    }
}
