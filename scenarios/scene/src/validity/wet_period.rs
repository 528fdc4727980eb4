//! The first wet period of a scene's panels bounds the step of a projection (THEORY CO33).

use std::f64::consts::PI;

use fsi_coupling::first_wet_period;
use settings::significant;
use sph_core::Solver;

use super::exchange::wet_faces;
use crate::keys::{MODES, Modes, Panel, Scene, line};

/// Steps in the first wet period with which the step costs the frequency at most 0.25 % (CO33).
const STEPS_PER_PERIOD: f64 = 30.0;

/// The water's sound resonates in a basin whose depth is above this share of its wave length at a panel's first wet period [-].
const RESONANT: f64 = 1.0 / std::f64::consts::TAU;

/// CO33: the first wet periods of what bends in a scene with incompressible water [s], by name.
fn resolved_periods(scene: &Scene) -> Vec<(&str, f64)> {
    let resolved = matches!(scene.solver.kind(), Solver::Incompressible | Solver::IncompressibleExplicit);
    if resolved { wet_periods(scene) } else { Vec::new() }
}

/// CO33: the first wet periods of a scene's panels, or of its modes [s], by name.
fn wet_periods(scene: &Scene) -> Vec<(&str, f64)> {
    let Some(body) = &scene.body else { return Vec::new() };
    let (line, water) = (line(&body.shape), (wet_faces(body), scene.water().density));
    // a panel without a period cannot be built, which the build reports
    let of = |panel: &Panel| first_wet_period(&line, &panel.spec(), water).ok();
    let modal = body.modal.as_ref().map(|modal| (MODES, modal_wet_period(modal, water)));
    body.panels.iter().filter_map(|panel| Some((&panel.name[..], of(panel)?))).chain(modal).collect()
}

/// CO33 of the lowest mode: added mass ρ/k ∫ (φ·n)² ds with k = π/L of the whole length, on this number of faces of the surface in water of a
/// density [kg/m³].
fn modal_wet_period(modal: &Modes, (faces, density): (f64, f64)) -> f64 {
    let lowest = modal.modes.iter().min_by(|a, b| a.frequency.total_cmp(&b.frequency));
    let Some(mode) = lowest else { return f64::INFINITY };
    let (mut length, mut across) = (0.0, 0.0);
    for (ends, shape) in modal.nodes.windows(2).zip(mode.shape.windows(2)) {
        let [x, y] = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let piece = x.hypot(y);
        let normal = |[u, v, _]: [f64; 3]| (u * y - v * x) / piece;
        length += piece;
        across += 0.5 * piece * (normal(shape[0]).powi(2) + normal(shape[1]).powi(2));
    }
    let added = faces * density * length / PI * across;
    (1.0 + added / mode.mass).sqrt() / mode.frequency
}

/// CO33: the longest automatic step [s]; infinite without panels in incompressible water.
pub fn longest_step(scene: &Scene) -> f64 {
    resolved_periods(scene).iter().map(|(_, period)| period / STEPS_PER_PERIOD).fold(f64::INFINITY, f64::min)
}

/// Panels, by name, that vibrate with the sound of the water above them, and why their loads are not those of real water: in a basin
/// that a body does not enter from the air.
pub fn resonant_panels(scene: &Scene) -> Vec<(String, String)> {
    if scene.solver.kind() != Solver::WeaklyCompressible || !scene.entries().is_empty() {
        return Vec::new();
    }
    let (sound, depth) = (scene.sound_speed(), scene.tank.depth);
    let resonates = |period: &f64| depth > RESONANT * sound * period;
    wet_periods(scene)
        .into_iter()
        .filter(|(_, period)| resonates(period))
        .map(|(name, period)| {
            let why = format!(
                "its first wet period, about {} s, is short beside the {} s in which the numerical sound crosses the water: use solver \
                 = incompressible, or a fluid.sound_speed of {} m/s",
                significant(period),
                significant(depth / sound),
                significant(depth / (0.5 * RESONANT * period))
            );
            (name.to_string(), why)
        })
        .collect()
}

/// Panels whose vibration a fixed step does not resolve.
pub(crate) fn unresolved_panels(scene: &Scene) -> Vec<String> {
    let Some(step) = scene.time.step else { return Vec::new() };
    let coarse =
        resolved_periods(scene).into_iter().filter(|(_, period)| step * STEPS_PER_PERIOD > *period * (1.0 + 1e-9));
    coarse
        .map(|(name, period)| {
            format!(
                "time.step = {step} s is {} of {}'s first wet period, about {} s: at a tenth its frequency was 2.5 % low, at a \
                 third 23 %; {} s would do, or no time.step",
                significant(step / period),
                name,
                significant(period),
                significant(period / STEPS_PER_PERIOD)
            )
        })
        .collect()
}
