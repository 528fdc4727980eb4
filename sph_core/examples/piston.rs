//! A wall that moves: a piston starts at constant speed and pushes a bore along a channel.
//! `cargo run --release -p sph_core --example piston`
//!
//! Depth behind the bore and force on the piston are compared with the jump relations of shallow water (Stoker 1957, §10.6).

mod tank;

use sph_core::{Breakdown, Domain, Fluid, wcsph};
use tank::{WEIGHT, tank, water};

const SPACING: f64 = 0.01;
const DEPTH: f64 = 0.2;
const LENGTH: f64 = 3.0;
const SPEED: f64 = 0.3;
const END: f64 = 1.2;

/// Depth [m] behind a bore that leaves water at `SPEED`: U = (h₂ − h₁) √(g (h₁ + h₂)/(2 h₁ h₂)), by bisection.
fn depth_behind() -> f64 {
    let speed = |h: f64| (h - DEPTH) * (0.5 * 9.81 * (h + DEPTH) / (h * DEPTH)).sqrt();
    let halve = |[low, high]: [f64; 2], middle: f64| if speed(middle) < SPEED { [middle, high] } else { [low, middle] };
    (0..50).fold([DEPTH, 2.0 * DEPTH], |range, _| halve(range, 0.5 * (range[0] + range[1])))[0]
}

fn main() -> Result<(), Breakdown> {
    let domain = Domain { gravity: [0.0, -9.81], fastest_speed: 2.0, ..Domain::default() };
    let mut fluid = Fluid::new(domain, &wcsph::Settings::default(), &water([LENGTH, DEPTH], SPACING));
    let mut walls = tank([LENGTH, 2.0 * DEPTH], SPACING);
    let piston = walls.owners[1].clone(); // the left wall
    fluid.initialise(&mut walls)?;

    let (mut impulse, mut duration) = (0.0, 0.0);
    while fluid.time() < END {
        let dt = fluid.stable_dt(&walls)?;
        let moved = walls.slice_mut(piston.clone());
        moved.x.iter_mut().for_each(|x| *x += SPEED * dt); // where it is at the end of the step
        moved.u.fill(SPEED); // its velocity over the step
        fluid.step(&mut walls, dt)?;
        if fluid.time() > 0.5 * END {
            impulse -= dt * walls.forces(piston.clone()).mean_resultant([0.0; 2]).force[0];
            duration += dt;
        }
    }
    let p = fluid.particles();
    let behind = |k: &usize| (0.1..0.5).contains(&(p.x[*k] - SPEED * END));
    let depth = (0..p.len()).filter(behind).map(|k| p.mass[k] / p.rho[k]).sum::<f64>() / 0.4;
    let exact = depth_behind();
    let [force, exact_force] = [impulse / duration, 0.5 * WEIGHT * exact * exact];
    println!("depth behind the bore {depth:.4} m, of shallow water {exact:.4} m");
    println!("mean force on the piston {force:.1} N/m, of shallow water {exact_force:.1} N/m");
    assert!((depth / exact - 1.0).abs() < 0.03 && (force / exact_force - 1.0).abs() < 0.05);
    Ok(())
}
