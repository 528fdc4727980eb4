//! Masses on springs that stand on a rigid body: seats, equipment, engines (THEORY CO35).

use serde::{Deserialize, Serialize};

/// A mass that moves upright over a body, on a spring and a damper; everything per metre of span.
#[derive(Clone, Debug, PartialEq)]
pub struct SprungSpec {
    /// Name, as in output columns.
    pub name: String,
    /// Mass [kg/m].
    pub mass: f64,
    /// Stiffness of the spring [N/m per m].
    pub stiffness: f64,
    /// Coefficient of the damper [N s/m per m].
    pub damping: f64,
}

/// What a sprung mass reports.
#[derive(Clone, Debug, PartialEq)]
pub struct SprungState {
    /// Name, as in output columns.
    pub name: String,
    /// Height above its place on the unloaded spring [m].
    pub extension: f64,
    /// Upward acceleration in space [m/s²].
    pub acceleration: f64,
}

/// Motion relative to the body.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Sprung {
    /// Height above its place on the unloaded spring [m].
    pub extension: f64,
    /// Upward velocity in space [m/s].
    pub velocity: f64,
    /// Energy that the damper took [J/m].
    pub dissipated: f64,
}

/// Longest step over 1/ω of a mass on its spring [-]: at 2 kick and drift go unstable.
const LONGEST_STEP: f64 = 0.5;

impl SprungSpec {
    /// Force down on the mass, up on the body [N/m], at the body's upward velocity [m/s].
    pub(super) fn force(&self, now: &Sprung, of_body: f64) -> f64 {
        self.stiffness * now.extension + self.damping * (now.velocity - of_body)
    }

    /// Upward acceleration of the mass [m/s²] under a force of the spring [N/m] and gravity [m/s²].
    pub(super) fn acceleration(&self, force: f64, gravity: f64) -> f64 {
        gravity - force / self.mass
    }

    /// CO35: longest step [s] on a body of a mass [kg/m].
    pub fn longest_step(&self, of_body: f64) -> f64 {
        let reduced = self.mass * of_body / (self.mass + of_body);
        LONGEST_STEP * (reduced / self.stiffness).sqrt().min(reduced / self.damping)
    }
}
