//! Lifting surface of small aspect ratio: velocities that the loads of sections induce at each other (THEORY EN44).

use std::f64::consts::PI;

/// Half breadth over that of a surface of elliptic load whose middle has the mean velocity [-]: 16/(3π²) makes the limits exact, those of a
/// long surface (Jones 1946) and of a wide one (2π per radian).
const OF_HALF_BREADTH: f64 = 16.0 / (3.0 * PI * PI);

/// A surface in sections of one length, from its front to its step; each has its load at a quarter of its length, and its velocity is taken at
/// three quarters.
#[derive(Clone, Debug)]
pub struct LiftingSurface {
    /// Length of a section [m].
    step: f64,
    /// Half breadth of the water that a section moves [m].
    half_breadths: Vec<f64>,
}

impl LiftingSurface {
    /// Of the half breadths [m] at three quarters of each section of a length [m].
    pub fn new(step: f64, half_breadths: Vec<f64>) -> LiftingSurface {
        LiftingSurface { step, half_breadths }
    }

    /// EN44: share of the load of section `of` in the momentum of the water at section `at`; in a plane of water that no other changes it is 1
    /// for all sections ahead and itself, 0 behind.
    pub fn share(&self, at: usize, of: usize) -> f64 {
        let distance = (at as f64 - of as f64 + 0.5) * self.step;
        0.5 * (1.0 + distance.hypot(OF_HALF_BREADTH * self.half_breadths[at]) / distance)
    }

    /// Virtual mass ½π c² of a section, water on one side, for a density of 1 [m²].
    pub fn mass(&self, at: usize) -> f64 {
        0.5 * PI * self.half_breadths[at].powi(2)
    }

    /// Loads of the sections [m²] of a thin surface that moves across itself at the velocity 1 while it passes the water at the speed 1, density 1.
    pub fn thin_surface(&self) -> Vec<f64> {
        let n = self.half_breadths.len();
        let rows = (0..n).map(|at| (0..n).map(|of| self.share(at, of)).collect()).collect();
        solved(rows, (0..n).map(|at| self.mass(at)).collect())
    }
}

/// Solution of linear equations by elimination with partial pivots.
pub(super) fn solved(mut rows: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs())).unwrap_or(k);
        rows.swap(k, pivot);
        right.swap(k, pivot);
        let (done, rest) = rows.split_at_mut(k + 1);
        let first = &done[k];
        for (row, r) in rest.iter_mut().zip(k + 1..n) {
            let factor = row[k] / first[k];
            (k..n).for_each(|c| row[c] -= factor * first[c]);
            right[r] -= factor * right[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|c| rows[k][c] * right[c]).sum();
        right[k] = (right[k] - known) / rows[k][k];
    }
    right
}
