//! A step that was rejected leaves no trace; a state as bytes continues; impulses add up; runs do not disturb each other.

use sph_core::parallel::on_threads;

use super::*;

const DT: f64 = 4e-4;

#[test]
fn a_rejected_step_leaves_no_trace() {
    for case in CASES {
        let ((mut straight, start), (mut tried, _)) = (case.build(&[]), case.build(&[]));
        for step in 1..=4 {
            if step == 2 {
                tried.save();
                for wrong in [0.3, 2.0] {
                    stepped(&mut tried, &start, f64::from(step) * DT + (wrong - 1.0) * DT, wrong * DT);
                    stepped(&mut tried, &start, f64::from(step) * DT, (1.0 - 0.5 * wrong).abs().max(0.1) * DT);
                    tried.restore().expect("a saved state");
                }
            }
            let [a, b] = [&mut straight, &mut tried].map(|run| stepped(run, &start, f64::from(step) * DT, DT));
            assert_eq!(a, b, "{case:?}, step {step}");
        }
        assert!(straight.snapshot() == tried.snapshot(), "{case:?}");
    }
}

#[test]
fn a_state_as_bytes_continues_to_the_same_bits() {
    for case in CASES {
        let ((mut run, start), (mut other, _)) = (case.build(&[]), case.build(&[]));
        (1..=2).for_each(|step| drop(stepped(&mut run, &start, f64::from(step) * DT, DT)));
        other.restore_bytes(&run.to_bytes().expect("a state")).expect("its own bytes");
        assert!(run.snapshot() == other.snapshot(), "{case:?}");
        let [a, b] = [&mut run, &mut other].map(|run| stepped(run, &start, 3.0 * DT, DT));
        assert_eq!(a, b, "{case:?}");
    }
}

/// Of a half model both halves of the nodes get forces, each the image of the other.
#[test]
fn forces_of_a_half_model_are_images() {
    for case in [CASES[0], CASES[1], CASES[3], CASES[6]] {
        let (mut run, start) = case.build(&[]);
        let forces =
            (1..=20).map(|step| stepped(&mut run, &start, f64::from(step) * DT, DT)).next_back().expect("a step");
        assert!(forces.iter().any(|force| force[1].abs() > 100.0), "{case:?}: {forces:?}");
        for (at, force) in start.position.iter().zip(&forces) {
            let image = start.position.iter().position(|other| (other[0] + at[0]).hypot(other[1] - at[1]) < 1e-9);
            let other = forces[image.expect("a node of the other half")];
            assert!(
                [force[0] + other[0], force[1] - other[1], force[2] + other[2]] == [0.0; 3],
                "{case:?}: {forces:?}"
            );
        }
    }
}

/// A step of the host of fifty steps of the water: the impulse on the nodes is what the surface got of the water, and the water lost what
/// its walls got, to rounding.
#[test]
fn the_impulse_of_a_long_step_is_the_integral_of_the_force() {
    for case in CASES {
        let (mut run, start) = case.build(&[]);
        let external = |run: &HostedRun| {
            run.element().system().bodies().next().map(|body| body.momentum().external).expect("the host's surface")
        };
        (1..=10).for_each(|step| drop(stepped(&mut run, &start, f64::from(step) * DT, DT)));
        let dt = 60.0 * run.fluid_dt().expect("a step");
        let before = external(&run);
        let mut forces = vec![[0.0; 3]; start.len()];
        let given = run
            .contribute(dt, &moved(&start, 10.0 * DT + dt), &mut forces)
            .unwrap_or_else(|error| panic!("{case:?}: {error}"));
        assert!(given.fluid_steps >= 45, "{case:?}: {}", given.fluid_steps);
        let (after, momentum) = (external(&run), run.element().system().momentum_audit().worst);
        let size = given.impulse[0].hypot(given.impulse[1]);
        assert!(size > 0.1, "{case:?}: {size} N s/m");
        for k in 0..2 {
            let total: f64 = forces.iter().map(|force| dt * force[k]).sum();
            assert!((total + after[k] - before[k]).abs() < 1e-12 * size, "{case:?}: {total} {after:?} {before:?}");
            assert!((total - given.impulse[k]).abs() < 1e-12 * size, "{case:?}");
        }
        assert!(momentum < 1e-12, "{case:?}: the water lost another impulse than its walls got, by {momentum}");
    }
}

#[test]
fn two_runs_on_two_threads_are_those_of_each_alone() {
    let alone = |case: Case| {
        let (mut run, start) = case.build(&[]);
        (1..=3).map(|step| stepped(&mut run, &start, f64::from(step) * DT, DT)).collect::<Vec<_>>()
    };
    let expected = [alone(CASES[1]), alone(CASES[3])];
    let together = std::thread::scope(|scope| {
        let runs = [CASES[1], CASES[3]].map(|case| scope.spawn(move || alone(case)));
        runs.map(|run| run.join().expect("no panic"))
    });
    assert!(together == expected);
    assert!(on_threads(1, || alone(CASES[1])) == expected[0]);
}
