//! Pairs of fluid particles whose geometry is held over an advective step (THEORY WC23): two sparse products per acoustic step.
//!
//! Targets are kept in blocks of [`BLOCK`] that follow one another. An entry is a neighbour of any of them, with a weight for each:
//! it is read once, and the weights of a block lie side by side. Weights are stored in single precision and summed in double;
//! those of a and b are the same number with opposite signs, so momentum is exact.

use std::marker::PhantomData;

use serde::{Deserialize, Serialize};

use crate::interactions::dissipation::{Dissipation, PairDissipation, WithPairs, with_pairs};
use crate::interactions::geometry::{MeanScale, PairConstants, PairGeometry, ScaleRule};
use crate::interactions::kernel::{Kernel, Shape};
use crate::interactions::packed_particle::PackedParticle;
use crate::interactions::simd::{self, SimdReal, Task};
use crate::memory::of_vector;
use crate::neighbours::lists::Lists;
use crate::parallel::{self, CHUNK};
use crate::wcsph::split_explicit::entry_index::EntryIndex;

/// Targets of a block.
const BLOCK: usize = 8;

/// A number for each target of a block.
#[repr(align(32))]
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct OfBlock([f32; BLOCK]);

/// What a neighbour shows: velocity [m/s] and pressure [Pa].
#[repr(align(32))]
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Row {
    pub u: f64,
    pub v: f64,
    pub p: f64,
}

/// Entries of the blocks of a chunk.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct HeldChunk {
    /// Where the entries of each block start; one more than blocks.
    start: Vec<u32>,
    neighbour: Vec<u32>,
    /// V_a V_b ∇_a W_ab [m].
    gradient: Vec<[OfBlock; 2]>,
    /// V_a V_b ℓ (r_ab·∇W_ab)/r² [m] (WC4, WC8).
    diffusion: Vec<OfBlock>,
}

/// The sums of a target that no acoustic step changes.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Own {
    /// Σ V_a V_b ∇_a W_ab [m].
    gradient: [f64; 2],
    /// Σ of the diffusion's weights [m].
    diffusion: f64,
    /// The same with ρ₀ g·r_ab [Pa m].
    weight: f64,
    /// 1/V_a [1/m²].
    per_volume: f64,
}

/// All pairs of fluid particles.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct HeldPairs {
    chunks: Vec<HeldChunk>,
    own: Vec<Own>,
}

impl HeldPairs {
    /// Take the geometry of the packed particles.
    pub fn hold(
        &mut self,
        (kernel, dissipation, simd): (Kernel, Dissipation, bool),
        fluid: &[PackedParticle],
        lists: &Lists,
        constants: PairConstants,
    ) {
        let n = lists.targets();
        self.chunks.resize(n.div_ceil(CHUNK), HeldChunk::default());
        self.own.resize(n, Own::default());
        let HeldPairs { chunks, own } = self;
        with_pairs(kernel, dissipation, Hold { fluid, lists, constants, simd, chunks, own });
    }

    /// WC3 + WC4 among the fluid: `rate[k]` ← dρ/dt over ρ in the continuity equation and the diffusion [kg/(m³ s)]; `diffusion` is
    /// the factor of the latter [s/m].
    pub fn density_rate(&self, rows: &[Row], rho: &[f64], diffusion: f64, simd: bool, rate: &mut [f64]) {
        parallel::each_piece(rate.chunks_mut(CHUNK).collect(), |c, rate| {
            simd::run(simd, DensityRate { pairs: self, c, rows, rho, diffusion, rate });
        });
    }

    /// WC5 among the fluid: force on target k [N/m], handed to `take` with k.
    pub fn pressure_force(&self, rows: &[Row], simd: bool, x: &mut [f64], y: &mut [f64]) {
        let pieces: Vec<_> = x.chunks_mut(CHUNK).zip(y.chunks_mut(CHUNK)).collect();
        parallel::each_piece(pieces, |c, (x, y)| {
            simd::run(simd, PressureForce { pairs: self, c, rows, x, y });
        });
    }

