//! Schemes and options of the thesis of 2010 that the default schemes do not need: [`Compressible`]
//! is the weakly compressible scheme with other integrators, density filters, walls, turbulence and an ideal gas;
//! [`pilorget2010`] is the thesis's projection.

mod compressible;
mod density_filter;
mod dynamic_walls;
mod ideal_gas;
mod mirror_point;
mod multistep;
pub mod pilorget2010;
mod repulsive;
mod settings;
mod steps;
mod summation;
#[cfg(test)]
mod tests;
mod turbulence;
mod updates;
mod xsph;

use crate::interactions::geometry::{PairGeometry, pair_geometry};
use crate::interactions::packed_particle::PackedParticle;
use crate::kernel::Shape;
use crate::system::ParticleSystem;

pub use ideal_gas::IdealGas;
pub use pilorget2010::ThesisSettings;
pub use settings::*;

/// A fluid neighbour: its index as listed, the particle or image, and the geometry of the pair.
type FluidPair<'a> = (u32, &'a PackedParticle, PairGeometry);

/// The fluid neighbours of particle `k` within the kernel, as last packed.
#[inline(always)]
fn fluid_pairs<K: Shape>(system: &ParticleSystem, k: usize) -> impl Iterator<Item = FluidPair<'_>> {
    let (fluid, a) = (&system.packed.fluid, &system.packed.fluid[k]);
    system.neighbours.fluid.of(k).filter_map(move |j| {
        let b = &fluid[j as usize];
        Some((j, b, pair_geometry::<K>(a.x, a.y, a.h, b.x, b.y, b.h)?))
    })
}
