//! The four sweeps of a step: which rows meet in which sum.

use std::marker::PhantomData;

use crate::dissipation::{ElasticPair, PairDissipation, WithPairs};
use crate::kernel::{Shape, WithKernel};
use crate::lanes::{self, LANES, Number, Task};
use crate::neighbours::{Lists, NONE};
use crate::pair::{self, Alike, Constants, Extrapolated, Face, Gathered, Mean, Row};
use crate::parameters::Parameters;
use crate::search::Search;
use crate::sweep::{self, CHUNK};

/// What a sweep gathers for its targets, side by side.
pub(crate) trait Gather: Sync {
    /// A target's sum.
    type Sum: Send;
    /// Sums of the targets from `first` on, as many as an `R` is wide.
    fn gather<R: Number, K: Shape, D: PairDissipation>(&self, first: usize, zero: R) -> [Self::Sum; LANES];
}

impl Parameters {
    /// `out[k]` ← the sum of target k: one dispatch on kernel and dissipation a sweep, one on the processor a chunk.
    pub(crate) fn sweep<G: Gather>(&self, gather: &G, out: &mut [G::Sum]) {
        self.with_pairs(Sweep { gather, out, wide: self.wide });
    }

    /// The same for sums in which fluid does not meet fluid, and nothing dissipates.
    pub(crate) fn sweep_walls<G: Gather>(&self, gather: &G, out: &mut [G::Sum]) {
        self.kernel.run(Sweep { gather, out, wide: self.wide });
    }
}

struct Sweep<'a, G: Gather> {
    gather: &'a G,
    out: &'a mut [G::Sum],
    wide: bool,
}

impl<G: Gather> WithKernel for Sweep<'_, G> {
    type Out = ();
    fn with<K: Shape>(self) {
        WithPairs::with::<K, ElasticPair>(self);
    }
}

impl<G: Gather> WithPairs for Sweep<'_, G> {
    fn with<K: Shape, D: PairDissipation>(self) {
        let Sweep { gather, out, wide } = self;
        sweep::update_pieces(out, CHUNK, |c, out| {
            lanes::run(wide, Piece::<G, K, D> { gather, first: c * CHUNK, out, pairs: PhantomData });
        });
    }
}

struct Piece<'a, G: Gather, K, D> {
    gather: &'a G,
    first: usize,
    out: &'a mut [G::Sum],
    pairs: PhantomData<(K, D)>,
}

impl<G: Gather, K: Shape, D: PairDissipation> Task for Piece<'_, G, K, D> {
    type Out = ();
    #[inline(always)]
    fn run<R: Number>(self, zero: R) {
        for (c, out) in self.out.chunks_mut(R::WIDTH).enumerate() {
            let sums = self.gather.gather::<R, K, D>(self.first + c * R::WIDTH, zero);
            out.iter_mut().zip(sums).for_each(|(out, sum)| *out = sum);
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
