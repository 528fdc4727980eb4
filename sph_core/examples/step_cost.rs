//! What a weakly compressible step costs, ns a particle, on a still square of water.
use sph_core::eos::Tait;
use sph_core::{Fluid, Parameters, Seed, Walls};
use std::time::Instant;

fn main() {
    let n: usize = std::env::args().nth(1).map_or(20_000, |s| s.parse().expect("a number"));
    let steps: usize = std::env::args().nth(2).map_or(100, |s| s.parse().expect("a number"));
    for wide in [true] {
        let side = (n as f64).sqrt() as usize;
        let dx = 0.01;
        let seeds: Vec<Seed> = (0..side * side)
            .map(|k| {
                let at = [(k % side) as f64 * dx, (k / side) as f64 * dx];
                Seed { at, velocity: [0.3 * at[1], -0.3 * at[0]], area: dx * dx, pressure: 0.0 }
            })
            .collect();
        let parameters =
            Parameters { wide, gravity: [0.0; 2], ..Parameters::usual(Tait { rho0: 1000.0, c0: 50.0, gamma: 7.0 }) };
        let mut fluid = Fluid::new(parameters, &seeds);
        let mut walls = Walls::default();
        fluid.initialise(&mut walls).expect("sound");
        let start = Instant::now();
        for _ in 0..steps {
            let dt = fluid.stable_dt(&walls).expect("sound");
            fluid.step(&mut walls, dt).expect("sound");
        }
        let each = start.elapsed().as_secs_f64() * 1e9 / (steps * fluid.particles.len()) as f64;
        println!(
            "wide {wide}: {} particles, {each:.0} ns a particle and step, {} lists, {:.1} pairs",
            fluid.particles.len(),
            fluid.search.rebuilds,
            fluid.search.fluid.pairs() as f64 / fluid.particles.len() as f64
        );
    }
}
