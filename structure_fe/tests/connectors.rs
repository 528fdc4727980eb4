//! Connectors: springs and dampers between a body and a node, against closed forms and the laws of conservation.

mod common;

use common::{CONSERVING, LENGTH, MATERIAL, RUBBER, beam, bending_stiffness, none, section};
use structure_fe::{
    Beam, Connector, Damping, Dof, Dynamics, Error, Integration, Material, Section, Statics, Supports, natural_modes,
};

/// Steel without bending: a bar that moves as a rigid body.
const STIFF: Material = Material { youngs_modulus: 1e14, poissons_ratio: 0.0, density: 2700.0 };

/// The root of a function that changes its sign once in a range.
fn root(of: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    assert!(of(low) * of(high) < 0.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if of(low) * of(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

/// kappa (1 + cos l cosh l) + l (cos l sinh l - sin l cosh l) = 0 with kappa = k L/(EI): a beam on a hinge with a rotational spring.
#[test]
fn a_cantilever_on_a_rotational_spring_has_the_frequency_of_its_equation() {
    for kappa in [0.1, 1.0, 10.0, 1e4] {
        let exact =
            root(|l| kappa * (1.0 + l.cos() * l.cosh()) + l * (l.cos() * l.sinh() - l.sin() * l.cosh()), [0.1, 2.5]);
        let omega = (exact / LENGTH).powi(2) * (bending_stiffness() / section().mass_per_length(&MATERIAL)).sqrt();
        let (model, body) = beam(16).with_rigid_body([-0.2, 0.1], 0.0, 0.0).unwrap();
        let spring = Connector { stiffness: [0.0, 0.0, kappa * bending_stiffness() / LENGTH], ..Connector::default() };
        let mut held = Supports::default();
        held.clamp(body).link_pinned(body, 0).connect(body, 0, spring);
        let found = natural_modes(&model, &held, 1).unwrap()[0].angular_frequency;
        assert!((found / omega - 1.0).abs() < 2e-5, "{kappa}: {found} instead of {omega}");
    }
}

/// A rigid bar on two springs with dampers across it: x = exp(-xi w t) cos(w' t), whatever the angle of the bar.
#[test]
fn a_rigid_plate_on_springs_and_dampers_swings_like_an_oscillator() {
    let (stiffness, ratio) = (4e4, 0.05);
    for angle in [0.0_f64, 0.7, 2.4] {
        let (c, s) = (angle.cos(), angle.sin());
        let bar = Beam::straight([0.0, 0.0], [c, s], 4, STIFF, Section::strip(0.05)).unwrap();
        let mass = bar.mass();
        let omega = (2.0 * stiffness / mass).sqrt();
        let (model, body) = bar.with_rigid_body([0.3, 0.4], 0.0, 0.0).unwrap();
        let mut held = Supports::default();
        held.clamp(body);
        let damping = ratio * mass * omega; // of each: c/2 = xi m w
        for node in [0, 4] {
            let connector = Connector { angle, stiffness: [1e7, stiffness, 0.0], damping: [0.0, damping, 0.0] };
            held.connect(body, node, connector);
        }
        let mut dynamics = Dynamics::new(model, held, CONSERVING, Damping::default()).unwrap();
        let mut state = dynamics.at_rest();
        for u in &mut state.displacement[..5] {
            *u = [-1e-3 * s, 1e-3 * c, 0.0];
        }
        let (load, dt) = (none(6), 1e-3 / omega);
        dynamics.equilibrate_over(&mut state, &load, dt).unwrap();
        let slower = omega * (1.0 - ratio * ratio).sqrt();
        let (mut worst, mut lost) = (0.0_f64, 0.0);
        let start = dynamics.strain_energy(&state);
        for _ in 0..20_000 {
            lost += dynamics.step(&mut state, &load, dt).unwrap().dissipated;
            let (t, [x, y, _]) = (state.time, state.displacement[2]);
            let swing = (slower * t).cos() + ratio / (1.0 - ratio * ratio).sqrt() * (slower * t).sin();
            let exact = 1e-3 * (-ratio * omega * t).exp() * swing;
            worst = worst.max((c * y - s * x - exact).abs() / 1e-3);
        }
        let energy = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state) + lost;
        println!("{angle}: worst {worst:e}, energy {:e}", energy / start - 1.0);
        assert!(worst < 1e-4, "{angle}: {worst:e}");
        assert!((energy / start - 1.0).abs() < 1e-9, "{angle}: {energy} J instead of {start} J");
    }
}

/// A body that spins with a panel on springs: momentum to rounding, angular momentum and energy to second order in the step.
#[test]
fn a_spinning_body_with_a_sprung_panel_conserves() {
    let spin = |dt: f64, damping: [f64; 3]| {
        let panel = Beam::straight([0.1, 0.05], [0.6, 0.05], 8, RUBBER, Section::strip(0.03)).unwrap();
        let (model, body) = panel.with_rigid_body([-0.05, 0.0], 20.0, 0.3).unwrap();
        let mut held = Supports::default();
        held.connect(body, 0, Connector { angle: 0.3, stiffness: [2e4, 1e4, 50.0], damping });
        held.connect(body, 8, Connector { angle: 0.0, stiffness: [1e4, 5e3, 0.0], damping });
        let mut dynamics = Dynamics::new(model, held, CONSERVING, Damping::default()).unwrap();
        let load = none(10);
        let mut state = dynamics.at_rest();
        dynamics.set_rigid_velocity(&mut state, [0.0; 2], [1.0, -2.0], 8.0);
        dynamics.equilibrate_over(&mut state, &load, dt).unwrap();
        let (before, energy) = (dynamics.momentum(&state), dynamics.kinetic_energy(&state));
        let (mut by_push, mut by_turn, mut by_energy, mut lost, mut iterations) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0, 0);
        while state.displacement[body][2] < 10.0 {
            let report = dynamics.step(&mut state, &load, dt).unwrap();
            lost += report.dissipated;
            iterations = iterations.max(report.iterations);
            let now = dynamics.momentum(&state);
            by_push = (0..2).map(|k| (now[k] - before[k]).abs() / before[1].abs()).fold(by_push, f64::max);
            by_turn = by_turn.max((now[2] / before[2] - 1.0).abs());
            let total = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state) + lost;
            by_energy = by_energy.max((total / energy - 1.0).abs());
        }
        println!(
            "steps of {dt} s: momentum {by_push:e}, angular {by_turn:e}, energy {by_energy:e}, {iterations} iterations"
        );
        assert!(by_push < 1e-12 && iterations <= 8, "{by_push:e}, {iterations}");
        [by_turn, by_energy]
    };
    for damping in [[0.0; 3], [20.0, 30.0, 0.5]] {
        let (coarse, fine) = (spin(2e-3, damping), spin(1e-3, damping));
        assert!(fine[0] < 1e-3 && fine[1] < 1e-3, "{fine:?}");
        assert!(coarse[0] / fine[0] > 3.0, "angular momentum: {coarse:?}, {fine:?}");
    }
}