    /// Largest |v_a − v_b|/h_a of a pair [1/s].
    pub fn strain(&self, rows: &[Row], h: &[f64], simd: bool) -> f64 {
        let of = |c: usize| simd::run(simd, Strain { pairs: self, c, rows, h });
        parallel::map_pieces(self.chunks.len(), of).into_iter().fold(0.0, f64::max).sqrt()
    }

    /// What the weights hold on to [bytes].
    pub fn bytes(&self) -> usize {
        let of = |c: &HeldChunk| {
            of_vector(&c.start) + of_vector(&c.neighbour) + of_vector(&c.gradient) + of_vector(&c.diffusion)
        };
        of_vector(&self.own) + of_vector(&self.chunks) + self.chunks.iter().map(of).sum::<usize>()
    }
}

impl HeldChunk {
    /// Entries of block `b`.
    #[inline(always)]
    fn of(&self, b: usize) -> impl Iterator<Item = (usize, &[OfBlock; 2], &OfBlock)> {
        let range = self.start[b] as usize..self.start[b + 1] as usize;
        let pairs = self.neighbour[range.clone()].iter().zip(&self.gradient[range.clone()]);
        pairs.zip(&self.diffusion[range]).map(|((j, gradient), diffusion)| (*j as usize, gradient, diffusion))
    }
}

/// The lanes of an `R` from `first` on.
#[inline(always)]
fn lanes<R: SimdReal>(zero: R, of: &OfBlock, first: usize) -> R {
    zero.widened(&of.0[first..])
}

/// The numbers of a block's targets, of which an `R` has some.
#[inline(always)]
fn of_targets<R: SimdReal>(sums: [R; BLOCK]) -> [f64; BLOCK] {
    let mut targets = [0.0; BLOCK];
    for l in 0..BLOCK / R::WIDTH {
        targets[l * R::WIDTH..(l + 1) * R::WIDTH].copy_from_slice(&sums[l].lanes()[..R::WIDTH]);
    }
    targets
}

struct DensityRate<'a> {
    pairs: &'a HeldPairs,
    c: usize,
    rows: &'a [Row],
    rho: &'a [f64],
    diffusion: f64,
    rate: &'a mut [f64],
}

impl Task for DensityRate<'_> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let DensityRate { pairs, c, rows, rho, diffusion, rate } = self;
        for (b, rate) in rate.chunks_mut(BLOCK).enumerate() {
            let (mut along_x, mut along_y, mut smoothed) = ([zero; BLOCK], [zero; BLOCK], [zero; BLOCK]);
            for (j, [gx, gy], d) in pairs.chunks[c].of(b) {
                let [u, v, p] = [rows[j].u, rows[j].v, rows[j].p].map(|x| zero.of(x));
                for l in 0..BLOCK / R::WIDTH {
                    let at = l * R::WIDTH;
                    along_x[l] = lanes(zero, gx, at).mul_add(u, along_x[l]);
                    along_y[l] = lanes(zero, gy, at).mul_add(v, along_y[l]);
                    smoothed[l] = lanes(zero, d, at).mul_add(p, smoothed[l]);
                }
            }
            let first = c * CHUNK + b * BLOCK;
            let [along_x, along_y, smoothed] = [along_x, along_y, smoothed].map(of_targets);
            for (k, rate) in rate.iter_mut().enumerate() {
                let (a, own) = (&rows[first + k], &pairs.own[first + k]);
                let divergence = own.gradient[0] * a.u - along_x[k] + (own.gradient[1] * a.v - along_y[k]);
                let excess = smoothed[k] - own.diffusion * a.p + own.weight;
                *rate = (rho[first + k] * divergence - diffusion * excess) * own.per_volume;
            }
        }
    }
}

struct PressureForce<'a> {
    pairs: &'a HeldPairs,
    c: usize,
    rows: &'a [Row],
    x: &'a mut [f64],
    y: &'a mut [f64],
}

