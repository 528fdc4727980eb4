//! Where the thesis's projection fails (THEORY LE1): its author's dead ends, and where the thesis ended. The remedy of each is
//! the default; that of the last three is `solver = "incompressible"`.

use evidence::systems::{of_text, scene, system};
use fsi_coupling::{Coupled, CouplingError};
use run::{self, RunOptions};
use scene::vocabulary::Status;
use sph_core::Breakdown;

/// ρ g [Pa/m] of every scene.
const WEIGHT: f64 = 1000.0 * 9.81;
/// The solver by its name in a scene.
const SOLVER: &str = "solver=incompressible_thesis";
/// A single pass of the corrector, as the thesis had it before its inner loop.
const ONE_PASS: &str = "thesis.inner_passes=1";

/// Largest error of a particle's pressure against ρ g times its depth below the top layer over that of the lowest [-].
fn pressure_error(system: &Coupled) -> f64 {
    let p = system.fluid.particles();
    let [top, floor] = [p.y.iter().copied().fold(f64::MIN, f64::max), p.y.iter().copied().fold(f64::MAX, f64::min)];
    let of = |k: usize| (system.fluid.fields().pressure[k] - WEIGHT * (top - p.y[k])).abs();
    (0..p.len()).map(of).fold(0.0, f64::max) / (WEIGHT * (top - floor))
}

/// The thesis's column of 16 layers, four particles wide, between walls.
fn column(sets: &[&str]) -> Coupled {
    let text =
        "name = \"column\"\n[time]\nend = 10.0\n[resolution]\nspacing = 0.05\n[tank]\nwidth = 0.2\ndepth = 0.8\n";
    of_text(text, &[&[SOLVER], sets].concat())
}

/// One stable step.
fn step(system: &mut Coupled) -> Result<(), CouplingError> {
    let dt = system.stable_dt()?;
    system.step(dt)
}

/// Stable steps until `end` [s].
fn advance(system: &mut Coupled, end: f64) -> Result<(), CouplingError> {
    while system.fluid.time() < end {
        step(system)?;
    }
    Ok(())
}

/// Breaks down before `end` [s], after `from` [s] at the earliest; says how.
fn breaks_down(what: &str, system: &mut Coupled, from: f64, end: f64) -> CouplingError {
    let error = advance(system, end).expect_err(what);
    println!("{what}: {error}");
    assert!(system.fluid.time() > from, "{what}: {error}");
    error
}

/// Failure: masses from W m = ρ₀ (LE28) are negative where kernels are wide, and whatever they are, water at rest flies
/// apart within a quarter of a second. Remedy: one mass, and what is lacking stored (LE18, LE19).
#[test]
fn masses_that_give_every_particle_its_density_are_negative() {
    let inverse = |sets: &[&str]| column(&[&["thesis.masses=inverse"], sets].concat());
    let least = |s: &Coupled| s.fluid.particles().mass.iter().copied().fold(f64::INFINITY, f64::min);
    for (sets, below) in [
        (["fluid.kernel=cubic_spline", "fluid.smoothing_ratio=1.5"], -1.0),
        (["fluid.kernel=wendland_c2", "fluid.smoothing_ratio=2.0"], -0.3),
    ] {
        let mut system = inverse(&sets);
        assert!(least(&system) < below, "{sets:?}: {} kg/m", least(&system));
        breaks_down(&format!("{sets:?}"), &mut system, 0.01, 0.25);
    }
    // worse, and the pressure equation has no solution that Bi-CGSTAB finds
    let mut wide = inverse(&["fluid.kernel=cubic_spline", "fluid.smoothing_ratio=2.0"]);
    assert!(least(&wide) < -20.0, "{} kg/m", least(&wide));
    let error = step(&mut wide).expect_err("a solution");
    assert!(matches!(error, CouplingError::Fluid(Breakdown::Poisson { .. })), "{error}");
    // narrow kernels have positive masses, which do not help
    let mut narrow = inverse(&[]);
    assert!(least(&narrow) > 0.0, "{} kg/m", least(&narrow));
    let ended = advance(&mut narrow, 0.5);
    println!("narrow: {ended:?}, {:.2} %", 100.0 * pressure_error(&narrow));
    assert!(ended.is_err() || pressure_error(&narrow) > 0.02, "{:.2e}", pressure_error(&narrow));
    // the remedy
    let mut remedy = column(&[]);
    advance(&mut remedy, 0.5).expect("one mass");
    assert!(least(&remedy) > 0.0 && pressure_error(&remedy) < 1e-3, "{:.2e}", pressure_error(&remedy));
}

