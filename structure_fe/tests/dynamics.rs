//! Motion in time: frequencies, energy, momentum, supports that move, and a step that can be redone.

mod common;

use approx::assert_relative_eq;
use common::{
    LENGTH, MATERIAL, beam, beam_at, bending_stiffness, exact_frequency, frequency_in_time, none, number, supports,
    table,
};
use structure_fe::{
    Beam, Damping, Dof, Dynamics, Error, Integration, Loads, Material, Section, State, Statics, SupportMotion,
    Supports, Theory, natural_modes,
};

const TRAPEZOIDAL: Integration = Integration::GeneralisedAlpha { spectral_radius: 1.0 };
const DAMPED: Integration = Integration::GeneralisedAlpha { spectral_radius: 0.8 };

#[test]
fn a_cantilever_swings_at_its_exact_frequencies() {
    for mode in 0..3 {
        let root = number(&table("beam_frequency_roots")[mode], "cantilever");
        let ours = frequency_in_time(TRAPEZOIDAL, mode, 32, 400.0);
        let error = ours / exact_frequency(root) - 1.0;
        println!("mode {}: {error:e}", mode + 1);
        assert!(error.abs() < 1e-3, "mode {}: {error:e}", mode + 1);
    }
    // Lumped and explicit: second order in the mesh.
    let root = number(&table("beam_frequency_roots")[0], "cantilever");
    let error = frequency_in_time(Integration::CentralDifference, 0, 32, 400.0) / exact_frequency(root) - 1.0;
    println!("explicit, mode 1: {error:e}");
    assert!(error.abs() < 2e-3, "{error:e}");
}

/// A light cantilever with a point mass: omega^2 = 3 EI/(L^3 (M + 33/140 m)) (Rayleigh 1877, to 1e-4 where M >> m).
#[test]
fn a_point_mass_swings_on_its_beam() {
    let elements = 8;
    let mass = 20.0 * beam(elements).mass();
    let heavy = beam(elements).with_point_mass(elements, mass, 0.0).unwrap();
    let mode = &natural_modes(&heavy, &supports("cantilever", elements), 1).unwrap()[0];
    let exact = 3.0 * bending_stiffness() / (LENGTH.powi(3) * (mass + 33.0 / 140.0 * mass / 20.0));
    assert_relative_eq!(mode.angular_frequency.powi(2), exact, max_relative = 1e-4);
    assert_relative_eq!(heavy.mass(), 1.05 * mass, max_relative = 1e-12);
    // And it falls freely with the rest: total momentum grows by weight times time.
    let mut dynamics = Dynamics::new(heavy, Supports::default(), TRAPEZOIDAL, Damping::default()).unwrap();
    let mut load = none(elements + 1);
    load[elements] = [0.0, -10.0, 0.0];
    let mut state = dynamics.at_rest();
    dynamics.equilibrate(&mut state, &load).unwrap();
    for _ in 0..50 {
        dynamics.step(&mut state, &load, 1e-3).unwrap();
    }
    assert_relative_eq!(dynamics.momentum(&state)[1], -10.0 * 0.05, max_relative = 1e-6);
}

