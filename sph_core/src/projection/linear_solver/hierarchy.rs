//! The preconditioner, and how long one serves (THEORY LS9).

use serde::{Deserialize, Serialize};

use crate::parallel::{self, CHUNK};
use crate::projection::linear_solver::matrix::MatrixRows;
use crate::projection::linear_solver::multigrid::Multigrid;
use crate::projection::linear_solver::null_space::Components;

/// What approximates A⁻¹ in each iteration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Preconditioner {
    /// The diagonal alone.
    Diagonal,
    /// The diagonal, and coarser systems over aggregates of rows (LS6–LS8).
    #[default]
    Aggregates,
}

#[cfg(test)]
impl Preconditioner {
    /// Every preconditioner.
    pub const ALL: [Preconditioner; 2] = [Preconditioner::Diagonal, Preconditioner::Aggregates];
}

/// A row that has gone so far, in smoothing lengths, has other neighbours.
const FAR: f64 = 0.6;
/// A hierarchy serves while no larger share of its rows has gone far [-].
const FEW_MOVED: f64 = 0.2;

/// A preconditioner and the connected parts of the matrix, made for one matrix and kept for those that are like it.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Hierarchy {
    kind: Preconditioner,
    multigrid: Multigrid,
    pub components: Components,
    /// How often one was made.
    pub set_ups: u64,
    /// Where rows were when it was made [m]; rows of another matrix are elsewhere.
    made_at: Vec<[f64; 2]>,
    #[serde(skip)]
    now_at: Vec<[f64; 2]>,
    #[serde(skip)]
    moved: Vec<u32>,
    /// Identities of the rows of the hierarchy, and where each stands; empty where they are not known.
    id: Vec<u32>,
    place: Vec<u32>,
    /// Made for an earlier matrix.
    old: bool,
    /// Most iterations of the solves with the matrix that it was made for.
    fresh: usize,
    worn_out: bool,
}

impl Hierarchy {
    #[cfg(test)]
    pub fn with(kind: Preconditioner) -> Hierarchy {
        Hierarchy { kind, ..Hierarchy::default() }
    }

    /// What a stored hierarchy is without.
    pub fn complete(&mut self) {
        self.multigrid.factorise_coarsest();
    }

    /// Row k is that of `id[k]`, who may have stood elsewhere before: so has its aggregate.
    pub fn name(&mut self, id: &[u32]) {
        if self.id == id {
            return;
        }
        if self.id.len() != id.len() {
            self.made_at.clear(); // other rows: of no use
        } else if self.made_at.len() == id.len() {
            let Hierarchy { multigrid, components, made_at, place, .. } = self;
            let from = || id.iter().map(|&i| place[i as usize]);
            *made_at = from().map(|k| made_at[k as usize]).collect();
            if self.kind == Preconditioner::Aggregates {
                multigrid.rename(from());
                components.spread(multigrid.first().1);
            }
        }
        self.id.clear();
        self.id.extend_from_slice(id);
        self.place.resize(id.len(), 0);
        for (k, &i) in id.iter().enumerate() {
            self.place[i as usize] = k as u32;
        }
    }

    /// Keep what serves, else rebuild it.
    pub fn prepare(&mut self, a: &impl MatrixRows, x: &[f64], y: &[f64], h: &[f64]) {
        self.now_at.clear();
        self.now_at.extend(x.iter().zip(y).map(|(&x, &y)| [x, y]));
        self.old = self.serves(h) && !self.components.changed(a);
        if !self.old {
            self.renew(a);
        }
    }

    /// Have few rows gone far?
    fn serves(&mut self, h: &[f64]) -> bool {
        if self.kind == Preconditioner::Diagonal || self.worn_out || self.made_at.len() != h.len() {
            return false;
        }
        let Hierarchy { made_at, now_at, moved, .. } = self;
        moved.resize(h.len().div_ceil(CHUNK), 0);
        parallel::for_each_chunk(moved, h.len(), |rows, count| {
            let far = |k: &usize| {
                let ([x, y], [x0, y0], reach) = (now_at[*k], made_at[*k], FAR * h[*k]);
                (x - x0) * (x - x0) + (y - y0) * (y - y0) > reach * reach
            };
            *count = rows.filter(far).count() as u32;
        });
        f64::from(moved.iter().sum::<u32>()) <= FEW_MOVED * h.len() as f64
    }

    /// Made for an earlier matrix?
    pub fn is_old(&self) -> bool {
        self.old
    }

    /// Make it for this matrix.
    pub fn renew(&mut self, a: &impl MatrixRows) {
        match self.kind {
            Preconditioner::Diagonal => self.components.find(a, None),
            Preconditioner::Aggregates => {
                self.multigrid.set_up(a);
                let (coarse, aggregates) = self.multigrid.first();
                self.components.find(coarse, Some(aggregates));
            }
        }
        self.made_at.clone_from(&self.now_at);
        (self.old, self.fresh, self.worn_out) = (false, 0, false);
        self.set_ups += 1;
    }

    /// A hierarchy whose solves fail, or take twice as long as they did at first, is worn out.
    pub fn judge(&mut self, iterations: Option<usize>) {
        let Some(iterations) = iterations else {
            self.worn_out = true;
            return;
        };
        if self.old {
            self.worn_out |= iterations > self.fresh.saturating_mul(2).saturating_add(5);
        } else {
            self.fresh = self.fresh.max(iterations);
        }
    }

    /// z = B r, r·z returned; see [`Multigrid::apply`].
    pub fn apply(&mut self, inverse: &[f64], r: &[f64], z: &mut [f64], sums: &mut [f64]) -> f64 {
        match self.kind {
            Preconditioner::Aggregates => self.multigrid.apply(inverse, r, z, sums),
            Preconditioner::Diagonal => {
                parallel::update_chunks(sums, z, |rows, chunk| {
                    let mut sum = 0.0;
                    for (i, z) in rows.zip(chunk) {
                        *z = inverse[i] * r[i];
                        sum += *z * r[i];
                    }
                    sum
                });
                sums.iter().sum()
            }
        }
    }
}
