//! A flexible panel as the floor of a tank: `cargo run --release -p fsi_coupling --example flexible_panel`.
//!
//! Still water, 1 m deep, on an aluminium strip of 1 m by 30 mm between clamps; everything is per metre of span. The load comes at once, so
//! that the strip swings about its deflection at rest, which the damping reaches: w = (rho g H + rho_s g t) L^4/(384 D) in the middle.

mod still_water;
use fsi_coupling::{Coupled, FlexibleBody, FlexibleSpec, Frame, Outline, PanelEnd, PanelSpec, Plane};
use fsi_coupling::{PrescribedBody, RigidMotion, Scheme};
use sph_core::Domain;
use std::error::Error;
use still_water::still_water;
use structure_fe::{Damping, Material, Theory};

fn main() -> Result<(), Box<dyn Error>> {
    let (thickness, spacing, gravity) = (0.03, 0.05, 9.81);
    let material = Material { youngs_modulus: 70e9, poissons_ratio: 0.33, density: 2700.0 };
    let strip = PanelSpec {
        name: "strip".into(),
        span: [[0.5, -1.0], [-0.5, -1.0]], // counter-clockwise on the bed's outline
        elements: 16,
        mesh: None,
        thickness,
        plane: Plane::Strain,
        material,
        theory: Theory::EulerBernoulli,
        plasticity: None,
        rupture_strain: None,
        allowable_stress: None,
        ends: [PanelEnd::Clamped; 2],
        end_springs: Default::default(),
        watch: vec![0.5], // the middle
    };
    let bed = FlexibleBody::new(FlexibleSpec {
        name: "bed".into(),
        outline: Outline::polygon(&[[-0.5, -1.4], [0.5, -1.4], [0.5, -1.0], [-0.5, -1.0]])?,
        middle: None,
        panels: vec![strip],
        frame: Frame::Given(PrescribedBody::steady([0.0; 2], 0.0, [0.0; 2], 0.0)),
        start: RigidMotion::default(),
        gravity: [0.0, -gravity],
        damping: Damping { mass: 40.0, stiffness: 0.0 },
        half: false,
    })?;
    let domain = Domain { gravity: [0.0, -gravity], fastest_speed: 5.0, ..Domain::default() };
    let (fluid, tank) = still_water(domain, ([-0.5, 0.5], -1.4), ([0.5, 1.4], spacing), |cell| cell.at[1] > -1.0);
    let mut system = Coupled::new(fluid, vec![Box::new(bed), Box::new(tank)], Scheme::AddedMass, spacing)?;
    let (mut sum, mut count) = (0.0, 0);
    while system.fluid.time() < 0.6 {
        system.step(system.stable_dt()?)?;
        let deflection = system.bodies().next().map_or(0.0, |bed| bed.panels()[0].watched[0].deflection);
        let settled = system.fluid.time() > 0.3;
        (sum, count) = if settled { (sum + deflection, count + 1) } else { (sum, count) };
    }
    let load = gravity * (1000.0 + material.density * thickness);
    let exact = 1e3 * load / (384.0 * Plane::Strain.section(thickness).bending_stiffness(&material));
    let mean = 1e3 * sum / f64::from(count);
    println!("mean of the second half {mean:.4} mm, theory {exact:.4} mm");
    assert!((mean / exact - 1.0).abs() < 0.03);
    Ok(())
}
