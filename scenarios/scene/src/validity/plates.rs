//! Panels whose numbers say that they are too thin, too short in their elements, or too slow for the step.

use std::f64::consts::TAU;

use fsi_coupling::PanelEnd;
use settings::significant;

use crate::keys::{Body, Panel, Scene, panel_length};

/// Deflection over length from which a clamped or pinned plate is rather a membrane [-].
const MEMBRANE: f64 = 0.1;
/// Elements this short, in spacings, held with a light and soft panel; 0.83 did not [-].
const SHORTEST: f64 = 1.5;
/// Mass of a panel over that of a row of water below which it counts as light [-].
const LIGHT: f64 = 1.0;
/// Periods of the first dry mode in a step from which the step leaves the panel's vibration out [-].
const UNRESOLVED: f64 = 0.1;

/// Warnings about a scene's panels, each with its number and a cure.
pub(crate) fn doubtful_panels(scene: &Scene) -> Vec<String> {
    let Some(body) = &scene.body else { return Vec::new() };
    let each = body.panels.iter();
    each.flat_map(|panel| [thin(scene, body, panel), short(scene, body, panel), slow(scene, body, panel)])
        .flatten()
        .collect()
}

/// Bending stiffness D = E h³/(12 (1 − ν²)), without the bracket in plane stress [N m].
fn stiffness(panel: &Panel) -> f64 {
    panel.plane.modulus(&panel.material()) * panel.thickness.powi(3) / 12.0
}

/// A plate on two supports under the mean pressure of a wedge's entry (Wagner 1932) or of the depth: w = q L⁴/(384 D) clamped, five
/// times that pinned.
fn thin(scene: &Scene, body: &Body, panel: &Panel) -> Option<String> {
    use PanelEnd::{Clamped, Free, Guided};
    let both = !panel.ends.contains(&Free);
    let softest = if panel.ends.iter().all(|end| matches!(end, Clamped | Guided)) { 1.0 } else { 5.0 };
    // rho V dc/dt
    let pressure = match scene.entry() {
        Some(entry) => scene.water().density * body.velocity[0].hypot(body.velocity[1]) * entry.root_speed(),
        None => scene.water().density * scene.tank.depth * scene.gravity[1].abs(),
    };
    let long = panel_length(body, panel);
    let deflection = softest * pressure * long.powi(4) / (384.0 * stiffness(panel));
    (both && deflection > MEMBRANE * long).then(|| {
        format!(
            "{} is so thin that {} Pa bend it by {} of its length in plate theory: it will carry its load as a membrane, and \
             strains may be far beyond the limits of its material",
            panel.name,
            significant(pressure),
            significant(deflection / long)
        )
    })
}

/// Elements much shorter than a spacing let a light panel crumple between particles.
fn short(scene: &Scene, body: &Body, panel: &Panel) -> Option<String> {
    let spacings = panel_length(body, panel) / panel.elements as f64 / scene.resolution.spacing;
    let light = panel.density * panel.thickness < LIGHT * scene.water().density * scene.resolution.spacing;
    (light && spacings < SHORTEST).then(|| {
        format!(
            "{} is light, and its elements are {} spacings long: below {SHORTEST} soft panels crumpled between the particles and \
             the run broke down; {} elements would do",
            panel.name,
            significant(spacings),
            (panel_length(body, panel) / (SHORTEST * scene.resolution.spacing)).floor().max(2.0)
        )
    })
}

/// First dry mode of a clamped or pinned plate, ω = (λ/L)² √(D/m), at the least λ that its ends allow.
fn slow(scene: &Scene, body: &Body, panel: &Panel) -> Option<String> {
    let step = scene.time.step?;
    let free = panel.ends.contains(&PanelEnd::Free);
    let lambda = if free { 1.875 } else { 4.730 };
    let mass = panel.density * panel.thickness;
    let omega = (lambda / panel_length(body, panel)).powi(2) * (stiffness(panel) / mass).sqrt();
    let share = step * omega / TAU;
    (share > UNRESOLVED).then(|| {
        format!(
            "time.step = {step} s is {} of the period of {}'s first dry mode: steps longer than a tenth leave its vibration out",
            significant(share),
            panel.name
        )
    })
}
