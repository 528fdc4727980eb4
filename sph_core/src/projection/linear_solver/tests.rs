//! The solver against a direct one, on random systems.

use super::cg::{PressureSolver, Solved, Stop};
use super::hierarchy::Preconditioner;
use super::matrix::{Matrix, MatrixRows, RankOne};
use super::test_systems::{System, body, directly, row_of, thrown};
use crate::SplitMix64;

fn solve(s: &System, ranks: &[RankOne], constrained: &[bool], kind: Preconditioner) -> (Vec<f64>, Solved) {
    let n = s.a.rows();
    let mut solver = PressureSolver::with(kind);
    solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
    let mut x = vec![0.0; n];
    let stop = Stop { tolerance: 1e-11, most_iterations: 2000 };
    let solved = solver.solve(&s.a, ranks, &s.b, &vec![1.0; n], constrained, &mut x, &stop).expect("converged");
    (x, solved)
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    let size = b.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    a.iter().zip(b).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / size
}

#[test]
fn solutions_are_those_of_a_direct_solver() {
    let mut random = SplitMix64(1);
    for round in 0..20 {
        let s = thrown(30 + 20 * round, 1, 1, &mut random);
        let n = s.a.rows();
        let constrained: Vec<bool> = (0..n).map(|_| random.unit() < 0.1 * f64::from(round as u8 % 3)).collect();
        let ranks =
            if round % 2 == 0 { Vec::new() } else { body(&s, &mut random, 10.0_f64.powi(round as i32 % 5 - 1)) };
        let expected = directly(&s.a, &ranks, &s.b, &constrained, 0.0);
        for kind in Preconditioner::ALL {
            let (x, _) = solve(&s, &ranks, &constrained, kind);
            let off = largest_difference(&x, &expected);
            assert!(off < 1e-8, "{n} rows, {kind:?}: off by {off:.2e}");
            assert!(constrained.iter().zip(&x).all(|(&p, &x)| !p || x == 0.0));
        }
    }
}

/// Means over the rows of each box.
fn box_means(v: &[f64], n: usize) -> Vec<f64> {
    v.chunks(n).map(|c| c.iter().sum::<f64>() / n as f64).collect()
}

#[test]
fn what_floats_has_the_mean_zero_and_the_rest_a_level() {
    let mut random = SplitMix64(77);
    let n = 150;
    let s = thrown(n, 3, 1, &mut random);
    let constrained: Vec<bool> = (0..3 * n).map(|i| i == n + 7).collect(); // the second box has a pin, the third floats
    let mut balanced = s.b.clone();
    let excess = box_means(&s.b, n)[2];
    balanced[2 * n..].iter_mut().for_each(|b| *b -= excess);
    let mut expected = directly(&s.a, &[], &balanced, &constrained, 1e-9);
    let level = box_means(&expected, n)[2];
    expected[2 * n..].iter_mut().for_each(|x| *x -= level);
    for kind in Preconditioner::ALL {
        let (x, _) = solve(&s, &[], &constrained, kind);
        let off = largest_difference(&x, &expected);
        assert!(off < 1e-5, "{kind:?}: off by {off:.2e}"); // the spring's own error
        assert!(box_means(&x, n)[2].abs() < 1e-12, "{kind:?}: {:?}", box_means(&x, n));
        assert!(box_means(&x, n)[1].abs() > 1e-3, "{kind:?}: {:?}", box_means(&x, n));
    }
}

#[test]
fn a_body_gives_a_closed_tank_a_level_or_not() {
    let mut random = SplitMix64(4242);
    let n = 200;
    let s = thrown(n, 1, 0, &mut random);
    let constrained = vec![false; n];
    let pushing = body(&s, &mut random, 3.0);
    let expected = directly(&s.a, &pushing, &s.b, &constrained, 0.0);
    let mut closed = pushing.clone(); // a body that is wet all round: its normals add up to nothing
    for rank in &mut closed {
        let mean = rank.entries.iter().map(|e| e.1).sum::<f64>() / rank.entries.len() as f64;
        rank.entries.iter_mut().for_each(|e| e.1 -= mean);
    }
    for kind in Preconditioner::ALL {
        let (x, _) = solve(&s, &pushing, &constrained, kind);
        let off = largest_difference(&x, &expected);
        assert!(off < 1e-7, "{kind:?}: off by {off:.2e}");
        assert!(box_means(&x, n)[0].abs() > 1e-3);
        let (x, _) = solve(&s, &closed, &constrained, kind);
        assert!(box_means(&x, n)[0].abs() < 1e-12, "{kind:?}: {:?}", box_means(&x, n));
    }
}

