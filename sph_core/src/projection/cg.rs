//! Conjugate gradients for the pressure equation (THEORY PS2–PS4).

use super::matrix::{Matrix, RankOne};
use super::multigrid::Multigrid;
use super::null_space::{Components, NullSpace};
use crate::sweep::{self, CHUNK};

/// When to stop (PS3).
#[derive(Clone, Copy, Debug)]
pub struct Stop {
    /// Largest |r_i|/scale_i allowed [-].
    pub tolerance: f64,
    /// Iterations after which to give up.
    pub most_iterations: usize,
}

/// How a solve went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solved {
    /// Iterations taken.
    pub iterations: usize,
    /// Largest |r_i|/scale_i left [-].
    pub residual: f64,
}

/// A solve that did not reach its tolerance; the solution holds how far it got.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "pressure not converged: after {iterations} iterations the residual is {residual:.3e} of its scale, in row {worst}"
)]
pub struct NotConverged {
    /// Iterations taken.
    pub iterations: usize,
    /// Largest |r_i|/scale_i left [-].
    pub residual: f64,
    /// The row that has it.
    pub worst: usize,
}

/// What approximates A⁻¹ in each iteration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preconditioner {
    /// The diagonal alone.
    Diagonal,
    /// A V-cycle over aggregates of rows (PS5–PS7).
    #[default]
    Multigrid,
}

impl Preconditioner {
    /// Every preconditioner, for tests and tables.
    pub const ALL: [Preconditioner; 2] = [Preconditioner::Diagonal, Preconditioner::Multigrid];
}

/// PS2: solves A x = b by conjugate gradients. Keeps its memory from solve to solve.
#[derive(Debug, Default)]
pub struct PressureSolver {
    /// What approximates A⁻¹.
    pub preconditioner: Preconditioner,
    components: Components,
    null_space: NullSpace,
    /// 1/a_ii, 0 in rows that are pinned or empty.
    inverse: Vec<f64>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    sums: Vec<f64>,
    parts: Vec<[f64; 2]>,
    multigrid: Multigrid,
    /// What the hierarchy takes for pinned.
    pinned: Vec<bool>,
    preconditioned: Vec<f64>,
}

impl PressureSolver {
    /// With a preconditioner of choice.
    pub fn with(preconditioner: Preconditioner) -> PressureSolver {
        PressureSolver { preconditioner, ..PressureSolver::default() }
    }

    /// Set up for a new matrix; positions [m] and smoothing lengths [m] of its rows.
    pub fn prepare(&mut self, a: &Matrix, x: &[f64], y: &[f64], h: &[f64]) {
        let n = a.rows();
        debug_assert!(x.len() == n && y.len() == n && h.len() == n);
        self.components.find(a);
        for array in
            [&mut self.inverse, &mut self.residual, &mut self.direction, &mut self.image, &mut self.preconditioned]
        {
            array.clear();
            array.resize(n, 0.0);
        }
        if self.preconditioner == Preconditioner::Multigrid {
            self.multigrid.gather_rows(a);
            self.pinned.clear();
            self.pinned.resize(n, false);
            for i in 0..n {
                self.inverse[i] = if a.diagonal[i] > 0.0 { 1.0 / a.diagonal[i] } else { 0.0 };
            }
            self.multigrid.set_up(a, &self.inverse);
        }
        self.sums.resize(n.div_ceil(CHUNK), 0.0);
        self.parts.resize(n.div_ceil(CHUNK), [0.0; 2]);
    }

    /// PS2–PS4: (A + Σ c g gᵀ) x = b, x = 0 where `pinned`, with the matrix that was prepared. `x` is the first guess and
    /// becomes the solution; the residual of row i is measured against `scale[i]` > 0. What floats gets the mean 0.
    pub fn solve(
        &mut self,
        a: &Matrix,
        ranks: &[RankOne],
        b: &[f64],
        scale: &[f64],
        pinned: &[bool],
        x: &mut [f64],
        stop: &Stop,
    ) -> Result<Solved, NotConverged> {
        assert_eq!(self.inverse.len(), a.rows(), "prepare the solver for this matrix first");
        sweep::within_pool(|| self.iterate(a, ranks, b, scale, pinned, x, stop))
    }

