//! The four sweeps of a step: which rows meet in which sum. One dispatch on kernel and dissipation each.

use crate::dissipation::{PairDissipation, WithPairs};
use crate::kernel::{Shape, WithKernel};
use crate::pair::{self, Constants, Extrapolated, Face, Gathered, Row};
use crate::search::Search;
use crate::sweep;

/// E4 + E5 (R1): dρ/dt of every fluid particle.
pub(crate) struct DensityRate<'a> {
    pub fluid: &'a [Row],
    pub faces: &'a [Face],
    pub rho: &'a [f64],
    pub search: &'a Search,
    pub constants: Constants,
    /// Walls reflect the velocity (E10).
    pub reflecting: bool,
    pub out: &'a mut [f64],
}

impl WithPairs for DensityRate<'_> {
    fn with<K: Shape, D: PairDissipation>(self) {
        let DensityRate { fluid, faces, rho, search, constants, reflecting, out } = self;
        sweep::gather_into(out, |k| {
            let near = search.fluid.of(k).iter().map(|&j| &fluid[j as usize]);
            let listed = if reflecting { search.walls_of_fluid.of(k) } else { &[] };
            let walls = listed.iter().map(|&j| &faces[j as usize]);
            pair::density_rate::<K, D>(&fluid[k], rho[k], near, walls, &constants)
        });
    }
}

/// E9: what every wall particle extrapolates from the fluid.
pub(crate) struct WallState<'a> {
    pub fluid: &'a [Row],
    pub walls: &'a [Row],
    pub acceleration: (&'a [f64], &'a [f64]),
    pub search: &'a Search,
    pub constants: Constants,
    pub out: &'a mut [Extrapolated],
}

impl WithKernel for WallState<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let WallState { fluid, walls, acceleration: (ax, ay), search, constants, out } = self;
        sweep::gather_into(out, |k| {
            let near = search.fluid_of_wall.of(k).iter().map(|&j| &fluid[j as usize]);
            pair::extrapolate::<K>(&walls[k], [ax[k], ay[k]], near, &constants)
        });
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
    pub out: &'a mut [Gathered],
}

impl WithPairs for Momentum<'_> {
    fn with<K: Shape, D: PairDissipation>(self) {
        let Momentum { fluid, walls, search, constants, wall_nu, pushing, out } = self;
        sweep::gather_into(out, |k| {
            let near = search.fluid.of(k).iter().map(|&j| &fluid[j as usize]);
            let listed = if pushing { search.walls_of_fluid.of(k) } else { &[] };
            let near_walls = listed.iter().map(|&j| &walls[j as usize]);
            pair::momentum::<K, D>(&fluid[k], near, near_walls, &constants, wall_nu)
        });
    }
}

/// The fluid's force on every wall particle.
pub(crate) struct WallForce<'a> {
    pub fluid: &'a [Row],
    pub walls: &'a [Row],
    pub search: &'a Search,
    pub constants: Constants,
    pub wall_nu: f64,
    pub out: &'a mut [[f64; 2]],
}

impl WithKernel for WallForce<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let WallForce { fluid, walls, search, constants, wall_nu, out } = self;
        sweep::gather_into(out, |k| {
            let near = search.fluid_of_wall.of(k).iter().map(|&j| &fluid[j as usize]);
            pair::wall_force::<K>(&walls[k], near, &constants, wall_nu)
        });
    }
}