/// Simply supported Timoshenko beam (Huang 1961): rho I/(kappa G) omega^4 - (A + (I + E I/(kappa G)) k^2) omega^2
/// + (E I/rho) k^4 = 0, all over rho, with k = n pi/L.
#[test]
fn thick_beams_have_timoshenkos_frequencies() {
    let length = 1.0;
    let section = Section::rectangular(0.2, 0.1);
    let (e, rho) = (MATERIAL.youngs_modulus, MATERIAL.density);
    let shear = 5.0 / 6.0 * e / (2.0 * (1.0 + MATERIAL.poissons_ratio));
    let (area, second) = (section.area(), section.second_moment());
    let errors = [16, 32].map(|elements| {
        let beam = Beam::straight([0.0, 0.0], [length, 0.0], elements, MATERIAL, section).unwrap();
        let beam = beam.with_theory(Theory::TIMOSHENKO).unwrap().with_rotatory_inertia().unwrap();
        let mut held = Supports::default();
        held.pin(0).pin(elements);
        let modes = natural_modes(&beam, &held, 8).unwrap();
        [1.0, 2.0, 3.0].map(|n| {
            let k = n * std::f64::consts::PI / length;
            let (a, b, c) =
                (rho * second / shear, -(area + (second + e * second / shear) * k * k), e * second / rho * k.powi(4));
            let exact = ((-b - (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)).sqrt();
            assert!(exact < 0.96 * k * k * (e * second / (rho * area)).sqrt(), "shear matters here");
            let errors = modes.iter().map(|mode| mode.angular_frequency / exact - 1.0);
            errors.min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap()
        })
    });
    println!("modes 1 to 3, 16 and 32 elements: {errors:?}");
    for (coarse, fine) in errors[0].iter().zip(errors[1]) {
        let order = (coarse / fine).log2();
        assert!(fine > 0.0 && fine < 2e-3 && order > 1.9, "{fine:e}, order {order}");
    }
}

/// A soft beam pinned at one end, let go from the horizontal.
fn pendulum(integration: Integration, damping: Damping) -> (Dynamics, Vec<[f64; 3]>, State) {
    let elements = 16;
    let rubber = Material { youngs_modulus: 5e6, poissons_ratio: 0.45, density: 1100.0 };
    let beam = Beam::straight([0.0, 0.0], [1.0, 0.0], elements, rubber, Section::strip(0.03)).unwrap();
    let mut loads = Loads::default();
    let weight = -9.81 * beam.mass();
    for element in 0..elements {
        loads.along_element(element, [0.0, weight], [0.0, weight]);
    }
    let load = loads.at_nodes(&beam, &none(elements + 1)).unwrap();
    let mut held = Supports::default();
    held.pin(0);
    let mut dynamics = Dynamics::new(beam, held, integration, damping).unwrap();
    let mut state = dynamics.at_rest();
    dynamics.equilibrate(&mut state, &load).unwrap();
    (dynamics, load, state)
}

fn work(load: &[[f64; 3]], state: &State) -> f64 {
    load.as_flattened().iter().zip(state.displacement.as_flattened()).map(|(f, u)| f * u).sum()
}

/// Largest error of the energy over three seconds, as a fraction of the largest kinetic energy.
fn energy_error(integration: Integration, dt: f64) -> Result<f64, Error> {
    let (mut dynamics, load, mut state) = pendulum(integration, Damping::default());
    let (mut worst, mut most): (f64, f64) = (0.0, 0.0);
    for _ in 0..(3.0 / dt) as usize {
        dynamics.step(&mut state, &load, dt)?;
        let kinetic = dynamics.kinetic_energy(&state);
        let sum = kinetic + dynamics.strain_energy(&state) - work(&load, &state);
        worst = worst.max(sum.abs());
        most = most.max(kinetic);
    }
    Ok(worst / most)
}

#[test]
fn a_free_swinging_beam_keeps_its_energy() {
    let errors = [1e-3, 5e-4].map(|dt| energy_error(TRAPEZOIDAL, dt).unwrap());
    println!("trapezoidal, steps of 1 and 0.5 ms: {errors:?}");
    assert!(errors[1] < 1e-3, "{errors:?}");
    let (dynamics, ..) = pendulum(Integration::CentralDifference, Damping::default());
    let explicit = energy_error(Integration::CentralDifference, 0.5 * dynamics.stable_dt()).unwrap();
    println!("central differences, half the stable step of {:e} s: {explicit:e}", dynamics.stable_dt());
    assert!(explicit < 1e-3, "{explicit:e}");
}

/// Two bars, pinned and hinged to each other: a double pendulum keeps its energy, and its hinge holds.
#[test]
fn a_double_pendulum_keeps_its_energy_and_its_hinge() {
    let rubber = Material { youngs_modulus: 5e6, poissons_ratio: 0.45, density: 1100.0 };
    let nodes: Vec<[f64; 2]> = [0.0, 0.25, 0.5, 0.5, 0.75, 1.0].map(|x| [x, 0.0]).to_vec();
    let beam = Beam::uniform(nodes, &[[0, 1], [1, 2], [3, 4], [4, 5]], rubber, Section::strip(0.05)).unwrap();
    let mut loads = Loads::default();
    let weight = -9.81 * beam.mass();
    for element in 0..4 {
        loads.along_element(element, [0.0, weight], [0.0, weight]);
    }
    let load = loads.at_nodes(&beam, &none(6)).unwrap();
    let mut held = Supports::default();
    held.pin(0).hinge(2, 3);
    let mut dynamics = Dynamics::new(beam, held, TRAPEZOIDAL, Damping::default()).unwrap();
    let mut state = dynamics.at_rest();
    dynamics.equilibrate(&mut state, &load).unwrap();
    let (mut worst, mut most, mut bend): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for _ in 0..2000 {
        dynamics.step(&mut state, &load, 5e-4).unwrap();
        let kinetic = dynamics.kinetic_energy(&state);
        worst = worst.max((kinetic + dynamics.strain_energy(&state) - work(&load, &state)).abs());
        most = most.max(kinetic);
        bend = bend.max((state.displacement[2][2] - state.displacement[3][2]).abs());
        assert_eq!(state.displacement[2][..2], state.displacement[3][..2]);
    }
    println!("double pendulum: energy {:e}, hinge opened by {bend} rad", worst / most);
    assert!(worst < 2e-3 * most, "{worst} of {most}");
    assert!(bend > 0.5, "the hinge turns: {bend}");
}

/// A free beam thrown with spin and bent: nothing from outside, momenta stay.
#[test]
fn a_thrown_beam_keeps_its_momentum() {
    let elements = 12;
    let rubber = Material { youngs_modulus: 5e6, poissons_ratio: 0.45, density: 1100.0 };
    for (integration, allowed) in [(TRAPEZOIDAL, 2e-4), (Integration::CentralDifference, 1e-11)] {
        let beam = Beam::straight([0.3, -0.2], [1.1, 0.4], elements, rubber, Section::strip(0.03)).unwrap();
        let places = beam.nodes().to_vec();
        let mut dynamics = Dynamics::new(beam, Supports::default(), integration, Damping::default()).unwrap();
        let load = none(elements + 1);
        let mut state = dynamics.at_rest();
        for (node, v) in state.velocity.iter_mut().enumerate() {
            let [x, y] = places[node];
            // Rigid, with a bending on top.
            let bend = (node as f64 / elements as f64 * std::f64::consts::PI).sin();
            *v = [2.0 - 6.0 * y, 1.0 + 6.0 * x + 3.0 * bend, 6.0];
        }
        dynamics.equilibrate(&mut state, &load).unwrap();
        let before = dynamics.momentum(&state);
        let energy = dynamics.kinetic_energy(&state);
        let dt = dynamics.stable_dt().min(1e-3) * 0.5;
        for _ in 0..(1.0 / dt) as usize {
            dynamics.step(&mut state, &load, dt).unwrap();
        }
        let after = dynamics.momentum(&state);
        let scale = before.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let drift = before.iter().zip(after).map(|(b, a)| (a - b).abs() / scale).fold(0.0, f64::max);
        let total = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state);
        println!(
            "{integration:?}: momentum {drift:e}, energy {:e}, turned by {}",
            total / energy - 1.0,
            state.displacement[0][2]
        );
        assert!(drift < allowed, "{integration:?}: {drift:e}");
        assert!((total / energy - 1.0).abs() < 1e-3);
    }
}

