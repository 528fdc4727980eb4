//! A seat on a spring in a hull that hits water: `cargo run --release -p fsi_coupling --example joined_bodies`.
//!
//! A wedge of 40 kg/m, a seat of 10 kg/m, and a slider with a spring between them: 10 Hz, a tenth of critical damping. In the theory the
//! modified Logvinovich model loads the same two masses. Compared is the spring's largest force up to 24 ms, when the chines get wet.

mod still_water;
use std::error::Error;
use std::f64::consts::TAU;

use fsi_coupling::{Body, ContactLaw, Coupled, JointKind, JointSpec, Outline, RigidBody2d, RigidSpec, Scheme, Shape};
use sph_core::Domain;
use still_water::still_water;
use water_entry::{EntryModel, Loads, Section};

fn main() -> Result<(), Box<dyn Error>> {
    let (masses, g, spacing) = ([40.0, 10.0], 9.81, 0.008);
    let (stiffness, damping) = (masses[1] * (TAU * 10.0_f64).powi(2), 0.2 * masses[1] * TAU * 10.0);
    let domain = Domain { gravity: [0.0, -g], fastest_speed: 12.0, ..Domain::default() };
    let hull = RigidSpec {
        name: "hull".into(),
        outline: Outline::of(&Shape::Wedge { deadrise_deg: 30.0, breadth: 0.4, side_height: 0.2 })?,
        mass: masses[0],
        inertia: 0.0,
        center_of_mass: [0.0; 2],
        free: [false, true, false],
        position: [0.0; 2],
        angle: 0.0,
        velocity: [0.0, -4.0],
        angular_velocity: 0.0,
        gravity: domain.gravity,
        half: false,
        sprung: Vec::new(),
    };
    let (place, outline) = ([0.0, 0.6], Outline::of(&Shape::Box { breadth: 0.2, height: 0.1 })?);
    let seat = RigidSpec { name: "seat".into(), outline, mass: masses[1], position: place, ..hull.clone() };
    let (name, bodies, kind) = ("spring".into(), [0, 1], JointKind::Slider { axis: [0.0, 1.0] });
    let slider = JointSpec { name, bodies, at: place, kind, stiffness, damping, breaks_at: None };
    let (fluid, tank) = still_water(domain, ([-1.2, 1.2], -0.8), ([0.3, 0.15], spacing), |_| true);
    let [hull, seat] = [hull, seat].map(RigidBody2d::new);
    let bodies: Vec<Box<dyn Body>> = vec![Box::new(hull?), Box::new(seat?), Box::new(tank)];
    let mut system =
        Coupled::new(fluid, bodies, Scheme::AddedMass, spacing)?.with_links(ContactLaw::default(), vec![slider])?;
    let loads = Loads::new(EntryModel::Mlm, &Section::wedge(30.0, 0.4)?)?;
    let (mut depth, mut speeds, mut most, dt) = ([0.0; 2], [4.0; 2], 0.0_f64, 1e-5);
    for _ in 0..2400 {
        let load = loads.at(depth[0]);
        let spring = stiffness * (depth[1] - depth[0]) + damping * (speeds[1] - speeds[0]);
        let water = 1000.0 * (load.slam * speeds[0].powi(2) + g * loads.section().still_area(depth[0]));
        speeds[0] += dt * (masses[0] * g + spring - water) / (masses[0] + 1000.0 * load.added_mass);
        speeds[1] += dt * (g - spring / masses[1]);
        (depth, most) = ([0, 1].map(|k| depth[k] + dt * speeds[k]), most.max(spring));
    }
    while system.fluid.time() < 0.024 {
        system.step(system.stable_dt()?)?;
    }
    let found = system.joints()[0].largest;
    println!("spring {found:.0} N/m, theory {most:.0} N/m: {:.1} g on the seat", found / (masses[1] * g));
    assert!((found / most - 1.0).abs() < 0.1);
    Ok(())
}
