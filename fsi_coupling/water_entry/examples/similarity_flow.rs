//! The exact flow about a wedge of 30 degrees at constant speed: `cargo run --release -p water_entry --example similarity_flow`.
//!
//! Without gravity and viscosity the flow grows with V t and keeps its shape (Dobrovolskaya 1969). Reference: Zhao & Faltinsen
//! (1993), table 1, whose values differ from later solutions by up to one percent. The force follows twice, from the pressure and from the rate of the water's energy.

use water_entry::SimilarityFlow;

fn main() {
    let flow = SimilarityFlow::solve(30.0).expect("deadrises of 4 to 80 degrees have a solution");
    let rows = [
        ("largest pressure coefficient", flow.cp_max, 6.927),
        ("height of it over still water, over V t", flow.z_max, 0.4243),
        ("force over rho V^3 t", flow.force_coefficient, 14.139),
        ("the same from the energy", flow.force_from_energy, 14.139),
    ];
    for (name, computed, published) in rows {
        println!(
            "{name:40} {computed:8.4}, Zhao & Faltinsen {published:7.4}: {:+.2} %",
            100.0 * (computed / published - 1.0)
        );
        assert!((computed / published - 1.0).abs() < 0.01, "{name}");
    }

    // a wedge at 6 m/s, 10 ms after contact
    let (density, speed, time) = (1000.0, 6.0_f64, 0.01);
    println!("jet's tip at ({:.1}, {:.1}) mm", 1e3 * speed * time * flow.tip[0], 1e3 * speed * time * flow.tip[1]);
    for x in [0.0, 0.03, 0.06, 0.09, 0.12, 0.14] {
        let pressure = 0.5 * density * speed * speed * flow.pressure_coefficient(x / (speed * time));
        println!("{:5.0} mm from the keel: {:6.1} kPa", 1e3 * x, 1e-3 * pressure);
    }
}
