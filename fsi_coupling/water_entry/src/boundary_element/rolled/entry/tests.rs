//! A fall as a symmetric wedge, and the end.

use super::*;
use crate::{FlowEntry, Section};

/// A wedge with equal faces that falls from above the water, against the driver of a symmetric one.
#[test]
fn equal_faces_fall_as_a_symmetric_wedge() {
    let (deadrise, breadth, motion, gravity, density) = (30.0_f64, 0.5, SectionMotion::Free(60.0), 9.81, 1000.0);
    let section = Section::wedge(deadrise, breadth).expect("a section");
    let entry = FlowEntry { section: &section, motion: motion.clone(), draught: -0.02, speed: 3.0, gravity, density };
    let times: Vec<f64> = (0..=25).map(|k| 1e-3 * f64::from(k)).collect();
    let (theirs, _, end) = entry.solve(&times).expect("in range");
    assert!(end.is_none(), "{end:?}");
    let lengths = [0.5 * breadth / deadrise.to_radians().cos(); 2];
    let own = RolledEntry {
        sideways: 0.0,
        deadrises: [deadrise.to_radians(); 2],
        lengths,
        motion,
        draught: -0.02,
        speed: 3.0,
        gravity,
        density,
    };
    let (steps, end) = own.solve(0.025).expect("in range");
    assert!(end.is_none(), "{end:?}");
    for now in theirs {
        let own = RolledInstant::between(&steps, now.time);
        let [draught, speed] = [own.draught - now.draught, own.speed - now.speed];
        assert!(draught.abs() < 3e-4 && speed.abs() < 0.01 * 3.0, "{} s: {draught:+.5} m, {speed:+.4} m/s", now.time);
        if now.wetted > 0.01 && now.wetted < 0.23 {
            assert!((own.force[1] / now.force - 1.0).abs() < 0.02, "{} s: {} {}", now.time, own.force[1], now.force);
        }
    }
}

#[test]
fn the_reason_of_the_end_is_returned() {
    let entry = RolledEntry {
        sideways: 0.0,
        deadrises: [0.6, 0.7],
        lengths: [0.5; 2],
        motion: SectionMotion::Free(20.0),
        draught: 0.0,
        speed: 1.0,
        gravity: 0.0,
        density: 1000.0,
    };
    let (steps, end) = RolledEntry { motion: SectionMotion::Constant, ..entry }.solve(1.5).expect("in range");
    assert!(end.expect("an end").what.contains("deeper") && steps[steps.len() - 1].draught > 1.0);
    assert!(steps.windows(2).all(|w| w[1].time > w[0].time));
}
