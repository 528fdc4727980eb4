//! The cost of a step grows with the number of elements, not faster. (Absolute times: the example `step_cost`.)

mod common;

use common::{MATERIAL, supports};
use std::time::Instant;
use structure_fe::{Beam, Damping, Dynamics, Integration, Loads, Section, Supports};

/// Seconds a step and element, the best of many short runs; and the corrections a step.
fn cost(elements: usize) -> (f64, f64) {
    let beam = Beam::straight([0.0, 0.0], [1.0, 0.0], elements, MATERIAL, Section::strip(0.005)).unwrap();
    let rule = Integration::GeneralisedAlpha { spectral_radius: 0.8 };
    let mut dynamics = Dynamics::new(beam, supports("cantilever", elements), rule, Damping::default()).unwrap();
    let mut loads = Loads::default();
    for element in 0..elements {
        loads.along_element(element, [0.0, -1000.0], [0.0, -1000.0]);
    }
    let load = loads.at_nodes(dynamics.beam(), &vec![[0.0; 3]; elements + 1]).unwrap();
    let mut state = dynamics.at_rest();
    dynamics.equilibrate(&mut state, &load).unwrap();
    let (mut best, mut corrections) = (f64::INFINITY, 0);
    for _ in 0..20 {
        let start = Instant::now();
        for _ in 0..5 {
            corrections += dynamics.step(&mut state, &load, 5e-4).unwrap().iterations;
        }
        best = best.min(start.elapsed().as_secs_f64() / 5.0);
    }
    (best / elements as f64, corrections as f64 / 100.0)
}

/// Seconds a step and element of a skin that is tied to one free rigid body at every fifth node.
fn cost_of_ties(elements: usize) -> f64 {
    let skin = Beam::straight([0.0, 0.0], [1.0, 0.0], elements, MATERIAL, Section::strip(0.005)).unwrap();
    let (model, body) = skin.with_rigid_body([0.5, 0.3], 50.0, 5.0).unwrap();
    let mut held = Supports::default();
    for node in (0..=elements).step_by(5) {
        held.link(body, node);
    }
    let rule = Integration::Trapezoidal { spectral_radius: 1.0 };
    let mut dynamics = Dynamics::new(model, held, rule, Damping::default()).unwrap();
    let load = dynamics.gravity_load([0.0, -9.81]);
    let mut state = dynamics.at_rest();
    let mut best = f64::INFINITY;
    for _ in 0..20 {
        let start = Instant::now();
        for _ in 0..5 {
            dynamics.step(&mut state, &load, 1e-4).unwrap();
        }
        best = best.min(start.elapsed().as_secs_f64() / 5.0);
    }
    best / elements as f64
}

#[test]
fn ties_to_a_body_all_along_do_not_widen_the_band() {
    let [few, many] = [100, 1000].map(cost_of_ties);
    println!("tied at every fifth node, 100 and 1000 elements: {:.3} and {:.3} us an element", 1e6 * few, 1e6 * many);
    assert!(many < 3.0 * few, "{few:e} and {many:e}: a body inside the band would make it a hundred times");
}

#[test]
fn a_step_costs_in_proportion_to_the_elements() {
    let [few, many] = [100, 1000].map(cost);
    println!("100 and 1000 elements: {:.3} and {:.3} us an element", 1e6 * few.0, 1e6 * many.0);
    assert!(many.0 < 3.0 * few.0, "{few:?} and {many:?}: a dense factor would make it a hundred times");
    assert!(many.1 < 4.0 && few.1 < 4.0, "{few:?} and {many:?}");
}
