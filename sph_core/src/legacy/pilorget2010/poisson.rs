//! The pressure equation's rows (THEORY LE22, LE23, LE28), and Bi-CGSTAB (van der Vorst 1992) with a criterion on every row (LE27).

use crate::legacy::pilorget2010::cast::{Cast, Pairs};
use crate::legacy::pilorget2010::settings::LimitRows;
use crate::parallel;

/// What the rows are made of.
pub(crate) struct Assembly<'a> {
    pub cast: &'a Cast,
    pub pairs: &'a Pairs,
    /// ρ* [kg/m³] of each row.
    pub density: &'a [f64],
    pub at_surface: &'a [bool],
    /// Normals of the limit particles, in the order of their rows.
    pub normals: &'a [[f64; 2]],
    pub limit_rows: LimitRows,
    pub rho0: f64,
    pub dt: f64,
}

impl Assembly<'_> {
    /// A and b of A P = b [1/s²].
    pub fn rows(&self) -> (Matrix, Vec<f64>) {
        let n = self.cast.rows;
        let fluid = n - self.normals.len();
        let mut a = Matrix { start: vec![0], ..Matrix::default() };
        let mut b = Vec::with_capacity(n);
        for i in 0..n {
            let zero_gradient = i >= fluid && self.limit_rows == LimitRows::ZeroGradient;
            let rho = self.density[i];
            let (mut diagonal, mut source) = (0.0, (rho - self.rho0) / (rho * self.dt * self.dt)); // LE22
            if self.at_surface[i] {
                (diagonal, source) = (1.0, 0.0); // LE23
            } else if zero_gradient {
                source = 0.0; // LE28
                let normal = self.normals[i - fluid];
                for pair in self.pairs.of(i) {
                    let along = pair.r[0] * normal[0] + pair.r[1] * normal[1];
                    self.link(&mut a, &mut diagonal, i, pair.j, pair.grad_factor * along / (rho * rho));
                }
            } else {
                for pair in self.pairs.of(i) {
                    self.link(&mut a, &mut diagonal, i, pair.j, -2.0 / (rho * rho) * pair.link);
                }
            }
            if diagonal == 0.0 {
                (diagonal, source) = (1.0, 0.0); // no neighbours
            }
            a.diagonal.push(diagonal);
            a.start.push(a.column.len() as u32);
            b.push(source);
        }
        (a, b)
    }

    /// Add `strength` m_j (P_i − P_j) to row `i`, where P_j is a row's pressure, or its opposite.
    fn link(&self, a: &mut Matrix, diagonal: &mut f64, i: usize, j: u32, strength: f64) {
        let other = &self.cast.players[j as usize];
        let weight = strength * other.mass;
        *diagonal += weight;
        if other.row as usize == i {
            *diagonal -= other.sign * weight;
        } else if !self.at_surface[other.row as usize] {
            a.column.push(other.row);
            a.value.push(-other.sign * weight);
        }
    }
}

/// A sparse matrix by rows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Matrix {
    /// First entry of each row, and the end.
    pub start: Vec<u32>,
    /// Columns of the entries beside the diagonal.
    pub column: Vec<u32>,
    /// The entries beside the diagonal.
    pub value: Vec<f64>,
    /// The diagonal.
    pub diagonal: Vec<f64>,
}

/// How a solution ended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ended {
    /// Products with the matrix, halved.
    pub iterations: usize,
    /// Largest residual of a row, in the right-hand side's unit.
    pub residual: f64,
    /// Its row.
    pub row: usize,
}

impl Matrix {
    /// out = A x.
    pub fn apply(&self, x: &[f64], out: &mut [f64]) {
        parallel::gather_into(out, |i| {
            let entries = self.start[i] as usize..self.start[i + 1] as usize;
            let beside = self.column[entries.clone()].iter().zip(&self.value[entries]);
            beside.fold(self.diagonal[i] * x[i], |sum, (&j, a)| sum + a * x[j as usize])
        });
    }