#[test]
fn a_lone_particle_has_no_pressure() {
    let mut random = SplitMix64(5);
    let mut s = thrown(60, 1, 1, &mut random);
    s.a.starts.push(s.a.columns.len());
    s.a.diagonal.push(0.0);
    s.b.push(1.0);
    s.at.iter_mut().for_each(|v| v.push(5.0));
    for kind in Preconditioner::ALL {
        let (x, _) = solve(&s, &[], &[false; 61], kind);
        assert_eq!(x[60], 0.0);
        assert!(x.iter().all(|x| x.is_finite()));
    }
}

#[test]
fn the_same_bits_at_one_and_two_threads() {
    let mut random = SplitMix64(11);
    let s = thrown(1500, 2, 1, &mut random);
    let constrained: Vec<bool> = (0..3000).map(|_| random.unit() < 0.02).collect();
    let ranks = body(&s, &mut random, 20.0);
    for kind in Preconditioner::ALL {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| solve(&s, &ranks, &constrained, kind))
        };
        let ((one, few), (two, many)) = (with(1), with(2));
        assert!(one.iter().zip(&two).all(|(a, b)| a.to_bits() == b.to_bits()), "{kind:?}");
        assert_eq!(few, many);
    }
}

#[test]
fn a_solve_that_does_not_converge_says_how_far_it_got() {
    let mut random = SplitMix64(3);
    let s = thrown(1000, 1, 1, &mut random);
    let (n, stop) = (1000, Stop { tolerance: 1e-14, most_iterations: 3 });
    for kind in Preconditioner::ALL {
        let mut solver = PressureSolver::with(kind);
        solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
        let mut x = vec![0.0; n];
        let failed = solver.solve(&s.a, &[], &s.b, &vec![1.0; n], &vec![false; n], &mut x, &stop).unwrap_err();
        assert_eq!(failed.iterations, 3);
        let left = |i: usize| (s.b[i] - s.a.times(i, &x)).abs();
        let worst = (0..n).map(left).fold(0.0, f64::max);
        assert!((worst - failed.residual).abs() < 1e-10 && (left(failed.worst) - worst).abs() < 1e-10, "{failed}");
        let mut broken = s.b.clone();
        broken[17] = f64::NAN;
        let failed = solver.solve(&s.a, &[], &broken, &vec![1.0; n], &vec![false; n], &mut x, &stop).unwrap_err();
        assert!(failed.residual.is_nan() && failed.worst == 17, "{failed}");
        solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
        assert_eq!(solver.set_ups(), 2, "what failed is not kept");
    }
}

#[test]
fn a_good_first_guess_is_kept() {
    let mut random = SplitMix64(21);
    let s = thrown(400, 1, 1, &mut random);
    let (n, stop) = (400, Stop { tolerance: 1e-6, most_iterations: 500 });
    for kind in Preconditioner::ALL {
        let mut solver = PressureSolver::with(kind);
        solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
        let mut x = vec![0.0; n];
        let mut again =
            || solver.solve(&s.a, &[], &s.b, &vec![1.0; n], &vec![false; n], &mut x, &stop).expect("converged");
        assert!(again().iterations > 2);
        assert_eq!(again().iterations, 0);
    }
}

#[test]
fn the_smallest_pocket_floats_too() {
    let mut random = SplitMix64(8);
    let mut s = thrown(40, 1, 1, &mut random);
    // two particles that know only each other
    s.a.columns.extend([41, 40]);
    s.a.values.extend([-0.3, -0.3]);
    s.a.starts.extend([s.a.columns.len() - 1, s.a.columns.len()]);
    s.a.diagonal.extend([0.3, 0.3]);
    s.b.extend([1.0, 0.4]);
    s.at.iter_mut().for_each(|v| v.extend([5.0, 5.0]));
    for kind in Preconditioner::ALL {
        let (x, _) = solve(&s, &[], &[false; 42], kind);
        assert!((x[40] - 0.5).abs() < 1e-10 && (x[41] + 0.5).abs() < 1e-10, "{kind:?}: {:?}", &x[40..]);
    }
}

