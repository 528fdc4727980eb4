//! Panels on rigid bodies: one set of equations, so momentum and energy close to rounding.

mod common;

use common::{MATERIAL, beam, number, section, supports, table};
use structure_fe::{
    Beam, Damping, Dof, Dynamics, Error, Integration, Loads, Material, NonlinearStatics, Section, State, Statics,
    SupportMotion, Supports, natural_modes,
};

const CONSERVING: Integration = Integration::Trapezoidal { spectral_radius: 1.0 };

fn none(nodes: usize) -> Vec<[f64; 3]> {
    vec![[0.0; 3]; nodes]
}

/// A body with a panel clamped to it that begins beside its centre of mass.
fn body_with_panel(material: Material, thickness: f64, elements: usize) -> (Beam, Supports, usize) {
    let panel = Beam::straight([0.1, 0.05], [0.6, 0.05], elements, material, Section::strip(thickness)).unwrap();
    let (model, body) = panel.with_rigid_body([-0.05, 0.0], 20.0, 0.3).unwrap();
    let mut held = Supports::default();
    held.tie(body, 0);
    (model, held, body)
}

const RUBBER: Material = Material { youngs_modulus: 5e6, poissons_ratio: 0.45, density: 1100.0 };

fn pairing(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

fn moved(from: &State, to: &State) -> Vec<[f64; 3]> {
    let each = to.displacement.iter().zip(&from.displacement);
    each.map(|(to, from)| [0, 1, 2].map(|dof| to[dof] - from[dof])).collect()
}

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
        let at = |node: usize, dof: usize| size * (0.37 * step as f64 + 1.3 * node as f64 + 2.1 * dof as f64).sin();
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
        ("large, conserving", 1.0, Damping::default(), 60.0, 1e-3),
        ("large, damped", 0.7, Damping { mass: 0.4, stiffness: 1e-4 }, 60.0, 1e-2),
    ] {
        let (model, held, _) = body_with_panel(RUBBER, 0.02, 12);
        let rule = Integration::Trapezoidal { spectral_radius: radius };
        let mut dynamics = Dynamics::new(model, held, rule, damping).unwrap();
        let (by_momentum, by_energy, state) = run(&mut dynamics, size, 1e-3, 600);
        let turned = state.displacement.last().unwrap()[2];
        println!("{name}: momentum {by_momentum:e}, energy {by_energy:e}, turned by {turned} rad");
        // Damping of the mass is a force from outside.
        if damping.mass == 0.0 {
            assert!(by_momentum < 1e-12, "{name}: {by_momentum:e}");
        }
        assert!(by_energy < allowed, "{name}: {by_energy:e}");
    }
}

#[test]
fn supports_of_a_body_give_what_the_panel_lacks() {
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
        let (by_momentum, by_energy, _) = run(&mut dynamics, 1e-5, 1e-3, 400);
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
        dynamics.start_moving(&mut state, centre, [1.0, -2.0], 8.0);
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
    let (model, held, body) = body_with_panel(stiff, 0.05, 8);
    let mass = model.mass();
    let rule = Integration::Trapezoidal { spectral_radius: 0.8 };
    let mut dynamics = Dynamics::new(model, held, rule, Damping::default()).unwrap();
    let places = dynamics.beam().nodes().to_vec();
    // The body's centre, 20 kg, with the panel's at its middle.
    let centre = [0, 1].map(|k| (20.0 * [-0.05, 0.0][k] + (mass - 20.0) * [0.35, 0.05][k]) / mass);
    for k in 0..2 {
        assert!((places[body][k] - centre[k]).abs() < 1e-12, "{:?} against {centre:?}", places[body]);
    }
    let about = |m: f64, at: [f64; 2]| m * ((at[0] - centre[0]).powi(2) + (at[1] - centre[1]).powi(2));
    let panel = mass - 20.0;
    let inertia = 0.3 + about(20.0, [-0.05, 0.0]) + panel * 0.25 / 12.0 + about(panel, [0.35, 0.05]);
    let mut state = dynamics.at_rest();
    let (moment, force, dt) = (400.0, [300.0, -500.0], 1e-3);
    let mut load = none(places.len());
    // At the tip, with the moment that makes it a force through the centre and a moment.
    let tip = 8;
    for _ in 0..1000 {
        let arm =
            [0, 1].map(|k| places[tip][k] + state.displacement[tip][k] - places[body][k] - state.displacement[body][k]);
        load[tip] = [force[0], force[1], moment - (arm[0] * force[1] - arm[1] * force[0])];
        dynamics.step(&mut state, &load, dt).unwrap();
    }
    let [u, w, theta] = state.displacement[body];
    let exact = [0.5 * force[0] / mass, 0.5 * force[1] / mass, 0.5 * moment / inertia];
    println!("rigid: {u}, {w}, {theta} against {exact:?}, inertia of the lumped model included");
    assert!((u / exact[0] - 1.0).abs() < 2e-3 && (w / exact[1] - 1.0).abs() < 2e-3);
    assert!((theta / exact[2] - 1.0).abs() < 0.02, "{theta} against {}", exact[2]);
    // And the panel has turned with it, as far as its own bending under inertia goes.
    assert!((state.displacement[tip][2] - theta).abs() < 1e-3);
    let arm = [0, 1].map(|k| places[tip][k] - places[body][k]);
    let (s, c) = theta.sin_cos();
    let at = [u + (c - 1.0) * arm[0] - s * arm[1], w + s * arm[0] + (c - 1.0) * arm[1]];
    for k in 0..2 {
        assert!((state.displacement[tip][k] - at[k]).abs() < 1e-4);
    }
}

