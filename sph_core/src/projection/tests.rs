//! The solver against a direct one, on random systems.

use super::*;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Col, Side};

/// Numbers from 0 to 1 that come again from the same seed (Marsaglia 2003, xorshift).
struct Dice(u64);

impl Dice {
    fn throw(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A system and the places of its rows.
struct System {
    a: Matrix,
    b: Vec<f64>,
    at: [Vec<f64>; 3],
}

/// `n` points thrown into a box per `boxes`, far from each other; within a box whoever is near is coupled. The first `open`
/// boxes have a surface.
fn thrown(n: usize, boxes: usize, open: usize, dice: &mut Dice) -> System {
    let points: Vec<[f64; 2]> = (0..n * boxes).map(|k| [10.0 * (k / n) as f64 + dice.throw(), dice.throw()]).collect();
    let reach = 2.5 / (n as f64).sqrt();
    let mut a = Matrix { starts: vec![0], ..Matrix::default() };
    for (i, p) in points.iter().enumerate() {
        let mut sum = 0.0;
        for (j, q) in points.iter().enumerate() {
            let distance = (p[0] - q[0]).hypot(p[1] - q[1]);
            if i != j && distance < reach {
                let weight = (1.0 - distance / reach).powi(3);
                a.columns.push(j as u32);
                a.values.push(-weight);
                sum += weight;
            }
        }
        let excess = if i / n < open && p[1] > 0.85 { 0.5 } else { 0.0 };
        a.starts.push(a.columns.len());
        a.diagonal.push(sum + excess);
    }
    let b = points.iter().map(|_| dice.throw() - 0.5).collect();
    let at = [points.iter().map(|p| p[0]).collect(), points.iter().map(|p| p[1]).collect(), vec![reach; n * boxes]];
    System { a, b, at }
}

/// The same by Cholesky, floating rows held by a weak spring (a mean that is taken out shows no difference).
fn directly(a: &Matrix, ranks: &[RankOne], b: &[f64], pinned: &[bool], spring: f64) -> Vec<f64> {
    let n = a.rows();
    let mut entries = Vec::new();
    let free = |i: usize| !pinned[i] && a.diagonal[i] > 0.0;
    for i in 0..n {
        entries.push(Triplet::new(i, i, if free(i) { a.diagonal[i] + spring } else { 1.0 }));
        entries.extend(a.row(i).filter(|&(j, _)| free(i) && free(j)).map(|(j, v)| Triplet::new(i, j, v)));
    }
    for rank in ranks {
        for &(i, gi) in &rank.entries {
            for &(j, gj) in &rank.entries {
                if free(i as usize) && free(j as usize) {
                    entries.push(Triplet::new(i as usize, j as usize, rank.weight * gi * gj));
                }
            }
        }
    }
    let matrix = SparseColMat::try_new_from_triplets(n, n, &entries).expect("a matrix");
    let right = Col::from_fn(n, |i| if free(i) { b[i] } else { 0.0 });
    let solution = matrix.sp_cholesky(Side::Lower).expect("positive definite").solve(&right);
    (0..n).map(|i| solution[i]).collect()
}

fn solve(s: &System, ranks: &[RankOne], pinned: &[bool], kind: Preconditioner) -> (Vec<f64>, Solved) {
    let n = s.a.rows();
    let mut solver = PressureSolver::with(kind);
    solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
    let mut x = vec![0.0; n];
    let stop = Stop { tolerance: 1e-11, most_iterations: 2000 };
    let solved = solver.solve(&s.a, ranks, &s.b, &vec![1.0; n], pinned, &mut x, &stop).expect("converged");
    (x, solved)
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    let size = b.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    a.iter().zip(b).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / size
}

/// A body over about a third of the first box, and its two ways to move.
fn body(s: &System, dice: &mut Dice, weight: f64) -> Vec<RankOne> {
    let near: Vec<u32> = (0..s.a.rows() as u32).filter(|&i| s.at[0][i as usize] < 0.33).collect();
    (0..2).map(|_| RankOne { weight, entries: near.iter().map(|&i| (i, dice.throw() - 0.3)).collect() }).collect()
}

#[test]
fn solutions_are_those_of_a_direct_solver() {
    let mut dice = Dice(0x9e37_79b9_7f4a_7c15);
    for round in 0..20 {
        let s = thrown(30 + 20 * round, 1, 1, &mut dice);
        let n = s.a.rows();
        let pinned: Vec<bool> = (0..n).map(|_| dice.throw() < 0.1 * f64::from(round as u8 % 3)).collect();
        let ranks = if round % 2 == 0 { Vec::new() } else { body(&s, &mut dice, 10.0_f64.powi(round as i32 % 5 - 1)) };
        let expected = directly(&s.a, &ranks, &s.b, &pinned, 0.0);
        for kind in Preconditioner::ALL {
            let (x, _) = solve(&s, &ranks, &pinned, kind);
            let off = largest_difference(&x, &expected);
            assert!(off < 1e-8, "{n} rows, {kind:?}: off by {off:.2e}");
            assert!(pinned.iter().zip(&x).all(|(&p, &x)| !p || x == 0.0));
        }
    }
}

/// Means over the rows of each box.
fn box_means(v: &[f64], n: usize) -> Vec<f64> {
    v.chunks(n).map(|c| c.iter().sum::<f64>() / n as f64).collect()
}

#[test]
fn what_floats_has_the_mean_zero_and_the_rest_a_level() {
    let mut dice = Dice(77);
    let n = 150;
    let s = thrown(n, 3, 1, &mut dice);
    let pinned: Vec<bool> = (0..3 * n).map(|i| i == n + 7).collect(); // the second box has a pin, the third floats
    let mut balanced = s.b.clone();
    let excess = box_means(&s.b, n)[2];
    balanced[2 * n..].iter_mut().for_each(|b| *b -= excess);
    let mut expected = directly(&s.a, &[], &balanced, &pinned, 1e-9);
    let level = box_means(&expected, n)[2];
    expected[2 * n..].iter_mut().for_each(|x| *x -= level);
    for kind in Preconditioner::ALL {
        let (x, _) = solve(&s, &[], &pinned, kind);
        let off = largest_difference(&x, &expected);
        assert!(off < 1e-5, "{kind:?}: off by {off:.2e}"); // the spring's own error
        assert!(box_means(&x, n)[2].abs() < 1e-12, "{kind:?}: {:?}", box_means(&x, n));
        assert!(box_means(&x, n)[1].abs() > 1e-3, "{kind:?}: {:?}", box_means(&x, n));
    }
}

#[test]
fn a_body_gives_a_closed_tank_a_level_or_not() {
    let mut dice = Dice(4242);
    let n = 200;
    let s = thrown(n, 1, 0, &mut dice);
    let pinned = vec![false; n];
    let pushing = body(&s, &mut dice, 3.0);
    let expected = directly(&s.a, &pushing, &s.b, &pinned, 0.0);
    let mut closed = pushing.clone(); // a body that is wet all round: its normals add up to nothing
    for rank in &mut closed {
        let mean = rank.entries.iter().map(|e| e.1).sum::<f64>() / rank.entries.len() as f64;
        rank.entries.iter_mut().for_each(|e| e.1 -= mean);
    }
    for kind in Preconditioner::ALL {
        let (x, _) = solve(&s, &pushing, &pinned, kind);
        let off = largest_difference(&x, &expected);
        assert!(off < 1e-7, "{kind:?}: off by {off:.2e}");
        assert!(box_means(&x, n)[0].abs() > 1e-3);
        let (x, _) = solve(&s, &closed, &pinned, kind);
        assert!(box_means(&x, n)[0].abs() < 1e-12, "{kind:?}: {:?}", box_means(&x, n));
    }
}

#[test]
fn a_lone_particle_has_no_pressure() {
    let mut dice = Dice(5);
    let mut s = thrown(60, 1, 1, &mut dice);
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
    let mut dice = Dice(11);
    let s = thrown(1500, 2, 1, &mut dice);
    let pinned: Vec<bool> = (0..3000).map(|_| dice.throw() < 0.02).collect();
    let ranks = body(&s, &mut dice, 20.0);
    for kind in Preconditioner::ALL {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| solve(&s, &ranks, &pinned, kind))
        };
        let ((one, few), (two, many)) = (with(1), with(2));
        assert!(one.iter().zip(&two).all(|(a, b)| a.to_bits() == b.to_bits()), "{kind:?}");
        assert_eq!(few, many);
    }
}