impl Task for PressureForce<'_> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let PressureForce { pairs, c, rows, x, y } = self;
        for (b, (x, y)) in x.chunks_mut(BLOCK).zip(y.chunks_mut(BLOCK)).enumerate() {
            let (mut fx, mut fy) = ([zero; BLOCK], [zero; BLOCK]);
            for (j, [gx, gy], _) in pairs.chunks[c].of(b) {
                let p = zero.of(rows[j].p);
                for l in 0..BLOCK / R::WIDTH {
                    let at = l * R::WIDTH;
                    fx[l] = lanes(zero, gx, at).mul_add(p, fx[l]);
                    fy[l] = lanes(zero, gy, at).mul_add(p, fy[l]);
                }
            }
            let first = c * CHUNK + b * BLOCK;
            let (fx, fy) = (of_targets(fx), of_targets(fy));
            for (k, (x, y)) in x.iter_mut().zip(y).enumerate() {
                let (p, own) = (rows[first + k].p, &pairs.own[first + k]);
                *x = -(p * own.gradient[0] + fx[k]);
                *y = -(p * own.gradient[1] + fy[k]);
            }
        }
    }
}

struct Strain<'a> {
    pairs: &'a HeldPairs,
    c: usize,
    rows: &'a [Row],
    h: &'a [f64],
}

impl Task for Strain<'_> {
    type Out = f64;
    /// The square of it.
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) -> f64 {
        let Strain { pairs, c, rows, h } = self;
        let (chunk, mut worst) = (&pairs.chunks[c], 0.0_f64);
        for b in 0..chunk.start.len() - 1 {
            let first = c * CHUNK + b * BLOCK;
            for l in (0..BLOCK).step_by(R::WIDTH) {
                let at = |k: usize| (first + l + k).min(h.len() - 1);
                let (ua, va) = (zero.each(|k| rows[at(k)].u), zero.each(|k| rows[at(k)].v));
                let per_h = zero.each(|k| 1.0 / h[at(k)]);
                let mut most = zero;
                for (j, _, d) in chunk.of(b) {
                    let (du, dv) = (ua - zero.of(rows[j].u), va - zero.of(rows[j].v));
                    let apart = du.mul_add(du, dv * dv);
                    most = most.max(lanes(zero, d, l).below(zero, apart, zero)); // a neighbour's weight is negative
                }
                let most = (most * per_h * per_h).lanes();
                worst = most[..R::WIDTH].iter().fold(worst, |worst, &x| worst.max(x));
            }
        }
        worst
    }
}

struct Hold<'a> {
    fluid: &'a [PackedParticle],
    lists: &'a Lists,
    constants: PairConstants,
    simd: bool,
    chunks: &'a mut [HeldChunk],
    own: &'a mut [Own],
}

impl WithPairs for Hold<'_> {
    fn with<K: Shape, D: PairDissipation>(self) {
        let Hold { fluid, lists, constants, simd, chunks, own } = self;
        let pieces: Vec<_> = chunks.iter_mut().zip(own.chunks_mut(CHUNK)).collect();
        parallel::each_piece(pieces, |c, (held, own)| {
            let meets = held.list(lists, c * CHUNK, own.len());
            let first = c * CHUNK;
            simd::run(
                simd,
                HoldChunk::<K, D> { fluid, constants, first, meets: &meets, held, own, pairs: PhantomData },
            );
            held.drop_distant();
        });
    }
}

impl HeldChunk {
    /// Everyone whom a target of each block may meet, of the `count` targets from `first` on; of each entry a bit for each target that
    /// meets it.
    fn list(&mut self, lists: &Lists, first: usize, count: usize) -> Vec<u8> {
        self.start.clear();
        self.neighbour.clear();
        self.start.push(0);
        let (mut seen, mut meets) = (EntryIndex::default(), Vec::new());
        for block in (first..first + count).step_by(BLOCK) {
            seen.clear();
            let from = self.neighbour.len();
            for k in block..(block + BLOCK).min(first + count) {
                for j in lists.of(k) {
                    let e = from + seen.entry(j) as usize;
                    if e == self.neighbour.len() {
                        self.neighbour.push(j);
                        meets.push(0);
                    }
                    meets[e] |= 1_u8 << (k - block);
                }
            }
            self.start.push(self.neighbour.len() as u32);
        }
        self.gradient.clear();
        self.gradient.resize(self.neighbour.len(), Default::default());
        self.diffusion.clear();
        self.diffusion.resize(self.neighbour.len(), OfBlock::default());
        meets
    }
}

