//! Panels on rigid bodies: one set of equations, so momentum and energy close to rounding.

mod common;

use common::{CONSERVING, MATERIAL, RUBBER, body_with_panel, moved, none, pairing};
use structure_fe::{Beam, Damping, Dof, Dynamics, Integration, Material, Section, State, SupportMotion, Supports};

/// Steps under loads that change with time; returns the worst errors of linear momentum over the impulse
/// and of the energy balance over the work.
fn run(dynamics: &mut Dynamics, size: f64, dt: f64, steps: usize) -> (f64, f64, State) {
    let nodes = dynamics.beam().nodes().len();
    let mut state = dynamics.at_rest();
    dynamics.equilibrate(&mut state, &none(nodes)).unwrap();
    let energy = |d: &Dynamics, s: &State| d.kinetic_energy(s) + d.strain_energy(s);
    let (mut impulse, mut gross, mut work, mut exchanged) = ([0.0; 2], 0.0, 0.0, 0.0);
    let (mut by_momentum, mut by_energy): (f64, f64) = (0.0, 0.0);
    for step in 0..steps {
        let at = |node: usize, dof: usize| size * (0.03 * step as f64 + 1.3 * node as f64 + 2.1 * dof as f64).sin();
        let load: Vec<[f64; 3]> = (0..nodes).map(|n| [at(n, 0), at(n, 1) + 0.3 * size, 0.05 * at(n, 2)]).collect();
        let before = state.clone();
        let report = dynamics.step(&mut state, &load, dt).unwrap();
        for (load, reaction) in load.iter().zip(&state.mean_reaction) {
            for dof in 0..2 {
                impulse[dof] += dt * (load[dof] + reaction[dof]);
                gross += dt * load[dof].abs();
            }
        }
        let done = pairing(&load, &moved(&before, &state));
        work += done + report.support_work - report.dissipated;
        exchanged += done.abs() + report.support_work.abs();
        let momentum = dynamics.momentum(&state);
        for dof in 0..2 {
            by_momentum = by_momentum.max((momentum[dof] - impulse[dof]).abs() / gross);
        }
        by_energy = by_energy.max((energy(dynamics, &state) - work).abs() / exchanged);
    }
    (by_momentum, by_energy, state)
}

#[test]
fn a_free_body_with_a_panel_keeps_momentum_and_energy() {
    for (name, radius, damping, size, allowed) in [
        ("small, conserving", 1.0, Damping::default(), 1e-6, 1e-10),
        ("small, damped", 0.7, Damping { mass: 0.4, stiffness: 1e-4 }, 1e-6, 1e-10),
        ("large, conserving", 1.0, Damping::default(), 20.0, 1e-3),
        ("large, damped", 0.7, Damping { mass: 0.4, stiffness: 1e-4 }, 20.0, 1e-2),
    ] {
        let (model, held, _) = body_with_panel(RUBBER, 0.02, 12);
        let rule = Integration::Trapezoidal { spectral_radius: radius };
        let mut dynamics = Dynamics::new(model, held, rule, damping).unwrap();
        let (by_momentum, by_energy, state) = run(&mut dynamics, size, 1e-3, 600);
        let turned = state.displacement.last().unwrap()[2];
        println!("{name}: momentum {by_momentum:e}, energy {by_energy:e}, turned by {turned} rad");
        assert!(by_momentum < 1e-12, "{name}: {by_momentum:e}");
        assert!(by_energy < allowed, "{name}: {by_energy:e}");
    }
}

#[test]
fn reactions_of_a_body_balance_the_panel() {
    for (name, fixed) in [
        ("clamped", vec![Dof::U, Dof::W, Dof::Theta]),
        ("pinned", vec![Dof::U, Dof::W]),
        ("guided", vec![Dof::U, Dof::Theta]),
        ("slides", vec![Dof::U]),
    ] {
        let (model, mut held, body) = body_with_panel(RUBBER, 0.02, 12);
        for dof in fixed {
            held.fix(body, dof);
        }
        held.spring(body, Dof::W, 500.0).spring(4, Dof::W, 20.0);
        let mut dynamics = Dynamics::new(model, held, CONSERVING, Damping::default()).unwrap();
        let (by_momentum, by_energy, _) = run(&mut dynamics, 1e-6, 1e-3, 400);
        println!("{name}: momentum {by_momentum:e}, energy {by_energy:e}");
        assert!(by_momentum < 1e-12, "{name}: {by_momentum:e}");
        assert!(by_energy < 1e-10, "{name}: {by_energy:e}");
        let (by_momentum, by_energy, _) = run(&mut dynamics, 20.0, 1e-3, 400);
        println!("{name}, large: momentum {by_momentum:e}, energy {by_energy:e}");
        assert!(by_momentum < 1e-12 && by_energy < 5e-3, "{name}: {by_momentum:e}, {by_energy:e}");
    }
}

