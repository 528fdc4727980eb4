//! Neighbour lists with a skin that suits each particle's speed.
//!
//! A list made at one moment holds every pair that can meet until some particle has moved farther than
//! the skin it was given: its share of the smoothing length plus its speed times the time the list
//! should live. Jets move several times as fast as the spray root, so one skin for all would be wasted
//! on still water (findings of the prototypes, item 10).

use crate::bytes::of_vector;
use crate::cells::{Cells, Point};
use crate::sweep::{self, CHUNK};

/// Neighbours of many targets, in rows; stored by chunk so that chunks are filled independently.
#[derive(Clone, Debug, Default)]
pub struct Lists {
    chunks: Vec<ChunkList>,
}

#[derive(Clone, Debug, Default)]
struct ChunkList {
    start: Vec<u32>,
    index: Vec<u32>,
}

impl Lists {
    /// For each of `n` targets, everyone in `cells` within reach, except the point with the target's own index.
    pub fn build(&mut self, n: usize, cells: &Cells, target: impl Fn(usize) -> Point + Sync) {
        self.chunks.resize(n.div_ceil(CHUNK), ChunkList::default());
        sweep::for_each_chunk(&mut self.chunks, n, |targets, list| {
            list.start.clear();
            list.index.clear();
            list.start.push(0);
            for k in targets {
                let p = target(k);
                cells.for_each_within(p.x, p.y, p.reach, |q| {
                    if q.index != p.index {
                        list.index.push(q.index);
                    }
                });
                list.start.push(list.index.len() as u32);
            }
        });
    }

    /// Of the list of each target k, keep those j that `keep(k, j)` wants.
    pub fn retain(&mut self, keep: impl Fn(usize, u32) -> bool + Sync) {
        let n = self.chunks.len() * CHUNK;
        sweep::for_each_chunk(&mut self.chunks, n, |targets, list| {
            let (mut from, mut kept) = (0, 0);
            for i in 0..list.start.len().saturating_sub(1) {
                let to = list.start[i + 1] as usize;
                for read in from..to {
                    let j = list.index[read];
                    if keep(targets.start + i, j) {
                        list.index[kept] = j;
                        kept += 1;
                    }
                }
                from = to;
                list.start[i + 1] = kept as u32;
            }
            list.index.truncate(kept);
        });
    }

    /// Neighbours of target `k`, in a fixed order.
    #[inline(always)]
    pub fn of(&self, k: usize) -> &[u32] {
        let list = &self.chunks[k / CHUNK];
        let k = k % CHUNK;
        &list.index[list.start[k] as usize..list.start[k + 1] as usize]
    }

    /// What the lists hold on to [bytes].
    pub(crate) fn bytes(&self) -> usize {
        of_vector(&self.chunks) + self.chunks.iter().map(|c| of_vector(&c.start) + of_vector(&c.index)).sum::<usize>()
    }

    /// Number of listed pairs.
    pub fn pairs(&self) -> usize {
        self.chunks.iter().map(|c| c.index.len()).sum()
    }
}

/// Where particles were when the lists were made, and how far each may go before they must be remade.
#[derive(Clone, Debug, Default)]
pub struct Skin {
    x: Vec<f64>,
    y: Vec<f64>,
    allowance: Vec<f64>,
}

impl Skin {
    /// Note positions and allowances [m].
    pub fn reset(&mut self, x: &[f64], y: &[f64], allowance: Vec<f64>) {
        self.x.clear();
        self.x.extend_from_slice(x);
        self.y.clear();
        self.y.extend_from_slice(y);
        self.allowance = allowance;
    }

    /// What it holds on to [bytes].
    pub(crate) fn bytes(&self) -> usize {
        [&self.x, &self.y, &self.allowance].map(of_vector).iter().sum()
    }

    /// True if nobody has moved farther than its allowance.
    pub fn holds(&self, x: &[f64], y: &[f64]) -> bool {
        self.x.len() == x.len()
            && sweep::least(x.len(), |k| {
                let (dx, dy) = (x[k] - self.x[k], y[k] - self.y[k]);
                self.allowance[k] * self.allowance[k] - (dx * dx + dy * dy)
            }) >= 0.0
    }
}
