//! A hierarchy of coarser systems as an approximate inverse (THEORY PS5–PS7).

use super::aggregates::{Aggregates, NOBODY};
use super::galerkin::{Collected, RowSum, Sparse, collapse, smoothed, triple};
use super::matrix::Matrix;
use crate::sweep;
use faer::linalg::solvers::{Llt, SolveCore};
use faer::{Conj, Mat, MatMut, Side};

/// A coupling is strong from this share of its row's largest on the level of particles [-].
const STRONG: f64 = 0.25;
/// The same on coarser levels, whose stencils are narrow.
const STRONG_COARSE: f64 = 0.08;
/// Couplings of piecewise constant pressures are too stiff by this factor [-].
pub const SOFTENING: f64 = 1.8;
/// Share of Jacobi's step that smooths on the level of particles [-].
const STEP: f64 = 0.9;
/// The same on coarser levels.
const STEP_COARSE: f64 = 0.8;
/// ω of prolongation smoothing: 4/3 over the largest eigenvalue of D⁻¹A, which is 2 at most [-].
const SMOOTHING: f64 = 2.0 / 3.0;
/// A level of so few unknowns is solved directly.
const FEW: usize = 60;
/// A spring for what floats, as a share of the diagonal [-].
const SPRING: f64 = 1e-8;
/// Sweeps over fewer targets are not worth a second thread.
const NOT_WORTH: usize = 2048;

fn gather(out: &mut [f64], value: impl Fn(usize) -> f64 + Sync) {
    if out.len() > NOT_WORTH {
        sweep::gather_into(out, value);
    } else {
        out.iter_mut().enumerate().for_each(|(k, slot)| *slot = value(k));
    }
}

/// A coarse system and the way to the next coarser one.
#[derive(Debug, Default)]
struct Level {
    a: Matrix,
    /// ω/a_ii.
    step: Vec<f64>,
    right: Vec<f64>,
    x: Vec<f64>,
    rest: Vec<f64>,
    aggregates: Aggregates,
    p: Sparse,
    pt: Sparse,
}

/// The hierarchy below the level of particles.
#[derive(Debug, Default)]
pub(crate) struct Multigrid {
    aggregates: Aggregates,
    levels: Vec<Level>,
    depth: usize,
    coarsest: Option<Llt<f64>>,
    collected: Vec<Collected>,
    sum: RowSum,
    ap: Sparse,
    smooth: Vec<f64>,
    rest: Vec<f64>,
}

impl Multigrid {
    /// Which rows belong together: once for a matrix.
    pub fn gather_rows(&mut self, a: &Matrix) {
        self.aggregates.find(a, STRONG);
        self.smooth.clear();
        self.smooth.resize(a.rows(), 0.0);
        self.rest.clear();
        self.rest.resize(a.rows(), 0.0);
    }

    /// The coarser matrices, for the rows with `inverse` ≠ 0.
    pub fn set_up(&mut self, a: &Matrix, inverse: &[f64]) {
        let Multigrid { aggregates, levels, depth, coarsest, collected, sum, ap, .. } = self;
        if levels.is_empty() {
            levels.push(Level::default());
        }
        collapse(a, |i| inverse[i] != 0.0, aggregates, SOFTENING, collected, &mut levels[0].a);
        *depth = 1;
        loop {
            if levels.len() == *depth {
                levels.push(Level::default());
            }
            let (fine, coarse) = levels.split_at_mut(*depth);
            let (fine, coarse) = (&mut fine[*depth - 1], &mut coarse[0]);
            fine.size();
            let n = fine.a.rows();
            if n <= FEW || *depth > 12 {
                break;
            }
            fine.aggregates.find(&fine.a, STRONG_COARSE);
            let fewer = fine.aggregates.len();
            if fewer == 0 {
                break;
            }
            smoothed(&fine.a, &fine.aggregates, SMOOTHING, sum, &mut fine.p);
            fine.pt.transpose(&fine.p, fewer);
            triple(&fine.a, &fine.p, &fine.pt, sum, ap, &mut coarse.a);
            *depth += 1;
        }
        let last = &levels[*depth - 1].a;
        *coarsest = if last.rows() <= 4 * FEW { factor(last) } else { None };
    }

    /// z ≈ A⁻¹ r by one V-cycle (PS7); returns r·z by chunks into `sums`.
    pub fn apply(&mut self, a: &Matrix, inverse: &[f64], r: &[f64], z: &mut [f64], sums: &mut [f64]) -> f64 {
        let Multigrid { aggregates, levels, depth, coarsest, smooth, rest, .. } = self;
        // smooth = ω D⁻¹ r; rest = r − A smooth
        sweep::gather_into(smooth, |i| STEP * inverse[i] * r[i]);
        let s = &*smooth;
        sweep::gather_into(rest, |i| if inverse[i] == 0.0 { 0.0 } else { r[i] - a.times(i, s) });
        let sum_of = |c: usize| aggregates.of_aggregate(c).iter().map(|&i| rest[i as usize]).sum::<f64>();
        gather(&mut levels[0].right, sum_of);
        cycle(&mut levels[..*depth], coarsest.as_ref());
        let e = &levels[0].x;
        sweep::update(smooth, |i, s| {
            let c = aggregates.of[i];
            if c != NOBODY && inverse[i] != 0.0 {
                *s += e[c as usize];
            }
        });
        let s = &*smooth;
        sweep::update_chunks(sums, z, |rows, chunk| {
            let mut sum = 0.0;
            for (i, z) in rows.zip(chunk) {
                *z = if inverse[i] == 0.0 { 0.0 } else { s[i] + STEP * inverse[i] * (r[i] - a.times(i, s)) };
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

/// x ≈ A⁻¹ right on the first of `levels`.
fn cycle(levels: &mut [Level], coarsest: Option<&Llt<f64>>) {
    let Some((level, below)) = levels.split_first_mut() else { return };
    let Level { a, step, right, x, rest, p, pt, .. } = level;
    let right = &*right;
    if below.is_empty() {
        match coarsest {
            Some(factor) => {
                x.copy_from_slice(right);
                let n = x.len();
                factor.solve_in_place_with_conj(Conj::No, MatMut::from_column_major_slice_mut(x, n, 1));
            }
            None => gather(x, |i| step[i] * right[i]),
        }
        return;
    }
    gather(x, |i| step[i] * right[i]);
    gather(rest, |i| right[i] - a.times(i, x));
    gather(&mut below[0].right, |c| pt.times(c, rest));
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