/// Nothing from outside: linear momentum to rounding, angular momentum and energy to second order in the step.
#[test]
fn a_body_with_a_panel_spins_through_several_turns() {
    let turn = |dt: f64| {
        let (model, held, body) = body_with_panel(RUBBER, 0.03, 12);
        let mut dynamics = Dynamics::new(model, held, CONSERVING, Damping::default()).unwrap();
        let load = none(dynamics.beam().nodes().len());
        let mut state = dynamics.at_rest();
        let centre = dynamics.beam().nodes()[body];
        dynamics.set_rigid_velocity(&mut state, centre, [1.0, -2.0], 8.0);
        dynamics.equilibrate_over(&mut state, &load, dt).unwrap();
        let (before, energy) = (dynamics.momentum(&state), dynamics.kinetic_energy(&state));
        let (mut by_energy, mut by_turn, mut by_push): (f64, f64, f64) = (0.0, 0.0, 0.0);
        while state.displacement[body][2] < 3.0 * std::f64::consts::TAU {
            dynamics.step(&mut state, &load, dt).unwrap();
            let now = dynamics.momentum(&state);
            for axis in 0..2 {
                by_push = by_push.max((now[axis] - before[axis]).abs() / before[1].abs());
            }
            // About the place where the common centre of mass would be: on a straight line from the start.
            by_turn = by_turn.max((now[2] / before[2] - 1.0).abs());
            let total = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state);
            by_energy = by_energy.max((total / energy - 1.0).abs());
        }
        println!("spin, steps of {dt} s: momentum {by_push:e}, angular {by_turn:e}, energy {by_energy:e}");
        assert!(by_push < 1e-12, "{by_push:e}");
        [by_turn, by_energy]
    };
    let (coarse, fine) = (turn(2e-3), turn(1e-3));
    assert!(fine[0] < 1e-3 && fine[1] < 1e-3, "{fine:?}");
    assert!(coarse[0] / fine[0] > 3.0, "angular momentum: {coarse:?}, {fine:?}");
}

/// A panel too stiff to bend moves with its body as one rigid body does: x = F t^2/(2m), theta = M t^2/(2J).
#[test]
fn a_stiff_panel_and_its_body_are_one_rigid_body() {
    let stiff = Material { youngs_modulus: 1e13, ..MATERIAL };
    let elements = 8;
    let (model, held, body) = body_with_panel(stiff, 0.05, elements);
    let mass = model.mass();
    let mut dynamics = Dynamics::new(model, held, CONSERVING, Damping::default()).unwrap();
    let places = dynamics.beam().nodes().to_vec();
    // The body, 20 kg, and the panel about their common centre; lumping adds m h^2/39 of each element.
    let panel = mass - 20.0;
    let centre = [0, 1].map(|k| (20.0 * [-0.05, 0.0][k] + panel * [0.35, 0.05][k]) / mass);
    let about = |m: f64, at: [f64; 2]| m * ((at[0] - centre[0]).powi(2) + (at[1] - centre[1]).powi(2));
    let own = 0.3 + panel * (0.25 / 12.0 + (0.5 / elements as f64).powi(2) / 39.0);
    let inertia = own + about(20.0, [-0.05, 0.0]) + about(panel, [0.35, 0.05]);
    let mut state = dynamics.at_rest();
    let (moment, force, dt) = (100.0, [300.0, -500.0], 1e-3);
    let mut load = none(places.len());
    let arm = [0, 1].map(|k| centre[k] - places[body][k]);
    let turned = |theta: f64, [x, y]: [f64; 2]| {
        let (s, c) = theta.sin_cos();
        [c * x - s * y, s * x + c * y]
    };
    for _ in 0..1000 {
        // At the body, with the moment that makes it a force through the centre and a moment.
        let [x, y] = turned(state.displacement[body][2] + 0.5 * dt * state.velocity[body][2], arm);
        load[body] = [force[0], force[1], moment + x * force[1] - y * force[0]];
        dynamics.step(&mut state, &load, dt).unwrap();
    }
    let [u, w, theta] = state.displacement[body];
    let [x, y] = turned(theta, arm);
    let ours = [u + x - arm[0], w + y - arm[1], theta];
    let exact = [0.5 * force[0] / mass, 0.5 * force[1] / mass, 0.5 * moment / inertia];
    println!("rigid: {ours:?} against {exact:?}");
    for (ours, exact) in ours.iter().zip(exact) {
        assert!((ours / exact - 1.0).abs() < 2e-4, "{ours} against {exact}");
    }
    // And the panel has turned with it, as far as its own bending under inertia goes.
    let arm = [0, 1].map(|k| places[elements][k] - places[body][k]);
    let [x, y] = turned(theta, arm);
    let at = [u + x - arm[0], w + y - arm[1], theta];
    for k in 0..3 {
        assert!((state.displacement[elements][k] - at[k]).abs() < 1e-6, "{:?} at {at:?}", state.displacement[elements]);
    }
}

