//! Pairs of fluid particles whose geometry is held over an advective step (THEORY WC23): two sparse products per acoustic step.
//!
//! Targets are kept in blocks of [`BLOCK`] that follow one another. An entry is a neighbour of any of them, with a weight for each:
//! it is read once, and the weights of a block lie side by side. Weights are stored in single precision and summed in double;
//! those of a and b are the same number with opposite signs, so momentum is exact.

use serde::{Deserialize, Serialize};

use super::candidates::{BLOCK, Candidates};
use crate::memory::of_vector;
use crate::parallel::{self, CHUNK};
use crate::simd::{self, SimdReal, Task};

/// A number for each target of a block.
#[repr(align(32))]
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct OfBlock(pub [f32; BLOCK]);

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
pub(super) struct HeldChunk {
    /// Where the entries of each block start; one more than blocks.
    pub start: Vec<u32>,
    pub neighbour: Vec<u32>,
    /// V_a V_b ∇_a W_ab [m].
    pub gradient: Vec<[OfBlock; 2]>,
    /// V_a V_b ℓ (r_ab·∇W_ab)/r² [m] (WC4, WC8); empty where ℓ is the distance: [`by_distance`].
    pub diffusion: Vec<OfBlock>,
    /// Who may meet, until lists are made again.
    #[serde(skip)]
    pub candidates: Candidates,
}

/// The sums of a target that no acoustic step changes; the rates are those of the start of the advective step.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Own {
    /// Σ V_a V_b ∇_a W_ab [m].
    pub gradient: [f64; 2],
    /// Σ of the diffusion's weights [m].
    pub diffusion: f64,
    /// The same with ρ₀ g·r_ab [Pa m].
    pub weight: f64,
    /// 1/V_a [1/m²].
    pub per_volume: f64,
    /// Σ (v_a − v_b)·dS_ab/dt [m²/s²].
    pub opening_rate: f64,
    /// Σ (p_a + p_b) dS_ab/dt [N/(m s)].
    pub push_rate: [f64; 2],
}

/// All pairs of fluid particles.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct HeldPairs {
    pub chunks: Vec<HeldChunk>,
    pub own: Vec<Own>,
    /// Number of the lists that the candidates were taken from.
    #[serde(skip)]
    pub lists: Option<u64>,
}

impl HeldPairs {
    /// WC3 + WC4 among the fluid: dρ/dt [kg/(m³ s)] of the targets of chunk `c`, which have the densities `rho`; `diffusion` is the factor
    /// of the diffusion's sum [s/m], `later` the time since the middle of the advective step [s].
    #[inline(always)]
    pub fn density_rate<R: SimdReal>(
        &self,
        zero: R,
        c: usize,
        rows: &[Row],
        rho: &[f64],
        [diffusion, later]: [f64; 2],
    ) -> [f64; CHUNK] {
        match self.chunks[c].diffusion.is_empty() {
            true => self.density_rate_with::<R, false>(zero, c, rows, rho, [diffusion, later]),
            false => self.density_rate_with::<R, true>(zero, c, rows, rho, [diffusion, later]),
        }
    }

    #[inline(always)]
    fn density_rate_with<R: SimdReal, const STORED: bool>(
        &self,
        zero: R,
        c: usize,
        rows: &[Row],
        rho: &[f64],
        [diffusion, later]: [f64; 2],
    ) -> [f64; CHUNK] {
        let mut rate = [0.0; CHUNK];
        for (b, (rate, rho)) in rate.chunks_mut(BLOCK).zip(rho.chunks(BLOCK)).enumerate() {
            let (mut along_x, mut along_y, mut smoothed) = ([zero; BLOCK], [zero; BLOCK], [zero; BLOCK]);
            for (j, [gx, gy], d) in self.chunks[c].of::<STORED>(b) {
                let (u, v, p) = (zero.of(rows[j].u), zero.of(rows[j].v), zero.of(rows[j].p));
                for l in 0..BLOCK / R::WIDTH {
                    let at = l * R::WIDTH;
                    along_x[l] = lanes(zero, gx, at).mul_add(u, along_x[l]);
                    along_y[l] = lanes(zero, gy, at).mul_add(v, along_y[l]);
                    smoothed[l] = lanes(zero, &d, at).mul_add(p, smoothed[l]);
                }
            }
            let first = c * CHUNK + b * BLOCK;
            let [along_x, along_y, smoothed] = [along_x, along_y, smoothed].map(of_targets);
            for (k, (rate, rho)) in rate.iter_mut().zip(rho).enumerate() {
                let (a, own) = (&rows[first + k], &self.own[first + k]);
                let held = own.gradient[0] * a.u - along_x[k] + (own.gradient[1] * a.v - along_y[k]);
                let divergence = held + later * own.opening_rate;
                let excess = smoothed[k] - own.diffusion * a.p + own.weight;
                *rate = (rho * divergence - diffusion * excess) * own.per_volume;
            }
        }
        rate
    }

