//! What the program chooses around rigid, closed bodies that start under water.

use settings::{Problem, require};
use sph_core::{Auto, Dissipation};

use crate::draft::Draft;
use crate::legacy::{self, Options};

/// Artificial viscosity α [-]. With the usual one, and without `wall_stretch`, a cylinder of half the water's density, 10 spacings across, rises 15 %
/// too slowly instead of 2 %.
const VISCOSITY: f64 = 0.005;
/// Shift of a projection (THEORY PR14) [-]: with 1 that cylinder, 20 spacings across, is 4.4 instead of 3.2 % too slow.
const SHIFT: f64 = 3.0;
/// Calming of a projection (THEORY PR13) [-]: the usual one takes 2 % of its speed.
const CALMING: f64 = 0.02;

/// Keys of weakly compressible water.
pub(crate) fn fill_weakly_compressible(draft: &mut Draft, options: &Options) {
    let by_diffusion = draft.get("fluid.dissipation") != Some(Dissipation::Riemann);
    if by_diffusion && legacy::holds_geometry(options) {
        draft.fill("fluid.wall_stretch", true);
        draft.fill("fluid.artificial_viscosity", VISCOSITY);
    }
}

/// The pressure of still water acts by itself (THEORY WC29) where geometry is found in each step.
pub(crate) fn fill_still_pressure(draft: &mut Draft, options: &Options, under_water: bool) -> Result<(), Problem> {
    let each_step = draft.get("fluid.acoustic_steps").is_none_or(|steps: Auto<u32>| steps.or(1) == 1);
    let acts = each_step && legacy::holds_geometry(options);
    let still = draft.fill("fluid.still_pressure", under_water && acts);
    let expected = "false with fluid.acoustic_steps above 1 or an option of 2010";
    require(acts || !still, "fluid.still_pressure", still, expected)
}

/// Keys of a projection.
pub(crate) fn fill_projection(draft: &mut Draft) {
    draft.fill("projection.shift", SHIFT);
    draft.fill("projection.calming", CALMING);
}
