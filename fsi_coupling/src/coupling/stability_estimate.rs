//! Stability of explicit coupling for a panel: an estimate before the run (THEORY CO12).

use serde::Serialize;

/// A panel and the water next to it, for weak coupling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beside {
    /// Mass of the panel per area ρ_s t [kg/m²].
    pub mass: f64,
    /// Faces that are wet: 1 or 2 [-].
    pub faces: f64,
    /// Density of the water [kg/m³].
    pub density: f64,
    /// Distance between particles at the panel [m].
    pub spacing: f64,
    /// Smoothing length over that distance [-].
    pub smoothing_ratio: f64,
    /// Speed of sound [m/s].
    pub sound_speed: f64,
    /// Step [s].
    pub dt: f64,
}

/// Growth of an error in a panel's acceleration under explicit coupling (THEORY CO12).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PanelExchange {
    /// μ: mass of the water whose pressure follows the acceleration within a step, over the panel's [-].
    pub added_mass: f64,
    /// Δt ρc/(2 ρ_s t): a sound wave's resistance over the panel's inertia in half a step [-]; unstable from 1 on.
    pub acoustic: f64,
    /// Spectral radius: explicit coupling is unstable from 1 on [-].
    pub spectral_radius: f64,
}

/// Added mass of a wall's layers over ρ h of a face, on a lattice: 0.405 to 0.385 for h/Δx = 1.5 to 2 with Wendland C2 [-].
const LAYERS: f64 = 0.4;

/// CO12: explicit coupling of a panel.
///
/// Without the panel's stiffness, which helps. Against runs of a clamped strip, C = 0.075 to 0.6, h/Δx = 1.5, Wendland C2: one
/// exchange breaks down at 0.95 to 1.1 of the spectral radius given here (CO12).
pub fn exchange_ratio(panel: &Beside) -> PanelExchange {
    let Beside { mass, faces, density, spacing, smoothing_ratio, sound_speed, dt } = *panel;
    let added_mass = faces * LAYERS * density * smoothing_ratio * spacing / mass;
    let acoustic = faces * dt * density * sound_speed / (2.0 * mass);
    let courant = sound_speed * dt / spacing;
    PanelExchange { added_mass, acoustic, spectral_radius: added_mass * (1.0 + courant * courant) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of 50 kg/m², 5 cm between particles, c Δt = 0.9 Δx.
    #[test]
    fn a_strip_has_its_layers_of_water() {
        let strip = Beside {
            mass: 50.0,
            faces: 1.0,
            density: 1000.0,
            spacing: 0.05,
            smoothing_ratio: 1.5,
            sound_speed: 30.0,
            dt: 0.0015,
        };
        let found = exchange_ratio(&strip);
        assert!((found.added_mass - 0.6).abs() < 1e-14 && (found.acoustic - 0.45).abs() < 1e-14, "{found:?}");
        assert!((found.spectral_radius - 0.6 * 1.81).abs() < 1e-14, "{found:?}");
        let both = exchange_ratio(&Beside { faces: 2.0, ..strip });
        assert!((both.spectral_radius - 2.0 * found.spectral_radius).abs() < 1e-14);
    }
}
