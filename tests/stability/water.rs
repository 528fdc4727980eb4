//! Failures of the fluid by itself: too long a step, cells that grow too fast, tension in spray, particles that circle in a splash.

use evidence::parameters::Parameters;
use evidence::systems::{advance, system, take};
use sph_core::wcsph::Wcsph;
use sph_core::{Breakdown, Seed, Walls};

/// The acoustic step limit Δt ≤ C h/(c₀ + |v|) (THEORY WC12). Failure: with C = 1.5 the impact breaks down within a
/// hundred steps, and says which particle, where and when. Remedy: C = 0.6.
#[test]
fn a_step_above_the_acoustic_limit_breaks_down() {
    let entry = |cfl: f64| {
        let mut system =
            system("wedge_constant", &["resolution.spacing=0.1", "time.start=0", "fluid.acoustic_steps=1"]);
        system.fluid.scheme_mut::<Wcsph>().expect("the default scheme").settings.cfl = cfl.into();
        system
    };
    let error = take(&mut entry(1.5), 100).expect_err("C = 1.5 ran").to_string();
    assert!(error.contains("particle") && error.contains("at t ="), "{error}");
    take(&mut entry(0.6), 100).expect("C = 0.6 runs");
}

/// Mean kinetic energy of a tank of still water from 1.5 to 2 s [J/m].
fn kinetic_energy(sets: &[&str]) -> f64 {
    let fine_zone = "resolution.fine_zone=[0.2, 0.2]";
    let mut tank = system("hydrostatic_tank", &[&["resolution.spacing=0.025", fine_zone], sets].concat());
    let mut kinetic = Vec::new();
    advance(&mut tank, 2.0, |s| {
        if s.fluid.time() > 1.5 {
            kinetic.push(s.fluid_energy().kinetic);
        }
    })
    .expect("a stable run");
    evidence::statistics::mean(&kinetic)
}

/// Where neighbours differ in size, p_a + p_b does not balance gravity exactly. Failure: water that does not start level, here by 0.1
/// mm, is not held (THEORY WC28), and with cells that grow by 15 % a layer it moves at some centimetres a second. Remedies: a growth of 5 %;
/// a level surface.
#[test]
fn water_graded_by_fifteen_percent_that_does_not_start_level_moves() {
    let not_level = ["resolution.growth=1.15", "tank.surface_amplitude=0.0001"];
    let (fast, slow) = (kinetic_energy(&not_level), kinetic_energy(&["resolution.growth=1.05", not_level[1]]));
    let level = kinetic_energy(&not_level[..1]);
    println!("{fast:.3e} J/m with 15 % a layer, {slow:.3e} J/m with 5 %, {level:.3e} J/m level");
    assert!(fast > 5.0 * slow && fast > 5.0 * level, "{fast:.3e}, {slow:.3e}, {level:.3e} J/m");
}

/// Pressures of a square block of water that is stretched to a tension of 100 Pa, by identity.
fn stretched(side: usize, parameters: Parameters) -> Vec<f64> {
    let at = |k: usize| [0.05 * (k % side) as f64, 0.05 * (k / side) as f64];
    let seed = |k: usize| Seed { at: at(k), velocity: [0.0; 2], area: 0.0025, pressure: 0.0 };
    let mut fluid = parameters.fluid(&(0..side * side).map(seed).collect::<Vec<_>>());
    let mut walls = Walls::default();
    // the first pass counts neighbours, the second acts on what it found
    fluid.initialise(&mut walls).expect("water at rest");
    fluid.particles_mut().rho.fill(parameters.eos.density(-100.0));
    fluid.initialise(&mut walls).expect("water at rest");
    let mut pressures = vec![0.0; side * side];
    fluid.particles().id.iter().zip(&fluid.fields().pressure).for_each(|(&id, &p)| pressures[id as usize] = p);
    pressures
}

/// Water holds tension, which suction under a hull needs. Failure it would cause in spray: films cling to walls and
/// creep along them. Remedy: a particle whose neighbourhood is less than half full of fluid holds none.
#[test]
fn spray_holds_no_tension_and_water_does() {
    let parameters = Parameters::of(&system("hydrostatic_tank", &["resolution.spacing=0.25"]).fluid);
    let lone = stretched(1, parameters)[0];
    assert!((0.0..1e-6).contains(&lone), "a lone particle at {lone} Pa");
    let block = stretched(9, parameters);
    assert!((block[40] / -100.0 - 1.0).abs() < 1e-6, "the middle of a block at {} Pa", block[40]);
}

/// A density that no weakly compressible flow has is a breakdown with its numbers, not a result.
#[test]
fn an_absurd_density_is_reported_with_place_and_time() {
    let parameters = Parameters::of(&system("hydrostatic_tank", &["resolution.spacing=0.25"]).fluid);
    let crushed = parameters.eos.pressure(1.4 * parameters.eos.rho0);
    let seed = Seed { at: [0.5, -0.25], velocity: [0.0; 2], area: 0.01, pressure: crushed };
    let error = parameters.fluid(&[seed]).initialise(&mut Walls::default()).expect_err("a crushed particle");
    let Breakdown::Density { id, x, y, rho, time } = error else { panic!("{error}") };
    assert_eq!((id, x, y, time), (0, 0.5, -0.25, 0.0));
    assert!((rho - 1400.0).abs() < 1e-6, "{rho} kg/m^3");
}

/// A splash over a baffle, whose particles circle about each other while geometry is held for eight acoustic steps (THEORY WC22).
/// Failure: with the forces of the geometry before, they gain energy in each turn, and water is torn to 0.7 of its density at 0.2 s.
/// Remedy: forces are computed again when geometry is.
#[test]
fn circling_particles_gain_no_energy_from_held_geometry() {
    let mut dam = system("dam_break_baffle", &["fluid.acoustic_steps=8"]);
    advance(&mut dam, 0.21, |_| {}).expect("water that keeps its density");
    let least = dam.fluid.particles().rho.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(least > 850.0, "{least} kg/m^3");
}
