//! Work of the fluid on a body, compared on both sides of the interface (THEORY CO17).

use std::ops::Range;

use sph_core::Walls;

/// Work of the fluid on a body as the fluid does it, Σ Δt F̄·V over the boundary particles, and as the body takes it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorkAudit {
    /// Done by the fluid since the start [J/m].
    pub given: f64,
    /// Taken by the body since the start [J/m].
    pub received: f64,
    /// Σ of the steps' work by magnitude [J/m].
    pub exchanged: f64,
}

impl WorkAudit {
    /// Add the work of a step on the particles of a body, and the work of contact impulses [J/m].
    pub(crate) fn record(&mut self, walls: &Walls, range: Range<usize>, dt: f64, halves: f64, contact: f64) {
        let power = |k: usize| walls.mean_fx[k] * walls.u[k] + walls.mean_fy[k] * walls.v[k];
        let work = halves * dt * range.map(power).sum::<f64>() + contact;
        self.given += work;
        self.exchanged += work.abs();
    }

    /// Difference of both, over the work exchanged [-].
    pub fn residual(&self) -> f64 {
        if self.exchanged > 0.0 { (self.given - self.received).abs() / self.exchanged } else { 0.0 }
    }
}