/// A cantilever whose root is moved as a whole follows; reactions carry the load and the inertia.
#[test]
fn supports_move_as_prescribed() {
    let elements = 8;
    // The explicit damping force lags by half a step, so its reactions are exact to that order only.
    for (integration, stiffness) in [(TRAPEZOIDAL, 1e-5), (DAMPED, 1e-5), (Integration::CentralDifference, 0.0)] {
        let damping = Damping { mass: 0.0, stiffness };
        let mut dynamics =
            Dynamics::new(beam(elements), supports("cantilever", elements), integration, damping).unwrap();
        let mass = dynamics.beam().mass();
        let load = none(elements + 1);
        let mut state = dynamics.at_rest();
        let dt = (0.9 * dynamics.stable_dt()).min(1e-3);
        // From rest at constant acceleration: what comes in through the support is the beam's momentum.
        let a = 3.0;
        let at = |t: f64| SupportMotion { displacement: 0.5 * a * t * t, velocity: a * t, acceleration: a };
        dynamics.prescribe(0, Dof::U, at(0.0)).unwrap();
        dynamics.equilibrate(&mut state, &load).unwrap();
        let mut impulse = 0.5 * dt * dynamics.reactions(&state, &load)[0][0];
        for _ in 0..1000 {
            dynamics.prescribe(0, Dof::U, at(state.time + dt)).unwrap();
            dynamics.step(&mut state, &load, dt).unwrap();
            impulse += dt * dynamics.reactions(&state, &load)[0][0];
        }
        impulse -= 0.5 * dt * dynamics.reactions(&state, &load)[0][0];
        let [momentum, ..] = dynamics.momentum(&state);
        println!("{integration:?}: impulse {impulse}, momentum {momentum}, rigid {}", mass * a * state.time);
        assert_relative_eq!(impulse, momentum, max_relative = 1e-3);
        assert_relative_eq!(momentum, mass * a * state.time, max_relative = 0.02);
        assert_relative_eq!(state.displacement[0][0], 0.5 * a * state.time.powi(2), max_relative = 1e-12);
        let error = dynamics.prescribe(elements, Dof::W, SupportMotion::default()).unwrap_err();
        assert_eq!(error, Error::NotSupported { node: elements, dof: Dof::W });
    }
}

