//! What breaks off flies on with the momentum it had.

mod common;

use common::{CONSERVING, LENGTH, MATERIAL, RUBBER, beam, body_with_panel, none, section, supports};
use structure_fe::{
    Beam, Damping, Dof, Dynamics, Error, Integration, Rupture, Section, State, Supports, natural_modes,
};

fn momentum_change(dynamics: &Dynamics, before: [f64; 3], state: &State) -> f64 {
    let after = dynamics.momentum(state);
    let size = before.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    before.iter().zip(after).map(|(b, a)| (a - b).abs() / size).fold(0.0, f64::max)
}

/// A cantilever with a weak root, loaded until it breaks; then the load is taken off.
#[test]
fn a_cantilever_with_a_weak_root_breaks_off_and_flies() {
    let elements = 12;
    let limit = 4e-4;
    let mut held = supports("cantilever", elements);
    held.breakable(0, Rupture::FibreStrain(limit));
    let mut dynamics = Dynamics::new(beam(elements), held, CONSERVING, Damping::default()).unwrap();
    let mut state = dynamics.at_rest();
    let mut load = none(elements + 1);
    let (dt, mut last) = (1e-3, state.clone());
    let mut strain = 0.0;
    while state.ruptures.is_empty() {
        load[elements][1] += 2.0;
        last = state.clone();
        strain = dynamics.fibres(&state)[0].strain[0].abs();
        dynamics.step(&mut state, &load, dt).unwrap();
        assert!(state.time < 2.0, "breaks at last");
    }
    let rupture = state.ruptures[0];
    assert_eq!((rupture.node, rupture.time, rupture.place), (0, state.time, [0.0, 0.0]));
    assert!(strain <= limit && rupture.value > limit && rupture.value < 1.2 * limit, "{strain}, {rupture:?}");
    // A step taken back is whole again, breaks the same way, and does not break under less.
    let mut again = last.clone();
    assert!(dynamics.momentum(&again)[1] > 0.0);
    dynamics.step(&mut again, &none(elements + 1), 1e-6).unwrap();
    assert!(again.ruptures.is_empty() && again.displacement[0] == [0.0; 3]);
    let mut again = last;
    dynamics.step(&mut again, &load, dt).unwrap();
    assert_eq!(again, state);
    // It flies: the root moves, momentum and energy stay.
    let before = dynamics.momentum(&state);
    let energy = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state);
    let start = state.time;
    for _ in 0..400 {
        dynamics.step(&mut state, &none(elements + 1), dt).unwrap();
        assert_eq!(state.mean_reaction[0], [0.0; 3]);
    }
    let change = momentum_change(&dynamics, before, &state);
    let total = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state);
    println!("flight: momentum {change:e}, energy {:e}", total / energy - 1.0);
    assert!((total / energy - 1.0).abs() < 1e-9);
    let after = dynamics.momentum(&state);
    assert!((after[1] / before[1] - 1.0).abs() < 1e-12 && (after[0] - before[0]).abs() < 1e-12 * before[1]);
    // Its centre of mass moves at the speed it had.
    let mass = dynamics.beam().mass();
    let weights = dynamics.gravity_load([0.0, 1.0]);
    let centre: f64 = weights.iter().zip(&state.displacement).map(|(m, q)| m[1] * q[1]).sum::<f64>() / mass;
    let then: f64 = weights.iter().zip(&again.displacement).map(|(m, q)| m[1] * q[1]).sum::<f64>() / mass;
    let flown = before[1] / mass * (state.time - start);
    assert!(((centre - then) / flown - 1.0).abs() < 1e-9, "{} against {flown}", centre - then);
    assert!(state.displacement[0][1].abs() > 1e-3);
}

/// A flap on a free body that spins: it tears off, and body and flap have together what they had before.
#[test]
fn a_flap_tears_off_a_free_body() {
    for pinned in [false, true] {
        let (model, _, body) = body_with_panel(RUBBER, 0.02, 10);
        let mut held = Supports::default();
        if pinned {
            held.link_pinned(body, 0).breakable(0, Rupture::Rotation(0.5));
        } else {
            held.link(body, 0).breakable(0, Rupture::FibreStrain(0.02));
        }
        let mut dynamics = Dynamics::new(model, held, CONSERVING, Damping::default()).unwrap();
        let mut state = dynamics.at_rest();
        let together = dynamics.beam().nodes()[body];
        dynamics.set_rigid_velocity(&mut state, together, [0.5, 1.0], 2.0);
        let mut load = none(12);
        load[10][1] = -30.0;
        let mut before = dynamics.momentum(&state);
        let mut energy = 0.0;
        while state.ruptures.is_empty() {
            let last = state.clone();
            dynamics.step(&mut state, &load, 1e-3).unwrap();
            assert!(state.time < 3.0);
            // The impulse of the step, and its moment about the origin where the tip was on average.
            before = dynamics.momentum(&state);
            energy = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state);
            // Seen from the layout before the break: that of the step taken back.
            if !state.ruptures.is_empty() {
                let mut whole = last.clone();
                dynamics.step(&mut whole, &load, 1e-3).unwrap();
                assert_eq!(whole, state);
                dynamics.apply_ruptures(&last).unwrap();
                let p = dynamics.momentum(&last);
                dynamics.apply_ruptures(&state).unwrap();
                assert!((before[1] - p[1] + 30.0 * 1e-3).abs() < 1e-12, "{before:?}, {p:?}");
                assert!((before[0] - p[0]).abs() < 1e-12);
            }
        }
        let apart = dynamics.beam().nodes()[body];
        println!("pinned {pinned}: {:?}, body's node from {together:?} to {apart:?}", state.ruptures);
        assert!((apart[0] + 0.05).abs() < 1e-12 && apart[1].abs() < 1e-12, "the body alone");
        for _ in 0..500 {
            dynamics.step(&mut state, &none(12), 1e-3).unwrap();
        }
        let change = momentum_change(&dynamics, before, &state);
        let total = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state);
        let gap = state.displacement[0][0] - state.displacement[body][0];
        println!("apart: momentum {change:e}, energy {:e}, gap {gap}", total / energy - 1.0);
        assert!(change < 1e-5 && (total / energy - 1.0).abs() < 1e-9);
        // Nothing turns the body any more.
        let spin = state.velocity[body][2];
        dynamics.step(&mut state, &none(12), 1e-3).unwrap();
        assert_eq!(state.velocity[body][2], spin);
    }
}

