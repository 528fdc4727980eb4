//! Cauchy's integral on the whole contour (THEORY EN34): the stream function on the body is known but for a constant.

use std::f64::consts::TAU;

use faer::c64;

use super::super::buffer::Buffer;
use super::super::cauchy::{Coefficients, Complex, Known};
use super::super::factorised::Factorised;
use super::super::influence::Influence;

/// The whole contour, factorised.
pub(super) struct WholeContour {
    known: Vec<Known>,
    /// Nodes that have an unknown.
    unknown: Vec<usize>,
    /// The nodes where surface and body meet.
    contacts: Vec<usize>,
    of: Coefficients,
    matrix: Factorised,
}

/// Coefficients in the equations of all nodes but the first and the last.
fn coefficients(z: &[c64], known: &[Known], corners: Option<&[usize]>) -> Coefficients {
    let n = z.len();
    let mut influence = Influence::whole(z, corners);
    let mut of = Coefficients::zeros(n);
    let (one, right, left) = (c64::new(1.0, 0.0), z[0].re, -z[n - 1].re);
    for j in 1..n - 1 {
        let mut row = of.row(j, known[j]);
        influence.write(z[j], &mut row);
        // the node itself is outside the contour that is integrated: −iα β_j, α the angle of the water there
        let angle = ((z[j - 1] - z[j]) / (z[j + 1] - z[j])).arg();
        row.add(j, c64::new(0.0, -(if angle > 0.0 { angle } else { angle + TAU })));
        // beyond the first node, at x = l, and the last, at x = −l, β = iψ l/|x|
        row.add_stream(0, right / z[j] * (one - z[j] / right).ln());
        row.add_stream(n - 1, left / z[j] * (one + z[j] / left).ln());
    }
    of
}

impl WholeContour {
    /// Of the nodes `z` from the far free surface on the right to that on the left, water on the left.
    pub fn new(z: &[c64], known: Vec<Known>, corners: Option<&[usize]>) -> WholeContour {
        let n = z.len();
        let of = coefficients(z, &known, corners);
        let unknown: Vec<usize> = (0..n).filter(|&j| known[j] != Known::Both).collect();
        let contacts: Vec<usize> = (0..n).filter(|&j| known[j] == Known::Both).collect();
        let size = unknown.len() + 1;
        let mut rows = Buffer::zeros(size * size);
        for (number, row) in rows.chunks_exact_mut(size).enumerate() {
            let nodes = if number + 1 == size { &contacts[..] } else { &unknown[number..=number] };
            for &j in nodes {
                if j == 0 || j == n - 1 {
                    // ψ falls like 1/x
                    let next = if j == 0 { number + 1 } else { number - 1 };
                    (row[number], row[next]) = (1.0, -z[unknown[next]].re / z[j].re);
                    continue;
                }
                row.iter_mut().zip(of.of_unknown(j, &unknown, &known)).for_each(|(entry, factor)| *entry += factor);
                let [_, psi] = of.of(j);
                row[size - 1] += psi[contacts[0]..=contacts[1]].iter().sum::<f64>();
            }
        }
        let matrix = Factorised::new(rows, size);
        WholeContour { known, unknown, contacts, of, matrix }
    }

    /// Find what is not known of β: φ is read where it is known, ψ where it is but for a constant, the rest is written.
    pub fn solve(&self, beta: &mut Complex) {
        beta.clear(&self.known);
        let last = self.known.len() - 1;
        let right_of = |j: usize| if j == 0 || j == last { 0.0 } else { -self.of.sum(j, beta) };
        let of_contacts = self.contacts.iter().map(|&j| right_of(j)).sum();
        let mut solution: Vec<f64> = self.unknown.iter().map(|&j| right_of(j)).chain([of_contacts]).collect();
        self.matrix.solve(&mut solution);
        beta.take(&self.known, &self.unknown, &solution);
        let constant = solution[self.unknown.len()];
        for (psi, known) in beta.psi.iter_mut().zip(&self.known) {
            if *known != Known::Potential {
                *psi += constant;
            }
        }
    }
}
