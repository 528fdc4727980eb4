//! A structure and the water, coupled from outside of both by IQN-ILS.

#[allow(dead_code)] // its `main`
#[path = "../../examples/partitioned.rs"]
mod example;

use run::{RunOptions, run};

/// A wedge of half a kilogram per metre: by repetition of the exchange the two agree late or never, by IQN-ILS within a few iterations, and
/// the motion is that of the scene's own coupling.
#[test]
fn a_light_wedge_agrees_with_its_water_by_iqn_ils() {
    let sets = [
        "resolution.spacing=0.01",
        "time.end=0.004",
        "time.sample_every=1e-4",
        "body.mass=0.5",
        "fluid.acoustic_steps=1",
    ]
    .map(String::from);
    let (curve, iterations) = example::couple(&sets, true).expect("agreement");
    let mean = |counts: &[usize]| counts.iter().sum::<usize>() as f64 / counts.len() as f64;
    assert!(*iterations.iter().max().expect("windows") <= 6 && mean(&iterations) < 4.0, "{iterations:?}");
    let (_, plain) = example::couple(&sets, false).expect("steps");
    assert!(mean(&plain) > 2.0 * mean(&iterations), "{plain:?}");

    let series = run(&run::load("wedge", &sets).expect("a scene").scene, &RunOptions::default()).expect("a run").series;
    let (times, velocities) = (series.times(), series.column("wedge.vy_m_per_s").expect("a velocity"));
    let mut compared = 0;
    for (time, velocity) in times.iter().zip(&velocities) {
        let k = curve.partition_point(|[t, _]| t < time);
        if k == 0 || k == curve.len() {
            continue;
        }
        let ([t0, v0], [t1, v1]) = (curve[k - 1], curve[k]);
        let found = v0 + (time - t0) / (t1 - t0) * (v1 - v0);
        assert!((found - velocity).abs() < 0.01, "t = {time}: {found} {velocity} m/s");
        compared += 1;
    }
    assert!(compared > 50, "{compared} samples");
}