#[test]
fn a_surface_that_closes_or_opens_is_noticed_though_the_hierarchy_is_kept() {
    let n = 300;
    let (constrained, scale) = (vec![false; n], vec![1.0; n]);
    let stop = Stop { tolerance: 1e-8, most_iterations: 2000 };
    for kind in Preconditioner::ALL {
        let mut solver = PressureSolver::with(kind);
        let mut set_ups = Vec::new();
        for open in [true, true, false, false, true] {
            let s = row_of(n, open);
            solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
            let mut x = vec![0.0; n];
            solver.solve(&s.a, &[], &s.b, &scale, &constrained, &mut x, &stop).expect("converged");
            let mean = x.iter().sum::<f64>() / n as f64;
            assert_eq!(mean.abs() < 1e-9, !open, "{kind:?}: {mean}");
            set_ups.push(solver.set_ups());
        }
        if kind == Preconditioner::Aggregates {
            assert_eq!(set_ups, [1, 1, 2, 2, 3]);
        }
    }
}

#[test]
fn iterations_hardly_grow_with_the_number_of_rows() {
    let mut random = SplitMix64(1234);
    let (small, large) = (thrown(400, 1, 1, &mut random), thrown(6400, 1, 1, &mut random));
    let growth = |kind| {
        let count = |s: &System| solve(s, &[], &vec![false; s.a.rows()], kind).1.iterations as f64;
        count(&large) / count(&small)
    };
    let (diagonal, aggregates) = (growth(Preconditioner::Diagonal), growth(Preconditioner::Aggregates));
    assert!(diagonal > 3.0 && aggregates < 1.7, "{diagonal} {aggregates}"); // four times as many across
}

#[test]
fn a_clone_goes_on_to_the_same_bits() {
    let mut random = SplitMix64(99);
    let s = thrown(900, 1, 1, &mut random);
    let (scale, constrained, stop) = (vec![1.0; 900], vec![false; 900], Stop { tolerance: 1e-6, most_iterations: 500 });
    let mut solver = PressureSolver::default();
    solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
    let mut kept = solver.clone();
    let moved: Vec<f64> = s.at[0].iter().map(|x| x + 0.01 * s.at[2][0]).collect();
    let go_on = |solver: &mut PressureSolver| {
        let mut x = vec![0.0; 900];
        solver.prepare(&s.a, &moved, &s.at[1], &s.at[2]);
        solver.solve(&s.a, &[], &s.b, &scale, &constrained, &mut x, &stop).expect("converged");
        x
    };
    assert_eq!(go_on(&mut solver), go_on(&mut kept));
    assert_eq!(solver.set_ups(), 1);
}

/// Rows that stand in another order are known by name: nothing is rebuilt, and the iterations are as many.
#[test]
fn rows_in_another_order_keep_their_hierarchy() {
    let mut random = SplitMix64(7);
    let s = thrown(900, 1, 1, &mut random);
    let (scale, constrained, stop) = (vec![1.0; 900], vec![false; 900], Stop { tolerance: 1e-9, most_iterations: 500 });
    let order: Vec<u32> = (0..900).map(|k| (k * 7) % 900).map(|k| if k < 450 { k + 450 } else { k - 450 }).collect();
    let mut place = vec![0; 900];
    order.iter().enumerate().for_each(|(k, &i)| place[i as usize] = k as u32);
    let mut turned = Matrix { starts: vec![0], ..Matrix::default() };
    for &i in &order {
        for (j, value) in s.a.row(i as usize) {
            turned.columns.push(place[j]);
            turned.values.push(value);
        }
        turned.starts.push(turned.columns.len());
        turned.diagonal.push(s.a.diagonal[i as usize]);
    }
    let by_order = |v: &[f64]| -> Vec<f64> { order.iter().map(|&i| v[i as usize]).collect() };
    let mut solver = PressureSolver::default();
    let names: Vec<u32> = (0..900).collect();
    solver.name(&names);
    solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
    let mut x = vec![0.0; 900];
    let first = solver.solve(&s.a, &[], &s.b, &scale, &constrained, &mut x, &stop).expect("converged");
    solver.name(&order);
    solver.prepare(&turned, &by_order(&s.at[0]), &by_order(&s.at[1]), &by_order(&s.at[2]));
    let mut y = vec![0.0; 900];
    let second = solver.solve(&turned, &[], &by_order(&s.b), &scale, &constrained, &mut y, &stop).expect("converged");
    assert_eq!(solver.set_ups(), 1);
    assert!(second.iterations.abs_diff(first.iterations) <= 1, "{first:?} {second:?}");
    assert!(largest_difference(&y, &by_order(&x)) < 1e-7);
}