/// A pendulum: a body pinned at its node, a stiff rod tied to it. Small swings have w^2 = m g l/J, large ones
/// keep their energy; and the rule is of second order.
#[test]
fn a_pendulum_swings_and_the_rule_is_of_second_order() {
    let elements = 8;
    let rod = || {
        let rod = Beam::straight([0.0, -0.1], [0.0, -1.0], elements, MATERIAL, Section::strip(0.05)).unwrap();
        let (model, body) = rod.with_rigid_body([0.0, 0.0], 0.0, 2.0).unwrap();
        let mut held = Supports::default();
        held.link(body, 0).pin(body);
        (Dynamics::new(model, held, CONSERVING, Damping::default()).unwrap(), body)
    };
    let swing = |dt: f64, end: f64, angle: f64| {
        let (mut dynamics, body) = rod();
        let mass = dynamics.beam().mass();
        let mut state = dynamics.at_rest();
        let weight = dynamics.gravity_load([0.0, -9.81]);
        // Turned as a whole.
        let places = dynamics.beam().nodes().to_vec();
        let (s, c) = angle.sin_cos();
        for (q, [x, y]) in state.displacement.iter_mut().zip(&places) {
            *q = [(c - 1.0) * x - s * y, s * x + (c - 1.0) * y, angle];
        }
        dynamics.equilibrate_over(&mut state, &weight, dt).unwrap();
        let start = state.clone();
        let mut crossings = Vec::new();
        let mut worst: f64 = 0.0;
        while state.time < end - 0.5 * dt {
            let before = (state.time, state.displacement[body][2]);
            dynamics.step(&mut state, &weight, dt).unwrap();
            let now = state.displacement[body][2];
            if before.1 > 0.0 && now <= 0.0 {
                crossings.push(before.0 + dt * before.1 / (before.1 - now));
            }
            let energy = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state)
                - dynamics.strain_energy(&start)
                - pairing(&weight, &moved(&start, &state));
            worst = worst.max(energy.abs());
        }
        (state.displacement[body][2], crossings, worst / (mass * 9.81 * 0.55 * (1.0 - angle.cos())))
    };
    let (_, crossings, _) = swing(2e-3, 8.0, 1e-3);
    let periods = crossings.len() - 1;
    let frequency = std::f64::consts::TAU * periods as f64 / (crossings[periods] - crossings[0]);
    let mass = rod().0.beam().mass();
    // Lumping adds m h^2/39 of each element.
    let inertia = 2.0 + mass * (0.55_f64.powi(2) + 0.81 / 12.0 + (0.9 / elements as f64).powi(2) / 39.0);
    let exact = (mass * 9.81 * 0.55 / inertia).sqrt();
    println!("pendulum: {:e}", frequency / exact - 1.0);
    assert!((frequency / exact - 1.0).abs() < 2e-5);
    let [a, b, c] = [8e-3, 4e-3, 2e-3].map(|dt| swing(dt, 1.6, 2.0));
    let order = ((a.0 - b.0) / (b.0 - c.0)).abs().log2();
    println!("from 2 rad: order {order}, energy {:e}, {:e}, {:e}", a.2, b.2, c.2);
    assert!((order - 2.0).abs() < 0.2, "order {order}: {}, {}, {}", a.0, b.0, c.0);
    assert!(c.2 < 1e-3, "{:e}", c.2);
}

