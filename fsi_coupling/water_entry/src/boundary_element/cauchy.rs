//! Cauchy's integral on quadratic elements (THEORY EN21): one factorised matrix for the potential and for its time derivative.

use std::f64::consts::TAU;
use std::ops::Range;

use faer::c64;

use super::buffer::Buffer;
use super::factorised::Factorised;
use super::influence::{Influence, Row};

/// Potential φ and stream function ψ at the nodes [m²/s], or their time derivatives.
#[derive(Clone, Debug)]
pub(super) struct Complex {
    pub phi: Vec<f64>,
    pub psi: Vec<f64>,
}

/// The equations of the nodes of a contour, by rows: of each that part whose diagonal is large (Vinje & Brevig 1981), the imaginary one on the body.
/// There ψ is known and φ not; on the surfaces the other way round. Where they meet both are known, and the equation of ψ is what it is.
pub(super) struct Equations {
    /// Factors of what is known of the nodes.
    known: Buffer,
    /// Factors of the unknowns: one of each node, and `more` after these.
    unknown: Buffer,
    nodes: usize,
    more: usize,
    /// Nodes on the body, without those where the surfaces meet it.
    body: Range<usize>,
}

impl Equations {
    /// With zeros, for a number of nodes of which `body` are on the body, and `more` unknowns.
    pub fn zeros(nodes: usize, body: Range<usize>, more: usize) -> Equations {
        let size = nodes + more;
        Equations { known: Buffer::zeros(nodes * nodes), unknown: Buffer::zeros(size * size), nodes, more, body }
    }

    /// Cauchy's integral at the node `j`, which is outside the contour that is integrated: −iα β_j, α the `angle` of the water there [rad].
    pub fn write(&mut self, j: usize, influence: &mut Influence, z: &[c64], angle: f64) -> Row<'_> {
        let (is_imaginary, body, start) = (self.body.contains(&j), self.body.clone(), j * (self.nodes + self.more));
        let known = &mut self.known[j * self.nodes..][..self.nodes];
        let mut row = Row { known, unknown: &mut self.unknown[start..][..self.nodes], body, is_imaginary };
        influence.write(z[j], &mut row);
        row.add(j, c64::new(0.0, -(if angle > 0.0 { angle } else { angle + TAU })));
        row
    }

    /// Factors of the unknowns in the equation `j`.
    pub fn unknown(&mut self, j: usize) -> &mut [f64] {
        let size = self.nodes + self.more;
        &mut self.unknown[j * size..][..size]
    }

    /// Sum of the factors of ψ on the body in the equation of node `j`.
    pub fn of_psi_on_body(&self, j: usize) -> f64 {
        self.known[j * self.nodes..][self.body.clone()].iter().sum()
    }

    /// Factorised.
    pub fn factorised(self) -> System {
        let Equations { known, unknown, nodes, more, body } = self;
        System { known, matrix: Factorised::new(unknown, nodes + more), body }
    }
}

/// The same, factorised.
pub(super) struct System {
    known: Buffer,
    matrix: Factorised,
    body: Range<usize>,
}

impl System {
    /// Find what is not known of β: φ is read on the surfaces, ψ on the body, both where they meet; the rest is written. `right` gives the right side of
    /// an equation with the function that takes what is known into the equation of a node. Returns the further unknowns.
    pub fn solve(
        &self,
        beta: &mut Complex,
        right: impl Fn(usize, &dyn Fn(usize) -> f64) -> f64,
        more: usize,
    ) -> Vec<f64> {
        let n = beta.phi.len();
        let mut known = beta.phi.clone();
        known[self.body.clone()].copy_from_slice(&beta.psi[self.body.clone()]);
        let of_known = |j: usize| -dot(&self.known[j * n..][..n], &known);
        let mut solution: Vec<f64> = (0..n + more).map(|j| right(j, &of_known)).collect();
        self.matrix.solve(&mut solution);
        let further = solution.split_off(n);
        beta.phi[self.body.clone()].copy_from_slice(&solution[self.body.clone()]);
        solution[self.body.clone()].copy_from_slice(&known[self.body.clone()]);
        beta.psi = solution;
        further
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
    /// The node where surface and body meet.
    contact: usize,
    system: System,
}

fn mirrored(z: c64) -> c64 {
    c64::new(-z.re, z.im)
}

impl Contour {
    /// Of the nodes `z` from the far free surface to the `contact` with the body and on to the keel on x = 0, water on the left.
    pub fn new(z: &[c64], contact: usize, corners: Option<&[usize]>) -> Contour {
        let n = z.len();
        let mut influence = Influence::symmetric(z, corners);
        let mut equations = Equations::zeros(n, contact + 1..n, 0);
        for j in (1..n).filter(|j| *j != contact) {
            let next = if j + 1 == n { mirrored(z[j - 1]) } else { z[j + 1] } - z[j];
            let mut row = equations.write(j, &mut influence, z, ((z[j - 1] - z[j]) / next).arg());
            // beyond the first node, at x = l, β = iψ₁ l/x on both sides
            let (l, one) = (z[0].re, c64::new(1.0, 0.0));
            row.add_stream(0, l / z[j] * ((one - z[j] / l).ln() - (one + z[j] / l).ln()));
        }
        equations.unknown(0)[..2].copy_from_slice(&[1.0, -z[1].re / z[0].re]); // ψ falls like 1/x
        equations.unknown(contact)[contact] = 1.0;
        Contour { contact, system: equations.factorised() }
    }

    /// Find what is not known of β, as [`System::solve`].
    pub fn solve(&self, beta: &mut Complex) {
        let at_contact = beta.psi[self.contact];
        let right = |j: usize, of_known: &dyn Fn(usize) -> f64| match j {
            0 => 0.0,
            _ if j == self.contact => at_contact,
            _ => of_known(j),
        };
        self.system.solve(beta, right, 0);
    }
}
