//! A wedge with elastic faces against a rigid one: `cargo run --release -p water_entry --example elastic_faces`.
//!
//! Aluminium plates of 0.6 m and 40 mm, simply supported at keel and chine, at 10 degrees and 30 m/s: eight dry modes on Wagner's load
//! (Korobkin & Khabakhpasheva). An independent program gives 30.87 mm in the middle when the chines get wet, and a strain of
//! 1.586 % at most. The second wedge has plates ten times as thick: it is wetted as a rigid one, c = pi V t/(2 tan beta).

use std::f64::consts::PI;
use structure_fe::{Material, Section};
use water_entry::{ElasticWedge, Held};

fn main() {
    let wedge = |thickness: f64, steps: usize| ElasticWedge {
        deadrise_deg: 10.0,
        speed: 30.0,
        density: 1000.0,
        length: 0.6,
        thickness,
        section: Section::strip(thickness),
        material: Material { youngs_modulus: 67.5e9, poissons_ratio: 0.34, density: 2700.0 },
        held: [Held::Pinned; 2],
        modes: 8,
        steps,
    };
    let elastic = wedge(0.04, 200);
    let states = elastic.enter().expect("the wet part grows on these faces");
    println!("time ms  wetted m  middle mm  strain in the middle %  keel's potential m2/s");
    for now in states.iter().skip(25).step_by(25) {
        println!(
            "{:7.3}  {:8.3}  {:9.3}  {:22.4}  {:21.3}",
            1e3 * now.time,
            now.wetted,
            1e3 * elastic.deflection(now, 0.5),
            100.0 * elastic.strain(now, 0.5),
            elastic.potential(now, 0.0)
        );
    }
    let last = states.last().expect("a state at the chine");
    let deflection = elastic.deflection(last, 0.5);
    let strain = states.iter().map(|now| elastic.strain(now, 0.5)).fold(0.0, f64::max);
    println!(
        "at the chine {:.2} mm, reference 30.87 mm; strain {:.3} %, reference 1.586 %",
        1e3 * deflection,
        100.0 * strain
    );
    assert!((deflection / 30.87e-3 - 1.0).abs() < 0.02 && (strain / 1.586e-2 - 1.0).abs() < 0.02);

    let rigid_time = 2.0 * 0.6 * 10.0_f64.to_radians().tan() / (PI * 30.0);
    let stiff = wedge(0.4, 4000);
    let stiff_time = stiff.enter().and_then(|states| Some(states.last()?.time)).expect("a state at the chine");
    println!(
        "chines wet after {:.3} ms; stiff faces {:.3} ms, Wagner {:.3} ms",
        1e3 * last.time,
        1e3 * stiff_time,
        1e3 * rigid_time
    );
    assert!((stiff_time / rigid_time - 1.0).abs() < 0.01 && last.time > stiff_time);
}
