//! Cauchy's integral on the whole contour (THEORY EN34): the stream function on the body is known but for a constant.

use std::f64::consts::TAU;

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, c64};

use super::super::cauchy::{Complex, Known, element, equation, logarithm};

/// The whole contour, factorised.
pub(super) struct WholeContour {
    known: Vec<Known>,
    /// Nodes that have an unknown.
    unknown: Vec<usize>,
    /// Coefficients of β_k in the equation of node j, shape (n, n).
    of: Vec<c64>,
    /// Coefficients of iψ of the first and the last node for the surface beyond them.
    far: Vec<[c64; 2]>,
    lu: PartialPivLu<f64>,
}

const I: c64 = c64::new(0.0, 1.0);

/// Of each pair j, k of nodes: ln(z_k − z_j), shape (n, n), j by rows.
fn logarithms(z: &[c64]) -> Vec<c64> {
    let n = z.len();
    let mut logs = vec![c64::ZERO; n * n];
    for j in 0..n {
        for k in 0..j {
            let own = logarithm(z[k] - z[j]);
            logs[j * n + k] = own;
            let turn = if own.im > 0.0 { -0.5 * TAU } else { 0.5 * TAU };
            logs[k * n + j] = own + c64::new(0.0, turn);
        }
    }
    logs
}

/// Coefficients of β_k in the equations of all nodes but the first and the last.
fn coefficients(z: &[c64]) -> Vec<c64> {
    let n = z.len();
    let logs = logarithms(z);
    let mut of = vec![c64::ZERO; n * n];
    for (j, of) in of.chunks_exact_mut(n).enumerate().skip(1).take(n - 2) {
        let logs = &logs[j * n..];
        let from = |k: usize| z[k] - z[j];
        for k in 0..n - 1 {
            let [a, b] = element([from(k), from(k + 1)], [logs[k], logs[k + 1]]);
            of[k] += a;
            of[k + 1] += b;
        }
        // the node itself is outside the contour that is integrated: −iα β_j, α the angle of the water there
        let angle = (from(j - 1) / from(j + 1)).arg();
        of[j] -= I * if angle > 0.0 { angle } else { angle + TAU };
    }
    of
}

/// Beyond the first node, at x = l, and the last, at x = −l, β = iψ l/|x|.
fn beyond(z: &[c64]) -> Vec<[c64; 2]> {
    let (one, right, left) = (c64::new(1.0, 0.0), z[0].re, -z[z.len() - 1].re);
    let at = |z: &c64| [right / z * (one - z / right).ln(), left / z * (one + z / left).ln()];
    z.iter().map(at).collect()
}

impl WholeContour {
    /// Of the nodes `z` from the far free surface on the right to that on the left, water on the left.
    pub fn new(z: &[c64], known: Vec<Known>) -> WholeContour {
        let n = z.len();
        let (of, far) = (coefficients(z), beyond(z));
        let unknown: Vec<usize> = (0..n).filter(|&j| known[j] != Known::Both).collect();
        let size = unknown.len() + 1;
        let mut contour = WholeContour { known, unknown, of, far, lu: Mat::<f64>::zeros(0, 0).partial_piv_lu() };
        let mut matrix = Mat::<f64>::zeros(size, size);
        for row in 0..size - 1 {
            let j = contour.unknown[row];
            if j == 0 || j == n - 1 {
                // ψ falls like 1/x
                let next = if j == 0 { row + 1 } else { row - 1 };
                matrix[(row, row)] = z[j].re;
                matrix[(row, next)] = -z[contour.unknown[next]].re;
                continue;
            }
            contour.fill(&mut matrix, row, j);
        }
        for j in contour.contacts() {
            contour.fill(&mut matrix, size - 1, j);
        }
        contour.lu = matrix.partial_piv_lu();
        contour
    }

    /// The nodes where surface and body meet.
    fn contacts(&self) -> impl Iterator<Item = usize> + use<> {
        let contacts: Vec<usize> = (0..self.known.len()).filter(|&j| self.known[j] == Known::Both).collect();
        contacts.into_iter()
    }

    /// The part of the equation of a node that counts: where both are known, that of the potential.
    fn part(&self, j: usize, sum: c64) -> f64 {
        equation(if self.known[j] == Known::Both { Known::Potential } else { self.known[j] }, sum)
    }

    /// Coefficient of ψ_k in the equation of node j.
    fn of_psi(&self, j: usize, k: usize) -> c64 {
        let n = self.known.len();
        let far = match k {
            0 => self.far[j][0],
            k if k == n - 1 => self.far[j][1],
            _ => c64::ZERO,
        };
        (self.of[j * n + k] + far) * I
    }

    /// Add the equation of node j to a row.
    fn fill(&self, matrix: &mut Mat<f64>, row: usize, j: usize) {
        let n = self.known.len();
        for (column, &k) in self.unknown.iter().enumerate() {
            let of = match self.known[k] {
                Known::Potential => self.of_psi(j, k),
                _ => self.of[j * n + k],
            };
            matrix[(row, column)] += self.part(j, of);
        }
        let body = (0..n).filter(|&k| self.known[k] != Known::Potential);
        let constant: c64 = body.map(|k| self.of_psi(j, k)).sum();
        matrix[(row, self.unknown.len())] += self.part(j, constant);
    }

    /// Find what is not known of β: φ is read where it is known, ψ where it is but for a constant, the rest is written.
    pub fn solve(&self, beta: &mut Complex) {
        let n = self.known.len();
        let right_of = |j: usize| {
            let sum: c64 = (0..n)
                .map(|k| {
                    let phi = if self.known[k] == Known::StreamFunction { 0.0 } else { beta.phi[k] };
                    let psi = if self.known[k] == Known::Potential { 0.0 } else { beta.psi[k] };
                    self.of[j * n + k] * c64::new(phi, psi)
                })
                .sum();
            -self.part(j, sum)
        };
        let size = self.unknown.len() + 1;
        let right = Mat::from_fn(size, 1, |row, _| match self.unknown.get(row) {
            Some(&j) if j == 0 || j == n - 1 => 0.0,
            Some(&j) => right_of(j),
            None => self.contacts().map(right_of).sum(),
        });
        let solution = self.lu.solve(&right);
        for (row, &j) in self.unknown.iter().enumerate() {
            match self.known[j] {
                Known::Potential => beta.psi[j] = solution[(row, 0)],
                _ => beta.phi[j] = solution[(row, 0)],
            }
        }
        let constant = solution[(size - 1, 0)];
        for (psi, known) in beta.psi.iter_mut().zip(&self.known) {
            if *known != Known::Potential {
                *psi += constant;
            }
        }
    }
}
