//! Sums over the pairs of a step: geometry, divergence, viscosity and the matrix's rows (THEORY PR3–PR6, PR13).

use std::marker::PhantomData;
use std::ops::Range;

use crate::interactions::geometry::{PairConstants, pair_geometry};
use crate::interactions::packed_particle::{PackedParticle, PackedWall};
use crate::kernel::{self, Shape, WithKernel};
use crate::neighbours::Neighbours;
use crate::parallel::{self, CHUNK};
use crate::particles::KernelMoments;
use crate::projection::lattice::Lattice;
use crate::projection::pair_clusters::ChunkPairs;
use crate::simd::{LANES, SimdReal, Task};
use crate::system::ParticleSystem;
use crate::walls::Walls;

/// What the pairs give.
#[derive(Clone, Debug, Default)]
pub struct Operators {
    chunks: Vec<ChunkPairs>,
    /// Geometry.
    pub around: Vec<KernelMoments>,
    /// ∇·u* [1/s].
    pub divergence: Vec<f64>,
    /// −Σ V r⊗∇W.
    pub second_moment: Vec<[f64; 3]>,
    /// κ times the viscous force [N/m] (PR13).
    pub drag: Vec<[f64; 2]>,
}

impl Operators {
    /// Who is near row k, as listed (images count), and off-diagonals, positive: a_ij = 2 V_i V_j |slope|/ρ.
    #[inline(always)]
    pub fn row(&self, k: usize) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.chunks[k / CHUNK].row(k % CHUNK)
    }

    /// The pairs, by chunks of targets.
    pub(crate) fn chunks(&self) -> &[ChunkPairs] {
        &self.chunks
    }
}

/// What a chunk of targets finds.
struct Found<'a> {
    pairs: &'a mut ChunkPairs,
    around: &'a mut [KernelMoments],
    divergence: &'a mut [f64],
    second_moment: &'a mut [[f64; 3]],
    drag: &'a mut [[f64; 2]],
}

struct Assembly<'a> {
    shared: Shared<'a>,
    found: Vec<Found<'a>>,
    simd: bool,
}

impl WithKernel for Assembly<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Assembly { shared, mut found, simd } = self;
        parallel::for_each_chunk(&mut found, shared.n, |targets, out| {
            kernel::run_sums::<K, _>(simd, ChunkSums::<K> { shared: &shared, targets, out, kernel: PhantomData });
        });
    }
}

/// What every chunk reads.
struct Shared<'a> {
    fluid: &'a [PackedParticle],
    packed_walls: &'a [PackedWall],
    neighbours: &'a Neighbours,
    n: usize,
    kicks: &'a [[f64; 2]],
    walls: &'a [PackedParticle],
    constants: PairConstants,
    /// 1/κ (PR4).
    inverse: f64,
}

/// The sums of a chunk of targets.
struct ChunkSums<'a, 'b, K> {
    shared: &'a Shared<'a>,
    targets: Range<usize>,
    out: &'a mut Found<'b>,
    kernel: PhantomData<K>,
}

impl<K: Shape> Task for ChunkSums<'_, '_, K> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let ChunkSums { shared, targets, out, .. } = self;
        let Shared { fluid, neighbours, constants, .. } = shared;
        out.pairs.clear();
        for first in targets.clone().step_by(LANES) {
            let sums = out.pairs.add_cluster::<R, K>(&neighbours.fluid, first, fluid, constants, zero);
            for (k, sums) in (first..targets.end.min(first + LANES)).zip(sums) {
                let (a, slot) = (&fluid[k], k - targets.start);
                let own = a.raw_volume * K::ALPHA * K::w(0.0) / (a.h * a.h);
                let fluid_kernel_sum = own + sums.kernel_sum;
                let mut moments = Moments {
                    kernel_sum: fluid_kernel_sum,
                    concentration_gradient: sums.concentration_gradient,
                    arms: sums.second_moment,
                    rate: sums.divergence,
                };
                shared.add_walls::<K>(k, &mut moments);
                let Moments { kernel_sum, concentration_gradient, arms, rate } = moments;
                let (mean, half) = (0.5 * (arms[0] + arms[2]), 0.5 * (arms[0] - arms[2]));
                let lambda = mean - (half * half + arms[1] * arms[1]).sqrt();
                out.around[slot] = KernelMoments::new(kernel_sum, fluid_kernel_sum, concentration_gradient, lambda);
                out.divergence[slot] = shared.inverse * rate;
                out.second_moment[slot] = arms;
                out.drag[slot] = sums.drag;
            }
        }
    }
}

