//! The sums over pairs of a step: which particles meet in which sum.

use std::marker::PhantomData;

use crate::domain::Domain;
use crate::interactions::dissipation::{Dissipation, ElasticPair, PairDissipation, WithPairs, with_pairs};
use crate::interactions::geometry::{MeanScale, PairConstants, UniformScale};
use crate::interactions::packed_particle::{PackedParticle, PackedWall};
use crate::interactions::pair::{self, Extrapolated, Gathered};
use crate::kernel::{self, Kernel, Shape, WithKernel};
use crate::neighbours::Neighbours;
use crate::neighbours::lists::{Lists, NONE};
use crate::parallel::{self, CHUNK};
use crate::particles::KernelMoments;
use crate::simd::{LANES, SimdReal, Task};

/// The sum of each target over its neighbours, several targets side by side.
pub(crate) trait Gather: Sync {
    /// A target's sum.
    type Sum: Send;
    /// The sums of the targets that an `R` holds, beginning with `first`.
    fn gather<R: SimdReal, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [Self::Sum; LANES];
}

/// How sums over pairs are run: one dispatch on kernel and dissipation per sum, one on the processor per chunk.
pub(crate) struct PairSums {
    kernel: Kernel,
    dissipation: Dissipation,
    simd: bool,
}

impl PairSums {
    /// With the domain's kernel.
    pub fn of(domain: &Domain) -> PairSums {
        PairSums::with(domain, Dissipation::default())
    }

    /// With a dissipation too.
    pub fn with(domain: &Domain, dissipation: Dissipation) -> PairSums {
        PairSums { kernel: domain.fluid.kernel, dissipation, simd: domain.simd }
    }

    /// `out[k]` ← the sum of target k.
    pub fn run<G: Gather>(&self, gather: &G, out: impl Sums<G::Sum>) {
        with_pairs(self.kernel, self.dissipation, PairSum { gather, out, simd: self.simd });
    }

    /// The same for sums in which fluid does not meet fluid, so that nothing dissipates.
    pub fn run_without_dissipation<G: Gather>(&self, gather: &G, out: impl Sums<G::Sum>) {
        self.kernel.run(PairSum { gather, out, simd: self.simd });
    }
}

/// Where sums are stored, one per target.
pub(crate) trait Sums<S>: Send + Sized {
    /// Pieces of [`CHUNK`] targets, in order.
    fn pieces(self) -> Vec<Self>;
    /// How many targets.
    fn count(&self) -> usize;
    /// The sum of target `k`.
    fn put(&mut self, k: usize, sum: S);
}

impl<S: Send> Sums<S> for &mut [S] {
    fn pieces(self) -> Vec<Self> {
        self.chunks_mut(CHUNK).collect()
    }
    #[inline(always)]
    fn count(&self) -> usize {
        self.len()
    }
    #[inline(always)]
    fn put(&mut self, k: usize, sum: S) {
        self[k] = sum;
    }
}

struct PairSum<'a, G, O> {
    gather: &'a G,
    out: O,
    simd: bool,
}

impl<G: Gather, O: Sums<G::Sum>> WithKernel for PairSum<'_, G, O> {
    type Out = ();
    fn with<K: Shape>(self) {
        WithPairs::with::<K, ElasticPair>(self);
    }
}

impl<G: Gather, O: Sums<G::Sum>> WithPairs for PairSum<'_, G, O> {
    fn with<K: Shape, D: PairDissipation>(self) {
        let PairSum { gather, out, simd } = self;
        parallel::each_piece(out.pieces(), |c, out| {
            kernel::run_sums::<K, _>(simd, Piece::<G, O, K, D> { gather, first: c * CHUNK, out, pairs: PhantomData });
        });
    }
}

struct Piece<'a, G, O, K, D> {
    gather: &'a G,
    first: usize,
    out: O,
    pairs: PhantomData<(K, D)>,
}

