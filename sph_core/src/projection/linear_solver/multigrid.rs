//! A hierarchy of coarser systems as an approximate inverse (THEORY LS6–LS8).

use serde::{Deserialize, Serialize};

use crate::parallel;
use crate::projection::linear_solver::aggregates::{Aggregates, NO_ROW};
use crate::projection::linear_solver::coarse::{Collected, RowSum, Sparse, collapse, smoothed, triple};
use crate::projection::linear_solver::matrix::{Matrix, MatrixRows};
use faer::linalg::solvers::{Llt, SolveCore};
use faer::{Conj, Mat, MatMut, Side};

/// A coupling is strong from this share of its row's largest on the level of particles [-].
const STRONG: f64 = 0.25;
/// The same on coarser levels, whose stencils are narrow.
const STRONG_COARSE: f64 = 0.08;
/// Couplings of piecewise constant pressures are too stiff by about this factor [-]: 1.2 to 3 cost the same.
const SOFTENING: f64 = 1.8;
/// Share of Jacobi's step on the level of particles [-].
const STEP: f64 = 0.9;
/// The same on coarser levels.
const STEP_COARSE: f64 = 0.8;
/// ω of prolongation smoothing: 4/3 over the largest eigenvalue of D⁻¹A, which is about 1.6 here and at most 2 [-].
const SMOOTHING: f64 = 0.8;
/// A level of so few unknowns is solved directly, or of four times as many where it does not get coarser.
const FEW: usize = 60;
/// A spring for what floats, as a share of the coarsest diagonal [-].
const SPRING: f64 = 1e-3;
/// Levels at most.
const DEEPEST: usize = 12;
/// Loops over fewer targets are not worth a second thread.
const NOT_WORTH: usize = 2048;

fn gather(out: &mut [f64], value: impl Fn(usize) -> f64 + Sync) {
    if out.len() > NOT_WORTH {
        parallel::gather_into(out, value);
    } else {
        out.iter_mut().enumerate().for_each(|(k, slot)| *slot = value(k));
    }
}

/// A coarse system and the way to the next coarser one.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Level {
    a: Matrix,
    /// ω/a_ii, or 0.
    step: Vec<f64>,
    right: Vec<f64>,
    x: Vec<f64>,
    rest: Vec<f64>,
    aggregates: Aggregates,
    p: Sparse,
    pt: Sparse,
}

/// The hierarchy below the level of particles.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Multigrid {
    aggregates: Aggregates,
    levels: Vec<Level>,
    depth: usize,
    #[serde(skip)]
    coarsest: Option<Llt<f64>>,
    #[serde(skip)]
    collected: Vec<Collected>,
    #[serde(skip)]
    sum: RowSum,
    #[serde(skip)]
    ap: Sparse,
}

impl Multigrid {
    /// Aggregates and matrices of every level.
    pub fn set_up(&mut self, a: &impl MatrixRows) {
        let Multigrid { aggregates, levels, depth, collected, sum, ap, .. } = self;
        aggregates.find(a, STRONG);
        if levels.is_empty() {
            levels.push(Level::default());
        }
        collapse(a, aggregates, SOFTENING, collected, &mut levels[0].a);
        levels[0].size();
        *depth = 1;
        while levels[*depth - 1].a.rows() > FEW && *depth < DEEPEST {
            if levels.len() == *depth {
                levels.push(Level::default());
            }
            let (fine, coarse) = levels.split_at_mut(*depth);
            let (fine, coarse) = (&mut fine[*depth - 1], &mut coarse[0]);
            fine.aggregates.find(&fine.a, STRONG_COARSE);
            let fewer = fine.aggregates.len();
            if fewer == 0 {
                break;
            }
            smoothed(&fine.a, &fine.aggregates, SMOOTHING, sum, &mut fine.p);
            fine.pt.transpose(&fine.p, fewer);
            triple(&fine.a, &fine.p, &fine.pt, sum, ap, &mut coarse.a);
            coarse.size();
            *depth += 1;
        }
        self.factorise_coarsest();
    }

