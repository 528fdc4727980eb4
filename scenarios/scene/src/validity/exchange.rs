//! Is the exchange of accelerations between water and body stable? An estimate before the run (THEORY CO10, CO12).

use fsi_coupling::geometry::polygon;
use fsi_coupling::{Beside, PanelExchange, Shape, exchange_ratio};
use settings::significant;

use crate::keys::{Body, CouplingScheme, Freedom, Motion, Panel, Scene, Symmetry, panel_length};

/// Spectral radius of the weak exchange up to which it was smooth: 0.83 was, 1.0 shook (`tests/stability/coupling.rs`).
const SMOOTH: f64 = 0.84;

/// Spectral radius of the exchange with a panel up to which it is not doubted: runs broke down from 0.95 of CO12's on.
const LIGHT_PANEL: f64 = 0.9;

/// CO10: the added mass that half a row of water beside a free body carries, over the body's own inertia; the largest over
/// its free directions is the spectral radius of the weak exchange. `None` without a free body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExchangeRatio {
    /// Along x, y, and about the centre of mass [-]; 0 where the body is held.
    pub ratios: [f64; 3],
}

impl ExchangeRatio {
    /// Of a scene's bodies at t = 0 the one with the largest.
    pub fn of(scene: &Scene) -> Option<ExchangeRatio> {
        let all = scene.all_bodies().filter_map(|body| ExchangeRatio::of_body(scene, body));
        all.reduce(|a, b| if b.spectral_radius() > a.spectral_radius() { b } else { a })
    }

    /// Of a body of a scene at t = 0.
    fn of_body(scene: &Scene, body: &Body) -> Option<ExchangeRatio> {
        let Motion::Free(freedom) = &body.motion else { return None };
        let along = row_of_water(scene, body);
        let inertia = inertia(scene, body, freedom);
        Some(ExchangeRatio { ratios: [0, 1, 2].map(|k| inertia[k].map_or(0.0, |inertia| along[k] / inertia)) })
    }

    /// The largest [-].
    pub fn spectral_radius(&self) -> f64 {
        self.ratios.into_iter().fold(0.0, f64::max)
    }
}

/// Mass, mass and moment of inertia [kg/m, kg/m, kg m]; `None` where the body is held.
fn inertia(scene: &Scene, body: &Body, freedom: &Freedom) -> [Option<f64>; 3] {
    let whole = scene.symmetry == Symmetry::None;
    let halves = if whole { 1.0 } else { 2.0 };
    let of_panels: f64 = body.panels.iter().map(|p| p.density * p.thickness * panel_length(body, p)).sum();
    let of_modes: f64 = body.modal.iter().flat_map(|modal| &modal.masses).sum();
    let mass = freedom.mass + halves * (of_panels + of_modes);
    let x = (freedom.x() && whole).then_some(mass);
    [x, freedom.y().then_some(mass), freedom.inertia.filter(|_| whole)]
}

/// ½ ρ Δx ∮ (n_x², n_y², (r×n)²) ds over the faces that may be wet from the start: all of a body under water, else those
/// that do not look up.
fn row_of_water(scene: &Scene, body: &Body) -> [f64; 3] {
    let outline = body.placed_outline();
    let centre = body.to_tank(body.center_of_mass);
    let [_, top] = polygon::bounding_box(&outline);
    let submerged = top[1] < 0.0;
    let row = 0.5 * scene.water().density * scene.resolution.spacing;
    let mut sum = [0.0; 3];
    for (a, b) in polygon::edges(&outline) {
        let n = polygon::normal(a, b);
        if !submerged && n[1] > 1e-9 {
            continue;
        }
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let arm = |t: f64| {
            let r = [0, 1].map(|k| a[k] + t * (b[k] - a[k]) - centre[k]);
            (r[0] * n[1] - r[1] * n[0]).powi(2)
        };
        let arms = (arm(0.0) + 4.0 * arm(0.5) + arm(1.0)) / 6.0; // Simpson, exact for a square
        for (sum, share) in sum.iter_mut().zip([n[0] * n[0], n[1] * n[1], arms]) {
            *sum += row * length * share;
        }
    }
    sum
}

/// Bodies too light for explicit coupling.
pub(crate) fn light_bodies(scene: &Scene) -> Vec<String> {
    scene.all_bodies().filter_map(|body| light_body(scene, body)).collect()
}