impl<G: Gather, O: Sums<G::Sum>, K: Shape, D: PairDissipation> Task for Piece<'_, G, O, K, D> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let Piece { gather, first, mut out, .. } = self;
        for k in (0..out.count()).step_by(R::WIDTH) {
            let sums = gather.gather::<R, K, D>(first + k, zero);
            let here = (out.count() - k).min(R::WIDTH);
            sums.into_iter().take(here).enumerate().for_each(|(l, sum)| out.put(k + l, sum));
        }
    }
}

/// `lists` where `wanted`, else none.
pub(crate) fn listed(lists: &Lists, wanted: bool) -> &Lists {
    if wanted { lists } else { &NONE }
}

/// WC3 + WC4 (WC8): dρ/dt of every fluid particle.
pub(crate) struct DensityRate<'a> {
    pub fluid: &'a [PackedParticle],
    pub packed_walls: &'a [PackedWall],
    pub rho: &'a [f64],
    pub neighbours: &'a Neighbours,
    pub constants: PairConstants,
    /// Walls reflect the velocity (WA4).
    pub walls_reflect: bool,
}

impl Gather for DensityRate<'_> {
    type Sum = f64;
    #[inline(always)]
    fn gather<R: SimdReal, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [f64; LANES] {
        let DensityRate { fluid, packed_walls, rho, neighbours, constants, walls_reflect } = self;
        let (a, c) = (PackedParticle::targets(fluid, first, zero), constants.splat(zero));
        let rho_a = zero.each(|k| rho[(first + k).min(rho.len() - 1)]);
        let lists = &neighbours.fluid;
        let walls = listed(&neighbours.walls_of_fluid, *walls_reflect).around(first, zero, packed_walls);
        let rate = if R::WIDTH > 1 && lists.alike(first) {
            let near = lists.around_alike(first, zero, fluid);
            pair::density_rate::<R, K, D>(&a, rho_a, near, walls, UniformScale::new::<K>(a.h), &c)
        } else {
            let near = lists.around(first, zero, fluid);
            pair::density_rate::<R, K, D>(&a, rho_a, near, walls, MeanScale, &c)
        };
        rate.lanes()
    }
}

/// WA3: what every wall particle extrapolates from the fluid.
pub(crate) struct WallState<'a> {
    pub fluid: &'a [PackedParticle],
    pub walls: &'a [PackedParticle],
    pub acceleration: (&'a [f64], &'a [f64]),
    pub neighbours: &'a Neighbours,
    pub constants: PairConstants,
}

impl Gather for WallState<'_> {
    type Sum = Extrapolated;
    #[inline(always)]
    fn gather<R: SimdReal, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [Extrapolated; LANES] {
        let WallState { fluid, walls, acceleration: (ax, ay), neighbours, constants } = self;
        let acceleration = [ax, ay].map(|a| zero.each(|k| a[(first + k).min(a.len() - 1)]));
        let near = neighbours.fluid_of_wall.around(first, zero, fluid);
        let wall = PackedParticle::targets(walls, first, zero);
        pair::extrapolate::<R, K>(&wall, acceleration, near, &constants.splat(zero)).lanes()
    }
}

/// Where the sums of the momentum equation are stored: forces [N/m] and kernel moments.
pub(crate) struct MomentumSums<'a> {
    pub x: &'a mut [f64],
    pub y: &'a mut [f64],
    pub moments: &'a mut [KernelMoments],
}

impl Sums<Gathered> for MomentumSums<'_> {
    fn pieces(self) -> Vec<Self> {
        let (x, y) = (self.x.chunks_mut(CHUNK), self.y.chunks_mut(CHUNK));
        let pieces = x.zip(y).zip(self.moments.chunks_mut(CHUNK));
        pieces.map(|((x, y), moments)| MomentumSums { x, y, moments }).collect()
    }
    #[inline(always)]
    fn count(&self) -> usize {
        self.x.len()
    }
    #[inline(always)]
    fn put(&mut self, k: usize, sum: Gathered) {
        [self.x[k], self.y[k]] = sum.force;
        self.moments[k] = sum.moments;
    }
}

