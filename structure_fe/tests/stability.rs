//! Where methods fail, and what helps.

mod common;

use common::{beam, supports};
use structure_fe::{Beam, Damping, Dynamics, Error, Integration, Material, Section, State, Supports};

/// A cantilever hit at its tip, stepped at a share of the explicit limit: the largest energy in the second
/// half of the run over that in the first.
fn growth(share: f64, damping: Damping) -> Result<f64, Error> {
    let elements = 10;
    let held = supports("cantilever", elements);
    let mut dynamics = Dynamics::new(beam(elements), held, Integration::CentralDifference, damping)?;
    let mut state = dynamics.at_rest();
    state.velocity[elements] = [0.1, 0.1, 0.1];
    let load = vec![[0.0; 3]; elements + 1];
    dynamics.equilibrate(&mut state, &load)?;
    let dt = share * dynamics.stable_dt();
    let mut most = [0.0_f64; 2];
    for step in 0..4000 {
        dynamics.step(&mut state, &load, dt)?;
        let energy = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state);
        most[step / 2000] = most[step / 2000].max(energy);
    }
    Ok(most[1] / most[0])
}

/// Central differences are unstable beyond their step limit and stable below it, damped or not.
#[test]
fn the_explicit_step_has_a_limit_and_it_is_the_one_stated() {
    for damping in [Damping::default(), Damping { mass: 10.0, stiffness: 1e-5 }] {
        let within = growth(0.98, damping).unwrap();
        let beyond = growth(1.15, damping);
        println!("{damping:?}: growth of the energy {within} within the limit, {beyond:?} beyond");
        assert!(within < 1.2, "{within}");
        assert!(beyond.is_err() || beyond.unwrap() > 1e3);
    }
}

/// A stiff bar swung about its pinned end, at a step far longer than the period of its stretching.
fn swing(rule: Integration, dt: f64, turns: f64) -> Result<f64, Error> {
    let elements = 4;
    let steel = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };
    let bar = Beam::straight([0.0, 0.0], [1.0, 0.0], elements, steel, Section::rectangular(0.05, 0.05))?;
    let places = bar.nodes().to_vec();
    let mut held = Supports::default();
    held.pin(0);
    let mut dynamics = Dynamics::new(bar, held, rule, Damping::default())?;
    let mut state: State = dynamics.at_rest();
    let spin = 10.0;
    for (v, [x, y]) in state.velocity.iter_mut().zip(places) {
        *v = [-spin * y, spin * x, spin];
    }
    let load = vec![[0.0; 3]; elements + 1];
    dynamics.equilibrate(&mut state, &load)?;
    let first = dynamics.kinetic_energy(&state);
    let mut worst: f64 = 0.0;
    while state.time * spin < turns * std::f64::consts::TAU {
        dynamics.step(&mut state, &load, dt)?;
        let energy = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state);
        worst = worst.max((energy / first - 1.0).abs());
    }
    Ok(worst)
}

/// The trapezoidal rule is stable for linear models only: in rotation the stretching that it does not
/// resolve gains energy until nothing converges. A spectral radius below one damps just that.
#[test]
fn the_trapezoidal_rule_is_unstable_in_stiff_rotation_and_dissipation_cures_it() {
    let alpha = |spectral_radius: f64| Integration::GeneralisedAlpha { spectral_radius };
    for dt in [5e-3, 1e-2] {
        let trapezoidal = swing(alpha(1.0), dt, 20.0);
        let damped = swing(alpha(0.8), dt, 20.0);
        println!("steps of {dt} s: trapezoidal {trapezoidal:?}, rho = 0.8 {damped:?}");
        assert!(trapezoidal.is_err() || trapezoidal.unwrap() > 1.0);
        assert!(damped.unwrap() < 0.012);
    }
    // So does a step that resolves more of the rotation, for as long as is asked here.
    let short = swing(alpha(1.0), 5e-4, 20.0).unwrap();
    println!("trapezoidal, steps of 0.5 ms: {short}");
    assert!(short < 0.01);
}

/// In momentum form the same rule keeps the energy at steps of a twentieth, a tenth and a third of a radian, undamped:
/// its elastic forces do the work of the elastic energy.
#[test]
fn the_trapezoidal_rule_in_momentum_form_is_stable_in_stiff_rotation() {
    for dt in [5e-3, 1e-2, 3e-2] {
        let error = swing(Integration::Trapezoidal { spectral_radius: 1.0 }, dt, 20.0);
        println!("in momenta, steps of {dt} s: {error:?}");
        assert!(error.unwrap() < 1e-6);
    }
}
