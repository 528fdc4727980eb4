//! Boundaries by theory: each a number of a scene that reaches 1 where the method should fail.

use serde::{Deserialize, Serialize};

use super::acoustics::{Medium, largest_courant};
use super::lattice::{filling, neighbours};
use crate::scene::{CouplingScheme, ExchangeRatio, Kernel, Motion, Scene};
use fsi_coupling::polygon;

/// A formula for a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Theory {
    /// Δt c₀/h over the largest at which no wave on the lattice grows, of the scene's integrator, kernel and density
    /// diffusion (THEORY M1–M3). Linear, for still water of a square lattice without viscosity.
    Courant,
    /// Half a row of water over the body's inertia with one exchange a step; 0 with any other scheme (THEORY C4, C5, C8). For
    /// rigid bodies in weakly compressible water.
    RowOfWater,
    /// Added mass over mass of a circular cylinder with one exchange a step, 0 with any other scheme (THEORY M4; Causin,
    /// Gerbeau & Nobile 2005). For incompressible water, without bound.
    AddedMass,
    /// h/Δx over that at which the nearest neighbours of a hexagonal lattice lie where the kernel is steepest; 0 for kernels
    /// whose Fourier transform is positive (THEORY M5; Dehnen & Aly 2012).
    Pairing,
    /// The surface criterion over the window in which it finds the top row of a square lattice and no other (THEORY M6).
    SurfaceRows,
}

impl Theory {
    /// What is drawn, with its equations.
    pub fn name(self) -> &'static str {
        match self {
            Theory::Courant => "sound on the lattice (THEORY M1–M3)",
            Theory::RowOfWater => "half a row of water = the body's inertia (THEORY C8)",
            Theory::AddedMass => "added mass = mass (THEORY M4)",
            Theory::Pairing => "the steepest place of the kernel (THEORY M5)",
            Theory::SurfaceRows => "the top row and no other (THEORY M6)",
        }
    }

    /// The scene's number over the limit [-]; `None` where the formula does not apply.
    pub fn ratio(self, scene: &Scene) -> Option<f64> {
        match self {
            Theory::Courant => courant(scene),
            Theory::RowOfWater => one_exchange(scene, ExchangeRatio::of(scene)?.spectral_radius()),
            Theory::AddedMass => one_exchange(scene, displaced_over_own(scene)?),
            Theory::Pairing => Some(pairing(scene.fluid.kernel, scene.fluid.smoothing_ratio)),
            Theory::SurfaceRows => surface_rows(scene),
        }
    }
}

fn courant(scene: &Scene) -> Option<f64> {
    let fluid = &scene.fluid;
    let h = fluid.smoothing_ratio * scene.resolution.spacing;
    let courant = scene.time.step.map_or(fluid.cfl, |step| step * fluid.sound_speed / h);
    let medium = Medium {
        kernel: fluid.kernel,
        smoothing_ratio: fluid.smoothing_ratio,
        diffusion: fluid.density_diffusion,
    };
    let limit = largest_courant(fluid.integrator, fluid.verlet_correction_every, medium);
    (!scene.solver.is_incompressible()).then_some(courant / limit)
}

/// The ratio with one exchange a step; the other schemes find acceleration and pressure together, at any mass.
fn one_exchange(scene: &Scene, ratio: f64) -> Option<f64> {
    Some(if scene.coupling.scheme == CouplingScheme::Weak { ratio } else { 0.0 })
}

/// ρ₀ times the area of a free body's outline over its mass: the added mass of a circle is what it displaces.
fn displaced_over_own(scene: &Scene) -> Option<f64> {
    let body = scene.body.as_ref()?;
    let Motion::Free(freedom) = &body.motion else { return None };
    let displaced = scene.fluid.density * polygon::signed_area(&body.placed_outline());
    scene.solver.is_incompressible().then_some(displaced / freedom.mass)
}

fn pairing(kernel: Kernel, smoothing_ratio: f64) -> f64 {
    // |w'| is largest where w'' = 0
    let steepest = match kernel {
        Kernel::CubicSpline => 2.0 / 3.0,
        Kernel::Gaussian => std::f64::consts::FRAC_1_SQRT_2,
        // (2 − q)² is positive definite in two dimensions too (Askey 1973), and steepest at q = 0
        Kernel::WendlandC2 | Kernel::WendlandC4 | Kernel::Quadratic => return 0.0,
    };
    let nearest = (2.0 / 3.0_f64.sqrt()).sqrt(); // of a hexagonal lattice with Δx² a particle
    smoothing_ratio * steepest / nearest
}

fn surface_rows(scene: &Scene) -> Option<f64> {
    let ratio = scene.thesis.as_ref()?.surface_ratio;
    let around = neighbours(scene.fluid.kernel, scene.fluid.smoothing_ratio);
    let inside = filling(&around, f64::INFINITY);
    let [top, second] = [0.0, 1.0].map(|above| filling(&around, above) / inside);
    Some((top / ratio).max(ratio / second))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::load;

    fn ratio(theory: Theory, name: &str, sets: &[&str]) -> f64 {
        let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
        theory.ratio(&load(name, &sets).expect("a sound scene").scene).expect("the theory applies")
    }

    /// A 32-sided cylinder of a fifth of the water's density displaces five times its mass.
    #[test]
    fn a_light_cylinder_displaces_its_added_mass() {
        let sets = ["solver=incompressible", "coupling.scheme=weak"];
        assert!((ratio(Theory::AddedMass, "rising_body", &sets) - 5.0).abs() < 1e-4);
        assert_eq!(ratio(Theory::AddedMass, "rising_body", &["solver=incompressible"]), 0.0);
    }

    #[test]
    fn only_kernels_with_negative_transforms_pair() {
        let of = |kernel: &str| ratio(Theory::Pairing, "column", &[&format!("fluid.kernel={kernel}"), "fluid.smoothing_ratio=2"]);
        assert!(of("cubic_spline") > 1.0 && of("gaussian") > 1.0);
        assert_eq!([of("wendland_c2"), of("wendland_c4"), of("quadratic")], [0.0; 3]);
    }
}