    /// Solve A x = b from the x given, until no row's residual exceeds `tolerance`; preconditioned by the diagonal.
    pub fn solve(&self, b: &[f64], x: &mut [f64], tolerance: f64, most: usize) -> Ended {
        let n = b.len();
        let inverse: Vec<f64> = self.diagonal.iter().map(|d| 1.0 / d).collect();
        let scaled = |v: &[f64]| -> Vec<f64> { v.iter().zip(&inverse).map(|(v, d)| v * d).collect() };
        let (mut v, mut t) = (vec![0.0; n], vec![0.0; n]);
        self.apply(x, &mut t);
        let mut r: Vec<f64> = b.iter().zip(&t).map(|(b, t)| b - t).collect();
        let mut shadow = r.clone();
        let mut p = vec![0.0; n];
        let (mut rho, mut alpha, mut omega) = (1.0, 1.0, 1.0);
        let mut ended = worst(&r, 0);
        let mut best = (ended, x.to_vec());
        for iterations in 1..=most {
            if ended.residual <= tolerance || !ended.residual.is_finite() {
                break;
            }
            let next = dot(&shadow, &r);
            if next.abs() < 1e-14 * dot(&shadow, &shadow).sqrt() * dot(&r, &r).sqrt() {
                // the shadow has become orthogonal: begin again from here
                shadow.clone_from(&r);
                p.fill(0.0);
                v.fill(0.0);
                (rho, alpha, omega) = (1.0, 1.0, 1.0);
                ended.iterations = iterations;
                continue;
            }
            let beta = next / rho * (alpha / omega);
            rho = next;
            for k in 0..n {
                p[k] = r[k] + beta * (p[k] - omega * v[k]);
            }
            let y = scaled(&p);
            self.apply(&y, &mut v);
            alpha = rho / dot(&shadow, &v);
            for k in 0..n {
                r[k] -= alpha * v[k];
            }
            let z = scaled(&r);
            self.apply(&z, &mut t);
            let tt = dot(&t, &t);
            omega = if tt > 0.0 { dot(&t, &r) / tt } else { 0.0 };
            for k in 0..n {
                x[k] += alpha * y[k] + omega * z[k];
                r[k] -= omega * t[k];
            }
            ended = worst(&r, iterations);
            if ended.residual < best.0.residual {
                best = (ended, x.to_vec());
            }
        }
        if ended.residual <= tolerance {
            return ended;
        }
        x.copy_from_slice(&best.1);
        Ended { iterations: ended.iterations, ..best.0 }
    }
}

/// The row that is farthest from solved.
fn worst(r: &[f64], iterations: usize) -> Ended {
    let mut ended = Ended { iterations, residual: 0.0, row: 0 };
    for (row, r) in r.iter().enumerate() {
        if r.abs() > ended.residual || r.is_nan() {
            ended = Ended { residual: r.abs(), row, ..ended };
        }
        if !r.is_finite() {
            break;
        }
    }
    ended
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::linalg::solvers::Solve;
    use faer::sparse::{SparseColMat, Triplet};

    /// An unsymmetric matrix with a dominant diagonal.
    fn matrix(n: usize) -> Matrix {
        let mut m = Matrix { start: vec![0], ..Matrix::default() };
        for i in 0..n {
            for (j, a) in [(i + 1, -1.0), (i + 7, -0.4), (i + n - 1, -0.7), (i + n - 7, 0.3)] {
                m.column.push((j % n) as u32);
                m.value.push(a * (1.0 + 0.3 * (i as f64).sin()));
            }
            m.start.push(m.column.len() as u32);
            m.diagonal.push(2.3 + 0.1 * (i % 3) as f64);
        }
        m
    }

    #[test]
    fn it_agrees_with_a_factorisation() {
        let n = 300;
        let m = matrix(n);
        let b: Vec<f64> = (0..n).map(|k| (0.37 * k as f64).cos()).collect();
        let mut x = vec![0.0; n];
        let ended = m.solve(&b, &mut x, 1e-12, 500);
        assert!(ended.residual <= 1e-12, "{ended:?}");
        let mut entries = Vec::new();
        for i in 0..n {
            entries.push(Triplet::new(i, i, m.diagonal[i]));
            for e in m.start[i] as usize..m.start[i + 1] as usize {
                entries.push(Triplet::new(i, m.column[e] as usize, m.value[e]));
            }
        }
        let factors = SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &entries).unwrap().sp_lu().unwrap();
        let mut exact = faer::Col::from_fn(n, |k| b[k]);
        factors.solve_in_place(exact.as_mut());
        let gap = (0..n).map(|k| (x[k] - exact[k]).abs()).fold(0.0, f64::max);
        assert!(gap < 1e-11, "{gap:e}");
    }

    #[test]
    fn what_has_no_solution_says_how_far_it_got() {
        // two rows that contradict each other
        let m = Matrix { start: vec![0, 1, 2], column: vec![1, 0], value: vec![-1.0, -1.0], diagonal: vec![1.0, 1.0] };
        let mut x = vec![0.0; 2];
        let ended = m.solve(&[1.0, 1.0], &mut x, 1e-9, 50);
        assert!(ended.residual > 0.5, "{ended:?}");
    }
}
