//! A step whose pressure equation does not converge is repeated shorter.

use sph_core::Breakdown;

use crate::coupling::coupled::Coupled;
use crate::coupling::error::CouplingError;

/// Times that a step is halved before the run fails.
const MOST_RETRIES: u32 = 3;

impl Coupled {
    /// CO26: one step of `dt` [s], or of a half, a quarter, an eighth of it where the pressure equation of the projection
    /// ([`Breakdown::Projection`]) does not converge; returns the step taken [s]. The equation is solved before anything
    /// moves, and bodies are placed anew for each attempt, so that a shorter step starts from the same state.
    pub fn step_or_shorter(&mut self, dt: f64) -> Result<f64, CouplingError> {
        let mut shorter = dt;
        for _ in 0..MOST_RETRIES {
            match self.step(shorter) {
                Err(CouplingError::Fluid(Breakdown::Projection { .. })) => shorter *= 0.5,
                ended => return ended.map(|()| shorter),
            }
        }
        self.step(shorter).map(|()| shorter)
    }
}