/// The reactions of a held body balance the panel's momentum, and its energy.
#[test]
fn reactions_of_a_held_body_balance_a_sprung_panel() {
    let panel = Beam::straight([0.1, 0.05], [0.6, 0.05], 8, RUBBER, Section::strip(0.03)).unwrap();
    let (model, body) = panel.with_rigid_body([-0.05, 0.0], 0.0, 0.0).unwrap();
    let mut held = Supports::default();
    held.clamp(body);
    for node in [0, 8] {
        held.connect(body, node, Connector { angle: 0.2, stiffness: [1e4, 5e3, 10.0], damping: [5.0, 8.0, 0.1] });
    }
    let rule = Integration::Trapezoidal { spectral_radius: 0.8 };
    let mut dynamics = Dynamics::new(model, held, rule, Damping { mass: 0.0, stiffness: 1e-4 }).unwrap();
    let (mut state, dt) = (dynamics.at_rest(), 1e-3);
    let mut load = none(10);
    load[4] = [3.0, 40.0, 0.0];
    dynamics.equilibrate_over(&mut state, &load, dt).unwrap();
    let (mut impulse, mut energy) = ([0.0; 2], 0.0);
    for _ in 0..300 {
        let before = state.displacement[4];
        let report = dynamics.step(&mut state, &load, dt).unwrap();
        for k in 0..2 {
            impulse[k] += dt * (load[4][k] + state.mean_reaction[body][k]);
            energy += load[4][k] * (state.displacement[4][k] - before[k]);
        }
        energy -= report.dissipated;
    }
    let momentum = dynamics.momentum(&state);
    let total = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state);
    let by_momentum = (0..2).map(|k| (momentum[k] - impulse[k]).abs()).fold(0.0, f64::max) / (300.0 * dt * 40.0);
    println!("momentum {by_momentum:e}, energy {total} J, {energy} J");
    assert!(by_momentum < 1e-12, "{momentum:?}, {impulse:?}");
    assert!((total / energy - 1.0).abs() < 1e-9, "{total} J, {energy} J");
}

#[test]
fn a_wrong_connector_is_refused() {
    let refused = |connect: &dyn Fn(&mut Supports, usize)| {
        let (model, body) = beam(4).with_rigid_body([0.0, 0.0], 1.0, 1.0).unwrap();
        let mut held = Supports::default();
        connect(held.fix(body, Dof::U), body);
        natural_modes(&model, &held, 1).unwrap_err()
    };
    let spring = Connector { stiffness: [1.0; 3], ..Connector::default() };
    assert!(matches!(
        refused(&|held, _| {
            held.connect(1, 2, spring);
        }),
        Error::BadJoint { item: "connector", .. }
    ));
    assert!(matches!(
        refused(&|held, body| {
            held.connect(body, 9, spring);
        }),
        Error::NoSuchNode { .. }
    ));
    let negative = Connector { damping: [0.0, -1.0, 0.0], ..spring };
    assert!(matches!(
        refused(&|held, body| {
            held.connect(body, 2, negative);
        }),
        Error::OutOfRange { .. }
    ));
    let (model, body) = beam(4).with_rigid_body([0.0, 0.0], 1.0, 1.0).unwrap();
    let mut held = Supports::default();
    held.clamp(body).connect(body, 0, spring);
    assert!(matches!(Statics::new(model, held), Err(Error::Unsupported { feature: "connectors", .. })));
}
