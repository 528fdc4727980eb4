//! The four sweeps of a step: which rows meet in which sum.

use std::marker::PhantomData;

use crate::interactions::dissipation::{ElasticPair, PairDissipation, WithPairs};
use crate::interactions::kernel::{Shape, WithKernel};
use crate::interactions::pair::{self, Alike, Constants, Extrapolated, Face, Gathered, Mean, Row};
use crate::interactions::simd::{self, LANES, Number, Task};
use crate::neighbours::Search;
use crate::neighbours::lists::{Lists, NONE};
use crate::parallel::{self, CHUNK};
use crate::parameters::Parameters;
use crate::particles::Surroundings;

/// What a sweep gathers for its targets, side by side.
pub(crate) trait Gather: Sync {
    /// A target's sum.
    type Sum: Send;
    /// Sums of the targets from `first` on, as many as an `R` is wide.
    fn gather<R: Number, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [Self::Sum; LANES];
}

impl Parameters {
    /// `out[k]` ← the sum of target k: one dispatch on kernel and dissipation a sweep, one on the processor a chunk.
    pub(crate) fn sweep<G: Gather>(&self, gather: &G, out: impl Sums<G::Sum>) {
        self.with_pairs(Sweep { gather, out, wide: self.wide });
    }

    /// The same for sums in which fluid does not meet fluid, and nothing dissipates.
    pub(crate) fn sweep_walls<G: Gather>(&self, gather: &G, out: impl Sums<G::Sum>) {
        self.kernel.run(Sweep { gather, out, wide: self.wide });
    }
}

/// Where a sweep puts its sums, a target each.
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

struct Sweep<'a, G, O> {
    gather: &'a G,
    out: O,
    wide: bool,
}

impl<G: Gather, O: Sums<G::Sum>> WithKernel for Sweep<'_, G, O> {
    type Out = ();
    fn with<K: Shape>(self) {
        WithPairs::with::<K, ElasticPair>(self);
    }
}

impl<G: Gather, O: Sums<G::Sum>> WithPairs for Sweep<'_, G, O> {
    fn with<K: Shape, D: PairDissipation>(self) {
        let Sweep { gather, out, wide } = self;
        parallel::each_piece(out.pieces(), |c, out| {
            simd::run(wide, Piece::<G, O, K, D> { gather, first: c * CHUNK, out, pairs: PhantomData });
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
    fn run<R: Number>(self, zero: R) {
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

/// E4 + E5 (R1): dρ/dt of every fluid particle.
pub(crate) struct DensityRate<'a> {
    pub fluid: &'a [Row],
    pub faces: &'a [Face],
    pub rho: &'a [f64],
    pub search: &'a Search,
    pub constants: Constants,
    /// Walls reflect the velocity (E10).
    pub reflecting: bool,
}

impl Gather for DensityRate<'_> {
    type Sum = f64;
    #[inline(always)]
    fn gather<R: Number, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [f64; LANES] {
        let DensityRate { fluid, faces, rho, search, constants, reflecting } = self;
        let (a, c) = (Row::targets(fluid, first, zero), constants.spread(zero));
        let rho_a = zero.each(|k| rho[(first + k).min(rho.len() - 1)]);
        let near = search.fluid.around(first, zero, fluid);
        let walls = listed(&search.walls_of_fluid, *reflecting).around(first, zero, faces);
        let rate = match R::WIDTH > 1 && search.fluid.alike(first) {
            true => pair::density_rate::<R, K, D>(&a, rho_a, near, walls, Alike::new::<K>(a.h), &c),
            false => pair::density_rate::<R, K, D>(&a, rho_a, near, walls, Mean, &c),
        };
        rate.lanes()
    }
}

/// E9: what every wall particle extrapolates from the fluid.
pub(crate) struct WallState<'a> {
    pub fluid: &'a [Row],
    pub walls: &'a [Row],
    pub acceleration: (&'a [f64], &'a [f64]),
    pub search: &'a Search,
    pub constants: Constants,
}

impl Gather for WallState<'_> {
    type Sum = Extrapolated;
    #[inline(always)]
    fn gather<R: Number, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [Extrapolated; LANES] {
        let WallState { fluid, walls, acceleration: (ax, ay), search, constants } = self;
        let acceleration = [ax, ay].map(|a| zero.each(|k| a[(first + k).min(a.len() - 1)]));
        let near = search.fluid_of_wall.around(first, zero, fluid);
        let wall = Row::targets(walls, first, zero);
        pair::extrapolate::<R, K>(&wall, acceleration, near, &constants.spread(zero)).lanes()
    }
}

/// Where the momentum sweep puts its sums: forces [N/m] where accelerations will stand, and how neighbours lie.
pub(crate) struct Forces<'a> {
    pub x: &'a mut [f64],
    pub y: &'a mut [f64],
    pub around: &'a mut [Surroundings],
}

impl Sums<Gathered> for Forces<'_> {
    fn pieces(self) -> Vec<Self> {
        let (x, y) = (self.x.chunks_mut(CHUNK), self.y.chunks_mut(CHUNK));
        let pieces = x.zip(y).zip(self.around.chunks_mut(CHUNK));
        pieces.map(|((x, y), around)| Forces { x, y, around }).collect()
    }
    #[inline(always)]
    fn count(&self) -> usize {
        self.x.len()
    }
    #[inline(always)]
    fn put(&mut self, k: usize, sum: Gathered) {
        [self.x[k], self.y[k]] = sum.force;
        self.around[k] = sum.around;
    }
}

/// E6–E8 (R2), E12–E14: force on every fluid particle, and how its neighbours lie.
pub(crate) struct Momentum<'a> {
    pub fluid: &'a [Row],
    pub walls: &'a [Row],
    pub search: &'a Search,
    pub constants: Constants,
    pub wall_nu: f64,
    /// Walls push by their pressure (E6).
    pub pushing: bool,
}

impl Gather for Momentum<'_> {
    type Sum = Gathered;
    #[inline(always)]
    fn gather<R: Number, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [Gathered; LANES] {
        let Momentum { fluid, walls, search, constants, wall_nu, pushing } = self;
        let (a, c, wall_nu) = (Row::targets(fluid, first, zero), constants.spread(zero), zero.of(*wall_nu));
        let near = search.fluid.around(first, zero, fluid);
        let near_walls = listed(&search.walls_of_fluid, *pushing).around(first, zero, walls);
        let sums = match R::WIDTH > 1 && search.fluid.alike(first) {
            true => pair::momentum::<R, K, D>(&a, near, near_walls, Alike::new::<K>(a.h), &c, wall_nu),
            false => pair::momentum::<R, K, D>(&a, near, near_walls, Mean, &c, wall_nu),
        };
        sums.lanes()
    }
}

/// The fluid's force on every wall particle.
pub(crate) struct WallForce<'a> {
    pub fluid: &'a [Row],
    pub walls: &'a [Row],
    pub search: &'a Search,
    pub constants: Constants,
    pub wall_nu: f64,
}

impl Gather for WallForce<'_> {
    type Sum = [f64; 2];
    #[inline(always)]
    fn gather<R: Number, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [[f64; 2]; LANES] {
        let WallForce { fluid, walls, search, constants, wall_nu } = self;
        let near = search.fluid_of_wall.around(first, zero, fluid);
        let wall = Row::targets(walls, first, zero);
        let [x, y] = pair::wall_force::<R, K>(&wall, near, &constants.spread(zero), zero.of(*wall_nu));
        let (x, y) = (x.lanes(), y.lanes());
        std::array::from_fn(|k| [x[k], y[k]])
    }
}
