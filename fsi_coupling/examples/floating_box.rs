//! A box is released near its floating position: `cargo run --release -p fsi_coupling --example floating_box`.
//!
//! 0.4 m broad and 60 kg per metre of span: Archimedes gives a draught of m/(rho b) = 0.15 m. It starts 30 mm too high and heaves; waves
//! take the energy away. Its mean draught over a period, below the level that the tank's water has by then, is that of Archimedes.

mod still_water;

use std::error::Error;

use fsi_coupling::geometry::layout::Cell;
use fsi_coupling::{Contact, Coupled, Outline, RigidBody2d, RigidSpec, Scheme, Shape};
use sph_core::Domain;
use still_water::still_water;

fn main() -> Result<(), Box<dyn Error>> {
    let (mass, breadth, height, gravity, spacing) = (60.0, 0.4, 0.3, 9.81, 0.02);
    let domain = Domain { gravity: [0.0, -gravity], fastest_speed: 1.0, ..Domain::default() };
    let floats = mass / (domain.fluid.density * breadth);
    let start = floats - 0.03;
    let body = RigidBody2d::new(RigidSpec {
        name: "box".into(),
        outline: Outline::of(&Shape::Box { breadth, height })?,
        mass,
        inertia: 1.0,
        center_of_mass: [0.0, 0.0],
        free: [false, true, false],
        position: [0.0, 0.5 * height - start],
        angle: 0.0,
        velocity: [0.0; 2],
        angular_velocity: 0.0,
        gravity: domain.gravity,
        half: false,
        sprung: Vec::new(),
    })?;
    let (width, floor) = (2.8, -0.6);
    let outside = |cell: &Cell| body.signed_distance(cell.at) > cell.clearance(false);
    let (fluid, tank) = still_water(domain, ([-0.5 * width, 0.5 * width], floor), ([width, -floor], spacing), outside);
    let mut system = Coupled::new(fluid, vec![Box::new(body), Box::new(tank)], Scheme::AddedMass, spacing)?;

    let (mut sum, mut steps, mut printed) = (0.0, 0, 0.0);
    while system.fluid.time() < 2.4 {
        system.step(system.stable_dt()?)?;
        let (time, motion) = (system.fluid.time(), system.bodies().find_map(|body| body.motion()).ok_or("no box")?);
        let deeper = 0.5 * height - motion.position[1] - start;
        let draught = start + deeper * (1.0 + breadth / (width - breadth)); // the water rises by what the box displaces
        if time >= printed {
            println!("{time:4.1} s: draught {:6.1} mm, water {:5.0} N/m", 1e3 * draught, motion.force[1]);
            printed += 0.2;
        }
        if time > 1.4 {
            (sum, steps) = (sum + draught, steps + 1);
        }
    }
    let mean = sum / f64::from(steps);
    println!("mean draught {:.1} mm, Archimedes {:.1} mm", 1e3 * mean, 1e3 * floats);
    assert!((mean / floats - 1.0).abs() < 0.03);
    Ok(())
}
