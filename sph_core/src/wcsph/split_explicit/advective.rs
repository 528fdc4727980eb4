//! The length of an advective step (THEORY WC25).

use serde::{Deserialize, Serialize};

/// Largest |v_a − v_b| Δt/h of neighbours in an advective step [-].
const STRAIN: f64 = 0.3;
/// Largest Δt √(p/ρ)/Δx [-]: under pressure, disorder of the lattice swings with about that frequency.
const SQUEEZE: f64 = 1.0;

/// Largest Δt ν/h² [-], as of WC12.
const VISCOUS: f64 = 0.125;

/// An advective step, and how much of it has passed.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct AdvectiveStep {
    length: f64,
    /// How much of it has passed [s].
    pub elapsed: f64,
    /// Acoustic steps that it has.
    steps: f64,
}

impl AdvectiveStep {
    /// Of as many acoustic steps of `dt` [s] as fit in `longest` [s], at most `most` and at least one.
    pub fn new(dt: f64, longest: f64, most: u32) -> AdvectiveStep {
        let steps = (longest / dt).floor().clamp(1.0, f64::from(most.max(1)));
        AdvectiveStep { length: steps * dt, elapsed: 0.0, steps }
    }

    /// Its length [s].
    pub fn length(self) -> f64 {
        self.length
    }

    /// Its length [s] and its acoustic steps.
    pub fn span(self) -> (f64, f64) {
        (self.length, self.steps)
    }

    /// The length of its next acoustic step [s]; `None` where it is over.
    pub fn acoustic_step(self) -> Option<f64> {
        let dt = self.length / self.steps.max(1.0);
        (dt > 0.0 && !self.is_over(dt)).then_some(dt)
    }

    /// The time `later` [s], less that of its middle, in which the geometry is held [s].
    pub fn after_middle(self, later: f64) -> f64 {
        self.elapsed + later - 0.5 * self.length
    }

    /// True if an acoustic step of `dt` [s] does not belong to it any more, for the most part.
    pub fn is_over(self, dt: f64) -> bool {
        self.elapsed + 0.5 * dt > self.length
    }

    /// An acoustic step of `dt` [s] has passed.
    pub fn elapse(&mut self, dt: f64) {
        self.elapsed += dt;
    }
}

/// The longest advective step [s] at a largest |v_a − v_b|/h of `strain` [1/s], a largest √(p/ρ)/Δx of `squeeze` [1/s] and a smallest h²/ν of
/// `diffusion` [s], artificial viscosity included.
pub(super) fn longest(strain: f64, squeeze: f64, diffusion: f64) -> f64 {
    (STRAIN / strain).min(SQUEEZE / squeeze).min(VISCOUS * diffusion)
}
