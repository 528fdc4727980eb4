//! The length of an advective step (THEORY WC25).

use serde::{Deserialize, Serialize};

/// Largest |v_a − v_b| Δt/h of neighbours in an advective step [-].
const STRAIN: f64 = 0.2;
/// Largest Δt √(p/ρ)/Δx [-]: under pressure, disorder of the lattice swings with about that frequency.
const SQUEEZE: f64 = 1.0;

/// An advective step, and how much of it has passed.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct AdvectiveStep {
    length: f64,
    /// How much of it has passed [s].
    pub elapsed: f64,
    /// Acoustic steps that have passed.
    pub passed: u32,
    /// True for every second one.
    pub even: bool,
}

impl AdvectiveStep {
    /// The next: of as many acoustic steps of `dt` [s] as fit in `longest` [s], at most `most` and at least one.
    pub fn next(self, dt: f64, longest: f64, most: u32) -> AdvectiveStep {
        let steps = (longest / dt).floor().clamp(1.0, f64::from(most.max(1)));
        AdvectiveStep { length: steps * dt, elapsed: 0.0, passed: 0, even: !self.even }
    }

    /// Its length [s].
    pub fn length(self) -> f64 {
        self.length
    }

    /// True if an acoustic step of `dt` [s] does not belong to it any more, for the most part.
    pub fn is_over(self, dt: f64) -> bool {
        self.elapsed + 0.5 * dt > self.length
    }

    /// An acoustic step of `dt` [s] has passed.
    pub fn elapse(&mut self, dt: f64) {
        self.elapsed += dt;
        self.passed += 1;
    }
}

/// The longest advective step [s] at a largest |v_a − v_b|/h of `strain` [1/s] and a largest √(p/ρ)/Δx of `squeeze` [1/s].
pub(super) fn longest(strain: f64, squeeze: f64) -> f64 {
    (STRAIN / strain).min(SQUEEZE / squeeze)
}
