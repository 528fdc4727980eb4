//! Taylor & Green's (1937) vortices in a doubly periodic box: an exact solution of the Navier–Stokes equations.

use std::f64::consts::PI;

use evidence::bare::{advance, lattice, parameters};
use scenarios::reference::Table;
use sph_core::images::Periodic;
use sph_core::{Fluid, Parameters, Walls};

/// Re = U L/ν with U = 1 m/s, L = 1 m.
const REYNOLDS: f64 = 100.0;
/// Mach number 1/40 at first, so that compressibility, of the order of M² = 0.06 %, stays below what is measured.
const SOUND: f64 = 40.0;
const END: f64 = 0.5;

/// Velocity at a place of the unit box for a vortex strength `u` [m/s].
fn velocity([x, y]: [f64; 2], u: f64) -> [f64; 2] {
    let k = 2.0 * PI;
    [-u * (k * x).cos() * (k * y).sin(), u * (k * x).sin() * (k * y).cos()]
}

fn vortices(cells: usize, set: impl Fn(Parameters) -> Parameters) -> Fluid {
    let cell = Some([0.0, 1.0]);
    let parameters = set(Parameters {
        alpha: 0.0,
        nu: 1.0 / REYNOLDS,
        periodic: Some(Periodic { x: cell, y: cell }),
        ..parameters(SOUND)
    });
    let k = 4.0 * PI;
    let pressure = |[x, y]: [f64; 2]| -0.25 * 1000.0 * ((k * x).cos() + (k * y).cos());
    let seeds =
        lattice([0.0; 2], [1.0; 2], 1.0 / cells as f64, |at| Some((velocity(at, 1.0), pressure(at))));
    Fluid::new(parameters, &seeds)
}

/// Root mean square error of the velocity over the exact root mean square, and kinetic energy over that at the start.
fn run(cells: usize, set: impl Fn(Parameters) -> Parameters) -> [f64; 2] {
    let mut fluid = vortices(cells, set);
    let start = fluid.energy().kinetic;
    advance(&mut fluid, &mut Walls::default(), END, |_| {}).expect("a stable run");
    let (p, strength) = (&fluid.particles, (-8.0 * PI * PI / REYNOLDS * fluid.time).exp());
    let (mut wrong, mut exact) = (0.0, 0.0);
    for k in 0..p.len() {
        let [u, v] = velocity([p.x[k], p.y[k]], strength);
        wrong += (p.u[k] - u).powi(2) + (p.v[k] - v).powi(2);
        exact += u * u + v * v;
    }
    [(wrong / exact).sqrt(), fluid.energy().kinetic / start]
}

fn env(name: &str, or: f64) -> f64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(or)
}

#[test]
fn scan() {
    for cells in [16, 32, 64] {
        if cells as f64 > env("MAX", 64.0) { continue }
        let set = |p: Parameters| {
            let mut p = p;
            p.shifting = env("SHIFT", 1.0) > 0.5;
            p.delta = env("DELTA", p.delta);
            p.smoothing_ratio = env("RATIO", 1.5);
            p.volume_correction = env("THETA", 0.0) > 0.5;
            p.nu = env("NU", p.nu);
            p.eos.c0 = env("C0", p.eos.c0);
            p.eos.gamma = env("GAMMA", 7.0);
            p.cfl = env("CFL", 0.6);
            p
        };
        let mut fluid = vortices(cells, set);
        let b = env("BACK", 0.0);
        for k in 0..fluid.particles.len() {
            let p = fluid.parameters.eos.pressure(fluid.particles.rho[k]) + b;
            fluid.particles.rho[k] = fluid.parameters.eos.density(p);
        }
        let start = fluid.energy().kinetic;
        let mut walls = Walls::default();
        for k in 0..=10 {
            let t = 0.05 * k as f64;
            if k > 0 { advance(&mut fluid, &mut walls, t, |_| {}).expect("stable"); } else { fluid.initialise(&mut walls).unwrap() }
            let (p, strength) = (&fluid.particles, (-8.0 * PI * PI * fluid.parameters.nu * fluid.time).exp());
            let (mut wrong, mut exact) = (0.0, 0.0);
            for k in 0..p.len() {
                let [u, v] = velocity([p.x[k], p.y[k]], strength);
                wrong += (p.u[k] - u).powi(2) + (p.v[k] - v).powi(2);
                exact += u * u + v * v;
            }
            let mut fill = [9.0_f64, 0.0];
            for s in &fluid.derived.surroundings { fill = [fill[0].min(s.filling), fill[1].max(s.filling)] }
            let pm: f64 = fluid.derived.pressure.iter().sum::<f64>() / p.len() as f64;
            if k % env("EVERY", 2.0) as usize == 0 {
            println!("{cells} t {t:.2} error {:.5} kinetic {:.5} exact {:.5} fill {fill:.3?} images {} mom {:?} p {pm:.1} steps {}", (wrong / exact).sqrt(), fluid.energy().kinetic / start,
                strength * strength, fluid.search.fluid_images.len(), fluid.momentum(), fluid.steps);
            }
        }
    }
}
