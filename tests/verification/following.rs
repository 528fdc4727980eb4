//! Resolution that follows (THEORY WC21): what is halved is not felt, and comes again to the same bits.

use evidence::systems::{advance, scene, system, take};
use fsi_coupling::Coupled;
use sph_core::RefinementZone;

/// A wedge that has begun to enter.
fn entering(sets: &[&str]) -> Coupled {
    let mut system = system("wedge", &[&["resolution.spacing=0.01"], sets].concat());
    take(&mut system, 150).expect("a stable run");
    system
}

/// A step that is taken back halves the same particles again, to the same bits.
#[test]
fn steps_taken_back_come_again_to_the_same_bits() {
    let mut system = entering(&[]);
    system.checkpoint();
    let count = system.fluid.particles().len();
    take(&mut system, 60).expect("a stable run");
    let once = system.fluid.particles().clone();
    assert!(once.len() > count, "nothing was halved");
    system.restore();
    assert_eq!(system.fluid.particles().len(), count);
    take(&mut system, 60).expect("a stable run");
    assert!(once == *system.fluid.particles());
}

/// At the end the water that touches the body is as fine as the scene says, and no particle is finer.
#[test]
fn water_at_the_body_is_as_fine_as_asked() {
    let scene = scene("wedge", &["resolution.spacing=0.01"]);
    let mut system = entering(&[]);
    advance(&mut system, 0.6 * scene.time.end, |_| {}).expect("a stable run");
    let (p, d) = (system.fluid.particles(), system.fluid.fields());
    let spacing = |k: usize| (p.mass[k] / 1000.0).sqrt() / 0.01;
    let body = system.bodies().find(|b| b.motion().is_some()).expect("a wedge");
    for k in 0..p.len() {
        assert!(spacing(k) > 0.95, "finer than asked: {}", spacing(k));
        let near_wall = d.moments[k].wall_kernel_sum > 0.02 && body.signed_distance([p.x[k], p.y[k]]) < 0.05;
        assert!(!near_wall || spacing(k) < 1.1, "{} spacings at ({}, {})", spacing(k), p.x[k], p.y[k]);
    }
}

/// Root mean square of p − ρ g depth over ρ g H inside a tank of still water, mean over the last half second of two [-];
/// its middle is being halved all the time, or not.
fn unrest(moving: bool) -> f64 {
    let mut tank = system("hydrostatic_tank", &["resolution.spacing=0.05"]);
    let (mut sum, mut count) = (0.0, 0.0);
    while tank.fluid.time() < 2.0 {
        if moving {
            let depth = 0.25 * tank.fluid.time();
            let zone =
                RefinementZone { depth, half_width: 0.2, spacing: 0.025, slope: 0.1, ..RefinementZone::default() };
            tank.fluid.set_refinement_zone(Some(zone));
        }
        take(&mut tank, 1).expect("a stable run");
        if tank.fluid.time() > 1.5 {
            let (p, d) = (tank.fluid.particles(), tank.fluid.fields());
            let error = |k: usize| d.pressure[k] / 9810.0 + p.y[k];
            let inside: Vec<usize> =
                (0..p.len()).filter(|&k| p.x[k].abs() < 0.3 && (-0.9..-0.1).contains(&p.y[k])).collect();
            sum += (inside.iter().map(|&k| error(k).powi(2)).sum::<f64>() / inside.len() as f64).sqrt();
            count += 1.0;
        }
    }
    sum / count
}

/// Still water that is being halved is disturbed by less than a hundredth of its pressure.
#[test]
fn halving_is_not_felt_by_still_water() {
    let [coarse, halved] = [false, true].map(unrest);
    println!("error of the pressure over that of the depth: coarse {coarse:.5}, being halved {halved:.5}");
    assert!(halved < 0.01 && coarse < 0.005, "{halved} against {coarse}");
}
