//! A wedge of 30 degrees rolled by 5: faces of 25 and 35 degrees. `cargo run --release -p water_entry --example two_deadrises`
//!
//! At constant speed the flow is similar (Semenov & Iafrati 2006): force and moment come from the pressure, and once more from the
//! water's momentum. Boundary elements follow the same wedge step by step, and could follow it in free fall under gravity too.

use std::error::Error;
use water_entry::{AsymmetricFlow, RolledEntry, SectionMotion, SimilarityFlow};

fn main() -> Result<(), Box<dyn Error>> {
    let deadrises = [25.0_f64, 35.0].map(f64::to_radians);
    let (speed, density, time) = (4.0_f64, 1000.0, 0.02);
    let similar = AsymmetricFlow::solve(deadrises[0], deadrises[1])?;
    let unit = density * speed.powi(3) * time;
    let exact = [similar.force[0] * unit, similar.force[1] * unit, similar.moment * unit * speed * time];
    let balance = similar.balance;
    let of_momentum = [balance.force[0] * unit, balance.force[1] * unit, balance.moment * unit * speed * time];

    let motion = SectionMotion::Constant;
    let [draught, sideways, gravity] = [0.0; 3];
    let entry = RolledEntry { deadrises, lengths: [0.5; 2], motion, draught, speed, sideways, gravity, density };
    let (instants, _) = entry.solve(time)?;
    let last = instants.last().ok_or("no step")?;
    let unit_then = (last.time / time).powi(2); // the moment grows with the square of time, the force with time
    let stepped = [last.force[0] * time / last.time, last.force[1] * time / last.time, last.moment / unit_then];

    println!("                sideways kN/m  upwards kN/m  moment about the apex kN");
    let lines = [("pressure", exact), ("momentum", of_momentum), ("boundary el.", stepped)];
    for (name, [fx, fy, moment]) in lines {
        println!("{name:15} {:13.3}  {:12.3}  {:24.4}", 1e-3 * fx, 1e-3 * fy, 1e-3 * moment);
        let error = |k: usize| ([fx, fy, moment][k] / exact[k] - 1.0).abs();
        assert!((0..3).all(|k| error(k) < 0.03), "{name}: {:.4?}", [0, 1, 2].map(error));
    }
    let upright = SimilarityFlow::solve(30.0).ok_or("no solution")?.force_coefficient * unit;
    println!("upright, both faces of 30 degrees: {:.3} kN/m upwards", 1e-3 * upright);
    for (name, face) in ["left", "right"].iter().zip(similar.faces()) {
        let pressure = 0.5 * density * speed * speed * face.cp_max;
        println!("{name} face of {:.0} degrees: up to {:.1} kPa", face.deadrise_deg, 1e-3 * pressure);
    }
    Ok(())
}
