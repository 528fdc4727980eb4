//! Mass, momentum, energy and volume of the fluid (THEORY CO27, CO28).

use serde::{Deserialize, Serialize};

/// Energies of the fluid per metre of span [J/m].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FluidEnergy {
    /// Σ ½ m v².
    pub kinetic: f64,
    /// −Σ m g·r.
    pub potential: f64,
    /// Σ m ∫ p/ρ² dρ (CO28); of a gas Σ m (e − e₀ + p₀/ρ − p₀/ρ₀), heat included (LE12).
    pub elastic: f64,
}

impl FluidEnergy {
    /// Sum of all three [J/m].
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential + self.elastic
    }
}

/// Totals of the fluid at one time, per metre of span; with a mirror plane, of both halves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals {
    /// Σ m [kg/m].
    pub mass: f64,
    /// Σ m v [N s/m].
    pub momentum: [f64; 2],
    /// Energies [J/m].
    pub energy: FluidEnergy,
    /// Σ m/ρ [m²].
    pub volume: f64,
    /// Σ m y/Σ m [m].
    pub height: f64,
    /// Fastest particle [m/s].
    pub top_speed: f64,
}
