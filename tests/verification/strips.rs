//! The water uses the motion that the strip makes (THEORY CO18).

use evidence::strip::{Floor, PERIOD};
use fsi_coupling::{Iteration, Scheme};

/// Accelerations of the strip's particles after a step against those that the water had in it, root of the sum of squares, mean
/// over a quarter of the wet period.
fn mismatch(floor: &Floor) -> f64 {
    let scheme = Scheme::IqnIls(Iteration { tolerance: 1e-8, max_iterations: 60 });
    let mut system = floor.build(scheme).expect("a strip");
    let range = system.range(0);
    let (mut sum, mut steps) = (0.0, 0.0);
    while system.fluid.time() < 0.25 * PERIOD {
        let dt = system.stable_dt().expect("a step");
        system.step(dt).expect("a stable run");
        let mut after = system.walls.clone();
        system.bodies().next().expect("the strip").kinematics(0.0, after.slice_mut(range.clone()));
        let (seen, now) = (&system.walls.ay[range.clone()], &after.ay[range.clone()]);
        let size = |values: &mut dyn Iterator<Item = f64>| values.map(|a| a * a).sum::<f64>().sqrt();
        sum += size(&mut seen.iter().zip(now).map(|(seen, now)| seen - now)) / size(&mut now.iter().copied());
        steps += 1.0;
    }
    sum / steps
}

/// They differ by what the step does not resolve, and less than half as much at half the step, whatever the strip weighs
/// (20 layers of water; ρ_s t/(ρ L) = 1, 0.1, 0.01).
#[test]
fn the_water_has_the_accelerations_of_the_strip() {
    for (ratio, most) in [(1.0, 0.025), (0.1, 0.07), (0.01, 0.25)] {
        let found = [0.6, 0.3, 0.15].map(|courant| mismatch(&Floor { courant, ..Floor::still(ratio, 20) }));
        println!("ratio {ratio}: {found:.4?}");
        assert!(found[0] < most, "{ratio}: {found:?}");
        assert!(found[1] < 0.6 * found[0] && found[2] < 0.6 * found[1], "{ratio}: {found:?}");
    }
}
