//! The work of a step for each element does not grow with the number of elements: corrections are counted here, the
//! width of the matrix in `assembly/system.rs`. (Times: the example `step_cost`.)

mod common;

use common::{MATERIAL, supports};
use structure_fe::{Beam, Damping, Dynamics, Integration, Loads, Section};

/// Corrections per step, the mean of 100 steps of a cantilever under a sudden load.
fn corrections(elements: usize) -> f64 {
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
    let all: usize = (0..100).map(|_| dynamics.step(&mut state, &load, 5e-4).unwrap().iterations).sum();
    all as f64 / 100.0
}

#[test]
fn a_step_takes_few_corrections_for_any_number_of_elements() {
    let [few, many] = [100, 1000].map(corrections);
    println!("corrections per step: {few} and {many}");
    assert!(few < 4.0 && many < 4.0, "corrections per step: {few} and {many}");
}