/// WC5–WC7 (WC9), OP4, OP5, WC10: force on every fluid particle, and how its neighbours lie.
pub(crate) struct Momentum<'a> {
    pub fluid: &'a [PackedParticle],
    pub walls: &'a [PackedParticle],
    pub neighbours: &'a Neighbours,
    pub constants: PairConstants,
    pub wall_nu: f64,
    /// Walls push by their pressure (WC5).
    pub walls_push: bool,
}

impl Gather for Momentum<'_> {
    type Sum = Gathered;
    #[inline(always)]
    fn gather<R: SimdReal, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [Gathered; LANES] {
        let Momentum { fluid, walls, neighbours, constants, wall_nu, walls_push } = self;
        let (a, c, wall_nu) = (PackedParticle::targets(fluid, first, zero), constants.splat(zero), zero.of(*wall_nu));
        let lists = &neighbours.fluid;
        let near_walls = listed(&neighbours.walls_of_fluid, *walls_push).around(first, zero, walls);
        let sums = if R::WIDTH > 1 && lists.alike(first) {
            let near = lists.around_alike(first, zero, fluid);
            pair::momentum::<R, K, D>(&a, near, near_walls, UniformScale::new::<K>(a.h), &c, wall_nu)
        } else {
            let near = lists.around(first, zero, fluid);
            pair::momentum::<R, K, D>(&a, near, near_walls, MeanScale, &c, wall_nu)
        };
        sums.lanes()
    }
}

/// The fluid's force on every wall particle.
pub(crate) struct WallForce<'a> {
    pub fluid: &'a [PackedParticle],
    pub walls: &'a [PackedParticle],
    pub neighbours: &'a Neighbours,
    pub constants: PairConstants,
    pub wall_nu: f64,
}

impl Gather for WallForce<'_> {
    type Sum = [f64; 2];
    #[inline(always)]
    fn gather<R: SimdReal, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [[f64; 2]; LANES] {
        let WallForce { fluid, walls, neighbours, constants, wall_nu } = self;
        let near = neighbours.fluid_of_wall.around(first, zero, fluid);
        let wall = PackedParticle::targets(walls, first, zero);
        let [x, y] = pair::wall_force::<R, K>(&wall, near, &constants.splat(zero), zero.of(*wall_nu));
        let (x, y) = (x.lanes(), y.lanes());
        std::array::from_fn(|k| [x[k], y[k]])
    }
}

/// OP4 alone: ∇C [1/m] of every fluid particle.
pub(crate) struct ConcentrationGradient<'a> {
    pub fluid: &'a [PackedParticle],
    pub walls: &'a [PackedParticle],
    pub neighbours: &'a Neighbours,
}

impl Gather for ConcentrationGradient<'_> {
    type Sum = [f64; 2];
    #[inline(always)]
    fn gather<R: SimdReal, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [[f64; 2]; LANES] {
        let ConcentrationGradient { fluid, walls, neighbours } = self;
        let (a, lists) = (PackedParticle::targets(fluid, first, zero), &neighbours.fluid);
        let near_walls = neighbours.walls_of_fluid.around(first, zero, walls);
        let [x, y] = if R::WIDTH > 1 && lists.alike(first) {
            let near = lists.around_alike(first, zero, fluid);
            pair::concentration_gradient::<R, K>(&a, near, near_walls, UniformScale::new::<K>(a.h))
        } else {
            pair::concentration_gradient::<R, K>(&a, lists.around(first, zero, fluid), near_walls, MeanScale)
        };
        let (x, y) = (x.lanes(), y.lanes());
        std::array::from_fn(|k| [x[k], y[k]])
    }
}

/// Sums of vectors, by component.
pub(crate) struct VectorSums<'a> {
    pub x: &'a mut [f64],
    pub y: &'a mut [f64],
}

impl Sums<[f64; 2]> for VectorSums<'_> {
    fn pieces(self) -> Vec<Self> {
        self.x.chunks_mut(CHUNK).zip(self.y.chunks_mut(CHUNK)).map(|(x, y)| VectorSums { x, y }).collect()
    }
    #[inline(always)]
    fn count(&self) -> usize {
        self.x.len()
    }
    #[inline(always)]
    fn put(&mut self, k: usize, sum: [f64; 2]) {
        [self.x[k], self.y[k]] = sum;
    }
}
