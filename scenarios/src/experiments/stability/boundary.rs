//! Theoretical boundaries of stability: each is a number of a scene that is 1 at the limit.

use fsi_coupling::geometry::polygon;
use scene::{CouplingScheme, ExchangeRatio, Kernel, Motion, Scene, panel_exchanges};
use serde::{Deserialize, Serialize};

use super::acoustics::{Medium, largest_courant};
use super::lattice::{gain_of_pairs, kernel_sum, neighbours};

/// A cylinder seems smaller by this number of spacings to a shove of one step (CO25) [-].
const SHORT_RADIUS: f64 = 0.8;

/// A formula for the boundary of stability.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Boundary {
    /// Δt c₀/h over the largest at which no wave on the lattice grows, of the scene's integrator, kernel and density
    /// diffusion (THEORY WC14, WC15). Linear, for still water of a square lattice without viscosity.
    Courant,
    /// Half a row of water over the body's inertia with one exchange per step; 0 with any other scheme (THEORY CO7, CO8, CO10). For
    /// rigid bodies in weakly compressible water.
    RowOfWater,
    /// Water on the face of the body's first panel over the panel's inertia with one exchange per step; 0 with any other scheme
    /// (THEORY CO12). For panels in weakly compressible water.
    Panel,
    /// Added mass over mass of a circular cylinder, over its limit with one exchange per step; 0 with any other scheme (THEORY
    /// CO25, after Causin, Gerbeau & Nobile 2005). For a projection, far from walls.
    AddedMass,
    /// h/Δx over the least at which a hexagonal lattice of pairs holds less energy under pressure than one of single
    /// particles; 0 where there is none (THEORY OP7). No disorder.
    Pairing,
    /// The surface criterion over the window in which it finds the top row of a square lattice and no other (THEORY LE24).
    SurfaceRows,
}

impl Boundary {
    /// Name, with its equations.
    pub fn name(self) -> &'static str {
        match self {
            Boundary::Courant => "sound on the lattice (THEORY WC14, WC15)",
            Boundary::RowOfWater => "half a row of water = the body's inertia (THEORY CO10)",
            Boundary::Panel => "water beside the panel = the panel's inertia (THEORY CO12)",
            Boundary::AddedMass => "added mass (1 + 2β) = mass (THEORY CO25)",
            Boundary::Pairing => "pairs hold less energy (THEORY OP7)",
            Boundary::SurfaceRows => "the top row and no other (THEORY LE24)",
        }
    }

    /// The scene's number over the limit [-]; `None` where the formula does not apply.
    pub fn ratio(self, scene: &Scene) -> Option<f64> {
        match self {
            Boundary::Courant => courant(scene),
            Boundary::RowOfWater => one_exchange(scene, ExchangeRatio::of(scene)?.spectral_radius()),
            Boundary::Panel => one_exchange(scene, panel_exchanges(scene).first()?.1.spectral_radius),
            Boundary::AddedMass => one_exchange(scene, added_mass(scene)?),
            Boundary::Pairing => Some(pairing(scene.water().kernel, scene.water().smoothing_ratio)),
            Boundary::SurfaceRows => surface_rows(scene),
        }
    }
}

fn courant(scene: &Scene) -> Option<f64> {
    let (water, fluid) = (scene.water(), scene.solver.weakly_compressible()?);
    let h = water.smoothing_ratio * scene.resolution.spacing;
    let courant = scene.time.step.map_or(scene.courant_number(), |step| step * scene.sound_speed() / h);
    let diffusion = fluid.scheme.density_diffusion;
    let medium = Medium { kernel: water.kernel, smoothing_ratio: water.smoothing_ratio, diffusion };
    Some(courant / largest_courant(fluid.options.integrator, fluid.options.verlet_correction_every, medium))
}

/// The ratio with one exchange per step; 0 with the other schemes, which are stable at any mass.
fn one_exchange(scene: &Scene, ratio: f64) -> Option<f64> {
    Some(if scene.coupling.scheme == CouplingScheme::Weak { ratio } else { 0.0 })
}

/// μ (1 + 2β) with μ what a circle displaces over its mass and β the share of a shove that one step answers (CO25).
fn added_mass(scene: &Scene) -> Option<f64> {
    let body = scene.body.as_ref()?;
    let Motion::Free(freedom) = &body.motion else { return None };
    let area = polygon::signed_area(&body.placed_outline());
    let radius = (area / std::f64::consts::PI).sqrt();
    let answered = (1.0 - SHORT_RADIUS * scene.resolution.spacing / radius).powi(2);
    let displaced = scene.water().density * area / freedom.mass;
    scene.solver.is_incompressible().then_some(displaced * (1.0 + 2.0 * answered))
}

fn pairing(kernel: Kernel, smoothing_ratio: f64) -> f64 {
    let steps = (1000..3000).map(|k| f64::from(k) * 1e-3);
    let least = steps.into_iter().find(|&h| gain_of_pairs(kernel, h) < 0.0);
    least.map_or(0.0, |least| smoothing_ratio / least)
}

fn surface_rows(scene: &Scene) -> Option<f64> {
    let ratio = scene.solver.surface_ratio()?;
    let around = neighbours(scene.water().kernel, scene.water().smoothing_ratio);
    let inside = kernel_sum(&around, f64::INFINITY);
    let [top, second] = [0.0, 1.0].map(|above| kernel_sum(&around, above) / inside);
    Some((top / ratio).max(ratio / second))
}

#[cfg(test)]
mod tests {
    use run::load;

    use super::*;

    fn ratio(theory: Boundary, name: &str, sets: &[&str]) -> f64 {
        let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
        theory.ratio(&load(name, &sets).expect("a sound scene").scene).expect("the theory applies")
    }

    /// A 32-sided cylinder of a fifth of the water's density, ten spacings wide: five times its mass, and β = 0.84².
    #[test]
    fn a_light_cylinder_displaces_its_added_mass() {
        let sets = ["solver=incompressible", "coupling.scheme=weak"];
        let exact = 5.0 * (1.0 + 2.0 * 0.84_f64.powi(2));
        assert!((ratio(Boundary::AddedMass, "rising_body", &sets) - exact).abs() < 0.02);
        assert_eq!(ratio(Boundary::AddedMass, "rising_body", &["solver=incompressible"]), 0.0);
    }

    #[test]
    fn kernels_with_positive_transforms_do_not_pair() {
        let of = |kernel: &str| {
            ratio(Boundary::Pairing, "column", &[&format!("fluid.kernel={kernel}"), "fluid.smoothing_ratio=2"])
        };
        assert!((of("cubic_spline") - 2.0 / 1.271).abs() < 2e-3, "{}", of("cubic_spline"));
        assert!(of("gaussian") > 1.0);
        assert_eq!([of("wendland_c2"), of("wendland_c4"), of("quadratic")], [0.0; 3]);
    }
}
