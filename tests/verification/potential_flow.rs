//! Fully nonlinear potential flow by boundary elements (THEORY EN20–EN23) against the similarity solution and against conservation.

use fsi_coupling::entry_theory::{SimilarityFlow, WedgeFlow};

/// Draught at the start [m] and downward speed [m/s].
const START: f64 = 0.1;
const SPEED: f64 = 2.0;

/// At constant speed without gravity force and largest pressure are those of the exact solution, at deadrises beside the round ones too. The
/// start is forgotten at three times its draught.
#[test]
fn a_wedge_at_constant_speed_has_the_similar_flow() {
    for deadrise in [22.0, 30.0, 37.0, 43.5, 52.0, 60.0] {
        let exact = SimilarityFlow::solve(deadrise).expect("a solution");
        let mut flow = WedgeFlow::new(deadrise, START, SPEED, 0.0).expect("in range");
        let mut samples = Vec::new();
        while flow.draught() < 4.0 * START {
            let draught = flow.draught();
            let (_, load) = flow.step(|_| 0.0).expect("a step");
            if draught > 3.0 * START {
                let highest = load.pressure.iter().map(|p| p[1]).fold(0.0, f64::max);
                samples.push([load.force / (SPEED * SPEED * draught), 2.0 * highest / (SPEED * SPEED)]);
            }
        }
        let mean = |of: usize| samples.iter().map(|s| s[of]).sum::<f64>() / samples.len() as f64;
        let [force, cp_max] = [mean(0) / exact.force_coefficient - 1.0, mean(1) / exact.cp_max - 1.0];
        assert!(force.abs() < 0.005, "{deadrise}°: force {:+.2} %", 100.0 * force);
        assert!(cp_max.abs() < 0.01, "{deadrise}°: largest pressure {:+.2} %", 100.0 * cp_max);
        let scatter = samples.iter().map(|s| (s[0] / mean(0) - 1.0).powi(2)).sum::<f64>() / samples.len() as f64;
        assert!(scatter.sqrt() < 0.003, "{deadrise}°: scatter of the force {:.2} %", 100.0 * scatter.sqrt());
    }
}

/// A body without weight of its own that is let go decelerates by momentum: m dV = −F dt. Two masses of one flow differ as F = ρ(A V² + M V̇)
/// says, and an infinite mass keeps its speed.
#[test]
fn a_free_wedge_decelerates_by_the_load() {
    let drop = |mass: f64| {
        let mut flow = WedgeFlow::new(30.0, START, SPEED, 9.81).expect("in range");
        let mut impulse = 0.0;
        while flow.draught() < 3.0 * START {
            let of = |load: &fsi_coupling::entry_theory::WedgeLoad| -load.force / (mass + load.added_mass);
            let (dt, load) = flow.step(of).expect("a step");
            impulse += dt * (load.force + load.added_mass * of(&load));
        }
        (flow.speed(), impulse)
    };
    let (heavy, _) = drop(1e9);
    assert!((heavy / SPEED - 1.0).abs() < 1e-6, "{heavy}");
    for mass in [0.2, 1.0] {
        let (speed, impulse) = drop(mass);
        assert!(speed < SPEED && speed > 0.0, "{mass}: {speed}");
        assert!((mass * (SPEED - speed) / impulse - 1.0).abs() < 0.01, "{mass}: {speed}, impulse {impulse}");
    }
}

/// A wedge that is stopped ends the flow with place and speed.
#[test]
fn a_wedge_that_stops_is_told() {
    let mut flow = WedgeFlow::new(30.0, START, SPEED, 9.81).expect("in range");
    let ended = (0..1000).find_map(|_| flow.step(|_| -1000.0).err()).expect("an end");
    assert!(ended.speed <= 0.0 && ended.draught == flow.draught(), "{ended}");
}

/// Outside its range the model names the next that can.
#[test]
fn what_is_outside_the_range_is_refused() {
    for (deadrise, next) in [(14.0, "similarity"), (61.0, "wcsph")] {
        let refused = WedgeFlow::new(deadrise, START, SPEED, 0.0).expect_err("out of range").to_string();
        assert!(refused.contains("15 to 60°") && refused.contains(next), "{refused}");
    }
    for (draught, speed) in [(0.0, SPEED), (START, -1.0), (f64::NAN, SPEED)] {
        let refused = WedgeFlow::new(30.0, draught, speed, 0.0).expect_err("out of range").to_string();
        assert!(refused.contains("above zero"), "{refused}");
    }
}
