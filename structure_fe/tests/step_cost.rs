//! The cost of a step grows with the number of elements, not faster. (Absolute times: the example `step_cost`.)

mod common;

use common::{MATERIAL, supports};
use structure_fe::{Beam, Damping, Dynamics, Integration, Loads, Section, Supports};

/// Steps of all elements in a run: a few hundredths of a second.
const STEPS_OF_ELEMENTS: usize = 20_000;

/// Processor time of this thread [s]: what other processes take is not in it. None where the system does not tell.
fn processor_time() -> Option<f64> {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(1e-9 * told.split_whitespace().next()?.parse::<f64>().ok()?)
}

/// Processor time of `step` for each element [s], the least of some runs; none where the system does not tell.
fn time_of(elements: usize, mut step: impl FnMut()) -> Option<f64> {
    let mut least = f64::INFINITY;
    for _ in 0..5 {
        let start = processor_time();
        (0..STEPS_OF_ELEMENTS / elements).for_each(|_| step());
        least = least.min((processor_time()? - start?) / STEPS_OF_ELEMENTS as f64);
    }
    Some(least)
}

/// Growth of the time for an element from few elements to many is below `most`.
fn assert_growth(what: &str, few: Option<f64>, many: Option<f64>, most: f64) {
    let (Some(few), Some(many)) = (few, many) else { return println!("{what}: the system tells no time") };
    println!("{what}, 100 and 1000 elements: {:.3} and {:.3} us an element", 1e6 * few, 1e6 * many);
    assert!(many < most * few, "{what}: {few:e} s and {many:e} s an element");
}

/// Processor time of a step for each element [s]; and the corrections a step.
fn cost(elements: usize) -> (Option<f64>, f64) {
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
    let (mut corrections, mut steps) = (0, 0);
    let time = time_of(elements, || {
        corrections += dynamics.step(&mut state, &load, 5e-4).unwrap().iterations;
        steps += 1;
    });
    (time, corrections as f64 / f64::from(steps))
}

/// Processor time of a step for each element [s] of a skin that is tied to one free rigid body at every fifth node.
fn cost_of_ties(elements: usize) -> Option<f64> {
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
    time_of(elements, || assert!(dynamics.step(&mut state, &load, 1e-4).is_ok()))
}

/// A body inside the band would make it a hundred times.
#[test]
fn ties_to_a_body_all_along_do_not_widen_the_band() {
    let [few, many] = [100, 1000].map(cost_of_ties);
    assert_growth("tied at every fifth node", few, many, 3.0);
}

/// A dense factor would make it a hundred times.
#[test]
fn a_step_costs_in_proportion_to_the_elements() {
    let [few, many] = [100, 1000].map(cost);
    assert_growth("loaded all along", few.0, many.0, 3.0);
    assert!(many.1 < 4.0 && few.1 < 4.0, "corrections a step: {} and {}", few.1, many.1);
}
