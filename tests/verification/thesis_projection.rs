//! The thesis's projection (THEORY LE18–LE28): what it reaches where its author got.

use sph_core::legacy::pilorget2010::Thesis;

use evidence::systems::{of_text, system};
use fsi_coupling::Coupled;

/// ρ g [Pa/m] of every scene.
const WEIGHT: f64 = 1000.0 * 9.81;
/// The solver by its name in a scene.
const SOLVER: &str = "solver=incompressible_thesis";
/// A single pass of the corrector.
const ONE_PASS: &str = "thesis.inner_passes=1";

/// Largest error of a particle's pressure against ρ g times its depth below the top layer, where p = 0, over that of the
/// lowest layer [-].
fn pressure_error(system: &Coupled) -> f64 {
    let p = system.fluid.particles();
    let [top, floor] = [p.y.iter().copied().fold(f64::MIN, f64::max), p.y.iter().copied().fold(f64::MAX, f64::min)];
    let of = |k: usize| (system.fluid.fields().pressure[k] - WEIGHT * (top - p.y[k])).abs();
    (0..p.len()).map(of).fold(0.0, f64::max) / (WEIGHT * (top - floor))
}

/// Largest speed over √(g H) [-].
fn speed(system: &Coupled, depth: f64) -> f64 {
    system.fluid.top_speed() / (9.81 * depth).sqrt()
}

/// Stable steps until `end` [s]; how many.
fn advance(system: &mut Coupled, end: f64) -> u32 {
    let mut steps = 0;
    while system.fluid.time() < end {
        let dt = system.stable_dt().expect("a step");
        system.step(dt).expect("the thesis's case runs");
        steps += 1;
    }
    steps
}

/// The thesis's column of 16 to 60 layers, here four particles wide, between walls: within 0.3 % of hydrostatic at rest whatever
/// h is from 1 to 1.25 spacings, and at rest.
#[test]
fn a_column_carries_its_weight() {
    for (layers, set, end) in [
        (16, "fluid.smoothing_ratio=1.0", 2.0),
        (32, "fluid.smoothing_ratio=1.0", 0.8),
        (60, "fluid.smoothing_ratio=1.0", 0.5),
        (16, "fluid.kernel=cubic_spline", 0.8),
        (16, "fluid.smoothing_ratio=1.1", 0.8),
        (16, "fluid.smoothing_ratio=1.25", 0.8),
    ] {
        let depth = 0.05 * f64::from(layers);
        let text = format!(
            "name = \"column\"\n[time]\nend = 10.0\n[resolution]\nspacing = 0.05\n[tank]\nwidth = 0.2\ndepth = {depth}\n"
        );
        let mut column = of_text(&text, &[SOLVER, set]);
        advance(&mut column, 1e-9);
        let first = pressure_error(&column);
        advance(&mut column, end);
        let (error, speed) = (pressure_error(&column), speed(&column, depth));
        println!(
            "{layers} layers, {set}: {:.3} % at first, {:.4} % at {end} s, {speed:.1e} √(gH)",
            100.0 * first,
            100.0 * error
        );
        assert!(first < 0.02, "{layers} layers, {set}: {:.2} % at first", 100.0 * first);
        assert!(error < 3e-3, "{layers} layers, {set}: {:.3} %", 100.0 * error);
        assert!(speed < 1e-4, "{layers} layers, {set}: {speed:.1e} √(gH)");
    }
}