    /// WC5 among the fluid: force [N/m] on the `count` targets of chunk `c`, of pressures `p` [Pa] of particles and images, `later` [s] than the
    /// middle of the advective step.
    #[inline(always)]
    pub fn pressure_force<R: SimdReal>(
        &self,
        zero: R,
        c: usize,
        p: &[f64],
        (count, later): (usize, f64),
    ) -> [[f64; CHUNK]; 2] {
        let mut force = [[0.0; CHUNK]; 2];
        for b in 0..count.div_ceil(BLOCK) {
            let (mut fx, mut fy) = ([zero; BLOCK], [zero; BLOCK]);
            for (j, [gx, gy], _) in self.chunks[c].of::<false>(b) {
                let p = zero.of(p[j]);
                for l in 0..BLOCK / R::WIDTH {
                    let at = l * R::WIDTH;
                    fx[l] = lanes(zero, gx, at).mul_add(p, fx[l]);
                    fy[l] = lanes(zero, gy, at).mul_add(p, fy[l]);
                }
            }
            let (fx, fy) = (of_targets(fx), of_targets(fy));
            for k in 0..BLOCK.min(count - b * BLOCK) {
                let at = c * CHUNK + b * BLOCK + k;
                let own = &self.own[at];
                force[0][b * BLOCK + k] = -(p[at] * own.gradient[0] + fx[k] + later * own.push_rate[0]);
                force[1][b * BLOCK + k] = -(p[at] * own.gradient[1] + fy[k] + later * own.push_rate[1]);
            }
        }
        force
    }

    /// Largest |v_a − v_b|/h_a of a pair [1/s].
    pub fn strain(&self, rows: &[Row], h: &[f64], simd: bool) -> f64 {
        let of = |c: usize| simd::run(simd, Strain { pairs: self, c, rows, h });
        parallel::map_pieces(self.chunks.len(), of).into_iter().fold(0.0, f64::max).sqrt()
    }

    /// What the weights hold on to [bytes].
    pub fn bytes(&self) -> usize {
        let of = |c: &HeldChunk| {
            let weights = of_vector(&c.gradient) + of_vector(&c.diffusion);
            of_vector(&c.start) + of_vector(&c.neighbour) + weights + c.candidates.bytes()
        };
        of_vector(&self.own) + of_vector(&self.chunks) + self.chunks.iter().map(of).sum::<usize>()
    }
}

impl HeldChunk {
    /// Entries of block `b`: neighbour, gradient, weight of the diffusion.
    #[inline(always)]
    fn of<const STORED: bool>(&self, b: usize) -> impl Iterator<Item = (usize, &[OfBlock; 2], OfBlock)> {
        let range = self.start[b] as usize..self.start[b + 1] as usize;
        let diffusion = if STORED { &self.diffusion[range.clone()] } else { &[] };
        let pairs = self.neighbour[range.clone()].iter().zip(&self.gradient[range]).enumerate();
        pairs.map(|(e, (j, gradient))| {
            (*j as usize, gradient, if STORED { diffusion[e] } else { by_distance(gradient) })
        })
    }

    /// No entries yet, and room for as many as `most`; what is far too much is given back.
    pub fn clear(&mut self, most: usize, diffuses: bool) {
        let HeldChunk { start, neighbour, gradient, diffusion, .. } = self;
        if neighbour.capacity() > most + most / 2 {
            *self = HeldChunk::default();
            return self.clear(most, diffuses);
        }
        start.clear();
        start.push(0);
        neighbour.resize(most, 0);
        gradient.resize(most, Default::default());
        diffusion.resize(if diffuses { most } else { 0 }, OfBlock::default());
    }

    /// Keep the first `kept` entries.
    pub fn truncate(&mut self, kept: usize) {
        self.neighbour.truncate(kept);
        self.gradient.truncate(kept);
        self.diffusion.truncate(kept);
    }
}

/// V_a V_b r (r_ab·∇W_ab)/r² [m] of V_a V_b ∇_a W_ab, which has that length and is along −r_ab.
#[inline(always)]
pub(super) fn by_distance([x, y]: &[OfBlock; 2]) -> OfBlock {
    OfBlock(std::array::from_fn(|l| -(x.0[l] * x.0[l] + y.0[l] * y.0[l]).sqrt()))
}

/// The lanes of an `R` from `first` on.
#[inline(always)]
pub(super) fn lanes<R: SimdReal>(zero: R, of: &OfBlock, first: usize) -> R {
    zero.widened(&of.0[first..])
}

/// The numbers of a block's targets, of which an `R` has some.
#[inline(always)]
pub(super) fn of_targets<R: SimdReal>(sums: [R; BLOCK]) -> [f64; BLOCK] {
    let mut targets = [0.0; BLOCK];
    for l in 0..BLOCK / R::WIDTH {
        targets[l * R::WIDTH..(l + 1) * R::WIDTH].copy_from_slice(&sums[l].lanes()[..R::WIDTH]);
    }
    targets
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
                for (j, gradient, _) in chunk.of::<false>(b) {
                    let (du, dv) = (ua - zero.of(rows[j].u), va - zero.of(rows[j].v));
                    let apart = du.mul_add(du, dv * dv);
                    let (x, y) = (lanes(zero, &gradient[0], l), lanes(zero, &gradient[1], l));
                    most = most.max((zero - x * x - y * y).below(zero, apart, zero)); // of neighbours only
                }
                let most = (most * per_h * per_h).lanes();
                worst = most[..R::WIDTH].iter().fold(worst, |worst, &x| worst.max(x));
            }
        }
        worst
    }
}
