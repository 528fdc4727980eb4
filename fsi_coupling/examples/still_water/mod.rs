//! A tank of still water for the examples: its surface is at y = 0.

use fsi_coupling::Tank;
use fsi_coupling::geometry::layout::{Basin, Cell, Layout};
use sph_core::{Domain, Fluid, Seed, wcsph};

/// A tank with walls at `x` and a floor [m], and its water: cells of `spacing` [m] in the zone `fine` (half width about x = 0 and depth), larger
/// ones outside it. A cell is water where `is_water` says so.
pub fn still_water(
    domain: Domain,
    (x, floor): ([f64; 2], f64),
    ([half_width, fine_depth], spacing): ([f64; 2], f64),
    is_water: impl Fn(&Cell) -> bool,
) -> (Fluid, Tank) {
    let fine_x = [-half_width, half_width];
    let growth = if half_width < x[1] { 1.1 } else { 1.0 };
    let layout = Layout::new(Basin { x, y: [floor, 0.0], fine_x, fine_depth, spacing, growth });
    let mut seeds = Vec::new();
    layout.for_each(|cell| {
        if is_water(&cell) {
            let pressure = domain.fluid.density * domain.gravity[1] * cell.at[1];
            seeds.push(Seed { at: cell.at, velocity: [0.0; 2], area: cell.area(), pressure });
        }
    });
    (Fluid::new(domain, &wcsph::Settings::default(), &seeds), Tank::new(layout, x, floor, 0.5, false))
}
