//! A column of water collapses: `cargo run --release -p sph_core --example dam_break`.
//!
//! The front is compared with the experiment of Martin & Moyce (1952, fig. 3: a column twice as high as wide). Its place depends on when
//! the experiment's diaphragm opened; its speed does not.

mod tank;

use sph_core::{Breakdown, Domain, Fluid, wcsph};
use tank::{advance, tank, water};

/// Width a of the column [m].
const WIDTH: f64 = 0.5;
const SPACING: f64 = WIDTH / 40.0;
/// Time t √(2g/a) and place of the front z/a, as measured [-].
const MEASURED: [[f64; 2]; 5] = [[1.212, 1.443], [1.602, 1.884], [2.283, 2.689], [2.95, 3.728], [3.598, 4.528]];

fn main() -> Result<(), Breakdown> {
    let height = 2.0 * WIDTH;
    let fastest_speed = 2.0 * (9.81 * height).sqrt(); // that of a front on a dry bed (Ritter 1892)
    let domain = Domain { gravity: [0.0, -9.81], fastest_speed, ..Domain::default() };
    let mut fluid = Fluid::new(domain, &wcsph::Settings::default(), &water([WIDTH, height], SPACING));
    let mut walls = tank([6.0 * WIDTH, 1.5 * height], SPACING);
    fluid.initialise(&mut walls)?;

    let (energy, mut fronts) = (fluid.energy().total(), Vec::new());
    println!("t sqrt(2g/a)  z/a computed  z/a measured");
    for [time, measured] in MEASURED {
        advance(&mut fluid, &mut walls, time * (WIDTH / (2.0 * 9.81)).sqrt())?;
        let front = fluid.particles().x.iter().fold(0.0_f64, |front, &x| front.max(x)) / WIDTH;
        println!("{time:12.3}  {front:12.3}  {measured:12.3}");
        fronts.push(front);
    }
    let [first, .., last] = MEASURED;
    let [ours, theirs] = [fronts[4] - fronts[0], last[1] - first[1]].map(|way| way / (last[0] - first[0]));
    println!("mean speed over sqrt(2ga): {ours:.3} computed, {theirs:.3} measured");
    assert!((ours / theirs - 1.0).abs() < 0.15);
    let lost = 1.0 - fluid.energy().total() / energy;
    println!("{} steps, {:.2} % of the energy lost", fluid.steps(), 100.0 * lost);
    assert!((0.0..0.05).contains(&lost));
    Ok(())
}
