//! What a time step costs, by number of elements: `cargo run --release -p structure_fe --example step_cost`.
//!
//! A cantilever strip of aluminium, 1 m long and 5 mm thick, that a sudden load makes swing by a third of
//! its length, on one core; steps of 0.5 ms.

use std::time::Instant;
use structure_fe::{Beam, Damping, Dynamics, Error, Integration, Loads, Material, Section, Supports};

fn main() -> Result<(), Error> {
    println!("elements  implicit us/step  corrections  tangents  us/element | explicit us/step | trapezoidal us/step");
    for elements in [50, 100, 200, 400, 800, 1600, 3200] {
        let (time, corrections, tangents) =
            measure(elements, Integration::GeneralisedAlpha { spectral_radius: 0.8 }, 5e-4, 20)?;
        let (momentum, ..) = measure(elements, Integration::Trapezoidal { spectral_radius: 1.0 }, 5e-4, 20)?;
        let (explicit, ..) = measure(elements, Integration::CentralDifference, f64::NAN, 40)?;
        println!(
            "{elements:8}  {:16.1}  {corrections:11.2}  {tangents:8.2}  {:10.3} | {:16.1} | {:8.1}",
            1e6 * time,
            1e6 * time / elements as f64,
            1e6 * explicit,
            1e6 * momentum
        );
    }
    Ok(())
}

/// Seconds, corrections and tangents a step, the best of many short runs: others may use the machine.
fn measure(elements: usize, integration: Integration, dt: f64, steps: usize) -> Result<(f64, f64, f64), Error> {
    let material = Material { youngs_modulus: 70e9, poissons_ratio: 0.33, density: 2700.0 };
    let beam = Beam::straight([0.0, 0.0], [1.0, 0.0], elements, material, Section::strip(0.005))?;
    let mut loads = Loads::default();
    for element in 0..elements {
        loads.along_element(element, [0.0, -1000.0], [0.0, -1000.0]);
    }
    let mut supports = Supports::default();
    supports.clamp(0);
    let load = loads.at_nodes(&beam, &vec![[0.0; 3]; elements + 1])?;
    let mut dynamics = Dynamics::new(beam, supports, integration, Damping::default())?;
    let dt = if dt.is_nan() { 0.9 * dynamics.stable_dt() } else { dt };
    let mut state = dynamics.at_rest();
    dynamics.equilibrate(&mut state, &load)?;
    let runs = 40;
    let mut best = f64::INFINITY;
    let (mut corrections, mut tangents) = (0, 0);
    for _ in 0..runs {
        let start = Instant::now();
        (corrections, tangents) = (0, 0);
        for _ in 0..steps {
            let report = dynamics.step(&mut state, &load, dt)?;
            corrections += report.iterations;
            tangents += report.tangents;
        }
        best = best.min(start.elapsed().as_secs_f64() / steps as f64);
    }
    Ok((best, corrections as f64 / steps as f64, tangents as f64 / steps as f64))
}
