//! A host that moves a body as a scene does has the scene's force.

use run::{RunOptions, run};

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

/// A body that turns in the air about its centre of mass, which is not the frame's origin: the scene's own run and the host start alike,
/// and the centre of mass stays where it was.
#[test]
fn a_turning_body_starts_with_the_velocity_of_its_centre_of_mass() {
    let sets = ["symmetry=none", "gravity=[0.0, 0.0]", "body.position=[0.0, 0.3]", "body.velocity=[0.0, 0.0]"];
    let free = ["body.free=[\"x\", \"y\", \"angle\"]", "body.inertia=5", "body.angular_velocity_deg_per_s=400"];
    let sets: Vec<String> = [&SMALL[..], &sets, &free, &["tank.height=1.6", "fluid.sound_speed=60"]]
        .concat()
        .iter()
        .map(ToString::to_string)
        .collect();
    let scene = run::load("wedge", &sets).expect("a scene").scene;
    let series = run(&scene, &RunOptions::default()).expect("a run").series;
    let column = |name: &str| series.column(name).expect("a column");
    let (x, y, angle) = (column("wedge.x_m"), column("wedge.y_m"), column("wedge.angle_deg"));
    let arm = scene.body.as_ref().expect("a body").center_of_mass;
    let center = |k: usize| {
        let (sin, cos) = angle[k].to_radians().sin_cos();
        [x[k] + cos * arm[0] - sin * arm[1], y[k] + sin * arm[0] + cos * arm[1]]
    };
    let (first, last) = (center(0), center(x.len() - 1));
    assert!((angle[x.len() - 1] - angle[0]).abs() > 3.0 && arm[1] > 0.05);
    assert!((first[0] - last[0]).hypot(first[1] - last[1]) < 1e-9, "{first:?} {last:?}");
    let hosted = HostedScene::open("wedge", &sets, Interface::Body).expect("a scene");
    let expected = [column("wedge.vx_m_per_s")[0], column("wedge.vy_m_per_s")[0]];
    let found = hosted.nodes().velocity[0];
    assert!((found[0] - expected[0]).hypot(found[1] - expected[1]) < 1e-9, "{found:?} {expected:?}");
}
