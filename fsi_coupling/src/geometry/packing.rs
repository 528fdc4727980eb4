//! Packed water around a body at t = 0 (THEORY WC20): the number of cells is that of the free area, their positions are relaxed.

use sph_core::neighbours::cells::{Cells, Point};
use sph_core::{Kernel, Walls};

use crate::geometry::layout::Cell;

/// Samples along a side of a cell that the body's surface may cut.
const SAMPLES: usize = 8;
/// Cells move up to this distance from the body [spacings].
const REACH: f64 = 6.0;
/// Iterations, and the share of h²∇C that a cell moves in one.
const ITERATIONS: usize = 150;
const SHARE: f64 = 0.25;
/// Longest displacement in an iteration [spacings].
const LONGEST: f64 = 0.05;
/// Nearest that a cell's middle gets to the plane of symmetry [spacings]: beyond it its own image would push it on.
const BEFORE_PLANE: f64 = 0.1;

/// The boundary of the water, and the kernel.
pub struct Packing<'a> {
    /// Distance of a point from the body's surface [m], positive in the water.
    pub signed_distance: &'a dyn Fn([f64; 2]) -> f64,
    /// Every boundary particle, in place.
    pub walls: &'a Walls,
    /// The kernel, and h over the spacing.
    pub kernel: Kernel,
    /// h over the spacing [-].
    pub ratio: f64,
    /// Mirror plane x = 0.
    pub mirrored: bool,
}

/// Share of a cell that is water [-].
fn share(cell: &Cell, signed_distance: impl Fn([f64; 2]) -> f64) -> f64 {
    let reach = 0.5 * cell.size[0].hypot(cell.size[1]);
    let distance = signed_distance(cell.at);
    if distance.abs() >= reach {
        return if distance > 0.0 { 1.0 } else { 0.0 };
    }
    let offset = |k: usize| (k as f64 + 0.5) / SAMPLES as f64 - 0.5;
    let wet = |i: usize, j: usize| {
        let at = [cell.at[0] + offset(i) * cell.size[0], cell.at[1] + offset(j) * cell.size[1]];
        signed_distance(at) > 0.0
    };
    let count = (0..SAMPLES * SAMPLES).filter(|k| wet(k % SAMPLES, k / SAMPLES)).count();
    count as f64 / (SAMPLES * SAMPLES) as f64
}

/// WC20: of the cells that the body's surface cuts, those with most water in them, as many as give the area of the water.
pub fn choose(cells: Vec<Cell>, signed_distance: impl Fn([f64; 2]) -> f64) -> Vec<Cell> {
    let shares: Vec<f64> = cells.iter().map(|cell| share(cell, &signed_distance)).collect();
    let mut cut: Vec<usize> = (0..cells.len()).filter(|&k| shares[k] > 0.0 && shares[k] < 1.0).collect();
    let mut room: f64 = cut.iter().map(|&k| shares[k] * cells[k].area()).sum();
    cut.sort_by(|&a, &b| shares[b].total_cmp(&shares[a])); // stable: of equals the first
    let mut kept: Vec<bool> = shares.iter().map(|&share| share == 1.0).collect();
    for k in cut {
        let area = cells[k].area();
        kept[k] = room >= 0.5 * area;
        room -= if kept[k] { area } else { 0.0 };
    }
    cells.into_iter().zip(kept).filter_map(|(cell, keep)| keep.then_some(cell)).collect()
}

impl Packing<'_> {
    /// WC20: move the middles of the cells near the body down the gradient of Σ V W until the concentration is uniform. `level` is the
    /// surface's height at x [m]: above it stand the images of the cells below, so that the surface stays.
    pub fn relax(&self, cells: &mut [Cell], level: impl Fn(f64) -> f64) {
        let spacing = |cell: &Cell| cell.area().sqrt();
        let near: Vec<usize> =
            (0..cells.len()).filter(|&k| (self.signed_distance)(cells[k].at) < REACH * spacing(&cells[k])).collect();
        let bounds: Vec<([f64; 2], f64, f64)> = (0..self.walls.len())
            .map(|k| ([self.walls.x[k], self.walls.y[k]], self.walls.h[k], self.walls.volume[k]))
            .collect();
        for _ in 0..ITERATIONS {
            let mut around = bounds.clone();
            for cell in cells.iter() {
                let (h, area) = (self.ratio * spacing(cell), cell.area());
                let rise = level(cell.at[0]) - cell.at[1];
                around.push((cell.at, h, area));
                let above = [cell.at[0], cell.at[1] + 2.0 * rise];
                if rise < 2.0 * h && (self.signed_distance)(above) > 0.0 {
                    around.push((above, h, area));
                }
                if self.mirrored && cell.at[0] < 2.0 * h {
                    around.push(([-cell.at[0], cell.at[1]], h, area));
                }
            }
            let point = |(k, &(at, h, _)): (usize, &([f64; 2], f64, f64))| Point::at_rest(at, h, k as u32);
            let sorted = Cells::build(&around.iter().enumerate().map(point).collect::<Vec<_>>());
            let moves: Vec<[f64; 2]> = near.iter().map(|&k| self.step(&cells[k], &around, &sorted)).collect();
            for (&k, way) in near.iter().zip(moves) {
                let cell = &mut cells[k];
                let to = [cell.at[0] + way[0], cell.at[1] + way[1]];
                let margin = 0.3 * spacing(cell);
                let dry = (self.signed_distance)(to) <= margin.min((self.signed_distance)(cell.at));
                let beyond = self.mirrored && to[0] < BEFORE_PLANE * spacing(cell);
                if !dry && !beyond && level(to[0]) - to[1] > margin {
                    cell.at = to;
                }
            }
        }
    }

    /// −`SHARE` h² ∇C, no longer than `LONGEST` spacings [m].
    fn step(&self, cell: &Cell, around: &[([f64; 2], f64, f64)], sorted: &Cells) -> [f64; 2] {
        let spacing = cell.area().sqrt();
        let h = self.ratio * spacing;
        let mut gradient = [0.0; 2];
        sorted.for_each_within(cell.at[0], cell.at[1], h, |p| {
            let (_, other, area) = around[p.index as usize];
            let (dx, dy) = (cell.at[0] - p.x, cell.at[1] - p.y);
            let r = dx.hypot(dy);
            if r > 1e-9 * h {
                let factor = area * self.kernel.gradient_factor(r, 0.5 * (h + other));
                gradient = [gradient[0] + factor * dx, gradient[1] + factor * dy];
            }
        });
        let way = gradient.map(|c| -SHARE * h * h * c);
        let length = way[0].hypot(way[1]);
        way.map(|w| if length > LONGEST * spacing { w * LONGEST * spacing / length } else { w })
    }
}
