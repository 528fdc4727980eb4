//! Temporary measurement.
use sph_core::neighbours::images::Periodic;
use sph_core::{Domain, Fluid, Seed, Walls, Phase, parallel, wcsph};
use std::f64::consts::TAU;
use std::time::Instant;
fn main() {
    let a: Vec<usize> = std::env::args().skip(1).map(|x| x.parse().unwrap()).collect();
    let (particles, n, steps, threads) = (a[0], a[1] as u32, a[2], a[3]);
    let cfl: f64 = std::env::var("CFL").map(|c| c.parse().unwrap()).unwrap_or(0.6);
    parallel::on_threads(threads, || {
        let cells = (particles as f64).sqrt().round() as usize;
        let (dx, cell) = (1.0 / cells as f64, Some([0.0, 1.0]));
        let domain = Domain { periodic: Some(Periodic { x: cell, y: cell }), ..Domain::default() };
        let settings = wcsph::Settings { sound_speed: 10.0.into(), acoustic_steps: n, cfl: cfl.into(), ..wcsph::Settings::default() };
        let mut s = 1u64;
        let mut throw = || { s ^= s << 13; s ^= s >> 7; s ^= s << 17; (s >> 11) as f64 / (1_u64 << 53) as f64 - 0.5 };
        let seeds: Vec<Seed> = (0..cells * cells).map(|k| {
            let x = ((k % cells) as f64 + 0.5 + 0.1 * throw()) * dx;
            let y = ((k / cells) as f64 + 0.5 + 0.1 * throw()) * dx;
            let velocity = [-(TAU * x).cos() * (TAU * y).sin(), (TAU * x).sin() * (TAU * y).cos()];
            Seed { at: [x, y], velocity, area: dx * dx, pressure: 0.0 }
        }).collect();
        let mut fluid = Fluid::new(domain, &settings, &seeds);
        let mut walls = Walls::default();
        fluid.initialise(&mut walls).unwrap();
        for _ in 0..2 { let dt = fluid.stable_dt(&walls).unwrap(); fluid.step(&mut walls, dt).unwrap(); }
        let before: Vec<f64> = Phase::ALL.iter().map(|p| fluid.timers().seconds(*p)).collect();
        let lists = fluid.neighbours().rebuilds;
        let start = Instant::now();
        let t0 = fluid.time();
        for _ in 0..steps {
            fluid.timers_mut().begin(Phase::Integration);
            let dt = fluid.stable_dt(&walls).unwrap(); fluid.step(&mut walls, dt).unwrap();
            fluid.timers_mut().end();
        }
        let ns = 1e9 / (steps * fluid.particles().len()) as f64;
        println!("n {n}: {:.1} ns, lists {} in {steps} steps, t {:.4}, E {:.8}, mom {:?}", start.elapsed().as_secs_f64() * ns, fluid.neighbours().rebuilds - lists, fluid.time() - t0, fluid.energy().kinetic, fluid.momentum());
        for (p, b) in Phase::ALL.iter().zip(before) {
            let s = fluid.timers().seconds(*p) - b;
            if s > 0.0 { print!("{} {:.1}  ", p.name(), s * ns); }
        }
        println!(" bytes {:?}", fluid.bytes_by_use().iter().map(|(n, b)| format!("{n} {}", b / fluid.particles().len())).collect::<Vec<_>>());
    });
}
