//! Who meets whom: for each row its pairs, with the kernel and its gradient, so that nothing else asks for the kernel.

use crate::interactions::geometry::pair_geometry;
use crate::interactions::kernel::{Kernel, Shape, WithKernel};
use crate::neighbours::cells::{Cells, Point};
use crate::neighbours::lists::Lists;
use crate::parallel::{self, CHUNK};

use crate::legacy::pilorget2010::cast::{Cast, Player};

/// A neighbour of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    /// Who.
    pub j: u32,
    /// r_ij [m].
    pub r: [f64; 2],
    /// W_ij [1/m²].
    pub w: f64,
    /// ∇W_ij = grad_factor r_ij [1/m⁴]; negative.
    pub grad_factor: f64,
    /// r_ij·∇W_ij/(r² + 0.01h²) [1/m⁴]; negative.
    pub link: f64,
}

/// Pairs of every row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pairs {
    lists: Lists,
    chunks: Vec<Chunk>,
    /// W_ii [1/m²].
    pub own: Vec<f64>,
}

#[derive(Clone, Debug, Default)]
struct Chunk {
    ends: Vec<u32>,
    pairs: Vec<Pair>,
    own: Vec<f64>,
}

struct Task<'a> {
    players: &'a [Player],
    lists: &'a Lists,
    rows: usize,
    chunks: &'a mut [Chunk],
}

impl WithKernel for Task<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Task { players, lists, rows, chunks } = self;
        parallel::for_each_chunk(chunks, rows, |targets, chunk| {
            chunk.ends.clear();
            chunk.pairs.clear();
            chunk.own.clear();
            for i in targets {
                let a = &players[i];
                for j in lists.of(i) {
                    let b = &players[j as usize];
                    let Some(ab) = pair_geometry::<K>(a.x, a.y, a.h, b.x, b.y, b.h) else { continue };
                    let link = ab.grad_factor * ab.r2 / (ab.r2 + 0.01 * ab.size.h * ab.size.h);
                    chunk.pairs.push(Pair { j, r: [ab.dx, ab.dy], w: ab.w::<K>(), grad_factor: ab.grad_factor, link });
                }
                chunk.ends.push(chunk.pairs.len() as u32);
                chunk.own.push(K::ALPHA * K::w(0.0) / (a.h * a.h));
            }
        });
    }
}

impl Pairs {
    /// Find the pairs of all rows of the cast.
    pub fn find(&mut self, cast: &Cast, kernel: Kernel) {
        let point = |(k, p): (usize, &Player)| Point { x: p.x, y: p.y, reach: p.h, index: k as u32 };
        let points: Vec<Point> = cast.players.iter().enumerate().map(point).collect();
        let size = (|k: usize| points[k].reach, |j: u32| points[j as usize].reach);
        self.lists.build(cast.rows, &Cells::build(&points), |k| points[k], true, size);
        self.chunks.resize(cast.rows.div_ceil(CHUNK), Chunk::default());
        let (players, rows, lists, chunks) = (&cast.players[..], cast.rows, &self.lists, &mut self.chunks[..]);
        kernel.run(Task { players, lists, rows, chunks });
        self.own.clear();
        self.own.extend(self.chunks.iter().flat_map(|chunk| &chunk.own));
    }

    /// Pairs of row `i`.
    pub fn of(&self, i: usize) -> &[Pair] {
        let chunk = &self.chunks[i / CHUNK];
        let k = i % CHUNK;
        let from = if k == 0 { 0 } else { chunk.ends[k - 1] as usize };
        &chunk.pairs[from..chunk.ends[k] as usize]
    }
}
