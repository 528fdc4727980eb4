//! Bodies in the preconditioner (THEORY LS10).

use crate::projection::linear_solver::matrix::RankOne;

/// With more of them than this the preconditioner leaves them out.
const MOST: usize = 8;

/// LS10: B g_k for each body's g_k, and the Cholesky factor of the small matrix between them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bodies {
    images: Vec<Vec<f64>>,
    count: usize,
    factor: [[f64; MOST]; MOST],
    /// S⁻¹ gᵀ z of the last correction.
    share: [f64; MOST],
}

impl Bodies {
    /// For `ranks` and a preconditioner that `apply`s itself to a right side; `active` rows only. `right` is scratch.
    pub fn set_up(
        &mut self,
        ranks: &[RankOne],
        active: impl Fn(usize) -> bool,
        right: &mut [f64],
        mut apply: impl FnMut(&mut [f64], &mut [f64]),
    ) {
        self.count = 0;
        if ranks.is_empty() || ranks.len() > MOST || ranks.iter().any(|r| r.weight <= 0.0) {
            return;
        }
        right.fill(0.0);
        self.images.resize(ranks.len().max(self.images.len()), Vec::new());
        for (rank, image) in ranks.iter().zip(&mut self.images) {
            image.resize(right.len(), 0.0);
            for &(i, g) in rank.entries.iter().filter(|e| active(e.0 as usize)) {
                right[i as usize] = g;
            }
            apply(right, image);
            rank.entries.iter().for_each(|&(i, _)| right[i as usize] = 0.0);
        }
        // S = C⁻¹ + gᵀ B g = L Lᵀ; images vanish where rows are not active
        for k in 0..ranks.len() {
            for l in 0..=k {
                let own = if k == l { 1.0 / ranks[k].weight } else { 0.0 };
                let mut s = own + ranks[k].dot(&self.images[l]);
                for m in 0..l {
                    s -= self.factor[k][m] * self.factor[l][m];
                }
                self.factor[k][l] = if k == l { s.sqrt() } else { s / self.factor[l][l] };
            }
            if self.factor[k][k].is_nan() || self.factor[k][k] == 0.0 {
                return;
            }
        }
        self.count = ranks.len();
    }

    /// LS10 for z = B r: notes what bodies take off it, and returns what they take off r·z.
    pub fn correct(&mut self, ranks: &[RankOne], z: &[f64]) -> f64 {
        let (count, factor) = (self.count, &self.factor);
        let (mut t, mut u) = ([0.0; MOST], [0.0; MOST]);
        for k in 0..count {
            t[k] = ranks[k].dot(z);
            u[k] = (t[k] - (0..k).map(|m| factor[k][m] * u[m]).sum::<f64>()) / factor[k][k];
        }
        for k in (0..count).rev() {
            u[k] = (u[k] - (k + 1..count).map(|m| factor[m][k] * u[m]).sum::<f64>()) / factor[k][k];
        }
        self.share = u;
        (0..count).map(|k| t[k] * u[k]).sum()
    }

    /// What bodies take off z_i.
    #[inline(always)]
    pub fn taken(&self, i: usize) -> f64 {
        self.images[..self.count].iter().zip(&self.share).map(|(image, u)| u * image[i]).sum()
    }
}
