//! Control of Newton's method in a time step.

/// The tangent is kept while each correction is smaller than this fraction of the one before \[-\].
const CONTRACTING: f64 = 0.03;

/// Maximum number of corrections from one predictor.
pub(super) const ITERATIONS: usize = 40;

/// Modified Newton: the tangent of the predictor serves all corrections while they contract fast.
pub(super) struct NewtonControl {
    last: f64,
    /// Whether the next correction needs a new tangent.
    pub update_tangent: bool,
}

impl NewtonControl {
    pub fn new() -> Self {
        Self { last: f64::INFINITY, update_tangent: true }
    }

    /// Size of a correction as a fraction of the one before; none for the first.
    pub fn contraction(&self, size: f64) -> Option<f64> {
        self.last.is_finite().then_some(size / self.last)
    }

    /// Accepts a correction of this size.
    pub fn accept(&mut self, size: f64) {
        self.update_tangent = self.contraction(size).is_some_and(|ratio| ratio > CONTRACTING);
        self.last = size;
    }
}
