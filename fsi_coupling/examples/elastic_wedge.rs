//! A wedge whose faces bend enters water that boundary elements follow: `cargo run --release -p fsi_coupling --example elastic_wedge`.
//!
//! The benchmark of Scolan (2004): an aluminium wedge of 10° at 30 m/s, faces of 0.6 m by 40 mm between clamps. Deflection in the middle of a face
//! and strain there, beside Wagner's load on a modal beam (THEORY EN13), which holds for small deadrises.

use std::error::Error;
use std::time::Instant;

use fsi_coupling::{
    BendingEntry, FlexibleBody, FlexibleSpec, Frame, Outline, PanelEnd, PanelSpec, Plane, PrescribedBody, RigidMotion,
    Shape,
};
use structure_fe::{Damping, Material, Theory};
use water_entry::{BendingWater, ElasticWedge, Held, Section};

fn main() -> Result<(), Box<dyn Error>> {
    let given: Vec<f64> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    let given = |k: usize, usual: f64| given.get(k).copied().unwrap_or(usual);
    let (deadrise_deg, speed, thickness, pinned) =
        (given(0, 10.0), given(1, 30.0), given(2, 0.04), given(3, 0.0) > 0.0);
    let (length, density) = (0.6, 1000.0);
    let material = Material { youngs_modulus: 67.5e9, poissons_ratio: 0.34, density: 2700.0 };
    let (ends, held) = match pinned {
        true => ([PanelEnd::Sliding, PanelEnd::Pinned], [Held::Pinned; 2]),
        false => ([PanelEnd::Clamped; 2], [Held::Clamped; 2]),
    };
    let chine = [length, length * deadrise_deg.to_radians().tan()];
    let face = PanelSpec {
        name: "face".into(),
        span: [[0.0; 2], chine],
        elements: 30,
        mesh: None,
        thickness,
        plane: Plane::Strain,
        material,
        theory: Theory::EulerBernoulli,
        plasticity: None,
        rupture_strain: None,
        allowable_stress: None,
        ends,
        end_springs: Default::default(),
        watch: vec![0.5],
    };
    let outline = Outline::of(&Shape::Wedge { deadrise_deg, breadth: 2.0 * length, side_height: 0.2 })?;
    let section = Section::wedge(deadrise_deg, 2.0 * length)?;
    let water = BendingWater::new(&section, 0.0, speed, 0.0)?; // the face is rigid until then
    let (position, velocity) = ([0.0, -water.draught()], [0.0, -speed]);
    let start = RigidMotion { position, velocity, ..RigidMotion::default() };
    let law = PrescribedBody::steady(position, 0.0, velocity, 0.0);
    let body = FlexibleBody::new(FlexibleSpec {
        name: "wedge".into(),
        outline,
        middle: None,
        panels: vec![face],
        frame: Frame::Given(law),
        start,
        gravity: [0.0; 2],
        damping: Damping { mass: 0.0, stiffness: 0.0 },
        half: true,
    })?;
    let begun = water.draught() / speed;
    let mut entry = BendingEntry::new(Box::new(body), &section, water, density)?;
    let wedge = ElasticWedge {
        deadrise_deg,
        speed,
        density,
        length,
        thickness,
        section: Plane::Strain.section(thickness),
        material,
        held,
        modes: 8,
        steps: 2000,
    };
    let theory = wedge.enter().ok_or("a face that bends as fast as the water comes")?;
    let clock = Instant::now();
    let (end, mut steps, mut next) = (given(4, theory[theory.len() - 1].time), 0, 0.0);
    println!("time_s draught_m force_N_per_m wetted_m deflection_m strain stress_Pa | Wagner: deflection strain");
    while entry.time() + begun < end * (1.0 - 1e-9) {
        entry.step(end - begun)?;
        steps += 1;
        let time = entry.time() + begun;
        if time >= next {
            next += end / 20.0;
            let panel = &entry.body().panels()[0];
            let watched = panel.watched[0];
            let force = entry.body().motion().unwrap_or_default().force[1];
            let of_theory = &theory[theory.partition_point(|b| b.time < time).min(theory.len() - 1)];
            println!(
                "{:.6} {:.5} {:.4e} {:.4} {:.5e} {:.4e} {:.4e} | {:.5e} {:.4e}",
                time,
                entry.draught(),
                force,
                entry.half_width(),
                watched.deflection,
                watched.strain[0],
                panel.stress,
                wedge.deflection(of_theory, 0.5),
                wedge.strain(of_theory, 0.5)
            );
        }
    }
    let worst = entry.body().panels()[0].worst;
    println!(
        "{steps} steps, {} iterations, {:.2} s; stress {:.4e} to {:.4e} Pa",
        entry.iterations(),
        clock.elapsed().as_secs_f64(),
        worst.stress.least,
        worst.stress.most
    );
    Ok(())
}