    /// The factors of the last level, which a stored hierarchy is without.
    pub fn factorise_coarsest(&mut self) {
        let last = self.depth.checked_sub(1).and_then(|last| self.levels.get(last));
        self.coarsest = last.filter(|last| last.a.rows() <= 4 * FEW).and_then(|last| factor(&last.a));
    }

    /// The rows of the matrix have other places; see [`Aggregates::rename`].
    pub fn rename(&mut self, from: impl Iterator<Item = u32>) {
        self.aggregates.rename(from);
    }

    /// The matrix of the first coarser level, and the row of it that each row belongs to.
    pub fn first(&self) -> (&Matrix, &[u32]) {
        (&self.levels[0].a, &self.aggregates.of)
    }

    /// LS8: z = ω D⁻¹ r + P B₁ Pᵀ r, where `inverse` ≠ 0 (r is 0 elsewhere); returns r·z, with `sums` for its parts.
    pub fn apply(&mut self, inverse: &[f64], r: &[f64], z: &mut [f64], sums: &mut [f64]) -> f64 {
        let Multigrid { aggregates, levels, depth, coarsest, .. } = self;
        let sum_of = |c: usize| aggregates.of_aggregate(c).iter().map(|&i| r[i as usize]).sum::<f64>();
        gather(&mut levels[0].right, sum_of);
        cycle(&mut levels[..*depth], coarsest.as_ref());
        let (of, e) = (&aggregates.of, &levels[0].x);
        parallel::update_chunks(sums, z, |rows, chunk| {
            let mut sum = 0.0;
            for (i, z) in rows.zip(chunk) {
                let coarse = if of[i] == NO_ROW { 0.0 } else { e[of[i] as usize] };
                *z = if inverse[i] == 0.0 { 0.0 } else { coarse + STEP * inverse[i] * r[i] };
                sum += *z * r[i];
            }
            sum
        });
        sums.iter().sum()
    }
}

impl Level {
    fn size(&mut self) {
        let n = self.a.rows();
        self.step.clear();
        self.step.extend(self.a.diagonal.iter().map(|&d| if d > 0.0 { STEP_COARSE / d } else { 0.0 }));
        for array in [&mut self.right, &mut self.x, &mut self.rest] {
            array.clear();
            array.resize(n, 0.0);
        }
    }
}

/// LS8: x = B right on the first of `levels`, by a V-cycle.
fn cycle(levels: &mut [Level], coarsest: Option<&Llt<f64>>) {
    let Some((level, below)) = levels.split_first_mut() else { return };
    let Level { a, step, right, x, rest, p, pt, .. } = level;
    let right = &*right;
    let Some(coarser) = below.first_mut() else {
        let Some(factor) = coarsest else {
            return gather(x, |i| step[i] * right[i]);
        };
        x.copy_from_slice(right);
        let n = x.len();
        return factor.solve_in_place_with_conj(Conj::No, MatMut::from_column_major_slice_mut(x, n, 1));
    };
    gather(x, |i| step[i] * right[i]);
    gather(rest, |i| right[i] - a.times(i, x));
    gather(&mut coarser.right, |c| pt.times(c, rest));
    cycle(below, coarsest);
    let e = &below[0].x;
    gather(rest, |i| x[i] + p.times(i, e));
    gather(x, |i| rest[i] + step[i] * (right[i] - a.times(i, rest)));
}

/// Cholesky of a small matrix, with a weak spring for what floats.
fn factor(a: &Matrix) -> Option<Llt<f64>> {
    let n = a.rows();
    let mut full = Mat::<f64>::zeros(n, n);
    for i in 0..n {
        full[(i, i)] = if a.diagonal[i] > 0.0 { a.diagonal[i] * (1.0 + SPRING) } else { 1.0 };
        for (j, v) in a.row(i) {
            full[(i, j)] = v;
        }
    }
    full.llt(Side::Lower).ok()
}