/// Damped to rest, a beam hangs where statics say, and its reactions and section forces are theirs.
#[test]
fn damped_motion_ends_in_static_equilibrium() {
    let elements = 8;
    let mut loads = Loads::default();
    loads.at_node(elements, [0.0, -1.0, 0.0]);
    let held = supports("cantilever", elements);
    let exact = Statics::new(beam(elements), held.clone()).unwrap().solve(&loads).unwrap();
    let load = loads.at_nodes(&beam(elements), &none(elements + 1)).unwrap();
    let damping = Damping { mass: 40.0, stiffness: 1e-3 };
    let mut dynamics = Dynamics::new(beam(elements), held, DAMPED, damping).unwrap();
    let mut state = dynamics.at_rest();
    dynamics.equilibrate(&mut state, &load).unwrap();
    for _ in 0..400 {
        dynamics.step(&mut state, &load, 5e-3).unwrap();
    }
    assert_relative_eq!(state.displacement[elements][1], exact.displacement[elements][1], max_relative = 1e-6);
    assert_relative_eq!(dynamics.reactions(&state, &load)[0][2], exact.reactions[0][2], max_relative = 1e-6);
    let ends = dynamics.section_forces(&state);
    assert_eq!(ends.len(), 2 * elements);
    assert_relative_eq!(ends[0].moment, exact.section_forces[0][0].moment, max_relative = 1e-6);
    assert_relative_eq!(ends[2 * elements - 1].shear, exact.section_forces[elements - 1][1].shear, max_relative = 1e-6);
}

#[test]
fn a_step_can_be_redone_to_the_same_bits_and_errors_change_nothing() {
    let (mut dynamics, load, mut state) = pendulum(DAMPED, Damping { mass: 0.1, stiffness: 1e-4 });
    for _ in 0..20 {
        dynamics.step(&mut state, &load, 2e-3).unwrap();
    }
    let saved = state.clone();
    dynamics.step(&mut state, &load, 5e-3).unwrap();
    let mut again = saved.clone();
    dynamics.step(&mut again, &load, 1e-3).unwrap();
    again = saved.clone();
    dynamics.step(&mut again, &load, 5e-3).unwrap();
    assert_eq!(state, again);

    for bad in [0.0, -1e-3, f64::NAN] {
        assert!(matches!(dynamics.step(&mut state, &load, bad), Err(Error::OutOfRange { .. })));
    }
    let mut wrong = load.clone();
    wrong[3][1] = f64::NAN;
    assert!(matches!(dynamics.step(&mut state, &wrong, 1e-3), Err(Error::BadProperty { index: 3, .. })));
    assert!(matches!(
        dynamics.step(&mut state, &load[1..], 1e-3),
        Err(Error::WrongLength { given: 16, expected: 17, .. })
    ));
    wrong[3][1] = 1e200;
    let error = dynamics.step(&mut state, &wrong, 1e-3).unwrap_err();
    println!("{error}");
    assert!(matches!(error, Error::StepNotConverged { dt: 1e-3, .. }), "{error}");
    assert_eq!(state, again);
}

#[test]
fn integration_and_damping_must_make_sense() {
    let build = |integration, damping| Dynamics::new(beam_at(0.3, 2), supports("cantilever", 2), integration, damping);
    for spectral_radius in [-0.1, 1.1, f64::NAN] {
        let error = build(Integration::GeneralisedAlpha { spectral_radius }, Damping::default()).unwrap_err();
        assert!(matches!(error, Error::OutOfRange { expected: "[0, 1]", .. }), "{error}");
    }
    for damping in [Damping { mass: -1.0, stiffness: 0.0 }, Damping { mass: 0.0, stiffness: f64::NAN }] {
        assert!(matches!(build(TRAPEZOIDAL, damping), Err(Error::OutOfRange { .. })));
    }
    assert_eq!(build(TRAPEZOIDAL, Damping::default()).unwrap().stable_dt(), f64::INFINITY);
}
