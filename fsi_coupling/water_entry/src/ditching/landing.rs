//! A landing: what it begins with, and what it is at a moment.

use super::aeroplane::{Aeroplane, Water};
use super::attitude::{Attitude, FREEDOMS};
use super::hull::Hull;
use super::parts::PointForce;
use super::strip::Strip;
use super::swell::Swell;

/// A landing: from the first touch to the end.
#[derive(Clone, Debug)]
pub struct Landing<'a> {
    /// What the water meets.
    pub hull: &'a Hull,
    /// What lands.
    pub aeroplane: Aeroplane,
    /// The water.
    pub water: Water,
    /// Its swell at the first touch; x = 0 is below the centre of mass then.
    pub swell: Swell,
    /// Pitch at the first touch, nose up [rad].
    pub pitch: f64,
    /// Direction of flight then, upwards [rad].
    pub path: f64,
    /// Speed along it [m/s].
    pub speed: f64,
    /// Number of strips along the fuselage.
    pub strips: usize,
    /// Length of a step [s].
    pub step: f64,
    /// Steps between samples.
    pub sample_every: usize,
    /// End of time [s].
    pub end: f64,
    /// The run ends below this forward speed [m/s].
    pub least_speed: f64,
}

/// The landing at a moment.
#[derive(Clone, Debug, PartialEq)]
pub struct LandingState {
    /// Time since the first touch [s].
    pub time: f64,
    /// Where it is and how it moves.
    pub attitude: Attitude,
    /// Accelerations forward and up [m/s²], in pitch [rad/s²] and of the bending modes [m/s²].
    pub acceleration: [f64; FREEDOMS],
    /// Force of the water forward and up [N], and its moment about the centre of mass, nose up [N m].
    pub force: [f64; 3],
    /// Lift of the wing [N].
    pub lift: f64,
    /// Foremost and aftmost wet place, from the nose [m]; `None` in the air.
    pub wetted: Option<[f64; 2]>,
    /// The strips that are wet, and the force of each on the keel line [N]: pressure of entry, without buoyancy.
    pub strips: Vec<(Strip, f64)>,
    /// Forces of the water on each surface, then on each nacelle's face and bottom, then on frames behind panels; of each strut that on the fuselage.
    pub parts: Vec<Vec<PointForce>>,
    /// Which of them have been lost up to now.
    pub lost: Vec<bool>,
}

/// Motion of a landing at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlightMoment {
    /// Time since the first touch [s].
    pub time: f64,
    /// Where it is and how it moves.
    pub attitude: Attitude,
    /// As of [`LandingState`].
    pub acceleration: [f64; FREEDOMS],
}

/// Why a landing ended.
#[derive(Clone, Debug, PartialEq)]
pub enum LandingEnd {
    /// The time was up.
    Time,
    /// Its speed fell below `least_speed`.
    Slow,
    /// It left the water for good: what happened.
    Aloft(String),
    /// The motion left what strips can describe: what happened.
    OutOfRange(String),
}

/// A landing that was followed.
#[derive(Clone, Debug)]
pub struct LandingResult {
    /// Samples, the first at the first touch, the last at the end.
    pub moments: Vec<LandingState>,
    /// Its motion at the start of each step.
    pub flight: Vec<FlightMoment>,
    /// Why it ended.
    pub ended: LandingEnd,
}

impl Landing<'_> {
    /// Ends of the strips, from the nose [m]: stations and ends of panels are among them.
    pub(super) fn edges(&self) -> Vec<f64> {
        let fuselage = self.hull.fuselage();
        let of_panels = self.aeroplane.panels.iter().flat_map(|panel| panel.ends);
        let mut joints: Vec<f64> = fuselage.stations().iter().map(|s| s.x).chain(of_panels).collect();
        joints.sort_by(f64::total_cmp);
        joints.dedup();
        let mut edges = vec![joints[0]];
        for pair in joints.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let n = (self.strips as f64 * (to - from) / fuselage.length()).ceil().max(1.0);
            edges.extend((1..=n as usize).map(|k| from + (to - from) * k as f64 / n));
        }
        edges
    }
}
