//! The incompressible scheme: a standing wave in a tank. `cargo run --release -p sph_core --example standing_wave`
//!
//! Its period is compared with that of small waves, ω² = g k tanh(k d) (Lamb 1932, §228).

mod tank;

use sph_core::{Breakdown, Domain, Fluid, projection};
use tank::{tank, water};

const SPACING: f64 = 0.0125;
const LENGTH: f64 = 1.0;
const DEPTH: f64 = 0.5;
/// Largest speed at first [m/s].
const SPEED: f64 = 0.1;

fn main() -> Result<(), Breakdown> {
    let k = std::f64::consts::PI / LENGTH;
    let omega = (9.81 * k * (k * DEPTH).tanh()).sqrt();
    let mut seeds = water([LENGTH, DEPTH], SPACING);
    for seed in &mut seeds {
        let [x, y] = seed.at;
        let scale = SPEED / (k * DEPTH).cosh();
        seed.velocity = [scale * (k * x).sin() * (k * y).cosh(), -scale * (k * x).cos() * (k * y).sinh()];
    }
    let domain = Domain { gravity: [0.0, -9.81], fastest_speed: SPEED, ..Domain::default() };
    let mut fluid = Fluid::new(domain, &projection::Settings::default(), &seeds);
    let mut walls = tank([LENGTH, 2.0 * DEPTH], SPACING);
    fluid.initialise(&mut walls)?;

    // times at which the momentum along the tank changes its sign, a half period apart
    let (mut changes, mut before) = (Vec::new(), fluid.momentum()[0]);
    while changes.len() < 5 {
        let dt = fluid.stable_dt(&walls)?.min(0.01);
        fluid.step(&mut walls, dt)?;
        let now = fluid.momentum()[0];
        if now * before < 0.0 {
            changes.push(fluid.time() - dt * now / (now - before));
        }
        before = now;
    }
    let (period, exact) = (0.5 * (changes[4] - changes[0]), std::f64::consts::TAU / omega);
    println!("period {period:.4} s, of small waves {exact:.4} s; {} steps", fluid.steps());
    assert!((period / exact - 1.0).abs() < 0.02);
    Ok(())
}
