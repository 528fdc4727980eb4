//! Measured points of other programs: `scenarios/cases/peers`.

use std::collections::BTreeMap;

use include_dir::{Dir, include_dir};
use scene::embedded;
use serde::Deserialize;

use super::case::Reading;
use crate::experiments::ExperimentError;

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/cases/peers");

/// A program's runs of a charted case.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Peer {
    /// Its name and version.
    pub name: String,
    /// Name of the charted case.
    pub case: String,
    /// Provenance of the measurement.
    pub provenance: String,
    pub point: Vec<PeerPoint>,
}

/// A run of another program.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PeerPoint {
    pub at: String,
    pub particles: usize,
    pub steps: u64,
    /// Wall-clock time × threads [s].
    pub core_seconds: f64,
    /// Results, by quantity of the case.
    pub gave: BTreeMap<String, Given>,
}

/// A number of another program.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum Given {
    /// Relative difference from the reference, and standard deviation over it [-].
    Error { bias: f64, scatter: f64 },
    /// A reading with an uncertain interpretation: least and largest value.
    Range { least: f64, largest: f64 },
}

impl Given {
    /// As a reading; of a range, its middle with half its width as the scatter.
    pub fn reading(self, reference: f64) -> Reading {
        match self {
            Given::Error { bias, scatter } => Reading::new(reference * (1.0 + bias), bias, scatter),
            Given::Range { least, largest } => {
                let middle = 0.5 * (least + largest);
                Reading::new(middle, middle / reference - 1.0, 0.5 * (largest - least) / reference.abs())
            }
        }
    }
}

/// The programs that ran a case.
///
/// # Errors
/// A file is wrong.
pub(super) fn peers(case: &str) -> Result<Vec<Peer>, ExperimentError> {
    let wrong = |(name, why)| ExperimentError::Case(format!("chart of another program `{name}`: {why}"));
    let all: Vec<(String, Peer)> = embedded::contents(&FILES).map_err(wrong)?;
    Ok(all.into_iter().map(|(_, peer)| peer).filter(|peer| peer.case == case).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::work_precision::CHARTS;

    #[test]
    fn every_peer_ran_a_charted_case_and_its_quantities() {
        let cases = CHARTS.all().expect("they parse");
        let all: Vec<(String, Peer)> = embedded::contents(&FILES).expect("they parse");
        assert!(!all.is_empty());
        for (file, peer) in all {
            let case = cases.iter().find(|c| c.name == peer.case).unwrap_or_else(|| panic!("{file}: {}", peer.case));
            for given in peer.point.iter().flat_map(|p| p.gave.keys()) {
                assert!(case.quantity.iter().any(|q| q.name == *given && q.reference.is_some()), "{file}: {given}");
            }
        }
    }

    #[test]
    fn a_range_is_its_middle_and_half_its_width() {
        let reading = Given::Range { least: 8.0, largest: 10.0 }.reading(10.0);
        assert!((reading.bias + 0.1).abs() < 1e-12 && (reading.scatter - 0.1).abs() < 1e-12, "{reading:?}");
    }
}
