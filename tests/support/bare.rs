//! Fluids without bodies: lattices of particles with a given field, and the loop that steps them.

use crate::parameters::Parameters;
use sph_core::wcsph::eos::Tait;
use sph_core::{Breakdown, Fluid, Seed, Walls};

/// The scheme as scenes have it by default, of density 1000 kg/m³ and without gravity; `c0` sound speed [m/s].
pub fn parameters(c0: f64) -> Parameters {
    Parameters::usual(Tait { rho0: 1000.0, c0, gamma: 7.0 })
}

/// Squares of `spacing` [m] whose middles are in `from..to` along each axis, those for which `seed` gives a state.
pub fn lattice(
    from: [f64; 2],
    to: [f64; 2],
    spacing: f64,
    seed: impl Fn([f64; 2]) -> Option<([f64; 2], f64)>,
) -> Vec<Seed> {
    let [columns, rows] = [0, 1].map(|k| ((to[k] - from[k]) / spacing).round() as usize);
    let middle = |i: usize, j: usize| [from[0] + (i as f64 + 0.5) * spacing, from[1] + (j as f64 + 0.5) * spacing];
    let places = (0..rows).flat_map(|j| (0..columns).map(move |i| middle(i, j)));
    places
        .filter_map(|at| seed(at).map(|(velocity, pressure)| Seed { at, velocity, area: spacing * spacing, pressure }))
        .collect()
}

/// Evaluate the first forces, then step until `end` [s], each step as long as is stable; the last one ends there.
pub fn advance(fluid: &mut Fluid, walls: &mut Walls, end: f64, mut watch: impl FnMut(&Fluid)) -> Result<(), Breakdown> {
    if fluid.steps() == 0 {
        fluid.initialise(walls)?;
    }
    while end - fluid.time() > 1e-12 * end {
        let left = end - fluid.time();
        let steps = (left / fluid.stable_dt(walls)?).ceil();
        fluid.step(walls, left / steps)?;
        watch(fluid);
    }
    Ok(())
}
