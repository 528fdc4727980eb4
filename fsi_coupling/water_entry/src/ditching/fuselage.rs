//! The wetted bottom of a fuselage: keel line, breadth and form of the sections along it.

use serde::{Deserialize, Serialize};

use super::form::Form;
use super::loft::Loft;
use super::monotone::Monotone;
use crate::{EntryModel, OutOfRange, Section};

/// Models for the sections of a landing.
pub const OF_LANDINGS: [EntryModel; 3] = [EntryModel::VonKarman, EntryModel::Wagner, EntryModel::Mlm];

/// A section outside the range of a model, with the model of a landing that holds for it, where there is one.
pub(super) fn outside(refused: &OutOfRange, section: Option<&Section>) -> String {
    let OutOfRange { what, range, .. } = refused;
    let able = |model: &EntryModel| section.is_some_and(|section| model.covers(section, f64::INFINITY).is_ok());
    let advice = match OF_LANDINGS.into_iter().find(able) {
        Some(model) => format!("model = \"{}\" holds for it", model.name()),
        None => "no model of a landing holds for it".to_string(),
    };
    format!("expected {range}, not {what}: {advice}")
}

/// Steepest angle between keel line and body axis [deg]: steeper ones are no slender body's.
const STEEPEST_KEEL_DEG: f64 = 60.0;

/// A section at its place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Station {
    /// Distance from the nose along the body axis [m].
    pub x: f64,
    /// Height of the keel over the body axis [m].
    pub keel: f64,
    /// Breadth between the edges that the water leaves [m].
    pub breadth: f64,
    /// Shape between them.
    #[serde(flatten)]
    pub form: Form,
}

/// The keel at a place: height over the body axis [m], its slope [-] and its curvature [1/m] against the distance from the nose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keel {
    /// Height [m].
    pub height: f64,
    /// dz/dx [-].
    pub slope: f64,
    /// d²z/dx² [1/m].
    pub bend: f64,
}

/// A fuselage: stations, joined smoothly.
#[derive(Clone, Debug, PartialEq)]
pub struct Fuselage {
    stations: Vec<Station>,
    keel: Monotone,
    breadth: Monotone,
    /// Bottoms between stations, where one of them has an outline.
    loft: Option<Loft>,
}

/// A fuselage that cannot be: which station (from 0), and why.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("station {station}: {why}")]
pub struct FuselageError {
    /// Index of the station.
    pub station: usize,
    /// What is wrong with it, and what was expected.
    pub why: String,
}

impl Fuselage {
    /// Stations from the nose aft; keel and breadth between them follow monotone cubics.
    ///
    /// # Errors
    /// Stations out of order, breadths that are none, sections that are not convex, a keel too steep for a slender body.
    pub fn new(stations: &[Station]) -> Result<Fuselage, FuselageError> {
        let refuse = |station: usize, why: String| Err(FuselageError { station, why });
        if stations.len() < 2 {
            return refuse(0, "expected at least two stations".into());
        }
        for (k, s) in stations.iter().enumerate() {
            if ![s.x, s.keel, s.breadth].iter().all(|v| v.is_finite()) || s.breadth <= 0.0 {
                return refuse(k, format!("breadth {} m: expected finite numbers, the breadth above 0", s.breadth));
            }
            if k > 0 && s.x <= stations[k - 1].x {
                return refuse(k, format!("x = {} m: expected more than the {} m before", s.x, stations[k - 1].x));
            }
            match &s.form {
                Form::Radius(r) if !(*r >= 0.5 * s.breadth && r.is_finite()) => {
                    return refuse(
                        k,
                        format!("radius {r} m: expected at least half the breadth, {} m", 0.5 * s.breadth),
                    );
                }
                form => form.section(s.breadth).map_err(|e| FuselageError { station: k, why: outside(&e, None) })?,
            };
        }
        let curve = |of: fn(&Station) -> f64| {
            Monotone::through(stations.iter().map(|s| s.x).collect(), stations.iter().map(of).collect())
        };
        let (keel, breadth) = (curve(|s| s.keel), curve(|s| s.breadth));
        let steepest = STEEPEST_KEEL_DEG.to_radians().tan();
        if let Some(k) = stations.iter().position(|s| keel.at(s.x)[1].abs() > steepest) {
            let angle = keel.at(stations[k].x)[1].atan().to_degrees();
            return refuse(k, format!("a keel at {angle:.1} degrees to the axis: expected up to {STEEPEST_KEEL_DEG}"));
        }
        let loft = stations.iter().any(|s| s.form.is_outline()).then(|| {
            let line =
                |s: &Station| s.form.section(s.breadth).map(|section| section.corners().to_vec()).unwrap_or_default();
            Loft::new(stations.iter().map(|s| s.x).collect(), stations.iter().map(line).collect())
        });
        Ok(Fuselage { stations: stations.to_vec(), keel, breadth, loft })
    }

    /// EN54: the bottom between two stations, from the keel to the edge [m]; `None` where neither has an outline.
    pub(super) fn lofted(&self, x: f64) -> Option<Form> {
        let (k, _) = self.between(x);
        let is_lofted = self.stations[k].form.is_outline() || self.stations[k + 1].form.is_outline();
        self.loft.as_ref().filter(|_| is_lofted).map(|loft| Form::Outline(loft.at(k, x)))
    }

    /// The stations.
    pub fn stations(&self) -> &[Station] {
        &self.stations
    }

    /// First and last place [m].
    pub fn ends(&self) -> [f64; 2] {
        [self.stations[0].x, self.stations[self.stations.len() - 1].x]
    }

    /// Length [m].
    pub fn length(&self) -> f64 {
        let [from, to] = self.ends();
        to - from
    }

    /// The keel at a place [m from the nose].
    pub fn keel(&self, x: f64) -> Keel {
        let [height, slope, bend] = self.keel.at(x);
        Keel { height, slope, bend }
    }

    /// Breadth there [m]; beyond the ends that of the last station.
    pub fn breadth(&self, x: f64) -> f64 {
        let [from, to] = self.ends();
        self.breadth.at(x.clamp(from, to))[0]
    }

    /// Index of the station at or before a place, and the share of the way to the next [-].
    pub(super) fn between(&self, x: f64) -> (usize, f64) {
        let after = self.stations.partition_point(|s| s.x <= x).clamp(1, self.stations.len() - 1);
        let [a, b] = [self.stations[after - 1].x, self.stations[after].x];
        (after - 1, ((x - a) / (b - a)).clamp(0.0, 1.0))
    }
}
