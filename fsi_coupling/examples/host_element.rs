//! Water around the nodes of another program: `cargo run --release -p fsi_coupling --example host_element`.
//!
//! The host has four nodes, the corners of a box of 0.4 by 0.3 m, and a time loop with a step of its own, 2 ms. Here it moves the box 0.1 m
//! further down within half a second and holds it there. Each call moves the water through the host's step and returns mean forces
//! on the nodes; after a while they are the buoyancy rho g b d. A step can be taken back: `save`, `restore`.

use fsi_coupling::embed::{FluidElementSpec, HostError, HostNodes, HostStep, Topology};

fn main() -> Result<(), HostError> {
    let reach = 2.0; // half width of the basin [m]
    let corners = vec![[-0.2, -0.1], [0.2, -0.1], [0.2, 0.2], [-0.2, 0.2]];
    let topology = Topology::of(corners.clone()).closed([0, 1, 2, 3]);
    let spec = FluidElementSpec { fastest_speed: Some(1.5), ..FluidElementSpec::new(0.02, reach, 0.5) };
    let sized = spec.size(&topology)?;
    println!(
        "{} particles, {:.1} MB, step of the water {:.1e} s",
        sized.fluid_particles(),
        1e-6 * sized.bytes() as f64,
        sized.fluid_dt()
    );
    sized.warnings().iter().for_each(|warning| println!("warning: {warning}"));

    let mut nodes = HostNodes::at_rest(corners.clone());
    let mut element = sized.build(&nodes)?;
    let mut forces = vec![[0.0; 3]; nodes.len()];
    let (dt, travel, duration) = (2e-3, 0.1, 0.5);
    let (mut mean, mut count) = (0.0, 0);
    for step in 1..=750 {
        // the host's motion: smooth from one place to the other
        let share = (f64::from(step) * dt / duration).min(1.0);
        let down = travel * share * share * (3.0 - 2.0 * share);
        nodes.position.iter_mut().zip(&corners).for_each(|(at, start)| at[1] = start[1] - down);
        nodes.velocity.fill([0.0, -travel * 6.0 * share * (1.0 - share) / duration]);
        if step == 100 {
            element.save(); // try a step, take it back, and take it again: the same bits
            element.contribute(HostStep { dt, nodes: &nodes }, &mut forces)?;
            let first = forces.clone();
            element.restore()?;
            element.contribute(HostStep { dt, nodes: &nodes }, &mut forces)?;
            assert_eq!(first, forces);
        } else {
            element.contribute(HostStep { dt, nodes: &nodes }, &mut forces)?;
        }
        let lift: f64 = forces.iter().map(|force| force[1]).sum();
        if step % 75 == 0 {
            println!("{:4.2} s: draught {:3.0} mm, upwards {lift:6.1} N/m", element.time(), 1e3 * (0.1 + down));
        }
        if step > 375 {
            (mean, count) = (mean + lift, count + 1);
        }
    }
    let rise = travel * 0.4 / (2.0 * reach - 0.4); // of the water, by what the box displaces
    let (mean, exact) = (mean / f64::from(count), 1000.0 * 9.81 * 0.4 * (0.1 + travel + rise));
    println!("mean of the second half {mean:.1} N/m, Archimedes {exact:.1} N/m");
    assert!((mean / exact - 1.0).abs() < 0.05);
    Ok(())
}
