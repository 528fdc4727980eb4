//! Systems to try the solver on, and a direct solver.

use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Col, Side};

use super::matrix::{Matrix, MatrixRows, RankOne};
use crate::SplitMix64;

/// A system and the places of its rows.
pub(crate) struct System {
    pub a: Matrix,
    pub b: Vec<f64>,
    pub at: [Vec<f64>; 3],
}

/// `n` points thrown into a box per `boxes`, far from each other; within a box near points are coupled. The first
/// `open` boxes have a surface.
pub(crate) fn thrown(n: usize, boxes: usize, open: usize, random: &mut SplitMix64) -> System {
    let points: Vec<[f64; 2]> =
        (0..n * boxes).map(|k| [10.0 * (k / n) as f64 + random.unit(), random.unit()]).collect();
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
    let b = points.iter().map(|_| random.unit() - 0.5).collect();
    let at = [points.iter().map(|p| p[0]).collect(), points.iter().map(|p| p[1]).collect(), vec![reach; n * boxes]];
    System { a, b, at }
}

/// The same by Cholesky, floating rows held by a weak spring (a mean that is taken out shows no difference).
pub(crate) fn directly(a: &Matrix, ranks: &[RankOne], b: &[f64], constrained: &[bool], spring: f64) -> Vec<f64> {
    let n = a.rows();
    let mut entries = Vec::new();
    let free = |i: usize| !constrained[i] && a.diagonal[i] > 0.0;
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

/// A body over about a third of the first box, and its two ways to move.
pub(crate) fn body(s: &System, random: &mut SplitMix64, weight: f64) -> Vec<RankOne> {
    let near: Vec<u32> = (0..s.a.rows() as u32).filter(|&i| s.at[0][i as usize] < 0.33).collect();
    (0..2).map(|_| RankOne { weight, entries: near.iter().map(|&i| (i, random.unit() - 0.3)).collect() }).collect()
}

/// A row of `n` with a surface at its end if it is `open`, the same places each time.
pub(crate) fn row_of(n: usize, open: bool) -> System {
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