/// Sums of a target over fluid and walls.
struct Moments {
    kernel_sum: f64,
    concentration_gradient: [f64; 2],
    /// −Σ V r⊗∇W.
    arms: [f64; 3],
    /// κ ∇·u*.
    rate: f64,
}

impl Shared<'_> {
    /// PR3: what the walls add to the sums of target `k`.
    #[inline(always)]
    fn add_walls<K: Shape>(&self, k: usize, moments: &mut Moments) {
        let Shared { fluid, packed_walls, neighbours, kicks, walls, .. } = self;
        let Moments { kernel_sum, concentration_gradient, arms, rate } = moments;
        let a = &fluid[k];
        for j in neighbours.walls_of_fluid.of(k) {
            let w = &packed_walls[j as usize];
            let Some(aw) = pair_geometry::<K>(a.x, a.y, a.h, w.x, w.y, w.h) else { continue };
            let wet = walls[j as usize].volume;
            *kernel_sum += wet * aw.w::<K>();
            let pull = wet * aw.grad_factor;
            concentration_gradient[0] += pull * aw.dx;
            concentration_gradient[1] += pull * aw.dy;
            arms[0] -= pull * aw.dx * aw.dx;
            arms[1] -= pull * aw.dx * aw.dy;
            arms[2] -= pull * aw.dy * aw.dy;
            let un = a.u * w.nx + a.v * w.ny;
            let rn = aw.dx * w.nx + aw.dy * w.ny;
            *rate += 2.0 * w.volume * aw.grad_factor * (w.vn - un) * rn;
            let kick = kicks[j as usize];
            *rate += 2.0 * pull * (kick[0] * aw.dx + kick[1] * aw.dy);
        }
    }
}

impl Operators {
    /// PR3–PR6, PR13: the sums over pairs of a step of `dt` [s].
    pub fn assemble(
        &mut self,
        system: &mut ParticleSystem,
        walls: &Walls,
        lattice: &Lattice,
        constants: PairConstants,
        dt: f64,
    ) {
        let n = system.particles.len();
        let (kernel, g) = (system.domain.fluid.kernel, system.domain.gravity);
        // the tangential velocity of a wall is not used here; Δt (a − g) acts instead
        let mut kicks = Vec::with_capacity(system.packed.packed_walls.len());
        for (k, face) in system.packed.packed_walls.iter_mut().enumerate() {
            let source = if k < walls.len() { k } else { system.neighbours.wall_images[k - walls.len()] as usize };
            // images have the same normal velocity
            let [u, v] = walls.velocity_at_start(source, dt);
            face.vn = u * walls.nx[source] + v * walls.ny[source];
            let side = if k < walls.len() { 1.0 } else { -1.0 };
            kicks.push([dt * (side * walls.ax[source] - g[0]), dt * (walls.ay[source] - g[1])]);
        }
        let Operators { chunks, around, divergence, second_moment, drag } = self;
        chunks.resize(n.div_ceil(CHUNK), ChunkPairs::default());
        around.resize(n, KernelMoments::default());
        divergence.resize(n, 0.0);
        second_moment.resize(n, [0.0; 3]);
        drag.resize(n, [0.0; 2]);
        let pieces = around.chunks_mut(CHUNK).zip(divergence.chunks_mut(CHUNK));
        let pieces = pieces.zip(second_moment.chunks_mut(CHUNK).zip(drag.chunks_mut(CHUNK)));
        let found = chunks.iter_mut().zip(pieces);
        let found = found.map(|(pairs, ((around, divergence), (second_moment, drag)))| Found {
            pairs,
            around,
            divergence,
            second_moment,
            drag,
        });
        let shared = Shared {
            fluid: &system.packed.fluid,
            packed_walls: &system.packed.packed_walls,
            neighbours: &system.neighbours,
            n,
            kicks: &kicks,
            walls: &system.packed.walls,
            constants,
            inverse: 1.0 / lattice.gradient,
        };
        kernel.run(Assembly { shared, found: found.collect(), simd: system.domain.simd });
    }
}
