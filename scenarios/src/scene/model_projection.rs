//! The projection of a resolved scene.

use serde::Serialize;
use sph_core::projection::Settings;

/// What a scene chooses of the projection that gives the pressures (THEORY I1–I16).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Projection {
    /// Residual that ends the iteration, over the largest right-hand side [-].
    pub tolerance: f64,
    /// Iterations after which a solve has failed.
    pub most_iterations: usize,
    /// Time in which an error of density relaxes, over h/U (I9) [-].
    pub relaxation: f64,
    /// Viscosity over h √(|g| h) (I12) [-].
    pub calming: f64,
    /// Shift over the distance moved in a step, times 2h∇C (I13) [-].
    pub shift: f64,
}

impl Projection {
    /// As the fluid takes it.
    pub fn settings(self) -> Settings {
        self.over(Settings::default())
    }

    fn over(self, mut settings: Settings) -> Settings {
        settings.tolerance = self.tolerance;
        settings.most_iterations = self.most_iterations;
        settings.relaxation = self.relaxation;
        settings.viscosity_coefficient = self.calming;
        settings.shift = self.shift;
        settings
    }
}

impl From<Settings> for Projection {
    fn from(settings: Settings) -> Projection {
        let Settings { tolerance, most_iterations, relaxation, viscosity_coefficient: calming, shift, .. } = settings;
        Projection { tolerance, most_iterations, relaxation, calming, shift }
    }
}