/// A body that is driven takes its panel along exactly: positions, velocities and accelerations.
#[test]
fn tied_nodes_follow_a_driven_body() {
    let (model, mut held, body) = body_with_panel(RUBBER, 0.03, 8);
    held.clamp(body);
    let mut dynamics = Dynamics::new(model, held, CONSERVING, Damping::default()).unwrap();
    let load = none(dynamics.beam().nodes().len());
    let mut state = dynamics.at_rest();
    let arm = [0, 1].map(|k| dynamics.beam().nodes()[0][k] - dynamics.beam().nodes()[body][k]);
    assert_eq!(dynamics.beam().nodes()[body], [-0.05, 0.0], "a held body's node stays");
    let dt = 1e-3;
    for step in 1..=500 {
        let t = dt * step as f64;
        let motion = |size: f64, w: f64| SupportMotion {
            displacement: size * (w * t).sin(),
            velocity: size * w * (w * t).cos(),
            acceleration: -size * w * w * (w * t).sin(),
        };
        for (dof, size, w) in [(Dof::U, 0.2, 7.0), (Dof::W, 0.1, 5.0), (Dof::Theta, 2.5, 4.0)] {
            dynamics.prescribe(body, dof, motion(size, w)).unwrap();
        }
        dynamics.step(&mut state, &load, dt).unwrap();
        let turn = motion(2.5, 4.0);
        let (s, c) = turn.displacement.sin_cos();
        let a = [c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]];
        let (spin, gain) = (turn.velocity, turn.acceleration);
        let (u, w) = (motion(0.2, 7.0), motion(0.1, 5.0));
        let exact = [
            [u.displacement + a[0] - arm[0], w.displacement + a[1] - arm[1], turn.displacement],
            [u.velocity - spin * a[1], w.velocity + spin * a[0], spin],
            [
                u.acceleration - gain * a[1] - spin * spin * a[0],
                w.acceleration + gain * a[0] - spin * spin * a[1],
                gain,
            ],
        ];
        for (ours, exact) in [state.displacement[0], state.velocity[0], state.acceleration[0]].iter().zip(&exact) {
            for dof in 0..3 {
                assert!((ours[dof] - exact[dof]).abs() < 1e-12 * (1.0 + exact[dof].abs()), "{ours:?}, {exact:?}");
            }
        }
    }
}

/// BE13: a body that flies and rotates with its panel keeps its speeds whatever a_M, and the first mode of the panel decays
/// with exp(−½ a_M t), its damping ratio being ½ a_M/ω.
#[test]
fn damping_of_the_mass_brakes_bending_only() {
    let fly = |damping: f64, bent: f64| {
        let panel = Beam::straight([0.0, 0.0], [0.5, 0.0], 8, MATERIAL, Section::strip(0.01)).unwrap();
        let (model, body) = panel.with_rigid_body([-0.1, 0.0], 1e4, 1e4).unwrap();
        let mut held = Supports::default();
        held.link(body, 0);
        let rule = Integration::Trapezoidal { spectral_radius: 1.0 };
        let mut dynamics = Dynamics::new(model, held, rule, Damping { mass: damping, stiffness: 0.0 }).unwrap();
        let mut state = dynamics.at_rest();
        let nodes = dynamics.beam().nodes().len();
        let (speed, turning) = if bent == 0.0 { ([3.0, -4.0], 0.5) } else { ([0.0; 2], 0.0) };
        dynamics.set_rigid_velocity(&mut state, dynamics.beam().nodes()[body], speed, turning);
        // the first mode of a cantilever, nearly: w = bent s²(6 − 4s + s²)/3
        for node in 1..9 {
            let s = node as f64 / 8.0;
            state.velocity[node][1] += bent * s * s * (6.0 - 4.0 * s + s * s) / 3.0;
            state.velocity[node][2] += bent * s * (12.0 - 12.0 * s + 4.0 * s * s) / 3.0 / 0.5;
        }
        dynamics.equilibrate(&mut state, &none(nodes)).unwrap();
        let reach = 0.5 - dynamics.beam().nodes()[body][0];
        let (start, mut last, mut peaks) = (dynamics.momentum(&state), 0.0, vec![(0.0_f64, 0.0_f64)]);
        for _ in 0..4000 {
            dynamics.step(&mut state, &none(nodes), 5e-5).unwrap();
            let [u, w, turn] = state.displacement[body];
            let [x, y, _] = state.displacement[8];
            let across = (y - w) * turn.cos() - (reach + x - u) * turn.sin();
            let peak = peaks.last_mut().unwrap();
            if across * last < 0.0 {
                peaks.push((0.0, state.time));
            } else if across.abs() > peak.0 {
                *peak = (across.abs(), state.time);
            }
            last = across;
        }
        (state.velocity[body], start, dynamics.momentum(&state), peaks)
    };
    let (velocity, before, after, _) = fly(200.0, 0.0);
    println!("flying: {velocity:?}, momentum {before:?} {after:?}");
    assert!((velocity[0] / 3.0 - 1.0).abs() < 2e-4 && (velocity[1] / -4.0 - 1.0).abs() < 2e-4, "{velocity:?}");
    assert!((velocity[2] / 0.5 - 1.0).abs() < 1e-3, "{velocity:?}");
    for k in 0..2 {
        assert!((after[k] / before[k] - 1.0).abs() < 1e-11, "{before:?} {after:?}");
    }
    let (_, _, _, peaks) = fly(30.0, 0.1);
    let (first, last) = (peaks[1], peaks[peaks.len() - 2]);
    let rate = (first.0 / last.0).ln() / (last.1 - first.1);
    println!("bending decays at {rate} 1/s, {} half swings", peaks.len());
    assert!(peaks.len() > 6 && (rate / 15.0 - 1.0).abs() < 0.02, "{rate} 1/s instead of 15, {peaks:?}");
}