#[test]
fn a_solve_that_does_not_converge_says_how_far_it_got() {
    let mut dice = Dice(3);
    let s = thrown(1000, 1, 1, &mut dice);
    let (n, stop) = (1000, Stop { tolerance: 1e-14, most_iterations: 3 });
    for kind in Preconditioner::ALL {
        let mut solver = PressureSolver::with(kind);
        solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
        let mut x = vec![0.0; n];
        let failed = solver.solve(&s.a, &[], &s.b, &vec![1.0; n], &vec![false; n], &mut x, &stop).unwrap_err();
        assert_eq!(failed.iterations, 3);
        let lack = |i: usize| (s.b[i] - s.a.times(i, &x)).abs();
        let worst = (0..n).map(lack).fold(0.0, f64::max);
        assert!((worst - failed.residual).abs() < 1e-10 && (lack(failed.worst) - worst).abs() < 1e-10, "{failed}");
        let mut broken = s.b.clone();
        broken[17] = f64::NAN;
        let failed = solver.solve(&s.a, &[], &broken, &vec![1.0; n], &vec![false; n], &mut x, &stop).unwrap_err();
        assert!(failed.residual.is_nan() && failed.worst == 17, "{failed}");
    }
}

#[test]
fn a_good_first_guess_is_kept() {
    let mut dice = Dice(21);
    let s = thrown(400, 1, 1, &mut dice);
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
    let mut dice = Dice(8);
    let mut s = thrown(40, 1, 1, &mut dice);
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

/// A row of `n` with a surface at its end if it is `open`, the same places each time.
fn row_of(n: usize, open: bool) -> System {
    let mut a = Matrix { starts: vec![0], ..Matrix::default() };
    for i in 0..n {
        let mut sum = 0.0;
        for j in i.saturating_sub(2)..(i + 3).min(n) {
            if j != i {
                a.columns.push(j as u32);
                a.values.push(-1.0);
                sum += 1.0;
            }
        }
        a.starts.push(a.columns.len());
        a.diagonal.push(sum + if open && i == n - 1 { 1.0 } else { 0.0 });
    }
    let b = (0..n).map(|i| 1.0 + (0.1 * i as f64).sin()).collect();
    System { a, b, at: [(0..n).map(|i| i as f64).collect(), vec![0.0; n], vec![1.5; n]] }
}

#[test]
fn a_surface_that_closes_or_opens_is_noticed_though_the_hierarchy_is_kept() {
    let n = 300;
    let (pinned, scale) = (vec![false; n], vec![1.0; n]);
    let stop = Stop { tolerance: 1e-8, most_iterations: 2000 };
    for kind in Preconditioner::ALL {
        let mut solver = PressureSolver::with(kind);
        let mut set_ups = Vec::new();
        for open in [true, true, false, false, true] {
            let s = row_of(n, open);
            solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
            let mut x = vec![0.0; n];
            solver.solve(&s.a, &[], &s.b, &scale, &pinned, &mut x, &stop).expect("converged");
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
    let mut dice = Dice(1234);
    let (small, large) = (thrown(400, 1, 1, &mut dice), thrown(6400, 1, 1, &mut dice));
    let growth = |kind| {
        let count = |s: &System| solve(s, &[], &vec![false; s.a.rows()], kind).1.iterations as f64;
        count(&large) / count(&small)
    };
    let (diagonal, aggregates) = (growth(Preconditioner::Diagonal), growth(Preconditioner::Aggregates));
    assert!(diagonal > 3.0 && aggregates < 1.7, "{diagonal} {aggregates}"); // four times as many across
}

#[test]
fn a_clone_goes_on_to_the_same_bits() {
    let mut dice = Dice(99);
    let s = thrown(900, 1, 1, &mut dice);
    let (scale, pinned, stop) = (vec![1.0; 900], vec![false; 900], Stop { tolerance: 1e-6, most_iterations: 500 });
    let mut solver = PressureSolver::default();
    solver.prepare(&s.a, &s.at[0], &s.at[1], &s.at[2]);
    let mut kept = solver.clone();
    let moved: Vec<f64> = s.at[0].iter().map(|x| x + 0.01 * s.at[2][0]).collect();
    let go_on = |solver: &mut PressureSolver| {
        let mut x = vec![0.0; 900];
        solver.prepare(&s.a, &moved, &s.at[1], &s.at[2]);
        solver.solve(&s.a, &[], &s.b, &scale, &pinned, &mut x, &stop).expect("converged");
        x
    };
    assert_eq!(go_on(&mut solver), go_on(&mut kept));
    assert_eq!(solver.set_ups(), 1);
}
