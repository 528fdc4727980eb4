//! Sums of the fluid's options that have exact answers (THEORY LE6–LE10), on an uneven block with a free edge all round.

use super::density_filter::smooth_density;
use super::turbulence::stresses;
use super::xsph::excess_velocities;
use crate::{Domain, Fluid, FluidSettings, Seed, SplitMix64, Walls, wcsph};

const SPACING: f64 = 0.1;
const SIDE: usize = 15;

/// A block of particles off their lattice by up to a fifth of a spacing, with velocities of their place and some disorder.
fn block(velocity: impl Fn([f64; 2]) -> [f64; 2], disorder: f64) -> Fluid {
    let mut random = SplitMix64(5);
    let mut draw = || 2.0 * random.unit() - 1.0;
    let mut seeds = Vec::new();
    for k in 0..SIDE * SIDE {
        let at = [k % SIDE, k / SIDE].map(|c| SPACING * (c as f64 + 0.2 * draw()));
        let velocity = velocity(at).map(|c| c + disorder * draw());
        seeds.push(Seed { at, velocity, area: SPACING * SPACING, pressure: 1000.0 * draw() });
    }
    let lossless = wcsph::Settings {
        sound_speed: 20.0.into(),
        eos_exponent: 1.0,
        artificial_viscosity: 0.0,
        density_diffusion: 0.0,
        shifting: false,
        ..wcsph::Settings::default()
    };
    let water = FluidSettings { kinematic_viscosity: 1e-6, ..FluidSettings::default() };
    let mut fluid = Fluid::new(Domain { fluid: water, ..Domain::default() }, &lossless, &seeds);
    fluid.initialise(&mut Walls::default()).expect("a block of water");
    fluid
}

/// Largest relative change that a filter makes to a density that varies as `rho`.
fn change(rho: impl Fn(f64, f64) -> f64, linear: bool) -> f64 {
    let mut fluid = block(|_| [0.0; 2], 0.0);
    let given: Vec<f64> = fluid.particles().x.iter().zip(&fluid.particles().y).map(|(&x, &y)| rho(x, y)).collect();
    fluid.particles_mut().rho.clone_from(&given);
    fluid.system_mut().pack(&Walls::default());
    smooth_density(fluid.system_mut(), linear, None);
    fluid.particles().rho.iter().zip(&given).map(|(found, given)| (found / given - 1.0).abs()).fold(0.0, f64::max)
}

/// Shepard's filter (LE6) keeps a constant to rounding, moving least squares (LE7) a linear field, edges and corners
/// included; what each is not made for it changes.
#[test]
fn density_filters_keep_the_fields_they_are_made_for() {
    let constant = |_: f64, _: f64| 998.0;
    let linear = |x: f64, y: f64| 998.0 + 7.0 * x - 12.0 * y;
    let curved = |x: f64, y: f64| 998.0 + 20.0 * (x - 0.7) * (y - 0.7) + 30.0 * x * x;
    assert!(change(constant, false) < 1e-14, "{:e}", change(constant, false));
    assert!(change(linear, true) < 1e-13, "{:e}", change(linear, true));
    assert!(change(linear, false) > 1e-4, "{:e}", change(linear, false));
    assert!(change(curved, true) > 1e-5, "{:e}", change(curved, true));
}

/// XSPH (LE8) moves the particles of a disordered flow, and not their centre of mass.
#[test]
fn smoothed_velocities_carry_the_same_momentum() {
    let fluid = block(|at| [at[1], 0.3], 1.0);
    let excess = excess_velocities(fluid.system());
    let (mut sum, mut size) = ([0.0; 2], 0.0);
    for (m, e) in fluid.particles().mass.iter().zip(&excess) {
        sum = [sum[0] + m * e[0], sum[1] + m * e[1]];
        size += m * e[0].hypot(e[1]);
    }
    assert!(size > 0.1 * fluid.mass(), "hardly anything is smoothed: {size} N s/m");
    assert!(sum[0].hypot(sum[1]) < 1e-13 * size, "{sum:?} of {size} N s/m");
}

/// In a linear shear u = γ̇ y the eddies' stress (LE9) is ρ (C_s Δ)² γ̇² across and −⅔ ρ C_I Δ² γ̇² along, at the block's
/// edges too.
#[test]
fn eddies_stress_of_a_linear_shear_is_its_formula() {
    let rate = 4.0;
    let fluid = block(|at| [rate * at[1], 0.0], 0.0);
    let stress = stresses(fluid.system());
    let strength = SPACING * SPACING * rate * rate;
    for (k, [xx, xy, yy]) in stress.into_iter().enumerate() {
        let rho = fluid.particles().rho[k];
        let (shear, along) = (rho * 0.12 * 0.12 * strength, -2.0 / 3.0 * rho * 0.0066 * strength);
        for (found, exact) in [(xy, shear), (xx, along), (yy, along)] {
            assert!((found / exact - 1.0).abs() < 1e-11, "particle {k}: {found} Pa, exact {exact} Pa");
        }
    }
}
