//! The mirror plane against the whole tank (THEORY OP3: images).

use std::collections::HashMap;

use evidence::systems::{lift, system};
use fsi_coupling::Coupled;

/// Steps compared: disorder amplifies rounding, so that longer runs part without either being wrong.
const STEPS: usize = 50;

/// Even cells: the rows of graded ones are divided over the whole width, and need not meet at the middle.
const EVEN: [&str; 8] = [
    "fluid.acoustic_steps=1", // weights that are held are in single precision
    "time.start=0",
    "resolution.growth=1",
    "resolution.spacing=0.125",
    "tank.width=8",
    "tank.depth=3",
    "body.breadth=4",
    "body.side_height=1",
];

/// Place at the start of each particle with x > 0, to the nearest 1e-6 of a metre, by identity.
fn labels(system: &Coupled) -> HashMap<(i64, i64), u32> {
    let p = system.fluid.particles();
    let micro = |x: f64| (1e6 * x).round() as i64;
    (0..p.len()).filter(|&k| p.x[k] > 0.0).map(|k| ((micro(p.x[k]), micro(p.y[k])), p.id[k])).collect()
}

/// Position, velocity and density of each particle, by identity.
fn states(system: &Coupled) -> HashMap<u32, [f64; 5]> {
    let p = system.fluid.particles();
    (0..p.len()).map(|k| (p.id[k], [p.x[k], p.y[k], p.u[k], p.v[k], p.rho[k]])).collect()
}

/// Half a tank with a mirror is the right half of the whole one: same particles, same force on the body, over 50 steps to
/// 1e-8 of each quantity's scale. (The two sides of the whole wedge carry wall particles that mirror each other to 1e-9
/// of a spacing: places along a face are found by bisection.)
#[test]
fn half_a_tank_with_a_mirror_is_half_of_the_whole() {
    let mut half = system("wedge_constant", &EVEN);
    let mut whole = system("wedge_constant", &[&EVEN[..], &["symmetry=none"]].concat());
    let (right, all) = (labels(&half), labels(&whole));
    assert_eq!(right.len(), half.fluid.particles().len());
    assert_eq!(2 * right.len(), whole.fluid.particles().len(), "the whole tank is not two halves");
    for _ in 0..STEPS {
        let dt = half.stable_dt().expect("a stable run");
        half.step(dt).expect("a stable run");
        whole.step(dt).expect("a stable run");
        let (one, other) = (lift(&half), lift(&whole));
        assert!((one - other).abs() <= 1e-8 * other.abs().max(1.0), "t = {}: {one} and {other} N/m", half.fluid.time());
    }
    assert!(lift(&half) > 1.0, "the wedge does not feel the water: {} N/m", lift(&half));
    let (ours, theirs) = (states(&half), states(&whole));
    let scale = [1.0, 1.0, 1.0, 1.0, 1000.0]; // m, m, m/s (the wedge's speed), kg/m³
    for (place, id) in &right {
        let (a, b) = (ours[id], theirs[&all[place]]);
        for k in 0..5 {
            assert!((a[k] - b[k]).abs() < 1e-8 * scale[k], "particle from {place:?} µm: {a:?} against {b:?}");
        }
    }
}
