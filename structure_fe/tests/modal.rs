//! A structure by its modes against exact motions, and against the finite elements that the modes are of.

use std::f64::consts::TAU;

use structure_fe::modal::{Frame, ModalMode, ModalState, ModalStructure, Step};
use structure_fe::{Beam, Damping, Dynamics, Integration, Material, Section, Supports, natural_modes};

const FREE: [bool; 3] = [false; 3];

/// A body with two masses that move on springs, one along and one across its axis, both away from its centre of mass.
fn two_masses() -> ModalStructure {
    let mode = |frequency: f64, mass: f64, shape: [[f64; 3]; 2]| ModalMode {
        frequency,
        mass,
        damping_ratio: 0.0,
        shape: shape.to_vec(),
    };
    let along = mode(3.0, 0.5, [[1.0, 0.3, 0.0], [0.0; 3]]);
    let across = mode(4.0, 0.9, [[0.2, 0.0, 0.0], [0.1, 1.0, 0.0]]);
    let frame = Frame { mass: 2.0, inertia: 0.4, center_of_mass: [-0.1, 0.05], held: FREE };
    ModalStructure::new(frame, vec![[0.6, 0.1], [-0.4, 0.3]], vec![0.4, 0.7], vec![along, across]).expect("a structure")
}

fn spinning(structure: &ModalStructure) -> ModalState {
    let mut state = structure.at_rest([0.2, -0.3], 0.4);
    state.velocity = vec![0.5, -0.2, 2.5, 0.3, -0.4];
    state.amplitude = vec![0.05, -0.03];
    state
}

fn fly(structure: &ModalStructure, dt: f64, steps: usize) -> ModalState {
    let (mut state, none) = (spinning(structure), [0.0; 5]);
    let step = Step { dt, gravity: [0.0; 2], frame: None };
    structure.equilibrate(&mut state, &none, [0.0; 2], dt).expect("a start");
    for _ in 0..steps {
        structure.step(&mut state, &none, &step).expect("a step");
    }
    state
}

/// A body that flies, turns and vibrates keeps its momentum to rounding and its energy to second order.
#[test]
fn free_flight_keeps_momentum_and_energy() {
    let structure = two_masses();
    let begun = spinning(&structure);
    let energy = |state: &ModalState| structure.kinetic_energy(state) + structure.strain_energy(state);
    let gain = |dt: f64, steps: usize| {
        let end = fly(&structure, dt, steps);
        let ([px, py], [qx, qy]) = (structure.momentum(&begun), structure.momentum(&end));
        assert!((px - qx).hypot(py - qy) < 1e-12 * px.hypot(py), "momentum {px} {py}, then {qx} {qy}");
        (energy(&end) - energy(&begun)).abs() / energy(&begun)
    };
    let [coarse, fine] = [gain(2e-3, 500), gain(1e-3, 1000)];
    assert!(coarse < 1e-3 && (3.0..5.0).contains(&(coarse / fine)), "{coarse} {fine}");
}

/// Halving the step quarters the error of place, angle and amplitudes.
#[test]
fn the_step_is_of_second_order() {
    let structure = two_masses();
    let values = |state: &ModalState| [&state.frame[..], &state.amplitude].concat();
    let [coarse, fine, finest] =
        [(4e-3, 250), (2e-3, 500), (1e-3, 1000)].map(|(dt, n)| values(&fly(&structure, dt, n)));
    for k in 0..5 {
        let ratio = (coarse[k] - fine[k]) / (fine[k] - finest[k]);
        assert!((3.5..4.5).contains(&ratio), "unknown {k}: {ratio}");
    }
}

/// In a frame that spins steadily a radial spring settles where it balances the centripetal force: q = ω² r/(ω_n² − ω²).
#[test]
fn a_spinning_spring_settles_where_theory_says() {
    let frame = Frame { mass: 0.0, inertia: 0.0, center_of_mass: [0.0; 2], held: [true; 3] };
    let mode = ModalMode { frequency: 5.0, mass: 0.8, damping_ratio: 0.2, shape: vec![[0.0, 1.0, 0.0]] };
    let structure = ModalStructure::new(frame, vec![[0.0, 0.5]], vec![0.8], vec![mode]).expect("a structure");
    let (mut state, spin, dt) = (structure.at_rest([0.0; 2], 0.0), 8.0, 1e-3);
    state.velocity[2] = spin;
    for k in 1..=4000 {
        let frame = Some([[0.0, 0.0, spin * dt * f64::from(k)], [0.0, 0.0, spin], [0.0; 3]]);
        structure.step(&mut state, &[0.0; 4], &Step { dt, gravity: [0.0; 2], frame }).expect("a step");
    }
    let exact = spin * spin * 0.5 / ((TAU * 5.0_f64).powi(2) - spin * spin);
    assert!((state.amplitude[0] / exact - 1.0).abs() < 1e-9, "{} {exact}", state.amplitude[0]);
}

