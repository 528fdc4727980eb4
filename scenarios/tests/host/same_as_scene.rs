//! A host that moves a body as a scene does has the scene's force.

use scenarios::run::{RunOptions, run};
use scenarios::scene;

use super::*;

/// Steps of both, so that their instants are the same.
const STEP: &str = "time.step=2e-5";
const DT: f64 = 2e-5;
const STEPS: usize = 100;

#[test]
fn at_constant_velocity_the_force_is_the_scenes() {
    // A surface of nodes is placed by other sums than a rigid one: rounding grows in free-surface flow, more in a projection.
    for (k, case) in CASES.into_iter().enumerate() {
        let tolerance = if case.sets.iter().any(|set| set.starts_with("solver=")) { 1e-4 } else { 1e-9 };
        let constant = ["gravity=[0.0, 0.0]", "time.end=0.002", "time.sample_every=1e-4", STEP];
        let mut scene = case.open(&constant).scene().clone();
        let body = scene.body.as_mut().expect("a body");
        body.motion = scene::Motion::ConstantVelocity;
        let name = body.name.clone();
        let series = run(&scene, &RunOptions::default()).expect("a run").series;
        let expected = series.column(&format!("{name}.fy_N_per_m")).expect("a force");
        let times = series.times();

        let (mut hosted, start) = case.build(&constant);
        let (mut found, mut next) = (vec![hosted.forces_now().iter().map(|f| f[1]).sum::<f64>()], 1);
        for step in 1..=STEPS {
            stepped(&mut hosted, &start, step as f64 * DT, DT);
            if next < times.len() && (hosted.time() - times[next]).abs() < 1e-9 {
                found.push(hosted.forces_now().iter().map(|f| f[1]).sum());
                next += 1;
            }
        }
        assert!(found.len() > 15, "case {k}, {case:?}: {} samples", found.len());
        let largest = expected.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        for (k, (a, b)) in found.iter().zip(&expected).enumerate() {
            assert!((a - b).abs() < tolerance * largest, "{case:?}, sample {k}: {a} {b} of {largest}");
        }
    }
}