/// Frequency of a cantilever of unit EI, rho A and length on a body of mass M and inertia J at its root:
/// M w^2 y = y''', J w^2 y' = -y'' at the root (what the beam lacks the body has), free at the tip.
fn frequency_on_a_body(mass: f64, inertia: f64) -> f64 {
    let determinant = |k: f64| {
        let w2 = k.powi(4);
        // y = a cos + b sin + c cosh + d sinh of kx; rows: root's force, root's moment, tip's moment and force.
        let (s, c, sh, ch) = (k.sin(), k.cos(), k.sinh(), k.cosh());
        let mut m = [
            [mass * w2, k.powi(3), mass * w2, -k.powi(3)],
            [-k * k, inertia * w2 * k, k * k, inertia * w2 * k],
            [-c, -s, ch, sh],
            [s, -c, sh, ch],
        ];
        let mut product = 1.0;
        for column in 0..4 {
            let pivot = (column..4).max_by(|&a, &b| m[a][column].abs().total_cmp(&m[b][column].abs())).unwrap();
            if pivot != column {
                m.swap(pivot, column);
                product = -product;
            }
            product *= m[column][column];
            for row in column + 1..4 {
                let factor = m[row][column] / m[column][column];
                for k in column..4 {
                    m[row][k] -= factor * m[column][k];
                }
            }
        }
        product
    };
    let (mut low, step) = (0.5, 1e-3);
    while determinant(low) * determinant(low + step) > 0.0 {
        low += step;
    }
    let mut high = low + step;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if determinant(low) * determinant(middle) > 0.0 { low = middle } else { high = middle }
    }
    low * low
}

#[test]
fn a_cantilever_on_a_body_has_the_frequency_of_both() {
    let (length, elements) = (common::LENGTH, 16);
    let unit = (common::bending_stiffness() / section().mass_per_length(&MATERIAL)).sqrt() / length.powi(2);
    let panel = section().mass_per_length(&MATERIAL) * length;
    let clamped = natural_modes(&beam(elements), &supports("cantilever", elements), 1).unwrap()[0].angular_frequency;
    for ratio in [1e6, 1.0, 0.1, 0.01] {
        // Inertia of a body as large as the panel is long.
        let (mass, inertia) = (ratio * panel, ratio * panel * length.powi(2) / 12.0);
        let (model, body) = beam(elements).with_rigid_body([0.0, 0.0], mass, inertia).unwrap();
        let mut held = Supports::default();
        held.tie(body, 0);
        // Three rigid motions come first; stretching is far above.
        let modes = natural_modes(&model, &held, 4).unwrap();
        let exact = unit * frequency_on_a_body(ratio, ratio / 12.0);
        let error = modes[3].angular_frequency / exact - 1.0;
        println!("body of {ratio} panels: {error:e} (clamped: {})", modes[3].angular_frequency / clamped - 1.0);
        assert!(error.abs() < 2e-5, "{ratio}: {error:e}");
        if ratio > 1e3 {
            assert!((modes[3].angular_frequency / clamped - 1.0).abs() < 1e-5);
        }
        // A body elsewhere than the node that is tied to it.
        let (model, body) = beam(elements).with_rigid_body([-0.3, 0.2], mass, inertia).unwrap();
        let mut held = Supports::default();
        held.tie(body, 0);
        let far = natural_modes(&model, &held, 4).unwrap();
        assert!(far[3].angular_frequency < modes[3].angular_frequency * (1.0 + 1e-9));
        if ratio > 1e3 {
            assert!((far[3].angular_frequency / clamped - 1.0).abs() < 1e-5);
        }
    }
}

