//! Ties to rigid bodies: frequencies, statics, and what is refused.

mod common;

use common::{CONSERVING, MATERIAL, beam, body_with_panel, section, supports};
use structure_fe::{
    Beam, Damping, Dof, Dynamics, Error, Integration, Loads, Material, NonlinearStatics, Section, Statics, Supports,
    natural_modes,
};

/// Frequency of a cantilever of unit EI, rho A and length on a body of mass M and inertia J at its root:
/// M w^2 y = y''', J w^2 y' = -y'' at the root (the beam acts on the body), free at the tip.
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
        held.link(body, 0);
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
        held.link(body, 0);
        let far = natural_modes(&model, &held, 4).unwrap();
        if ratio > 1e3 {
            assert!((far[3].angular_frequency / clamped - 1.0).abs() < 1e-5);
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
    loads.at_node(body, [1e-3, -2e-3, 3e-4]);
    let small = Statics::new(model.clone(), held.clone()).unwrap().solve(&loads).unwrap();
    let large = NonlinearStatics::new(model, held).unwrap().solve(&loads, 1).unwrap();
    for (small, large) in small.displacement.iter().zip(&large.displacement) {
        for dof in 0..3 {
            assert!((small[dof] - large[dof]).abs() < 1e-5 * small[dof].abs().max(1e-8), "{small:?}, {large:?}");
        }
    }
    // Equilibrium: the clamp takes force and moment about itself.
    let [x, y] = [-0.65_f64, -0.05];
    let moment = 1e-3 * (0.3 + x * -2.0 - y * 1.0);
    for solution in [&small, &large] {
        let [u, w, m] = solution.reactions[8];
        assert!((u + 1e-3).abs() < 1e-12 && (w - 2e-3).abs() < 1e-12 && (m + moment).abs() < 1e-10, "{u}, {w}, {m}");
    }
    // Hung at the body by a stiff rotational spring, with a force on the arm: k theta = r x F as turned.
    let stiff = Material { youngs_modulus: 1e12, ..MATERIAL };
    let (model, mut held, body) = body_with_panel(stiff, 0.05, 4);
    held.pin(body).spring(body, Dof::Theta, 100.0);
    let mut loads = Loads::default();
    loads.at_node(4, [0.0, -300.0, 0.0]);
    let solved = NonlinearStatics::new(model, held).unwrap().solve(&loads, 8).unwrap();
    let theta = solved.displacement[body][2];
    let (s, c) = theta.sin_cos();
    let arm = c * 0.65 - s * 0.05;
    println!("turned by {theta} rad: {} against {}", 100.0 * theta, -300.0 * arm);
    assert!(theta < -0.8 && (100.0 * theta + 300.0 * arm).abs() < 1e-2);
    assert!((solved.reactions[body][1] - 300.0).abs() < 1e-2);
}

#[test]
fn a_pinned_tie_leaves_the_rotation_free() {
    let panel = Beam::straight([0.0, 0.0], [0.5, 0.0], 8, MATERIAL, Section::strip(0.005)).unwrap();
    let (model, body) = panel.with_rigid_body([-0.2, 0.1], 1.0, 1.0).unwrap();
    let mut held = Supports::default();
    held.link_pinned(body, 0).clamp(body).pin(8);
    let mut loads = Loads::default();
    loads.at_node(4, [0.0, -10.0, 0.0]);
    let solution = Statics::new(model.clone(), held.clone()).unwrap().solve(&loads).unwrap();
    let stiffness = Section::strip(0.005).bending_stiffness(&MATERIAL);
    let exact = -10.0 * 0.125 / (48.0 * stiffness);
    assert!((solution.displacement[4][1] / exact - 1.0).abs() < 1e-9);
    assert!((solution.reactions[body][2] - 0.2 * 5.0).abs() < 1e-9, "{:?}", solution.reactions[body]);
    // Without its other support it hangs from one pin.
    let mut loose = Supports::default();
    loose.link_pinned(body, 0).clamp(body);
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
    held.link(body, 0);
    let error = fails(&held, CONSERVING);
    assert!(matches!(error, Error::MasslessBody { node, dof: Dof::U, .. } if node == body), "{error}");
    assert!(matches!(natural_modes(&model, &held, 1), Err(Error::MasslessBody { .. })));
    for rule in [Integration::GeneralisedAlpha { spectral_radius: 1.0 }, Integration::CentralDifference] {
        let error = fails(&held, rule);
        assert!(matches!(error, Error::Unsupported { feature: "rigid bodies", index, .. } if index == body), "{error}");
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
        with(&|held| _ = held.link(body, 0)),
        with(&|held| _ = held.link(1, 2)),
        with(&|held| _ = held.link(body, body)),
        with(&|held| _ = held.hinge(0, 1)),
    ] {
        assert!(matches!(error, Error::BadJoint { .. } | Error::HingeGap { .. }), "{error}");
    }
    assert!(matches!(with(&|held| _ = held.link(body, 77)), Error::NoSuchNode { item: "rigid link", node: 77, .. }));
    assert!(matches!(beam(4).with_rigid_body([0.0, 0.0], -1.0, 0.0), Err(Error::OutOfRange { value: -1.0, .. })));
    assert!(matches!(beam(4).with_rigid_body([f64::NAN, 0.0], 1.0, 0.0), Err(Error::BadProperty { .. })));
    // A body that nothing holds is a mechanism, named by its motion.
    let mut loose = Supports::default();
    loose.clamp(0);
    let error = Statics::new(model.clone(), loose).unwrap_err();
    assert!(matches!(error, Error::UnderSupported { node, .. } if node == body), "{error}");
}
