//! The matrix of the pressure equation by clusters of rows, as the sums over pairs leave it (THEORY PR6, LS2).

use crate::neighbours::Neighbours;
use crate::parallel::{self, CHUNK};
use crate::projection::linear_solver::matrix::MatrixRows;
use crate::projection::operators::Operators;
use crate::projection::pair_clusters::{ChunkPairs, Links};
use crate::simd::{self, LANES, SimdReal, Task};

/// Sums that a product is added up in, in turn, so that no addition waits for the one before it.
const TURNS: usize = 4;

/// What of the matrix is not in the operators; kept for its memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct ClusterRows {
    diagonal: Vec<f64>,
    /// The pairs with sources instead of images, where there are images.
    renamed: Vec<ChunkPairs>,
}

/// LS2: the rows of a cluster side by side: an entry is read once for all of them.
#[derive(Clone, Copy)]
pub(crate) struct ClusterMatrix<'a> {
    chunks: &'a [ChunkPairs],
    diagonal: &'a [f64],
    simd: bool,
}

impl ClusterRows {
    /// PR6: the links of the operators, each row with its excess on the diagonal. An image stands for its source, and a row's own
    /// images are left out.
    pub fn assemble<'a>(
        &'a mut self,
        operators: &'a Operators,
        excess: &[f64],
        search: &Neighbours,
        simd: bool,
    ) -> ClusterMatrix<'a> {
        let ClusterRows { diagonal, renamed } = self;
        let (n, mut chunks) = (excess.len(), operators.chunks());
        if !search.fluid_images.is_empty() {
            renamed.resize(chunks.len(), ChunkPairs::default());
            parallel::for_each_chunk(renamed, n, |rows, out| {
                out.renamed(&chunks[rows.start / CHUNK], rows.start, |j| search.source(j, n) as u32);
            });
            chunks = renamed;
        }
        diagonal.resize(n, 0.0);
        parallel::update_pieces(diagonal, CHUNK, |c, diagonal| {
            for (cluster, diagonal) in diagonal.chunks_mut(LANES).enumerate() {
                let mut sum = [0.0; LANES];
                for links in chunks[c].cluster(cluster).1 {
                    (0..LANES).for_each(|lane| sum[lane] += f64::from(links[lane]));
                }
                let first = c * CHUNK + cluster * LANES;
                diagonal.iter_mut().zip(sum).enumerate().for_each(|(k, (d, sum))| *d = excess[first + k] + sum);
            }
        });
        ClusterMatrix { chunks, diagonal, simd }
    }
}

impl MatrixRows for ClusterMatrix<'_> {
    fn diagonal(&self) -> &[f64] {
        self.diagonal
    }

    #[inline(always)]
    fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.chunks[i / CHUNK].row(i % CHUNK).map(|(j, link)| (j as usize, -link))
    }

    fn times(&self, i: usize, x: &[f64]) -> f64 {
        self.diagonal[i] * x[i] + self.row(i).map(|(j, v)| v * x[j]).sum::<f64>()
    }

    fn multiply(&self, x: &[f64], active: impl Fn(usize) -> bool + Sync, y: &mut [f64], sums: &mut [f64]) -> f64 {
        parallel::update_chunks(sums, y, |rows, out| {
            let pairs = &self.chunks[rows.start / CHUNK];
            let (diagonal, own) = (&self.diagonal[rows.clone()], &x[rows.clone()]);
            simd::run(self.simd, Product { pairs, x, out: &mut *out });
            let mut sum = 0.0;
            for (k, y) in out.iter_mut().enumerate() {
                *y = if active(rows.start + k) { diagonal[k] * own[k] - *y } else { 0.0 };
                sum += own[k] * *y;
            }
            sum
        });
        sums.iter().sum()
    }
}

/// Σ_j of links and x of the rows of a chunk.
struct Product<'a> {
    pairs: &'a ChunkPairs,
    x: &'a [f64],
    out: &'a mut [f64],
}

impl Task for Product<'_> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let Product { pairs, x, out } = self;
        for (c, out) in out.chunks_mut(LANES).enumerate() {
            let (near, links) = pairs.cluster(c);
            for lane in (0..LANES).step_by(R::WIDTH) {
                let of =
                    |links: &Links, j: u32, sum: R| zero.widened(&links[lane..]).mul_add(zero.of(x[j as usize]), sum);
                let mut sum = [zero; TURNS];
                let (near, last) = near.as_chunks::<TURNS>();
                let (links, last_links) = links.as_chunks::<TURNS>();
                for (near, links) in near.iter().zip(links) {
                    (0..TURNS).for_each(|k| sum[k] = of(&links[k], near[k], sum[k]));
                }
                for (k, (&j, links)) in last.iter().zip(last_links).enumerate() {
                    sum[k] = of(links, j, sum[k]);
                }
                let total = ((sum[0] + sum[1]) + (sum[2] + sum[3])).lanes();
                out.iter_mut().skip(lane).zip(&total[..R::WIDTH]).for_each(|(out, total)| *out = *total);
            }
        }
    }
}