    fn iterate(
        &mut self,
        a: &Matrix,
        ranks: &[RankOne],
        b: &[f64],
        scale: &[f64],
        pinned: &[bool],
        x: &mut [f64],
        stop: &Stop,
    ) -> Result<Solved, NotConverged> {
        self.null_space.find(&self.components, pinned, ranks);
        let inverse_of = |i: usize| if pinned[i] || a.diagonal[i] <= 0.0 { 0.0 } else { 1.0 / a.diagonal[i] };
        sweep::gather_into(&mut self.inverse, inverse_of);
        sweep::update(x, |i, x| {
            if inverse_of(i) == 0.0 {
                *x = 0.0
            }
        });

        if self.preconditioner == Preconditioner::Multigrid && self.pinned != pinned {
            self.pinned.copy_from_slice(pinned);
            self.multigrid.set_up(a, &self.inverse);
        }
        // r = b − A x
        self.apply(a, ranks, x, true);
        let PressureSolver { inverse, image, residual, .. } = self;
        sweep::gather_into(residual, |i| if inverse[i] == 0.0 { 0.0 } else { b[i] - image[i] });
        self.direction.fill(0.0);
        let (mut old, mut iterations) = (f64::INFINITY, 0);
        loop {
            self.null_space.remove(&mut self.residual);
            let [mut weighted, worst] = self.measure(scale);
            if worst <= stop.tolerance {
                self.null_space.remove(x);
                return Ok(Solved { iterations, residual: worst });
            }
            if iterations == stop.most_iterations || !worst.is_finite() {
                return Err(self.give_up(scale, iterations, worst));
            }
            if self.preconditioner == Preconditioner::Multigrid {
                let PressureSolver { multigrid, inverse, residual, preconditioned, sums, .. } = &mut *self;
                weighted = multigrid.apply(a, inverse, residual, preconditioned, sums);
                let beta = weighted / old;
                let PressureSolver { preconditioned, direction, .. } = &mut *self;
                sweep::update(direction, |i, p| *p = preconditioned[i] + beta * *p);
            } else {
                // p = z + β p
                let (beta, PressureSolver { inverse, residual, direction, .. }) = (weighted / old, &mut *self);
                sweep::update(direction, |i, p| *p = inverse[i] * residual[i] + beta * *p);
            }
            old = weighted;
            // x ← x + α p, r ← r − α A p
            let energy = self.apply(a, ranks, x, false);
            if energy <= 0.0 || !energy.is_finite() {
                return Err(self.give_up(scale, iterations, worst));
            }
            let (alpha, PressureSolver { residual, direction, image, .. }) = (weighted / energy, &mut *self);
            sweep::update_both(x, residual, |i, x, r| {
                *x += alpha * direction[i];
                *r -= alpha * image[i];
            });
            iterations += 1;
        }
    }

    /// image ← (A + Σ c g gᵀ) of the guess `x`, or of the direction; returns its energy.
    fn apply(&mut self, a: &Matrix, ranks: &[RankOne], x: &[f64], of_guess: bool) -> f64 {
        let PressureSolver { inverse, direction, image, sums, .. } = self;
        let of: &[f64] = if of_guess { x } else { direction };
        let mut energy = a.multiply(of, |i| inverse[i] != 0.0, image, sums);
        for rank in ranks {
            let along = rank.weight * rank.dot(of);
            for &(i, g) in &rank.entries {
                if inverse[i as usize] != 0.0 {
                    image[i as usize] += along * g;
                    energy += of[i as usize] * along * g;
                }
            }
        }
        energy
    }

    /// r·z and the largest |r_i|/scale_i.
    fn measure(&mut self, scale: &[f64]) -> [f64; 2] {
        let PressureSolver { inverse, residual, parts, .. } = self;
        sweep::update_chunks(parts, residual, |rows, chunk| {
            let (mut sum, mut worst) = (0.0, 0.0_f64);
            for (i, r) in rows.zip(chunk) {
                sum += *r * *r * inverse[i];
                let share = if *r == 0.0 { 0.0 } else { r.abs() / scale[i] };
                worst = if share > worst || share.is_nan() { share } else { worst };
            }
            [sum, worst]
        });
        self.parts
            .iter()
            .fold([0.0, 0.0], |[sum, worst], &[s, w]| [sum + s, if w > worst || w.is_nan() { w } else { worst }])
    }

    fn give_up(&self, scale: &[f64], iterations: usize, residual: f64) -> NotConverged {
        let share = |i: usize| self.residual[i].abs() / scale[i];
        let worst = (0..self.residual.len()).find(|&i| share(i) == residual || share(i).is_nan()).unwrap_or(0);
        NotConverged { iterations, residual, worst }
    }
}
