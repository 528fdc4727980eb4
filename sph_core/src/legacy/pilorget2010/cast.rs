//! All particles of a step (fluid, limit particles, dummies, those mirrored at the surface, images of a plane of symmetry) and
//! who meets whom: for each row its pairs, with the kernel and its gradient, so that nothing else asks for the kernel.

use crate::interactions::geometry::pair_geometry;
use crate::kernel::{Kernel, Shape, WithKernel};
use crate::neighbours::cells::{Cells, Point};
use crate::neighbours::lists::Lists;
use crate::parallel::{self, CHUNK};
use crate::planes::Mirror;

/// One of the cast.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Player {
    pub x: f64,
    pub y: f64,
    pub h: f64,
    pub mass: f64,
    /// Its pressure is `sign` times that of this row.
    pub row: u32,
    pub sign: f64,
    /// False for those that complete kernels of pressures only, not of densities: the mirrored ones (LE25).
    pub counts: bool,
}

/// A player and the surface that mirrors it (LE25): the plane through player `surface`, normal `n`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reflection {
    pub player: u32,
    pub surface: u32,
    pub n: [f64; 2],
}

/// The cast in this order: rows (system, then limit particles), dummies, their images, mirrored ones with theirs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cast {
    pub players: Vec<Player>,
    /// Players that have a row of their own.
    pub rows: usize,
    /// Players before images and mirrored ones.
    pub own: usize,
}

impl Cast {
    /// LE25: add the mirrored ones.
    pub fn reflect(&mut self, reflections: &[Reflection]) {
        for r in reflections {
            let (p, s) = (self.players[r.player as usize], self.players[r.surface as usize]);
            let height = (s.x - p.x) * r.n[0] + (s.y - p.y) * r.n[1];
            let (x, y) = (p.x + 2.0 * height * r.n[0], p.y + 2.0 * height * r.n[1]);
            self.players.push(Player { x, y, sign: -p.sign, counts: false, ..p });
        }
    }

    /// Add the images of those who can be felt across the plane of symmetry.
    pub fn repeat(&mut self, from: usize, mirror: Option<Mirror>) {
        let Some(mirror) = mirror else { return };
        for k in from..self.players.len() {
            let p = self.players[k];
            if p.x - mirror.at < 2.5 * p.h {
                self.players.push(Player { x: mirror.reflect(p.x), ..p });
            }
        }
    }
}

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
        let points = points(&cast.players);
        self.lists.build(cast.rows, &Cells::build(&points), |k| points[k], true, |_, _| false);
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

/// Where players are, and how far they reach.
pub(crate) fn points(players: &[Player]) -> Vec<Point> {
    let point = |(k, p): (usize, &Player)| Point::at_rest([p.x, p.y], p.h, k as u32);
    players.iter().enumerate().map(point).collect()
}
