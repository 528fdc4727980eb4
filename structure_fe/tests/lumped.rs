//! Lumped masses under the trapezoidal rule: frequencies, accelerations, the effective inertia.

mod common;

use common::{
    CONSERVING, RUBBER, beam, body_with_panel, exact_frequency, frequency_in_time, none, number, supports, table,
};
use structure_fe::{Damping, Dynamics, natural_modes};

#[test]
fn lumped_masses_keep_the_lowest_frequencies() {
    for elements in [16, 32] {
        for mode in 0..2 {
            let root = number(&table("beam_frequency_roots")[mode], "cantilever");
            let error = frequency_in_time(CONSERVING, mode, elements, 400.0) / exact_frequency(root) - 1.0;
            println!("{elements} elements, lumped, mode {}: {error:e}", mode + 1);
            assert!(error.abs() < 5e-3, "{elements} elements, mode {}: {error:e}", mode + 1);
        }
    }
}

/// Accelerations of a cantilever under a sudden load: strict equilibrium with the lumped masses against that over
/// a step, both against the mean acceleration of a fine solution.
#[test]
fn accelerations_over_a_step_are_smooth_where_strict_ones_are_rough() {
    let elements = 16;
    let period = 2.0 * std::f64::consts::PI
        / natural_modes(&beam(elements), &supports("cantilever", elements), 1).unwrap()[0].angular_frequency;
    for share in [50.0, 2.0] {
        let dt = period / share;
        let held = supports("cantilever", elements);
        let mut dynamics = Dynamics::new(beam(elements), held, CONSERVING, Damping::default()).unwrap();
        let mut state = dynamics.at_rest();
        let mut load = dynamics.gravity_load([0.0, -9.81]);
        load[elements][1] -= 10.0;
        let (mut rough, mut smooth): (f64, f64) = (0.0, 0.0);
        dynamics.equilibrate_over(&mut state, &load, dt).unwrap();
        let first = state.acceleration[elements][1];
        for _ in 0..100 {
            dynamics.step(&mut state, &load, dt).unwrap();
            let mut strict = state.clone();
            dynamics.equilibrate(&mut strict, &load).unwrap();
            let residual = dynamics.residual(&strict, &load);
            assert!(residual.as_flattened().iter().all(|residual| residual.abs() < 1e-6), "in equilibrium");
            rough = rough.max(strict.acceleration[elements][1].abs());
            dynamics.equilibrate_over(&mut strict, &load, dt).unwrap();
            let (over, after) = (strict.acceleration[elements][1], state.acceleration[elements][1]);
            assert!((over - after).abs() < 2e-2 * first.abs(), "{over} after the step {after}");
            smooth = smooth.max(strict.acceleration[elements][1].abs());
        }
        println!("step of T/{share}: first {first}, strict up to {rough}, over the step up to {smooth} m/s^2");
        assert!(smooth < 5.0 * 9.81 + 50.0, "{smooth}");
        assert!(rough > smooth);
    }
}

/// A mass given as a block is the mass: accelerations of a model with a point mass, and of one with its block; at a
/// tied node it is at the end of the body's arm.
#[test]
fn blocks_add_to_the_effective_inertia() {
    let (elements, dt) = (8, 1e-3);
    let solve = |point: bool, node: usize| {
        let (model, held, _) = body_with_panel(RUBBER, 0.02, elements);
        let model = if point { model.with_point_mass(node, 3.0, 0.0).unwrap() } else { model };
        let mut dynamics = Dynamics::new(model, held, CONSERVING, Damping { mass: 0.0, stiffness: 1e-4 }).unwrap();
        let mut state = dynamics.at_rest();
        let mut load = none(elements + 2);
        load[3] = [1.0, -2.0, 0.1];
        load[0] = [0.5, 0.0, 0.0];
        dynamics.equilibrate(&mut state, &none(elements + 2)).unwrap();
        let residual = dynamics.residual(&state, &load);
        let mut inertia = dynamics.effective_inertia(&state, dt);
        if !point {
            let mut block = [0.0; 36];
            (block[3 * 6 + 3], block[4 * 6 + 4]) = (3.0, 3.0);
            let other = if node == 0 { 1 } else { node - 1 };
            inertia.add(&[other, node], &block);
        }
        let solved = inertia.solve(&residual).unwrap();
        (solved[0], solved[5], solved[node])
    };
    for node in [5, 0] {
        let (with_mass, with_block) = (solve(true, node), solve(false, node));
        for (a, b) in [(with_mass.0, with_block.0), (with_mass.1, with_block.1), (with_mass.2, with_block.2)] {
            for k in 0..3 {
                // Where the body's node is differs, what moves does not.
                assert!((a[k] - b[k]).abs() < 1e-9 * b[k].abs().max(1e-3), "node {node}: {a:?}, {b:?}");
            }
        }
    }
}
