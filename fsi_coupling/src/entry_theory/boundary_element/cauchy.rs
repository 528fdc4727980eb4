//! Cauchy's integral on linear elements (THEORY EN21): one factorised matrix for the potential and for its time derivative.

use std::f64::consts::{PI, TAU};

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, c64};

/// What is known of β = φ + iψ at a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Known {
    /// The potential φ: on the free surface.
    Potential,
    /// The stream function ψ: on the body.
    StreamFunction,
    /// Both: where they meet.
    Both,
}

/// Potential φ and stream function ψ at the nodes [m²/s], or their time derivatives.
#[derive(Clone, Debug)]
pub(super) struct Complex {
    pub phi: Vec<f64>,
    pub psi: Vec<f64>,
}

/// The right half of a symmetric contour, factorised.
pub(super) struct Contour {
    known: Vec<Known>,
    /// Nodes that have an unknown.
    unknown: Vec<usize>,
    /// Coefficients of β_k and of its mirror image in the equation of node j, shape (n, n).
    of: Vec<[c64; 2]>,
    lu: PartialPivLu<f64>,
}

/// ∫ β/(z − z₀) dz of a straight element from z₀ + `a` to z₀ + `b`, with the logarithms of `a` and `b`: the factors of β at its ends. At an end
/// that is z₀ its singular part is left to the node.
pub(super) fn element([a, b]: [c64; 2], [log_a, log_b]: [c64; 2]) -> [c64; 2] {
    let one = c64::new(1.0, 0.0);
    if a == c64::ZERO {
        return [c64::new(log_b.re, 0.0) - one, one];
    }
    if b == c64::ZERO {
        return [-one, one - c64::new(log_a.re, 0.0)];
    }
    let angle = log_b.im - log_a.im;
    let turn = if angle > PI {
        -TAU
    } else if angle < -PI {
        TAU
    } else {
        0.0
    };
    let log = c64::new(log_b.re - log_a.re, angle + turn);
    let second = one - a * log / (b - a);
    [log - second, second]
}

fn mirrored(z: c64) -> c64 {
    c64::new(-z.re, z.im)
}

pub(super) fn logarithm(z: c64) -> c64 {
    c64::new(0.5 * z.norm_sqr().ln(), z.im.atan2(z.re))
}

/// Of each pair j, k of nodes: ln(z_k − z_j), and ln(z − z_j) at the mirror image z of z_k. Shape (n, n), j by rows.
fn logarithms(z: &[c64]) -> Vec<[c64; 2]> {
    let n = z.len();
    let mut logs = vec![[c64::ZERO; 2]; n * n];
    for j in 0..n {
        for k in 0..=j {
            let (own, image) = (logarithm(z[k] - z[j]), logarithm(mirrored(z[k]) - z[j]));
            logs[j * n + k] = [own, image];
            logs[k * n + j] = [own + c64::new(0.0, if own.im > 0.0 { -PI } else { PI }), image.conj()];
        }
    }
    logs
}

impl Contour {
    /// Of the nodes `z` from the far free surface to the keel on x = 0, water on the left.
    pub fn new(z: &[c64], known: Vec<Known>) -> Contour {
        let n = z.len();
        let logs = logarithms(z);
        let mut of = vec![[c64::ZERO; 2]; n * n];
        for (j, of) in of.chunks_exact_mut(n).enumerate().skip(1) {
            let logs = &logs[j * n..];
            let from = |k: usize| z[k] - z[j];
            let image = |k: usize| mirrored(z[k]) - z[j];
            for k in 0..n - 1 {
                let [a, b] = element([from(k), from(k + 1)], [logs[k][0], logs[k + 1][0]]);
                let [mirrored_b, mirrored_a] = element([image(k + 1), image(k)], [logs[k + 1][1], logs[k][1]]);
                of[k][0] += a;
                of[k + 1][0] += b;
                of[k][1] += mirrored_a;
                of[k + 1][1] += mirrored_b;
            }
            // the node itself is outside the contour that is integrated: −iα β_j, α the angle of the water there
            let next = if j + 1 == n { image(j - 1) } else { from(j + 1) };
            let angle = (from(j - 1) / next).arg();
            of[j][0] -= c64::new(0.0, if angle > 0.0 { angle } else { angle + TAU });
            // beyond the first node, at x = l, β = iψ₁ l/x on both sides
            let (l, one) = (z[0].re, c64::new(1.0, 0.0));
            let far = l / z[j] * ((one - z[j] / l).ln() - (one + z[j] / l).ln());
            of[0][0] += far * 0.5;
            of[0][1] -= far * 0.5;
        }
        let unknown: Vec<usize> = (0..n).filter(|&j| known[j] != Known::Both).collect();
        let matrix = Mat::from_fn(unknown.len(), unknown.len(), |row, column| {
            let (j, k) = (unknown[row], unknown[column]);
            let [phi, psi] = by_part(of[j * n + k]);
            match (j, k) {
                (0, 0 | 1) => [1.0, -1.0][k] * z[k].re, // ψ falls like 1/x
                (0, _) => 0.0,
                _ => equation(known[j], if known[k] == Known::Potential { psi } else { phi }),
            }
        });
        Contour { known, unknown, of, lu: matrix.partial_piv_lu() }
    }

    /// Find what is not known of β: φ is read where it is known, ψ where it is, the rest is written.
    pub fn solve(&self, beta: &mut Complex) {
        let n = self.known.len();
        let right = Mat::from_fn(self.unknown.len(), 1, |row, _| match self.unknown[row] {
            0 => 0.0,
            j => {
                let sum: c64 = (0..n)
                    .map(|k| {
                        let [phi, psi] = by_part(self.of[j * n + k]);
                        let of_phi = if self.known[k] == Known::StreamFunction { 0.0 } else { beta.phi[k] };
                        let of_psi = if self.known[k] == Known::Potential { 0.0 } else { beta.psi[k] };
                        phi * of_phi + psi * of_psi
                    })
                    .sum();
                -equation(self.known[j], sum)
            }
        });
        let solution = self.lu.solve(&right);
        for (row, &j) in self.unknown.iter().enumerate() {
            match self.known[j] {
                Known::Potential => beta.psi[j] = solution[(row, 0)],
                _ => beta.phi[j] = solution[(row, 0)],
            }
        }
    }
}

/// Factors of φ and ψ of those of β and its image's conjugate.
fn by_part([own, image]: [c64; 2]) -> [c64; 2] {
    [own + image, (own - image) * c64::new(0.0, 1.0)]
}

/// The part of the equation of a node whose diagonal is large (Vinje & Brevig 1981).
pub(super) fn equation(known: Known, sum: c64) -> f64 {
    if known == Known::Potential { sum.re } else { sum.im }
}
