//! The shares of known changes that leave the least of a residual (THEORY CO22): least squares by Gram and Schmidt.

/// A change that has less than this of news is left out [-].
const NEWS: f64 = 1e-12;

/// Changes of a residual that may be taken in any share.
pub(crate) struct Subspace {
    residual: Vec<f64>,
    /// Orthonormal.
    basis: Vec<Vec<f64>>,
    /// Each change by the basis up to its own vector; empty of one without news.
    parts: Vec<Vec<f64>>,
    /// How much of each basis vector the residual asks for.
    asked: Vec<f64>,
}

impl Subspace {
    /// With nothing to change a residual.
    pub fn new(residual: Vec<f64>) -> Subspace {
        Subspace { residual, basis: Vec::new(), parts: Vec::new(), asked: Vec::new() }
    }

    /// The residual with the best shares so far.
    pub fn residual(&self) -> Vec<f64> {
        self.residual.clone()
    }

    /// One change more.
    pub fn add(&mut self, mut change: Vec<f64>) {
        let length = dot(&change, &change).sqrt();
        let mut parts = vec![0.0; self.basis.len()];
        for _ in 0..2 {
            for (q, part) in self.basis.iter().zip(&mut parts) {
                let along = dot(q, &change);
                *part += along;
                change.iter_mut().zip(q).for_each(|(c, q)| *c -= along * q);
            }
        }
        let news = dot(&change, &change).sqrt();
        if news <= NEWS * length || news.is_nan() {
            self.parts.push(Vec::new());
            return;
        }
        change.iter_mut().for_each(|c| *c /= news);
        parts.push(news);
        let asked = -dot(&change, &self.residual);
        self.residual.iter_mut().zip(&change).for_each(|(r, q)| *r += asked * q);
        self.basis.push(change);
        self.parts.push(parts);
        self.asked.push(asked);
    }

    /// The best share of each change, in the order in which they came.
    pub fn shares(&self) -> Vec<f64> {
        let mut asked = self.asked.clone();
        let mut shares = vec![0.0; self.parts.len()];
        for (share, parts) in shares.iter_mut().zip(&self.parts).rev() {
            let Some((own, earlier)) = parts.split_last() else { continue };
            *share = asked[earlier.len()] / own;
            asked.iter_mut().zip(earlier).for_each(|(a, part)| *a -= *share * part);
        }
        shares
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_changes_as_entries_leave_nothing_whatever_is_repeated() {
        let residual = vec![3.0, -1.0, 0.5];
        let changes = [vec![1.0, 2.0, 0.0], vec![2.0, 4.0, 0.0], vec![0.5, -1.0, 3.0], vec![1.0, 1e-3, 1.0]];
        let mut space = Subspace::new(residual.clone());
        changes.iter().for_each(|change| space.add(change.clone()));
        let shares = space.shares();
        assert_eq!(shares[1], 0.0, "it tells nothing new");
        for i in 0..3 {
            let left = residual[i] + shares.iter().zip(&changes).map(|(s, c)| s * c[i]).sum::<f64>();
            assert!(left.abs() < 1e-13 && space.residual()[i].abs() < 1e-13, "{left}");
        }
    }

    #[test]
    fn fewer_changes_leave_what_is_across_them() {
        let (residual, changes) = ([1.0, 2.0, 3.0], [[1.0, 0.0, 1.0], [0.0, 2.0, 1.0]]);
        let mut space = Subspace::new(residual.to_vec());
        changes.iter().for_each(|change| space.add(change.to_vec()));
        for change in &changes {
            assert!(dot(&space.residual(), change).abs() < 1e-14);
        }
        assert!(dot(&space.residual(), &space.residual()) > 1e-2);
    }
}
