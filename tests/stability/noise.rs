//! Failures that show as noise, on a coarse wedge entry at constant speed: what each ingredient of the scheme is for.

use evidence::statistics::{deviation, mean};
use evidence::systems::{advance, lift, system};
use fsi_coupling::Coupled;
use sph_core::probe::Probe;

/// Noise of a run to Vt/Δx = 20.
struct Noise {
    /// Scatter of the force coefficient F/(ρV³t) over the last half of the run, relative to its mean [-].
    force: f64,
    /// Scatter of particles' pressures about their neighbours' mean near the wedge, relative to ½ρV² [-].
    pressure: f64,
}

fn entry(sets: &[&str]) -> Noise {
    let mut system = system("wedge_constant", &[sets, &["resolution.spacing=0.05"]].concat());
    let mut coefficients = Vec::new();
    advance(&mut system, 1.0, |s| {
        if s.fluid.time > 0.5 {
            coefficients.push(lift(s) / (1000.0 * s.fluid.time));
        }
    })
    .expect("a run that ends, noisy or not");
    Noise { force: deviation(&coefficients) / mean(&coefficients), pressure: roughness(&system) }
}

/// Standard deviation of p_a − ⟨p⟩_a of the water within 2 m of the keel, away from the free surface, over ½ρV².
fn roughness(system: &Coupled) -> f64 {
    let (p, d, probe) = (&system.fluid.particles, &system.fluid.derived, Probe::new(&system.fluid));
    let near = (0..p.len()).filter(|&k| p.x[k] < 2.0 && p.y[k] > -1.5 && !d.near_surface[k]);
    let gaps: Vec<f64> = near.map(|k| d.pressure[k] - probe.shepard([p.x[k], p.y[k]])).collect();
    assert!(gaps.len() > 30, "{} particles near the wedge", gaps.len());
    deviation(&gaps) / 500.0
}

/// Failure: without density diffusion (THEORY E5) and artificial viscosity (E7) the pressure is a checkerboard many
/// times the stagnation pressure, and the force means nothing. Remedy: the defaults, which cost under 0.5 % of force.
#[test]
fn without_density_diffusion_and_viscosity_the_pressure_is_noise() {
    let bare = entry(&["fluid.density_diffusion=0", "fluid.artificial_viscosity=0"]);
    let ours = entry(&[]);
    assert!(bare.pressure > 10.0, "bare: roughness {:.2} of ½ρV²", bare.pressure);
    assert!(bare.force > 0.3, "bare: force scatters by {:.2}", bare.force);
    assert!(ours.pressure < 0.5, "ours: roughness {:.2} of ½ρV²", ours.pressure);
    assert!(ours.force < 0.1, "ours: force scatters by {:.2}", ours.force);
}

/// Failure: without shifting (THEORY E13) particles line up along streamlines, leave pockets at the keel, and the
/// force is more than half as noisy again. Remedy: shifting.
#[test]
fn without_shifting_the_force_is_noisier() {
    let (without, with) = (entry(&["fluid.shifting=false"]), entry(&[]));
    assert!(without.force > 1.6 * with.force, "{:.3} without, {:.3} with shifting", without.force, with.force);
    assert!(without.pressure > 2.0 * with.pressure, "{:.3} without, {:.3} with", without.pressure, with.pressure);
}
