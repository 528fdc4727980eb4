//! A host program that integrates a falling wedge itself: the shortest one, and the reference of the interfaces in other languages.
//!
//! ```sh
//! cargo run --release -p scenarios --example host_drop
//! ```
//!
//! A mass of 100 kg/m falls in y; the force is that of the step before. At step 40 a step with another velocity is tried, rejected and
//! redone. Each line: time [s], height [m], velocity [m/s], force [N/m]. With the argument `straight` no step is tried: the lines are the
//! same to the last digit.

use run::host::{HostedError, HostedScene, Interface};

const MASS: f64 = 100.0;
const GRAVITY: f64 = 9.81;
const DT: f64 = 1e-4;
const STEPS: usize = 100;

fn main() -> Result<(), HostedError> {
    let tries = std::env::args().nth(1).as_deref() != Some("straight");
    let sets = ["resolution.spacing=0.01", "time.end=0.02"].map(String::from);
    let scene = HostedScene::open("wedge", &sets, Interface::Body)?;
    eprintln!("{} particles, {} bytes", scene.fluid_particles(), scene.bytes());
    let mut nodes = scene.nodes().clone();
    let mut water = scene.build(&nodes)?;
    let mut forces = [[0.0; 3]];
    for step in 0..STEPS {
        if tries && step == 40 {
            water.save();
            let mut wrong = nodes.clone();
            wrong.velocity[0][1] = 0.0;
            let mut discarded = [[0.0; 3]];
            water.contribute(DT, &wrong, &mut discarded)?;
            water.restore()?;
        }
        let before = nodes.velocity[0][1];
        let acceleration = forces[0][1] / MASS - GRAVITY;
        nodes.velocity[0][1] = before + DT * acceleration;
        nodes.position[0][1] += DT * (0.5 * (before + nodes.velocity[0][1]));
        water.contribute(DT, &nodes, &mut forces)?;
        let (y, v) = (nodes.position[0][1], nodes.velocity[0][1]);
        println!("{:.16e} {y:.16e} {v:.16e} {:.16e}", water.time(), forces[0][1]);
    }
    water.finish().map(drop)
}
