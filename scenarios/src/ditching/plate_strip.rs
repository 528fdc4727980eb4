//! A bay of plating as a strip of plate: its stress at rest and its slowest period (THEORY EN64).

use std::f64::consts::{PI, TAU};

use fsi_coupling::PanelEnd;

use super::plating_keys::{Bay, PlateEnd, PlateMaterial, PlatingKeys};

/// Largest mass of the water that moves with a bay, over that of water as deep as the bay is long [-].
const WATER: f64 = 0.5;

/// EN64: largest stress of a plate strip of a length [m] under a pressure [Pa]; a mirrored one is twice as long.
pub(super) fn static_stress(keys: &PlatingKeys, bay: &Bay, length: f64, pressure: f64) -> f64 {
    let span = span(bay, length);
    let of_moment = match keys.ends {
        PlateEnd::Clamped => 0.5,
        PlateEnd::Pinned => 0.75,
    };
    of_moment * pressure * (span / keys.thickness).powi(2)
}

/// The longest period of the first mode of a bay of a length [m] with the water below it [s].
pub(super) fn wet_period(keys: &PlatingKeys, plate: &PlateMaterial, bay: &Bay, length: f64, water: f64) -> f64 {
    let span = span(bay, length);
    let bending = plate.youngs_modulus * keys.thickness.powi(3) / (12.0 * (1.0 - plate.poissons_ratio.powi(2)));
    let root = match keys.ends {
        PlateEnd::Clamped => 4.73,
        PlateEnd::Pinned => PI,
    };
    let mass = plate.density * keys.thickness + WATER * water * span;
    TAU * (span / root).powi(2) * (mass / bending).sqrt()
}

/// Length between the supports of a bay of a length on one side [m].
fn span(bay: &Bay, length: f64) -> f64 {
    if bay.ends[0] == PanelEnd::Mirror { 2.0 * length } else { length }
}
