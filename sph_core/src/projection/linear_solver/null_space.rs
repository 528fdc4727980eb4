//! Pressures that no equation fixes: water that no free surface, no pin and no body gives a level (THEORY LS5).

use serde::{Deserialize, Serialize};

use crate::projection::linear_solver::aggregates::NO_ROW;
use crate::projection::linear_solver::matrix::{MatrixRows, RankOne};

/// Shares of a body's g below this, against its length, do not fix a level [-].
const NO_SHARE: f64 = 1e-8;

/// Connected parts of the matrix, and which of them no row gives a level.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Components {
    /// The part that each row of the flooded matrix belongs to.
    node: Vec<u32>,
    /// The part that each row belongs to; empty when nothing floats.
    of: Vec<u32>,
    /// For each part: no row of it has an excess.
    floating: Vec<bool>,
    pending: Vec<u32>,
}

impl Components {
    /// Flood a matrix, of the rows themselves or of aggregates that are connected within.
    pub fn find(&mut self, a: &impl MatrixRows, aggregates: Option<&[u32]>) {
        let Components { node: of, floating, pending, .. } = self;
        of.clear();
        of.resize(a.rows(), NO_ROW);
        floating.clear();
        for seed in 0..a.rows() {
            if of[seed] != NO_ROW {
                continue;
            }
            let name = floating.len() as u32;
            floating.push(aggregates.is_some() || a.diagonal()[seed] > 0.0); // a pocket may be one aggregate, without diagonal
            of[seed] = name;
            pending.push(seed as u32);
            while let Some(i) = pending.pop() {
                let i = i as usize;
                if a.has_excess(i) {
                    floating[name as usize] = false;
                }
                for (j, value) in a.row(i) {
                    if value != 0.0 && of[j] == NO_ROW {
                        of[j] = name;
                        pending.push(j as u32);
                    }
                }
            }
        }
        self.of.clear();
        if !self.floating.contains(&true) {
            return;
        }
        match aggregates {
            None => self.of.extend_from_slice(&self.node),
            Some(aggregates) => {
                self.floating.push(false); // the last part: no couplings, fixed by the diagonal, or empty
                self.spread(aggregates);
            }
        }
    }

    /// The parts of rows are those of the aggregates that they belong to.
    pub fn spread(&mut self, aggregates: &[u32]) {
        if !self.floating.contains(&true) {
            return;
        }
        let alone = self.floating.len() as u32 - 1;
        self.of.clear();
        self.of.extend(aggregates.iter().map(|&c| self.node.get(c as usize).copied().unwrap_or(alone)));
    }
}

impl Components {
    /// Whether something that floated has, in this matrix, an excess or a coupling to another part: then it no longer
    /// does.
    pub fn changed(&self, a: &impl MatrixRows) -> bool {
        let floats = |i: usize| self.floating[self.of[i] as usize];
        let differs = |i: usize| a.has_excess(i) || a.row(i).any(|(j, v)| v != 0.0 && self.of[j] != self.of[i]);
        (0..self.of.len()).any(|i| floats(i) && differs(i))
    }
}

/// LS5: the pressures t that the equation does not feel, A t = 0 and g·t = 0 for every body; constant in each floating
/// part.
#[derive(Clone, Debug, Default)]
pub(crate) struct NullSpace {
    /// Row → floating part, or `u32::MAX`; empty when nothing floats.
    part: Vec<u32>,
    /// √(rows) of each floating part.
    root: Vec<f64>,
    /// Orthonormal combinations of the parts' unit constants that bodies do feel.
    felt: Vec<Vec<f64>>,
    sums: Vec<f64>,
    renamed: Vec<u32>,
}

impl NullSpace {
    /// What floats, with these rows pinned and these bodies free.
    pub fn find(&mut self, components: &Components, constrained: &[bool], ranks: &[RankOne]) {
        let Components { of, floating, .. } = components;
        self.part.clear();
        self.root.clear();
        self.felt.clear();
        if !floating.contains(&true) {
            return;
        }
        let mut rows = vec![0_u32; floating.len()];
        for (i, &c) in of.iter().enumerate() {
            rows[c as usize] += 1;
            if constrained[i] {
                rows[c as usize] = u32::MAX / 2; // pinned somewhere: it has a level
            }
        }
        self.renamed.clear();
        for (c, &count) in rows.iter().enumerate() {
            let floats = floating[c] && count < u32::MAX / 2;
            self.renamed.push(if floats { self.root.len() as u32 } else { u32::MAX });
            if floats {
                self.root.push(f64::from(count).sqrt());
            }
        }
        if self.root.is_empty() {
            return;
        }
        self.part.extend(of.iter().map(|&c| self.renamed[c as usize]));
        for rank in ranks.iter().filter(|r| r.weight > 0.0) {
            self.feel(rank);
        }
    }

    /// Gram–Schmidt: a body's g, restricted to constants of parts, less what earlier bodies feel.
    fn feel(&mut self, rank: &RankOne) {
        let mut share = vec![0.0; self.root.len()];
        let mut length = 0.0;
        for &(i, g) in &rank.entries {
            length += g * g;
            if let Some(s) = share.get_mut(self.part[i as usize] as usize) {
                *s += g;
            }
        }
        share.iter_mut().zip(&self.root).for_each(|(s, root)| *s /= root);
        for _ in 0..2 {
            for q in &self.felt {
                let along: f64 = q.iter().zip(&share).map(|(q, s)| q * s).sum();
                share.iter_mut().zip(q).for_each(|(s, q)| *s -= along * q);
            }
        }
        let norm = share.iter().map(|s| s * s).sum::<f64>().sqrt();
        if norm > NO_SHARE * length.sqrt() {
            self.felt.push(share.iter().map(|s| s / norm).collect());
        }
    }

    /// Whether there is anything to take out.
    pub fn is_felt(&self) -> bool {
        !self.part.is_empty()
    }

    /// Take the null space's part out of `v`.
    pub fn remove(&mut self, v: &mut [f64]) {
        if self.part.is_empty() {
            return;
        }
        let NullSpace { part, root, felt, sums, .. } = self;
        sums.clear();
        sums.resize(root.len(), 0.0);
        for (value, &p) in v.iter().zip(&*part) {
            if let Some(sum) = sums.get_mut(p as usize) {
                *sum += value;
            }
        }
        sums.iter_mut().zip(&*root).for_each(|(s, root)| *s /= root);
        for q in &*felt {
            let along: f64 = q.iter().zip(&*sums).map(|(q, s)| q * s).sum();
            sums.iter_mut().zip(q).for_each(|(s, q)| *s -= along * q);
        }
        sums.iter_mut().zip(&*root).for_each(|(s, root)| *s /= root);
        for (value, &p) in v.iter_mut().zip(&*part) {
            if let Some(mean) = sums.get(p as usize) {
                *value -= mean;
            }
        }
    }
}
