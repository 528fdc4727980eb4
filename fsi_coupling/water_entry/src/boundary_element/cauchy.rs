//! Cauchy's integral on quadratic elements (THEORY EN21): one factorised matrix for the potential and for its time derivative.

use std::f64::consts::TAU;

use faer::c64;

use super::buffer::Buffer;
use super::factorised::Factorised;
use super::influence::{Influence, Row};

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

/// Coefficients of φ and ψ of the nodes in the equation of each node, by rows: that part of the equation whose diagonal is large
/// (Vinje & Brevig 1981), the imaginary one where ψ alone is known.
pub(super) struct Coefficients {
    phi: Buffer,
    psi: Buffer,
    nodes: usize,
}

impl Coefficients {
    /// Zeros for a number of nodes.
    pub fn zeros(nodes: usize) -> Coefficients {
        let all = nodes * nodes;
        Coefficients { phi: Buffer::zeros(all), psi: Buffer::zeros(all), nodes }
    }

    /// Of φ and of ψ in the equation of node `j`.
    pub fn of(&self, j: usize) -> [&[f64]; 2] {
        let start = j * self.nodes;
        [&self.phi[start..start + self.nodes], &self.psi[start..start + self.nodes]]
    }

    /// The equation of node `j`, of which `known` is known.
    pub fn row(&mut self, j: usize, known: Known) -> Row<'_> {
        let length = self.nodes;
        let row = j * length..(j + 1) * length;
        let is_imaginary = known == Known::StreamFunction;
        Row { phi: &mut self.phi[row.clone()], psi: &mut self.psi[row], is_imaginary }
    }

    /// Left side of the equation of node `j` with φ and ψ.
    pub fn sum(&self, j: usize, beta: &Complex) -> f64 {
        let [phi, psi] = self.of(j);
        dot(phi, &beta.phi) + dot(psi, &beta.psi)
    }

    /// Factors of what is unknown of the nodes `unknown` in the equation of node `j`.
    pub fn of_unknown<'a>(
        &'a self,
        j: usize,
        unknown: &'a [usize],
        known: &'a [Known],
    ) -> impl Iterator<Item = f64> + 'a {
        let [phi, psi] = self.of(j);
        unknown.iter().map(move |&k| if known[k] == Known::Potential { psi[k] } else { phi[k] })
    }
}

/// Σ a_k b_k.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    const LANES: usize = 8;
    let mut sums = [0.0; LANES];
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    for (a, b) in a.iter().zip(b) {
        (0..LANES).for_each(|k| sums[k] += a[k] * b[k]);
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

/// The right half of a symmetric contour, factorised.
pub(super) struct Contour {
    known: Vec<Known>,
    /// Nodes that have an unknown.
    unknown: Vec<usize>,
    of: Coefficients,
    matrix: Factorised,
}

fn mirrored(z: c64) -> c64 {
    c64::new(-z.re, z.im)
}

impl Contour {
    /// Of the nodes `z` from the far free surface to the keel on x = 0, water on the left.
    pub fn new(z: &[c64], known: Vec<Known>, corners: Option<&[usize]>) -> Contour {
        let n = z.len();
        let mut influence = Influence::symmetric(z, corners);
        let mut of = Coefficients::zeros(n);
        let unknown: Vec<usize> = (0..n).filter(|&j| known[j] != Known::Both).collect();
        for &j in &unknown[1..] {
            let mut row = of.row(j, known[j]);
            influence.write(z[j], &mut row);
            // the node itself is outside the contour that is integrated: −iα β_j, α the angle of the water there
            let next = if j + 1 == n { mirrored(z[j - 1]) } else { z[j + 1] } - z[j];
            let angle = ((z[j - 1] - z[j]) / next).arg();
            row.add(j, c64::new(0.0, -(if angle > 0.0 { angle } else { angle + TAU })));
            // beyond the first node, at x = l, β = iψ₁ l/x on both sides
            let (l, one) = (z[0].re, c64::new(1.0, 0.0));
            row.add_stream(0, l / z[j] * ((one - z[j] / l).ln() - (one + z[j] / l).ln()));
        }
        let first = of.row(0, Known::Potential);
        (first.psi[0], first.psi[1]) = (1.0, -z[1].re / z[0].re); // ψ falls like 1/x
        let size = unknown.len();
        let mut rows = Buffer::zeros(size * size);
        for (row, &j) in rows.chunks_exact_mut(size).zip(&unknown) {
            row.iter_mut().zip(of.of_unknown(j, &unknown, &known)).for_each(|(entry, factor)| *entry = factor);
        }
        let matrix = Factorised::new(rows, size);
        Contour { known, unknown, of, matrix }
    }

    /// Find what is not known of β: φ is read where it is known, ψ where it is, the rest is written.
    pub fn solve(&self, beta: &mut Complex) {
        beta.clear(&self.known);
        let right_of = |j: &usize| if *j == 0 { 0.0 } else { -self.of.sum(*j, beta) };
        let mut solution: Vec<f64> = self.unknown.iter().map(right_of).collect();
        self.matrix.solve(&mut solution);
        beta.take(&self.known, &self.unknown, &solution);
    }
}

impl Complex {
    /// Zeros where nothing is known.
    pub fn clear(&mut self, known: &[Known]) {
        for (k, known) in known.iter().enumerate() {
            match known {
                Known::Potential => self.psi[k] = 0.0,
                Known::StreamFunction => self.phi[k] = 0.0,
                Known::Both => (),
            }
        }
    }

    /// Write what was unknown of the nodes `unknown`.
    pub fn take(&mut self, known: &[Known], unknown: &[usize], solution: &[f64]) {
        for (&j, value) in unknown.iter().zip(solution) {
            let of = if known[j] == Known::Potential { &mut self.psi } else { &mut self.phi };
            of[j] = *value;
        }
    }
}