impl HeldChunk {
    /// Drop entries that no target feels, and what the arrays have to spare.
    fn drop_distant(&mut self) {
        let HeldChunk { start, neighbour, gradient, diffusion } = self;
        let (mut kept, mut from) = (0, 0);
        for end in start.iter_mut().skip(1) {
            for e in from..*end as usize {
                if diffusion[e].0.iter().any(|&weight| weight != 0.0) {
                    (neighbour[kept], gradient[kept], diffusion[kept]) = (neighbour[e], gradient[e], diffusion[e]);
                    kept += 1;
                }
            }
            from = *end as usize;
            *end = kept as u32;
        }
        neighbour.truncate(kept);
        gradient.truncate(kept);
        diffusion.truncate(kept);
        if neighbour.capacity() > kept + kept / 8 {
            neighbour.shrink_to_fit();
            gradient.shrink_to_fit();
            diffusion.shrink_to_fit();
        }
    }
}

struct HoldChunk<'a, K, D> {
    fluid: &'a [PackedParticle],
    constants: PairConstants,
    first: usize,
    meets: &'a [u8],
    held: &'a mut HeldChunk,
    own: &'a mut [Own],
    pairs: PhantomData<(K, D)>,
}

impl<K: Shape, D: PairDissipation> Task for HoldChunk<'_, K, D> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let HoldChunk { fluid, constants, first, meets, held, own, .. } = self;
        let weight = constants.gravity.map(|g| zero.of(constants.rho0 * g));
        let HeldChunk { start, neighbour, gradient, diffusion } = held;
        for (b, own) in own.chunks_mut(BLOCK).enumerate() {
            let range = start[b] as usize..start[b + 1] as usize;
            for lane in (0..own.len()).step_by(R::WIDTH) {
                let a = PackedParticle::targets(fluid, first + b * BLOCK + lane, zero);
                let there = (own.len() - lane).min(R::WIDTH);
                let mut sum = [zero; 4];
                for e in range.clone() {
                    let row = &fluid[neighbour[e] as usize];
                    let (dx, dy) = (a.x - zero.of(row.x), a.y - zero.of(row.y));
                    let ab = PairGeometry::new::<K>(dx, dy, MeanScale.of::<K>(a.h, zero.of(row.h)));
                    let flux = (a.volume * zero.of(row.volume) * ab.grad_factor).mask(u32::from(meets[e]) >> lane);
                    let (x, y, d) = (flux * dx, flux * dy, D::length(&ab) * flux);
                    let [x, y, d] = [x.to_single(), y.to_single(), d.to_single()];
                    gradient[e][0].0[lane..lane + R::WIDTH].copy_from_slice(&x[..R::WIDTH]);
                    gradient[e][1].0[lane..lane + R::WIDTH].copy_from_slice(&y[..R::WIDTH]);
                    diffusion[e].0[lane..lane + R::WIDTH].copy_from_slice(&d[..R::WIDTH]);
                    let [x, y, d] = [x, y, d].map(|x| zero.widened(&x));
                    let hydrostatic = d * weight[0].mul_add(dx, weight[1] * dy);
                    sum = [sum[0] + x, sum[1] + y, sum[2] + d, sum[3] + hydrostatic];
                }
                let [x, y, d, w] = sum.map(|s| s.lanes());
                for k in 0..there {
                    let per_volume = 1.0 / fluid[first + b * BLOCK + lane + k].volume;
                    own[lane + k] = Own { gradient: [x[k], y[k]], diffusion: d[k], weight: w[k], per_volume };
                }
            }
        }
    }
}