/// The thesis's tank of 1500 particles, here 1600: within 0.1 % of hydrostatic at rest, with the inner loop soon. What [6] costs:
/// momentum is open by two per cent, which the modern solver closes to rounding.
#[test]
fn the_tank_carries_its_weight() {
    for (sets, end, most) in [(vec![SOLVER, ONE_PASS], 0.3, 1e-3), (vec![SOLVER], 0.075, 5e-4)] {
        let mut tank = system("hydrostatic_tank", &sets);
        advance(&mut tank, 1e-9);
        let first = pressure_error(&tank);
        let steps = advance(&mut tank, end);
        let (error, speed, open) = (pressure_error(&tank), speed(&tank, 1.0), tank.momentum_audit().worst);
        let t = tank.fluid.scheme::<Thesis>().expect("the thesis's projection");
        let each = t.iterations as f64 / t.solutions as f64;
        println!(
            "{sets:?}: {:.3} % at first, {:.4} % at {end} s, {speed:.1e} √(gH); a step of {:.1} solutions of {each:.0} \
             iterations; momentum open by {open:.1e}",
            100.0 * first,
            100.0 * error,
            t.solutions as f64 / f64::from(steps + 1)
        );
        assert!(error < most, "{sets:?}: {:.3} %", 100.0 * error);
        assert!(speed < 1e-3, "{sets:?}: {speed:.1e} √(gH)");
        assert!(open < 0.05, "{sets:?}: momentum open by {open:.1e}");
    }
}

/// Half of the tank next to a plane of symmetry is the tank.
#[test]
fn half_a_tank_is_a_tank() {
    let mut tank = system("hydrostatic_tank", &[SOLVER, ONE_PASS, "symmetry=x", "resolution.spacing=0.05"]);
    advance(&mut tank, 1.0);
    let error = pressure_error(&tank);
    assert!(error < 2e-3, "{:.3} %", 100.0 * error);
}

/// A tank out of equilibrium: its first sloshing mode, ω² = g k tanh(k H), k = π/L, is 3 % too fast with the thesis's h = Δx
/// at any spacing: LE26 makes the gradient exact on the lattice, not on one that is strained.
#[test]
fn a_tank_out_of_equilibrium_sloshes() {
    for (set, from, to) in [
        (&[][..], -0.04, -0.015),
        (&["resolution.spacing=0.05"], -0.05, -0.02),
        (&["resolution.spacing=0.05", "fluid.smoothing_ratio=1.25"], -0.04, 0.02),
    ] {
        let mut tank =
            system("hydrostatic_tank", &[&[SOLVER, ONE_PASS, "fluid.smoothing_ratio=1.0"][..], set].concat());
        let k = std::f64::consts::PI;
        let omega = (9.81 * k * k.tanh()).sqrt();
        let p = tank.fluid.particles_mut();
        for i in 0..p.len() {
            let (x, y) = (k * (p.x[i] + 0.5), k * (p.y[i] + 1.0));
            p.u[i] = 0.02 * x.sin() * y.cosh() / k.sinh();
            p.v[i] = -0.02 * x.cos() * y.sinh() / k.sinh();
        }
        let momentum = |s: &Coupled| -> f64 { s.fluid.particles().u.iter().sum() };
        let (mut before, mut crossings) = ([0.0, momentum(&tank)], Vec::new());
        while crossings.len() < 2 {
            let dt = tank.stable_dt().expect("a step");
            tank.step(dt).expect("the thesis's case runs");
            let now = [tank.fluid.time(), momentum(&tank)];
            assert!(now[0] < 2.0, "{set:?}: crossings at {crossings:?} s");
            if before[1] * now[1] < 0.0 {
                crossings.push(before[0] + (now[0] - before[0]) * before[1] / (before[1] - now[1]));
            }
            before = now;
        }
        let error = (crossings[1] - crossings[0]) * omega / k - 1.0;
        println!("{set:?}: period {:+.2} %", 100.0 * error);
        assert!((from..to).contains(&error), "{set:?}: period {:+.2} %", 100.0 * error);
    }
}

/// The same bits with one thread and with two.
#[test]
fn threads_do_not_change_a_bit_of_the_thesiss_projection() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let mut tank = system("hydrostatic_tank", &[SOLVER, "resolution.spacing=0.05"]);
            advance(&mut tank, 0.02);
            let p = tank.fluid.particles();
            (p.x.clone(), p.y.clone(), tank.fluid.fields().pressure.clone())
        })
    };
    assert_eq!(run(1), run(2));
}