/// A weld is no joint at all until it breaks; a hinge breaks where it is opened too far.
#[test]
fn welds_and_hinges_break() {
    let half = 4;
    let nodes: Vec<[f64; 2]> =
        (0..=half).chain(half..=2 * half).map(|k| [LENGTH * k as f64 / (2 * half) as f64, 0.0]).collect();
    let links: Vec<[usize; 2]> =
        (0..half).map(|k| [k, k + 1]).chain((half + 1..=2 * half).map(|k| [k, k + 1])).collect();
    let model = Beam::uniform(nodes, &links, MATERIAL, section()).unwrap();
    let mut held = Supports::default();
    held.clamp(0).weld(half, half + 1);
    let whole = natural_modes(&beam(2 * half), &supports("cantilever", 2 * half), 3).unwrap();
    for (welded, whole) in natural_modes(&model, &held, 3).unwrap().iter().zip(&whole) {
        assert!((welded.angular_frequency / whole.angular_frequency - 1.0).abs() < 1e-9);
    }
    held.breakable(half + 1, Rupture::FibreStrain(1e-4));
    let mut dynamics = Dynamics::new(model.clone(), held, CONSERVING, Damping::default()).unwrap();
    let mut state = dynamics.at_rest();
    let mut load = none(2 * half + 2);
    while state.ruptures.is_empty() && state.time < 2.0 {
        load[2 * half + 1][1] -= 1.0;
        dynamics.step(&mut state, &load, 1e-3).unwrap();
        if state.ruptures.is_empty() {
            assert_eq!(state.displacement[half], state.displacement[half + 1]);
        }
    }
    assert_eq!(state.ruptures[0].node, half + 1);
    for _ in 0..200 {
        dynamics.step(&mut state, &load, 1e-3).unwrap();
    }
    assert!(state.displacement[half][1] - state.displacement[half + 1][1] > 5e-3, "the outer half has gone");

    let mut held = Supports::default();
    held.clamp(0).hinge(half, half + 1).breakable(half, Rupture::Rotation(0.3));
    let mut dynamics = Dynamics::new(model, held, CONSERVING, Damping::default()).unwrap();
    let (mut state, load) = (dynamics.at_rest(), dynamics.gravity_load([0.0, -9.81]));
    while state.ruptures.is_empty() && state.time < 2.0 {
        dynamics.step(&mut state, &load, 1e-3).unwrap();
    }
    let opened = state.displacement[half][2] - state.displacement[half + 1][2];
    assert!(opened > 0.3 && opened < 0.31, "{opened}");
    let start = state.velocity[2 * half][1];
    let fall = dynamics.gravity_load([0.0, -1.0]);
    let down = |state: &State| -> f64 { (half + 1..=2 * half + 1).map(|n| -fall[n][1] * state.velocity[n][1]).sum() };
    let (before, mass) = (down(&state), -(half + 1..=2 * half + 1).map(|n| fall[n][1]).sum::<f64>());
    for _ in 0..100 {
        dynamics.step(&mut state, &load, 1e-3).unwrap();
    }
    // It falls freely.
    assert!((down(&state) - before + 9.81 * mass * 0.1).abs() < 1e-9 * mass, "{start}");
}

#[test]
fn what_cannot_break_is_refused() {
    let build = |held: Supports, rule: Integration| Dynamics::new(beam(3), held, rule, Damping::default()).unwrap_err();
    let mut held = supports("cantilever", 3);
    held.breakable(2, Rupture::FibreStrain(0.01));
    assert!(matches!(build(held, CONSERVING), Error::BadJoint { item: "breakable joint", index: 0, node: 2, .. }));
    let mut held = supports("cantilever", 3);
    held.breakable(0, Rupture::Rotation(0.0));
    assert!(matches!(build(held, CONSERVING), Error::BadProperty { item: "breakable joint", .. }));
    let mut held = supports("cantilever", 3);
    held.breakable(0, Rupture::FibreStrain(0.01));
    assert!(matches!(
        build(held.clone(), Integration::CentralDifference),
        Error::Unsupported { feature: "rupture", index: 0, .. }
    ));
    held.weld(1, 2);
    assert!(matches!(build(held, CONSERVING), Error::HingeGap { .. }));
    let (model, body) = beam(3).with_rigid_body([0.0, 0.0], 1.0, 1.0).unwrap();
    let mut held = Supports::default();
    held.link(body, 0).fix(body, Dof::U).breakable(body, Rupture::FibreStrain(0.01));
    let error = Dynamics::new(model, held, CONSERVING, Damping::default()).unwrap_err();
    assert!(matches!(error, Error::BadJoint { item: "breakable joint", node, .. } if node == body));
    assert!(Beam::straight([0.0, 0.0], [1.0, 0.0], 1, MATERIAL, Section::strip(0.01)).is_ok());
}
