//! The ideal gas with its energy equation (THEORY LE11, LE12).

use evidence::parameters::Parameters;
use sph_core::wcsph::eos::Tait;
use sph_core::{IdealGas, Seed, Walls};

use super::acoustics::lossless;

const SPACING: f64 = 0.1;
const SIDE: usize = 41;

/// A block of air that closes in on its middle, u = −k r: until the news of its edges arrives nothing accelerates, every
/// particle flies straight, and volumes are V₀(1 − k t)². The middle must keep p V^γ, with ρ and p as that law says.
#[test]
fn compression_without_a_shock_is_adiabatic() {
    let air = IdealGas { rho0: 1.225, gamma: 1.4, temperature: 288.15, molar_mass: 0.028_964_4 };
    let eos = Tait { rho0: air.rho0, c0: air.sound_speed_at_rest(), gamma: air.gamma };
    let parameters = Parameters { eos, gas: Some([air.temperature, air.molar_mass]), cfl: 0.3, ..lossless() };
    let (rate, end) = (40.0, 0.003_5);
    let middle = 0.5 * (SIDE - 1) as f64;
    let seed = |k: usize| {
        let at = [k % SIDE, k / SIDE].map(|c| SPACING * (c as f64 - middle));
        Seed { at, velocity: at.map(|c| -rate * c), area: SPACING * SPACING, pressure: 0.0 }
    };
    let mut fluid = parameters.fluid(&(0..SIDE * SIDE).map(seed).collect::<Vec<_>>());
    let mut walls = Walls::default();
    fluid.initialise(&mut walls).expect("a block of air");
    while fluid.time() < end {
        let dt = fluid.stable_dt(&walls).expect("a stable step").min(end - fluid.time() + 1e-12);
        fluid.step(&mut walls, dt).expect("a stable run");
    }
    let (p, d) = (fluid.particles(), fluid.fields());
    let shrunk = (1.0 - rate * fluid.time()).powi(2);
    let exact = air.ambient() * shrunk.powf(-air.gamma);
    let mut seen = 0;
    for k in (0..p.len()).filter(|&k| p.x[k].abs().max(p.y[k].abs()) < 0.25) {
        let pressure = d.pressure[k] + air.ambient();
        let invariant = pressure / air.ambient() * (air.rho0 / p.rho[k]).powf(air.gamma);
        assert!((invariant - 1.0).abs() < 1e-5, "p V^γ changed by {:e}", invariant - 1.0);
        assert!((p.rho[k] / air.rho0 * shrunk - 1.0).abs() < 0.002, "density {} kg/m³", p.rho[k]);
        assert!((pressure / exact - 1.0).abs() < 0.002, "{pressure} Pa, exact {exact} Pa");
        seen += 1;
    }
    assert!(seen >= 25 && exact > 1.3 * air.ambient(), "{seen} particles at {exact} Pa");
}