/// The period of a small vibration in a mode, in time, from the zeros of the tip's deflection.
fn frequency_in_time(mode: usize, elements: usize, steps_a_period: f64) -> f64 {
    let held = supports("cantilever", elements);
    let shape = natural_modes(&beam(elements), &held, mode + 1).unwrap().swap_remove(mode);
    let mut dynamics = Dynamics::new(beam(elements), held, CONSERVING, Damping::default()).unwrap();
    let mut state = dynamics.at_rest();
    let scale = 1e-6 / shape.shape[elements][1];
    for (u, phi) in state.displacement.iter_mut().zip(&shape.shape) {
        *u = phi.map(|phi| scale * phi);
    }
    let load = none(elements + 1);
    let dt = std::f64::consts::TAU / shape.angular_frequency / steps_a_period;
    dynamics.equilibrate_over(&mut state, &load, dt).unwrap();
    let mut crossings = Vec::new();
    while crossings.len() < 11 {
        let before = (state.time, state.displacement[elements][1]);
        dynamics.step(&mut state, &load, dt).unwrap();
        let now = state.displacement[elements][1];
        if before.1 < 0.0 && now >= 0.0 {
            crossings.push(before.0 + dt * before.1 / (before.1 - now));
        }
    }
    std::f64::consts::TAU * 10.0 / (crossings[10] - crossings[0])
}

