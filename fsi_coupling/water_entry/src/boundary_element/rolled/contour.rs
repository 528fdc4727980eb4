//! Cauchy's integral on the whole contour (THEORY EN34): the stream function on the body is known but for a constant.

use faer::c64;

use super::super::cauchy::{Complex, Equations, System};
use super::super::influence::Influence;

/// The whole contour, factorised. The constant is the last unknown; its equation is the sum of those of the contacts.
pub(super) struct WholeContour {
    /// The nodes where surface and body meet.
    contacts: [usize; 2],
    system: System,
}

impl WholeContour {
    /// Of the nodes `z` from the far free surface on the right to that on the left, water on the left.
    pub fn new(z: &[c64], contacts: [usize; 2], corners: Option<&[usize]>) -> WholeContour {
        let n = z.len();
        let mut influence = Influence::whole(z, corners);
        let mut equations = Equations::zeros(n, contacts[0] + 1..contacts[1], 1);
        let (one, right, left) = (c64::new(1.0, 0.0), z[0].re, -z[n - 1].re);
        for j in 1..n - 1 {
            let angle = ((z[j - 1] - z[j]) / (z[j + 1] - z[j])).arg();
            let mut row = equations.write(j, &mut influence, z, angle);
            // beyond the first node, at x = l, and the last, at x = −l, β = iψ l/|x|
            row.add_stream(0, right / z[j] * (one - z[j] / right).ln());
            row.add_stream(n - 1, left / z[j] * (one + z[j] / left).ln());
            equations.unknown(j)[n] = equations.of_psi_on_body(j);
        }
        for (end, next) in [(0, 1), (n - 1, n - 2)] {
            // ψ falls like 1/x
            let row = equations.unknown(end);
            (row[end], row[next]) = (1.0, -z[next].re / z[end].re);
        }
        for contact in contacts {
            let own = equations.unknown(contact).to_vec();
            equations.unknown(n).iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
            let row = equations.unknown(contact);
            row.fill(0.0);
            (row[contact], row[n]) = (1.0, -1.0);
        }
        WholeContour { contacts, system: equations.factorised() }
    }

    /// Find what is not known of β: φ is read where it is known, ψ where it is but for a constant, the rest is written.
    pub fn solve(&self, beta: &mut Complex) {
        let n = beta.phi.len();
        let at_contacts = self.contacts.map(|contact| beta.psi[contact]);
        let right = |j: usize, of_known: &dyn Fn(usize) -> f64| match j {
            _ if j == 0 || j == n - 1 => 0.0,
            _ if j == n => self.contacts.into_iter().map(of_known).sum(),
            _ if j == self.contacts[0] => at_contacts[0],
            _ if j == self.contacts[1] => at_contacts[1],
            _ => of_known(j),
        };
        let constant = self.system.solve(beta, right, 1)[0];
        beta.psi[self.contacts[0] + 1..self.contacts[1]].iter_mut().for_each(|psi| *psi += constant);
    }
}