/// All modes of a clamped strip move as its finite elements do, under a load that rises at once.
#[test]
fn all_modes_are_the_finite_elements() {
    let material = Material { youngs_modulus: 70e9, poissons_ratio: 0.3, density: 2700.0 };
    let beam = Beam::straight([0.0; 2], [0.6, 0.0], 6, material, Section::strip(0.004)).expect("a beam");
    let mut supports = Supports::default();
    supports.clamp(0).clamp(6);
    let modes = natural_modes(&beam, &supports, 15).expect("modes");
    let modal = |mode: &structure_fe::Mode| ModalMode {
        frequency: mode.angular_frequency / TAU,
        mass: 1.0,
        damping_ratio: 0.0,
        shape: mode.shape.clone(),
    };
    let frame = Frame { mass: 0.0, inertia: 0.0, center_of_mass: [0.0; 2], held: [true; 3] };
    let modes: Vec<ModalMode> = modes.iter().map(modal).collect();
    let structure = ModalStructure::new(frame, beam.nodes().to_vec(), vec![0.0; 7], modes).expect("a structure");
    let rule = Integration::GeneralisedAlpha { spectral_radius: 1.0 };
    let mut dynamics = Dynamics::new(beam, supports, rule, Damping::default()).expect("a model");
    let load: Vec<[f64; 3]> = (0..7).map(|k| [0.0, if k == 2 { -0.01 } else { 0.005 }, 0.0]).collect();
    let (mut nodes, mut state) = (dynamics.at_rest(), structure.at_rest([0.0; 2], 0.0));
    dynamics.equilibrate(&mut nodes, &load).expect("a start");
    let mut most = [0.0_f64; 2];
    for _ in 0..400 {
        let mut forces = vec![0.0; structure.unknowns()];
        for (rows, force) in structure.jacobian(&state).iter().zip(&load) {
            (0..3).for_each(|i| forces.iter_mut().zip(&rows[i]).for_each(|(sum, row)| *sum += row * force[i]));
        }
        structure.step(&mut state, &forces, &Step { dt: 5e-5, gravity: [0.0; 2], frame: None }).expect("a step");
        dynamics.step(&mut nodes, &load, 5e-5).expect("a step");
        let places = structure.places(&state);
        for (k, place) in places.iter().take(7).enumerate() {
            most[0] = most[0].max(nodes.displacement[k][1].abs());
            most[1] = most[1].max((place[1] - nodes.displacement[k][1]).abs());
        }
    }
    assert!(most[0] > 1e-8 && most[1] < 1e-9 * most[0], "largest deflection and difference {most:?} m");
}

#[test]
fn impossible_structures_are_refused() {
    let frame = |mass: f64| Frame { mass, inertia: 1.0, center_of_mass: [0.0; 2], held: [true, false, true] };
    let mode = ModalMode { frequency: 5.0, mass: 1.0, damping_ratio: 0.0, shape: vec![[0.0, 1.0, 0.0]] };
    let build = |frame: Frame, masses: Vec<f64>, mode: ModalMode| {
        ModalStructure::new(frame, vec![[0.0; 2]], masses, vec![mode]).expect_err("an error").to_string()
    };
    let cases = [
        (build(frame(0.0), vec![0.0], mode.clone()), "a frame that is free has no mass"),
        (build(frame(1.0), vec![4.0], mode.clone()), "the generalised masses are smaller"),
        (build(frame(1.0), vec![], mode.clone()), "the list of masses has 0 entries; it must have 1"),
        (build(frame(1.0), vec![-1.0], mode.clone()), "mass [kg/m] of node 0 is -1"),
        (build(frame(1.0), vec![1.0], ModalMode { frequency: 0.0, ..mode.clone() }), "frequency [Hz] of mode 0 is 0"),
        (build(frame(1.0), vec![1.0], ModalMode { shape: Vec::new(), ..mode }), "the shape of a mode has 0 entries"),
    ];
    for (message, expected) in cases {
        assert!(message.contains(expected), "{message}");
    }
}