#[test]
fn bodies_and_constraints_at_the_surface_cost_no_iterations() {
    let mut random = SplitMix64(11);
    let s = thrown(4000, 1, 1, &mut random);
    let at_surface: Vec<bool> = s.at[1].iter().map(|&y| y > 0.95).collect();
    let none = vec![false; 4000];
    for kind in Preconditioner::ALL {
        let plain = solve(&s, &[], &none, kind).1.iterations as f64;
        for weight in [0.1, 1e6] {
            let ranks = body(&s, &mut random, weight);
            let with = |constrained: &[bool]| solve(&s, &ranks, constrained, kind).1.iterations as f64;
            let (free, constrained) = (with(&none), with(&at_surface));
            assert!(
                free < 1.1 * plain && constrained < 1.1 * plain,
                "{kind:?}, {weight}: {plain} {free} {constrained}"
            );
        }
    }
}

#[test]
fn no_water_and_spray_alone_are_solved() {
    let stop = Stop { tolerance: 1e-10, most_iterations: 5 };
    for kind in Preconditioner::ALL {
        let mut solver = PressureSolver::with(kind);
        let mut a = Matrix { starts: vec![0], ..Matrix::default() };
        solver.prepare(&a, &[], &[], &[]);
        assert_eq!(solver.solve(&a, &[], &[], &[], &[], &mut [], &stop).expect("nothing").iterations, 0);
        let n = 700; // each tied to the air only
        a.starts.resize(n + 1, 0);
        a.diagonal = (0..n).map(|i| 1.0 + i as f64).collect();
        let (one, mut x) = (vec![1.0; n], vec![0.0; n]);
        solver.prepare(&a, &one, &one, &one);
        solver.solve(&a, &[], &one, &one, &vec![false; n], &mut x, &stop).expect("diagonal");
        assert!((0..n).all(|i| (x[i] - 1.0 / a.diagonal[i]).abs() < 1e-12));
    }
}

/// LS11: half the iterations that are needed fail, from nothing fail again, and four times as many from there do.
#[test]
fn a_solve_that_fails_is_tried_from_nothing_and_then_longer() {
    let s = thrown(300, 1, 1, &mut SplitMix64(31));
    let (free, ones) = (vec![false; 300], vec![1.0; 300]);
    let (expected, all) = solve(&s, &[], &free, Preconditioner::Diagonal);
    let half = Stop { tolerance: 1e-11, most_iterations: all.iterations / 2 };
    let mut solver = PressureSolver::with(Preconditioner::Diagonal);
    solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
    let mut x = vec![1e3; 300];
    assert!(solver.solve(&s.a, &[], &s.b, &ones, &free, &mut x, &half).is_err());
    x.fill(1e3);
    let solved = solver.persist(&s.a, &s.b, &ones, &free, &mut x, &half).expect("converged");
    assert!(solved.iterations > 2 * half.most_iterations, "{solved:?} of {all:?}");
    let off = largest_difference(&x, &expected);
    assert!(off < 1e-8, "off by {off:.2e}");
    let few = Stop { most_iterations: 2, ..half };
    let failed = solver.persist(&s.a, &s.b, &ones, &free, &mut vec![0.0; 300], &few).expect_err("12 are too few");
    assert_eq!(failed.iterations, 2 + 2 + 8);
    assert!(failed.residual > few.tolerance && failed.worst < 300, "{failed}");
}