#[test]
fn lumped_masses_keep_the_lowest_frequencies() {
    for elements in [16, 32] {
        for mode in 0..2 {
            let root = number(&table("beam_frequency_roots")[mode], "cantilever");
            let exact = (root / common::LENGTH).powi(2)
                * (common::bending_stiffness() / section().mass_per_length(&MATERIAL)).sqrt();
            let error = frequency_in_time(mode, elements, 400.0) / exact - 1.0;
            println!("{elements} elements, lumped, mode {}: {error:e}", mode + 1);
            assert!(error.abs() < 5e-3, "{elements} elements, mode {}: {error:e}", mode + 1);
        }
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
        held.tie(body, 0).pin(body);
        (Dynamics::new(model, held, CONSERVING, Damping::default()).unwrap(), body)
    };
    let swing = |dt: f64, end: f64, angle: f64| {
        let (mut dynamics, body) = rod();
        let mass = dynamics.beam().mass();
        let mut state = dynamics.at_rest();
        let weight = dynamics.weight([0.0, -9.81]);
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
    let inertia = 2.0 + mass * (0.55_f64.powi(2) + 0.81 / 12.0);
    let exact = (mass * 9.81 * 0.55 / inertia).sqrt();
    println!("pendulum: {:e}", frequency / exact - 1.0);
    assert!((frequency / exact - 1.0).abs() < 2e-3);
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

/// Statics through a body: a bracket of panels on a body on springs, small and large, against each other; and a
/// large turn of a pinned body against the moment of its own arms.
#[test]
fn statics_know_ties_at_any_rotation() {
    let (model, mut held, body) = body_with_panel(MATERIAL, 0.02, 8);
    held.clamp(8);
    let mut loads = Loads::default();
    loads.at_node(body, [1.0, -2.0, 0.3]);
    let small = Statics::new(model.clone(), held.clone()).unwrap().solve(&loads).unwrap();
    let large = NonlinearStatics::new(model, held).unwrap().solve(&loads, 1).unwrap();
    for (small, large) in small.displacement.iter().zip(&large.displacement) {
        for dof in 0..3 {
            assert!((small[dof] - large[dof]).abs() < 1e-4 * small[dof].abs().max(1e-7), "{small:?}, {large:?}");
        }
    }
    // Equilibrium: the clamp takes force and moment about itself.
    let [x, y] = [-0.65, -0.05];
    let moment = 0.3 + x * -2.0 - y * 1.0;
    for solution in [&small, &large] {
        let [u, w, m] = solution.reactions[8];
        assert!((u + 1.0).abs() < 1e-9 && (w - 2.0).abs() < 1e-9 && (m + moment).abs() < 1e-5, "{u}, {w}, {m}");
    }
    // Hung at the body by a stiff rotational spring, with a force on the arm: k theta = r x F as turned.
    let stiff = Material { youngs_modulus: 1e14, ..MATERIAL };
    let (model, mut held, body) = body_with_panel(stiff, 0.05, 4);
    held.pin(body).spring(body, Dof::Theta, 100.0);
    let mut loads = Loads::default();
    loads.at_node(4, [0.0, -300.0, 0.0]);
    let solved = NonlinearStatics::new(model, held).unwrap().solve(&loads, 8).unwrap();
    let theta = solved.displacement[body][2];
    let (s, c) = theta.sin_cos();
    let arm = c * 0.65 - s * 0.05;
    println!("turned by {theta} rad: {} against {}", 100.0 * theta, -300.0 * arm);
    assert!(theta < -0.8 && (100.0 * theta + 300.0 * arm).abs() < 1e-4);
    assert!((solved.reactions[body][1] - 300.0).abs() < 1e-6);
}

#[test]
fn a_pinned_tie_leaves_the_rotation_free() {
    let panel = Beam::straight([0.0, 0.0], [0.5, 0.0], 8, MATERIAL, Section::strip(0.005)).unwrap();
    let (model, body) = panel.with_rigid_body([-0.2, 0.1], 1.0, 1.0).unwrap();
    let mut held = Supports::default();
    held.tie_pinned(body, 0).clamp(body).pin(8);
    let mut loads = Loads::default();
    loads.at_node(4, [0.0, -10.0, 0.0]);
    let solution = Statics::new(model.clone(), held.clone()).unwrap().solve(&loads).unwrap();
    let stiffness = Section::strip(0.005).bending_stiffness(&MATERIAL);
    let exact = -10.0 * 0.125 / (48.0 * stiffness);
    assert!((solution.displacement[4][1] / exact - 1.0).abs() < 1e-9);
    assert!((solution.reactions[body][2] - 0.2 * 5.0).abs() < 1e-9, "{:?}", solution.reactions[body]);
    // Without its other support it hangs from one pin.
    let mut loose = Supports::default();
    loose.tie_pinned(body, 0).clamp(body);
    let error = Statics::new(model.clone(), loose).unwrap_err();
    assert!(matches!(error, Error::UnderSupported { motion, .. } if motion[2] != 0.0), "{error}");
    // In motion, damped, it comes to the same rest.
    let rule = Integration::Trapezoidal { spectral_radius: 0.6 };
    let damping = Damping { mass: 60.0, stiffness: 0.0 };
    let mut dynamics = Dynamics::new(model, held, rule, damping).unwrap();
    let mut state = dynamics.at_rest();
    let load = loads.at_nodes(dynamics.beam(), &state.displacement).unwrap();
    for _ in 0..1000 {
        dynamics.step(&mut state, &load, 2e-3).unwrap();
    }
    assert!((state.displacement[4][1] / exact - 1.0).abs() < 1e-3, "{} against {exact}", state.displacement[4][1]);
    assert!((state.mean_reaction[body][1] - 5.0).abs() < 0.01);
}

#[test]
fn wrong_bodies_and_ties_are_named() {
    let (model, body) = beam(4).with_rigid_body([0.0, 0.5], 0.0, 1.0).unwrap();
    let fails = |held: &Supports, rule: Integration| {
        Dynamics::new(model.clone(), held.clone(), rule, Damping::default()).unwrap_err()
    };
    let mut held = Supports::default();
    held.tie(body, 0);
    let error = fails(&held, CONSERVING);
    assert!(matches!(error, Error::MasslessBody { node, dof: Dof::U, .. } if node == body), "{error}");
    assert!(matches!(natural_modes(&model, &held, 1), Err(Error::MasslessBody { .. })));
    for rule in [Integration::GeneralisedAlpha { spectral_radius: 1.0 }, Integration::CentralDifference] {
        let error = fails(&held, rule);
        assert!(matches!(error, Error::NoRigidBodies { node, .. } if node == body), "{error}");
    }
    assert!(matches!(
        fails(&held, Integration::Trapezoidal { spectral_radius: 0.0 }),
        Error::OutOfRange { value: 0.0, .. }
    ));
    held.clamp(body);
    assert!(Dynamics::new(model.clone(), held.clone(), CONSERVING, Damping::default()).is_ok());
    let with = |change: &dyn Fn(&mut Supports)| {
        let mut held = held.clone();
        change(&mut held);
        let error = Statics::new(model.clone(), held).unwrap_err();
        println!("{error}");
        error
    };
    for error in [
        with(&|held| _ = held.fix(0, Dof::U)),
        with(&|held| _ = held.tie(body, 0)),
        with(&|held| _ = held.tie(1, 2)),
        with(&|held| _ = held.tie(body, body)),
        with(&|held| _ = held.hinge(0, 1)),
    ] {
        assert!(matches!(error, Error::BadTie { .. } | Error::HingeGap { .. }), "{error}");
    }
    assert!(matches!(with(&|held| _ = held.tie(body, 77)), Error::NoSuchNode { item: "tie", node: 77, .. }));
    assert!(matches!(beam(4).with_rigid_body([0.0, 0.0], -1.0, 0.0), Err(Error::OutOfRange { value: -1.0, .. })));
    assert!(matches!(beam(4).with_rigid_body([f64::NAN, 0.0], 1.0, 0.0), Err(Error::NotFinite { .. })));
    // A body that nothing holds is a mechanism, named by its motion.
    let mut loose = Supports::default();
    loose.clamp(0);
    let error = Statics::new(model.clone(), loose).unwrap_err();
    assert!(matches!(error, Error::UnderSupported { node, .. } if node == body), "{error}");
}
