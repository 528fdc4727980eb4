//! A wedge falls into a tank of particles, against a theory: `cargo run --release -p fsi_coupling --example wedge_drop`.
//!
//! 30 degrees, 0.4 m broad, 40 kg per metre of span, 4 m/s at contact. The modified Logvinovich model (Korobkin 2004) gives the speed that
//! the water leaves to it as long as the chines are dry. Momentum of water, wedge and tank is kept to rounding.

mod still_water;

use std::error::Error;

use fsi_coupling::{Coupled, Outline, RigidBody2d, RigidSpec, Scheme, Shape};
use sph_core::Domain;
use still_water::still_water;
use water_entry::{Entry, EntryModel, Loads, Section, SectionMotion};

fn main() -> Result<(), Box<dyn Error>> {
    let (mass, speed, gravity, breadth) = (40.0, 4.0, 9.81, 0.4);
    let spacing = 0.006;
    let domain = Domain { gravity: [0.0, -gravity], fastest_speed: 3.0 * speed, ..Domain::default() };
    let (fluid, tank) = still_water(domain, ([-1.2, 1.2], -0.8), ([0.3, 0.15], spacing), |_| true);
    let wedge = RigidBody2d::new(RigidSpec {
        name: "wedge".into(),
        outline: Outline::of(&Shape::Wedge { deadrise_deg: 30.0, breadth, side_height: 0.2 })?,
        mass,
        inertia: 0.0,
        center_of_mass: [0.0, 0.15],
        free: [false, true, false],
        position: [0.0, 0.0],
        angle: 0.0,
        velocity: [0.0, -speed],
        angular_velocity: 0.0,
        gravity: domain.gravity,
        half: false,
        sprung: Vec::new(),
    })?;
    let mut system = Coupled::new(fluid, vec![Box::new(wedge), Box::new(tank)], Scheme::AddedMass, spacing)?;

    let loads = Loads::new(EntryModel::Mlm, &Section::wedge(30.0, breadth)?)?;
    let motion = SectionMotion::Free(mass);
    let (draught, density, buoyancy, steep) = (0.0, 1000.0, true, false);
    let theory = Entry { loads: &loads, motion, draught, speed, gravity, density, buoyancy, steep };
    println!("time ms  speed m/s  theory m/s  water kN/m  theory kN/m");
    for k in 1..=5 {
        while system.fluid.time() < 0.004 * f64::from(k) {
            system.step(system.stable_dt()?)?;
        }
        let now = system.bodies().find_map(|body| body.motion()).ok_or("no wedge")?;
        let exact = theory.solve(&[0.0, system.fluid.time()])?[1];
        print!("{:7.1}  {:9.3}  {:10.3}", 1e3 * exact.time, -now.velocity[1], exact.speed);
        println!("  {:10.2}  {:11.2}", 1e-3 * now.force[1], 1e-3 * exact.force);
        assert!((-now.velocity[1] / exact.speed - 1.0).abs() < 0.05);
    }
    println!("momentum: {:.1e} of what was exchanged is missing", system.momentum_audit().worst);
    assert!(system.momentum_audit().worst < 1e-10);
    Ok(())
}
