//! The pulse of the air under a flat plate: `cargo run --release -p water_entry --example air_cushion`.
//!
//! A flat bottom does not hit the water at once: air between them makes the pressure finite (Chuang 1966, 1967). What a heavy plate
//! gives the water in all is the momentum of the plate's added mass, (pi/2) rho b^2 V (von Karman 1929). Without air the pressure would
//! be that of the water hammer, rho c V. `water_entry::air_cushion` says for which slopes the cushion holds.

use std::f64::consts::FRAC_PI_2;
use water_entry::air_cushion::{AirCushion, LARGEST_SLOPE_DEG};

fn main() {
    let density = 1000.0;
    println!("for bottoms up to {LARGEST_SLOPE_DEG} degree; plates 0.5 m broad");
    println!(
        "speed m/s  largest kPa  water hammer kPa  duration ms  impulse N s/m  of the added mass  sound for particles m/s"
    );
    for speed in [1.0, 2.0, 4.0] {
        let cushion = AirCushion { half_breadth: 0.25, speed };
        // integral of the pulse over time and breadth, by the trapezoidal rule
        let (steps, breadth) = (2000, 2.0 * cushion.half_breadth);
        let dt = cushion.duration() / f64::from(steps);
        let impulse: f64 = (0..=steps).map(|k| cushion.pressure(f64::from(k) * dt) * dt * breadth).sum();
        let of_added_mass = FRAC_PI_2 * density * cushion.half_breadth.powi(2) * speed;
        println!(
            "{speed:9.1}  {:11.1}  {:16.0}  {:11.2}  {impulse:13.1}  {of_added_mass:17.1}  {:23.1}",
            1e-3 * cushion.largest_pressure(),
            1e-3 * density * 1480.0 * speed,
            1e3 * cushion.duration(),
            cushion.equivalent_sound_speed(density)
        );
        assert!((impulse / of_added_mass - 1.0).abs() < 0.02);
        assert!((impulse / (breadth * cushion.impulse()) - 1.0).abs() < 1e-3);
    }
}
