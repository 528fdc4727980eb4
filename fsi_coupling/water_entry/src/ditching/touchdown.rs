//! Where on the swell an aeroplane first touches (THEORY EN38).

use std::f64::consts::{PI, TAU};

use super::attitude::Attitude;
use super::landing::Landing;
use super::swell::Swell;

/// Largest difference between the phase at the first contact and the given one [rad].
const CLOSE: f64 = PI / 180.0;
/// Phases tried for the nearest one at which a part of the aeroplane touches first.
const TRIED: usize = 720;
/// Times for each period of encounter at which a straight flight path is looked at, and most of them.
const TIMES: f64 = 200.0;
const MOST_TIMES: f64 = 20_000.0;

/// The first contact with the water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touchdown {
    /// Place of the contact, from the nose [m].
    pub x: f64,
    /// Phase of the swell there ([`Swell::phase_at`]) [rad].
    pub phase: f64,
    /// Height of the water there over still water [m].
    pub elevation: f64,
    /// Speed at which aeroplane and surface approach there [m/s].
    pub closing_speed: f64,
}

impl Landing<'_> {
    /// EN38: the swell whose phase at the first contact is as given [rad].
    ///
    /// # Errors
    /// No part of the aeroplane touches first at such a phase: the nearest phase at which one does [rad].
    pub fn swell_touched_at(&self, phase: f64) -> Result<Swell, f64> {
        let places = self.places_at_start();
        let touched = |[x, _]: [f64; 2]| Landing { swell: self.swell.with_phase_at(x, phase), ..self.clone() };
        // a place is first where all others are further above the surface: it must be as deep as the deepest of the others
        let depth = |place: &[f64; 2]| {
            let swell = self.swell.with_phase_at(place[0], phase);
            let height = |p: &[f64; 2]| p[1] - swell.water(p[0]).elevation;
            height(place) - places.iter().map(height).fold(f64::INFINITY, f64::min)
        };
        let first = places.iter().min_by(|a, b| depth(a).total_cmp(&depth(b)));
        let landing = first.map(|place| touched(*place)).filter(|l| apart(l.touchdown().phase, phase) <= CLOSE);
        landing.map(|landing| landing.swell).ok_or_else(|| self.nearest_phase(phase))
    }

    /// EN59: the waves of a spectrum as they are when a straight flight path first meets them.
    pub fn swell_first_met(&self) -> Swell {
        let start = self.start();
        let mut swell = self.swell;
        // each earlier contact puts the aeroplane at another height over the waves there
        for _ in 0..8 {
            let now = Landing { swell, ..self.clone() };
            let Some(time) = now.earlier_contact() else { break };
            swell = swell.later(-time).seen_from(-time * start.rate[0]);
        }
        swell
    }

    /// The nearest phase to the given one at which a part of the aeroplane touches first [rad].
    fn nearest_phase(&self, wanted: f64) -> f64 {
        let of_origin = |k: usize| self.swell.with_phase_at(0.0, TAU * k as f64 / TRIED as f64);
        let phases = (0..TRIED).map(|k| Landing { swell: of_origin(k), ..self.clone() }.touchdown().phase);
        phases.min_by(|a, b| apart(*a, wanted).total_cmp(&apart(*b, wanted))).unwrap_or(wanted)
    }

    /// Places that may touch first, at the start: ahead of x = 0 and over the centre of mass [m].
    fn places_at_start(&self) -> Vec<[f64; 2]> {
        let attitude = Attitude { place: [0.0, 0.0, self.pitch], ..Attitude::default() };
        self.lowest_places().into_iter().map(|place| attitude.of_point(self.aeroplane.centre, place)).collect()
    }

    /// The first contact of this landing.
    pub fn touchdown(&self) -> Touchdown {
        let height = |[x, z]: [f64; 2]| z - self.swell.water(x).elevation;
        let places = self.lowest_places().into_iter().zip(self.places_at_start());
        let first = places.min_by(|(_, a), (_, b)| height(*a).total_cmp(&height(*b)));
        let [from_nose, x] = first.map_or([0.0; 2], |(place, at)| [place[0], at[0]]);
        let (sin, cos) = self.path.sin_cos();
        let [forward, up] = [self.speed * cos, self.speed * sin];
        let rises = self.swell.water(x).velocity[1] + self.swell.slope(x) * (forward - self.swell.water(x).velocity[0]);
        Touchdown {
            x: from_nose,
            phase: self.swell.phase_at(x),
            elevation: self.swell.water(x).elevation,
            closing_speed: rises - up,
        }
    }

    /// Time before the start at which the aeroplane would first have met the water on a straight flight path [s]; `None`: at no time.
    pub fn earlier_contact(&self) -> Option<f64> {
        let start = self.start();
        let sinking = -start.rate[1];
        let height = 2.0 * self.swell.amplitude;
        if height <= 0.0 || sinking <= 0.0 {
            return None;
        }
        let clear = height / sinking; // before that it is above all crests
        let period = TAU / self.swell.encounter_frequency(start.rate[0]).abs();
        let count = (clear / period * TIMES).clamp(TIMES, MOST_TIMES) as usize;
        let before = (1..=count).rev().map(|k| clear * k as f64 / count as f64);
        let is_wet = |time: &f64| {
            let mut then = start;
            (0..3).for_each(|k| then.place[k] -= time * then.rate[k]);
            self.clearance(&then, &self.swell.later(-time)) < -1e-3 * height
        };
        before.into_iter().find(is_wet)
    }
}

/// Angle between two phases [rad].
fn apart(a: f64, b: f64) -> f64 {
    let turn = (a - b).rem_euclid(TAU);
    turn.min(TAU - turn)
}
