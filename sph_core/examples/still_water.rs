//! Still water in a tank, and its pressure at points: `cargo run --release -p sph_core --example still_water`.

mod tank;

use sph_core::{Breakdown, Domain, Fluid, Probe, wcsph};
use tank::{WEIGHT, advance, tank, water};

const SPACING: f64 = 0.025;
const DEPTH: f64 = 0.5;

fn main() -> Result<(), Breakdown> {
    // the speed of sound is ten times the fastest speed: here that of a long wave, √(g H)
    let domain = Domain { gravity: [0.0, -9.81], fastest_speed: (9.81 * DEPTH).sqrt(), ..Domain::default() };
    let mut fluid = Fluid::new(domain, &wcsph::Settings::default(), &water([1.0, DEPTH], SPACING));
    let mut walls = tank([1.0, 2.0 * DEPTH], SPACING);
    fluid.initialise(&mut walls)?;
    advance(&mut fluid, &mut walls, 2.0)?;

    let probe = Probe::new(&fluid);
    println!("depth [m]  pressure [Pa]  rho g h [Pa]");
    for depth in [0.2, 0.3, 0.4, DEPTH] {
        let found = match depth {
            DEPTH => probe.on_flat_face([0.5, 0.0], [0.0, 1.0], -WEIGHT), // on the floor
            _ => probe.shepard([0.5, DEPTH - depth]),
        };
        println!("{depth:9.2}  {found:13.1}  {:12.1}", WEIGHT * depth);
        assert!((found / (WEIGHT * depth) - 1.0).abs() < 0.02);
    }
    println!("fastest particle: {:.4} m/s", fluid.top_speed());
    Ok(())
}
