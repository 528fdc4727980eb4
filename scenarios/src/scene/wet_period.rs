//! The first wet period of a scene's panels bounds the step of a projection (THEORY CO33).

use fsi_coupling::first_wet_period;
use fsi_coupling::settings::significant;
use sph_core::Solver;

use super::exchange::wet_faces;
use super::settings::{Panel, Scene, line};

/// Steps in the first wet period with which the step costs the frequency at most 0.25 % (CO33).
const STEPS_PER_PERIOD: f64 = 30.0;

/// CO33: the first wet periods of the panels of a scene with incompressible water [s], by panel.
fn wet_periods(scene: &Scene) -> Vec<(&Panel, f64)> {
    let resolved = matches!(scene.solver.kind(), Solver::Incompressible | Solver::IncompressibleExplicit);
    let Some(body) = scene.body.as_ref().filter(|_| resolved) else { return Vec::new() };
    let (line, water) = (line(&body.shape), (wet_faces(body), scene.water().density));
    // a panel without a period cannot be built, which the build reports
    let of = |panel: &Panel| first_wet_period(&line, &panel.spec(), water).ok();
    body.panels.iter().filter_map(|panel| Some((panel, of(panel)?))).collect()
}

/// CO33: the longest automatic step [s]; infinite without panels in incompressible water.
pub fn longest_step(scene: &Scene) -> f64 {
    wet_periods(scene).iter().map(|(_, period)| period / STEPS_PER_PERIOD).fold(f64::INFINITY, f64::min)
}

/// Panels whose vibration a fixed step does not resolve.
pub(super) fn unresolved_panels(scene: &Scene) -> Vec<String> {
    let Some(step) = scene.time.step else { return Vec::new() };
    let coarse = wet_periods(scene).into_iter().filter(|(_, period)| step * STEPS_PER_PERIOD > *period * (1.0 + 1e-9));
    coarse
        .map(|(panel, period)| {
            format!(
                "time.step = {step} s is {} of {}'s first wet period, about {} s: at a tenth its frequency was 2.5 % low, at a \
                 third 23 %; {} s would do, or no time.step",
                significant(step / period),
                panel.name,
                significant(period),
                significant(period / STEPS_PER_PERIOD)
            )
        })
        .collect()
}