/// Failure: limit layers of zero gradient (LE28) give half the pressure at the first step, and break down within half a second.
/// Remedy: the Poisson equation on them.
#[test]
fn zero_gradient_at_limit_particles_halves_the_pressure_and_diverges() {
    let mut system = column(&["thesis.limit_rows=zero_gradient", ONE_PASS]);
    step(&mut system).expect("a first step");
    let error = pressure_error(&system);
    assert!((error - 0.5).abs() < 0.02, "{:.1} % of the pressure", 100.0 * error);
    breaks_down("zero gradient, one pass", &mut system, 0.1, 0.6);
    breaks_down("zero gradient", &mut column(&["thesis.limit_rows=zero_gradient"]), 0.1, 0.7);
}

/// Failure: a predictor with the old pressure (LE28) diverges whatever the step. Remedy: a predictor of gravity alone.
#[test]
fn a_predictor_with_the_old_pressure_diverges() {
    breaks_down("old pressure", &mut column(&["thesis.predictor=old_pressure"]), 0.01, 0.5);
    breaks_down("old pressure, one pass", &mut column(&["thesis.predictor=old_pressure", ONE_PASS]), 0.01, 0.5);
    let mut small = column(&["thesis.predictor=old_pressure", ONE_PASS]);
    let ended = (0..300).try_for_each(|_| small.step(1e-3));
    assert!(ended.is_err(), "steps of 1 ms end with {:.2e}", pressure_error(&small));
    assert!(small.fluid.time() > 0.01, "{ended:?}");
}

/// Failure: side walls that do not follow the predictor change the density next to them: a third of the pressure at the
/// first step, and as much for ever where the inner loop is left to come and go at 1e-3 of the density. At rest a single pass
/// and a tight loop remove most of it: the columns next to the wall settle where their density is right. Remedy: LE21.
#[test]
fn side_walls_without_freedom_give_wrong_densities() {
    let error = |sets: &[&str]| {
        let mut system = column(sets);
        step(&mut system).expect("a first step");
        let first = pressure_error(&system);
        advance(&mut system, 2.0).expect("still water");
        [first, pressure_error(&system)]
    };
    const HELD: &str = "thesis.side_freedom=false";
    const COARSE: &str = "thesis.density_tolerance=1e-3";
    let (held, free) = (error(&[HELD, COARSE]), error(&[COARSE]));
    let (held_once, free_once) = (error(&[HELD, ONE_PASS]), error(&[ONE_PASS]));
    let (held_tight, free_tight) = (error(&[HELD]), error(&[]));
    println!("coarse {held:?} {free:?}, one pass {held_once:?} {free_once:?}, tight {held_tight:?} {free_tight:?}");
    assert!(held[0] > 0.2 && held[1] > 0.1, "held {held:?}");
    assert!(free[0] < 0.03 && free[1] < 0.05, "free {free:?}");
    assert!(held_once[0] > 0.2 && free_once[0] < 0.03, "one pass: held {held_once:?}, free {free_once:?}");
    assert!(held_tight[1] > 2.0 * free_tight[1], "tight: held {held_tight:?}, free {free_tight:?}");
}

/// Failure: without LE26 the pressure at rest depends on h. Remedy: the gradient correction.
#[test]
fn without_gradient_correction_the_pressure_depends_on_h() {
    let floor = |sets: &[&str]| {
        let mut system = column(sets);
        advance(&mut system, 0.5).expect("still water");
        system.fluid.fields().pressure.iter().copied().fold(0.0, f64::max) / (WEIGHT * 0.75)
    };
    for (ratio, off) in [("fluid.smoothing_ratio=1.0", 0.063), ("fluid.smoothing_ratio=1.25", 0.049)] {
        let [raw, corrected] = [floor(&["thesis.gradient_correction=false", ratio]) - 1.0, floor(&[ratio]) - 1.0];
        println!("{ratio}: {raw:.4} {corrected:.4}");
        assert!((raw - off).abs() < 0.01, "{ratio}: {:.2} % without", 100.0 * raw);
        assert!(corrected.abs() < 3e-3, "{ratio}: {:.2} % with", 100.0 * corrected);
    }
}

