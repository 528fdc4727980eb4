//! What the two forms of dissipation take from sound (THEORY WC4, WC8): a standing wave in a periodic box without walls.

use std::f64::consts::PI;

use evidence::bare::{advance, lattice};
use evidence::parameters::Parameters;
use sph_core::{Dissipation, Fluid, Periodic, Walls};

use super::acoustics::lossless;

/// Particles along the box of 1 m.
const CELLS: usize = 60;
/// Pressure's amplitude [Pa]: Mach 4e-5, so linear.
const AMPLITUDE: f64 = 100.0;

/// Rate [1/s] at which a wave p = A cos(2πx) loses amplitude over its first two periods, from its energy
/// p²/(2ρ₀c₀²) + ½ρ₀u² in the mode.
fn damping(parameters: Parameters) -> f64 {
    let (cell, k) = (Some([0.0, 1.0]), 2.0 * PI);
    let parameters = Parameters { periodic: Some(Periodic { x: cell, y: cell }), ..parameters };
    let wave = |[x, _]: [f64; 2]| Some(([0.0; 2], AMPLITUDE * (k * x).cos()));
    let mut fluid = parameters.fluid(&lattice([0.0; 2], [1.0; 2], 1.0 / CELLS as f64, wave));
    let (rho0, c0) = (parameters.eos.rho0, parameters.eos.c0);
    let energy = |fluid: &Fluid| {
        let (p, d) = (fluid.particles(), fluid.fields());
        let mode =
            |value: &[f64], shape: fn(f64) -> f64| (0..p.len()).map(|a| value[a] * shape(k * p.x[a])).sum::<f64>();
        (mode(&d.pressure, f64::cos) / (rho0 * c0)).powi(2) + mode(&p.u, f64::sin).powi(2)
    };
    let (end, mut walls) = (2.0 / c0, Walls::default());
    fluid.initialise(&mut walls).expect("water at rest");
    let first = energy(&fluid);
    advance(&mut fluid, &mut walls, end, |_| ()).expect("a stable run");
    0.5 * (first / energy(&fluid)).ln() / end
}

/// Long waves fall as exp(−½ δ h c₀ k² t) with density diffusion, and with the Riemann form as with δ = ½.
#[test]
fn both_dissipations_damp_sound_as_their_formula_says() {
    let h = 1.5 / CELLS as f64;
    let exact = |delta: f64| 0.5 * delta * h * lossless().eos.c0 * (2.0 * PI).powi(2);
    for (what, delta, parameters) in [
        ("δ = 0.1", 0.1, Parameters { delta: 0.1, ..lossless() }),
        ("δ = 0.5", 0.5, Parameters { delta: 0.5, ..lossless() }),
        ("riemann", 0.5, Parameters { dissipation: Dissipation::Riemann, ..lossless() }),
    ] {
        let error = damping(parameters) / exact(delta) - 1.0;
        println!("{what}: damping off by {:.2} % of {:.2} 1/s", 100.0 * error, exact(delta));
        assert!(error.abs() < 0.05, "{what}: damping off by {:.2} % of {:.2} 1/s", 100.0 * error, exact(delta));
    }
}
