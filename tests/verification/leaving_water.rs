//! Water that leaves a round bottom under the projection (THEORY PR8).

use evidence::systems::{advance, lift, system};

/// An arc enters at constant speed. From 0.18 radii on water leaves its sides. Deeper than 0.4 radii the force of each step is near the
/// mean, and water that air reaches is under no tension of more than 2 % of ρV².
#[test]
fn water_leaves_an_arc_without_steps_of_no_load() {
    let sets = ["solver=incompressible", "fluid.ventilation=true", "resolution.spacing=0.02"];
    let mut arc = system("arc_constant", &sets);
    let (mut forces, mut least) = (Vec::new(), 0.0_f64);
    advance(&mut arc, 0.5, |s| {
        if s.fluid.time() > 0.4 {
            forces.push(lift(s));
            least = s.fluid.fields().pressure.iter().fold(least, |least, &p| least.min(p));
        }
    })
    .expect("a stable run");
    let mean = forces.iter().sum::<f64>() / forces.len() as f64;
    let farthest = forces.iter().map(|force| (force / mean - 1.0).abs()).fold(0.0, f64::max);
    println!(
        "{} steps, mean {mean:.0} N/m, farthest {:.1} %, least pressure {least:.1} Pa",
        forces.len(),
        100.0 * farthest
    );
    assert!(farthest < 0.2, "{farthest}");
    assert!(least > -20.0, "{least} Pa");
}