fn light_body(scene: &Scene, body: &Body) -> Option<String> {
    let exchange = ExchangeRatio::of_body(scene, body)?;
    let radius = exchange.spectral_radius();
    (scene.coupling.scheme == CouplingScheme::Weak && radius > SMOOTH).then(|| {
        let which = exchange.ratios.iter().position(|r| *r == radius).unwrap_or(1);
        let direction = ["moves along x", "moves along y", "turns"][which];
        format!(
            "the {} is light for coupling.scheme = \"weak\": the water that {direction} with it has {} times its \
             inertia; from about 0.84 on, weak coupling oscillates; take coupling.scheme = \"added_mass\", or {} m for \
             resolution.spacing",
            if scene.bodies.is_empty() { "body".to_string() } else { format!("body {}", body.name) },
            significant(radius),
            significant(scene.resolution.spacing * SMOOTH / radius)
        )
    })
}

/// Faces of a body's panels that may be wet: both of those on a plate's middle line [-].
pub(crate) fn wet_faces(body: &Body) -> f64 {
    if matches!(body.shape, Shape::Polyline { .. }) { 2.0 } else { 1.0 }
}

/// CO12: what explicit coupling makes of the accelerations of a scene's panels, by panel.
pub fn panel_exchanges(scene: &Scene) -> Vec<(&Panel, PanelExchange)> {
    let Some(body) = &scene.body else { return Vec::new() };
    let faces = wet_faces(body);
    let (fluid, sound_speed, spacing) = (scene.water(), scene.sound_speed(), scene.resolution.spacing);
    let acoustic = fluid.smoothing_ratio * spacing / (sound_speed + scene.fastest_speed());
    let of = |panel: &Panel| {
        exchange_ratio(&Beside {
            mass: panel.density * panel.thickness,
            faces,
            density: fluid.density,
            spacing,
            smoothing_ratio: fluid.smoothing_ratio,
            sound_speed,
            dt: scene.time.step.unwrap_or(scene.courant_number() * acoustic),
        })
    };
    body.panels.iter().map(|panel| (panel, of(panel))).collect()
}

/// Panels too light for explicit coupling.
pub(crate) fn light_panels(scene: &Scene) -> Vec<String> {
    if scene.coupling.scheme != CouplingScheme::Weak {
        return Vec::new();
    }
    let light = panel_exchanges(scene).into_iter().filter(|(_, exchange)| exchange.spectral_radius > LIGHT_PANEL);
    light
        .map(|(panel, exchange)| {
            format!(
                "{} is light for coupling.scheme = \"weak\": the water beside it makes an error of its acceleration {} times \
                 larger in every step, and from about 1 on the run breaks down; take coupling.scheme = \"added_mass\", which \
                 holds at any mass",
                panel.name,
                significant(exchange.spectral_radius)
            )
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load;

    fn exchange(sets: &[&str]) -> [f64; 3] {
        let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
        ExchangeRatio::of(&load("floating_box", &sets).expect("a sound scene").scene).expect("a free body").ratios
    }

    /// A box of breadth b and height h, 40 kg/m: ½ρΔx (2h, b, b³/12 + 2 (h³/12)) afloat; twice the bottom's share under water.
    #[test]
    fn a_box_has_its_rows_of_water() {
        let (b, h, row): (f64, f64, f64) = (0.4, 0.2, 0.5 * 1000.0 * 0.02);
        let inertia = 40.0 * (b * b + h * h) / 12.0;
        let afloat = [row * 2.0 * h / 40.0, row * b / 40.0, row * (b.powi(3) + 2.0 * h.powi(3)) / 12.0 / inertia];
        let sunk = [afloat[0], 2.0 * afloat[1], row * 2.0 * (b.powi(3) + h.powi(3)) / 12.0 / inertia];
        for (found, exact) in [
            (exchange(&[]), afloat),
            (exchange(&["body.position=[0.0, -0.3]", "body.center_of_mass=[0.0, 0.0]"]), sunk),
        ] {
            (0..3).for_each(|k| assert!((found[k] / exact[k] - 1.0).abs() < 1e-12, "{found:?} {exact:?}"));
        }
    }

    #[test]
    fn a_light_body_is_warned_of_with_the_scheme_that_helps() {
        let warned = |set: &str| {
            let sets: Vec<String> = ["body.mass=4", set].map(String::from).to_vec();
            let warnings = load("floating_box", &sets).expect("a sound scene").warnings;
            warnings.iter().any(|w| w.contains("coupling.scheme = \"added_mass\""))
        };
        assert!(warned("coupling.scheme=weak") && !warned("coupling.scheme=added_mass"));
    }
}
