//! Error bars of the numbers of a run.
//!
//! # Example
//! ```
//! use run::error_bar::ErrorBar;
//!
//! let (verdict, method) = ("converged".to_string(), "convergence study".to_string());
//! let bar = ErrorBar { value: 1.2, extrapolated: Some(1.0), band: 0.1, order: Some(1.0), verdict, method };
//! assert!(bar.holds(1.05) && !bar.holds(1.2));
//! ```

use std::collections::BTreeMap;

use serde::Serialize;

/// A number of `summary.json` with its band.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorBar {
    /// The run's own.
    pub value: f64,
    /// The extrapolated value of a convergence study; absent without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extrapolated: Option<f64>,
    /// Half width about the extrapolated value, or else about the run's own, in the number's unit.
    pub band: f64,
    /// Observed order [-]; absent where none was observed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order: Option<f64>,
    /// "converged", or "not converged" and why; of a charted band, its probability.
    pub verdict: String,
    /// How the band was found.
    pub method: String,
}

/// Error bars, by path in `summary.json`.
pub type ErrorBars = BTreeMap<String, ErrorBar>;

impl ErrorBar {
    /// The middle of the band.
    pub fn middle(&self) -> f64 {
        self.extrapolated.unwrap_or(self.value)
    }

    /// True where the band holds a value.
    pub fn holds(&self, value: f64) -> bool {
        (self.middle() - value).abs() <= self.band
    }
}
