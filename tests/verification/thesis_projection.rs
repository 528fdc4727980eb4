//! The thesis's projection (THEORY J1–J16): what it reaches where its author got.

use std::time::Instant;

use evidence::systems::{of_text, system};
use fsi_coupling::Coupled;

/// ρ g [Pa/m] of every scene.
const WEIGHT: f64 = 1000.0 * 9.81;
/// The solver by its name in a scene.
const SOLVER: &str = "solver=incompressible_thesis";

/// Largest error of a particle's pressure against ρ g times its depth below the top row, where p = 0, over that of the
/// lowest row [-].
fn pressure_error(system: &Coupled) -> f64 {
    let p = &system.fluid.particles;
    let [top, floor] = [p.y.iter().copied().fold(f64::MIN, f64::max), p.y.iter().copied().fold(f64::MAX, f64::min)];
    let of = |k: usize| (system.fluid.derived.pressure[k] - WEIGHT * (top - p.y[k])).abs();
    (0..p.len()).map(of).fold(0.0, f64::max) / (WEIGHT * (top - floor))
}

/// Largest speed over √(g H) [-].
fn speed(system: &Coupled, depth: f64) -> f64 {
    system.fluid.top_speed() / (9.81 * depth).sqrt()
}

/// A column of `rows` particles, four wide, between walls.
fn column(rows: usize, sets: &[&str]) -> Coupled {
    let depth = 0.05 * rows as f64;
    let text = format!(
        "name = \"column\"\n[time]\nend = 10.0\n[resolution]\nspacing = 0.05\n[tank]\nwidth = 0.2\ndepth = {depth}\n"
    );
    of_text(&text, &[&[SOLVER], sets].concat())
}

/// Take stable steps until `end` [s].
fn advance(system: &mut Coupled, end: f64) {
    while system.fluid.time < end {
        let dt = system.stable_dt().expect("a step");
        system.step(dt).expect("the thesis's case runs");
    }
}

/// The thesis's column, of 16, 32 and 60 rows: its pressure is hydrostatic and it stays where it is, whatever h is up to 1.25
/// spacings.
#[test]
fn a_column_carries_its_weight() {
    for (rows, set) in [
        (16, "fluid.smoothing_ratio=1.0"),
        (32, "fluid.smoothing_ratio=1.0"),
        (60, "fluid.smoothing_ratio=1.0"),
        (16, "fluid.kernel=cubic_spline"),
        (16, "fluid.smoothing_ratio=1.1"),
        (16, "fluid.smoothing_ratio=1.25"),
    ] {
        let mut column = column(rows, &[set]);
        let dt = column.stable_dt().unwrap();
        column.step(dt).unwrap();
        let first = pressure_error(&column);
        advance(&mut column, 10.0);
        let (error, speed) = (pressure_error(&column), speed(&column, 0.05 * rows as f64));
        println!(
            "{rows} {set}: dt {dt:.4} first {:.4} % at 10 s {:.4} %, speed {speed:.2e}",
            100.0 * first,
            100.0 * error
        );
    }
}

/// The thesis's tank, here of 1600 particles.
#[test]
fn the_tank_carries_its_weight() {
    for sets in [vec![SOLVER], vec![SOLVER, "thesis.density_tolerance=1e-5"]] {
        let mut tank = system("hydrostatic_tank", &sets);
        let (mut steps, start) = (0, Instant::now());
        let dt = tank.stable_dt().unwrap();
        for end in [0.0, 0.01, 0.1, 1.0, 2.0] {
            while tank.fluid.time <= end {
                tank.step(dt).expect("still water");
                steps += 1;
            }
            let (error, speed) = (100.0 * pressure_error(&tank), speed(&tank, 1.0));
            let t = &tank.fluid.thesis;
            let cost = 1e3 * start.elapsed().as_secs_f64() / f64::from(steps);
            println!(
                "t {:.3} error {error:.4} % speed {speed:.2e} iterations {} solutions {} steps {steps}: {cost:.2} ms a step; momentum {:.2e}",
                tank.fluid.time,
                t.iterations,
                t.solutions,
                tank.momentum_audit().worst
            );
        }
    }
}

/// A tank set in motion in its first sloshing mode: ω² = g k tanh(k H), k = π/L.
#[test]
fn a_tank_out_of_equilibrium_sloshes_at_its_frequency() {
    for (amplitude, set) in [
        (0.02, "thesis.inner_passes=1"),
        (0.005, "thesis.inner_passes=1"),
        (0.02, "thesis.inner_passes=10"),
        (0.02, "resolution.spacing=0.05"),
        (0.02, "fluid.smoothing_ratio=1.25"),
        (0.02, "fluid.artificial_viscosity=0.02"),
    ] {
        let mut tank = system("hydrostatic_tank", &[SOLVER, set]);
        let k = std::f64::consts::PI;
        let omega = (9.81 * k * k.tanh()).sqrt();
        let p = &mut tank.fluid.particles;
        for i in 0..p.len() {
            let (x, y) = (k * (p.x[i] + 0.5), k * (p.y[i] + 1.0));
            p.u[i] = amplitude * x.sin() * y.cosh() / k.sinh();
            p.v[i] = -amplitude * x.cos() * y.sinh() / k.sinh();
        }
        let momentum = |s: &Coupled| -> f64 { s.fluid.particles.u.iter().sum() };
        let (first, mut before, mut crossings) = (momentum(&tank), [0.0, momentum(&tank)], Vec::new());
        while crossings.len() < 3 && tank.fluid.time < 3.0 {
            let dt = tank.stable_dt().unwrap();
            if let Err(e) = tank.step(dt) {
                println!("{e}");
                break;
            }
            let now = [tank.fluid.time, momentum(&tank)];
            if before[1] * now[1] < 0.0 {
                crossings.push(before[0] + (now[0] - before[0]) * before[1] / (before[1] - now[1]));
            }
            before = now;
        }
        println!(
            "{amplitude} {set} period {} crossings {crossings:?} in periods {:?} first {first} last {before:?}",
            std::f64::consts::TAU / omega,
            crossings.iter().map(|t| t * omega / std::f64::consts::TAU).collect::<Vec<_>>()
        );
    }
}