/// Failure: with a support beyond the thesis's the surface, whose layers are not solved, falls into disorder, and still water
/// breaks down. Remedy: h ≤ 1.25 Δx, or another solver.
#[test]
fn the_surface_holds_only_with_a_narrow_kernel() {
    breaks_down("h = 1.5 dx", &mut column(&["fluid.smoothing_ratio=1.5"]), 1.0, 10.0);
    breaks_down("h = 2 dx", &mut column(&["fluid.smoothing_ratio=2.0"]), 0.5, 3.0);
}

/// A body that falls at 1 m/s from above still water. Its limit particles, half a spacing inside, meet the supports of the top
/// layer, half a spacing below the surface, when its lowest point is a spacing, 0.025 m, above the surface: 2h = 2Δx.
fn falling(shape: &str) -> Coupled {
    let text = "name = \"fall\"\n[time]\nend = 1.0\n[resolution]\nspacing = 0.025\ngrowth = 1.0\n[tank]\nwidth = 1.0\n\
                depth = 0.5\n[body]\nname = \"fall\"\nmotion = \"constant_velocity\"\nvelocity = [0.0, -1.0]\n";
    of_text(&format!("{text}{shape}\n"), &[SOLVER])
}

/// Failure, and the thesis's end: "as soon as the structure is entering the surface particles' kernel support, the algorithm
/// breaks down". What is stored for the surface's densities (LE19) contains no body: its particles are density in excess, of
/// Δρ/(ρ Δt²), as soon as they are in the kernel.
#[test]
fn a_body_that_enters_the_surfaces_support_is_the_end() {
    for (name, shape, lowest) in [
        ("wedge", "shape = \"wedge\"\ndeadrise_deg = 30.0\nbreadth = 0.3\nposition = [0.0, 0.2]", 0.2),
        ("box", "shape = \"box\"\nbreadth = 0.3\nheight = 0.2\nposition = [0.0, 0.2]", 0.1),
    ] {
        let mut system = falling(shape);
        let (mut undisturbed, mut worst) = (0.0_f64, 0.0_f64);
        let error = loop {
            if let Err(error) = step(&mut system) {
                break error;
            }
            let above = lowest - system.fluid.time();
            if above > 0.03 {
                undisturbed = if system.fluid.time() < 0.01 { 0.0 } else { undisturbed.max(pressure_error(&system)) };
            } else {
                worst = worst.max(pressure_error(&system));
            }
            assert!(above > -0.1, "{name} is {above} m below the surface, pressures off by {worst:.2e}");
        };
        let above = lowest - system.fluid.time();
        println!("{name}: pressures off by {undisturbed:.2e} before, {worst:.2e} at {above:.4} m: {error}");
        assert!(undisturbed < 0.03, "{name}: off by {undisturbed:.2e} before the supports meet");
        assert!(worst > 10.0 && above < 0.025, "{name}: off by {worst:.2e}, {above} m above the surface");
    }
}

/// Failure: walls are as high as the water was (LE21). Water that rises above them has no wall next to it. Remedy: the other
/// solvers, whose walls are as high as the tank.
#[test]
fn water_that_rises_above_the_walls_is_lost() {
    let mut tank = system("hydrostatic_tank", &[SOLVER, ONE_PASS]);
    let k = std::f64::consts::PI;
    let p = tank.fluid.particles_mut();
    for i in 0..p.len() {
        let (x, y) = (k * (p.x[i] + 0.5), k * (p.y[i] + 1.0));
        p.u[i] = 0.05 * x.sin() * y.cosh() / k.sinh();
        p.v[i] = -0.05 * x.cos() * y.sinh() / k.sinh();
    }
    breaks_down("sloshing", &mut tank, 0.1, 1.0);
}

/// A pressure equation that is not solved says how far it got, and the run ends with what it has.
#[test]
fn a_pressure_equation_that_is_not_solved_is_reported() {
    let scene = scene("hydrostatic_tank", &[SOLVER, "thesis.most_iterations=3", "time.end=0.1"]);
    let outcome = run::run(&scene, &RunOptions::default()).expect("a scene that can be built");
    let message = outcome.summary.message.unwrap_or_default();
    assert_eq!(outcome.summary.status, Status::Failed, "{message}");
    for part in ["the pressure equation did not converge at t = 0", "after 3 iterations", "particle", "m"] {
        assert!(message.contains(part), "{message}");
    }
}
