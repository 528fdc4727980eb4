//! Where the air is: holes between the particles, and which of them are large enough to be air (THEORY PR5).

use crate::parallel;
use crate::projection::free_surface::occupancy_grid::OccupancyGrid;
use crate::projection::lattice::Lattice;
use crate::projection::operators::Operators;
use crate::system::ParticleSystem;
use crate::walls::Walls;

/// Cells per spacing.
const CELLS: f64 = 2.0;
/// A cell is covered by a particle nearer than this many of its spacings.
const COVER: f64 = 1.0;
/// Sizes of holes [spacings²]: below the first no air, above the second nothing else.
const HOLE: [f64; 2] = [1.0, 4.0];
/// Air is felt in full up to the first distance beyond the support [spacings], not beyond the second.
const FEEL: [f64; 2] = [0.1, 0.5];
/// Missing share of a kernel sum that shows air for certain, unless less is missing in a row of a flat surface [-].
const FAINT: f64 = 0.001;

/// Relative error of spacings that are a power of two apart [-].
const ROUNDING: f64 = 1e-9;

/// How near air is.
#[derive(Clone, Debug, Default)]
pub struct SurfaceDetection {
    /// 1 beside air, 0 far from it [-], per particle.
    indicator: Vec<f64>,
    /// Share of each wall particle that water meets [-].
    wet: Vec<f64>,
    grids: Vec<OccupancyGrid>,
    offsets: Vec<(i32, i32, f64)>,
    least: f64,
}

/// Doublings of the least spacing that a spacing is worth: which grid it reads.
fn level(dx: f64, least: f64) -> usize {
    let (mut level, mut next) = (0, 2.0 * (1.0 - ROUNDING) * least);
    while dx >= next {
        (level, next) = (level + 1, 2.0 * next);
    }
    level
}

impl SurfaceDetection {
    /// 1 beside air, 0 far from it [-], per particle.
    pub fn indicator(&self) -> &[f64] {
        &self.indicator
    }

    /// How much a place is air [-], for a particle of spacing `dx` there.
    pub(crate) fn share_at(&self, x: f64, y: f64, dx: f64) -> f64 {
        let Some(grid) = self.grids.get(level(dx, self.least)).filter(|r| r.columns > 0) else { return 0.0 };
        let [fx, fy] = grid.cell([x, y]);
        let (i, j) = (fx.floor(), fy.floor());
        let (s, t) = (fx - i, fy - j);
        let (columns, rows) = (grid.columns as f64, grid.rows as f64);
        let at = |i: f64, j: f64| match i < 0.0 || j < 0.0 || i >= columns || j >= rows {
            true => f64::from(u8::from(j >= rows)), // above everything is air
            false => grid.share(i as usize, j as usize),
        };
        (1.0 - t) * ((1.0 - s) * at(i, j) + s * at(i + 1.0, j))
            + t * ((1.0 - s) * at(i, j + 1.0) + s * at(i + 1.0, j + 1.0))
    }
}

impl SurfaceDetection {
    /// PR5: a wall particle whose mirror point is air is dry: it fills nothing and has no pressure.
    pub(crate) fn mark_dry_walls(&mut self, system: &mut ParticleSystem, walls: &Walls) {
        let ratio = system.domain.fluid.smoothing_ratio;
        let n = walls.len();
        let (fluid, rows, mirror) = (&system.packed.fluid, &system.packed.walls, system.domain.mirror);
        let near_mirror_points = &system.neighbours.fluid_of_mirror;
        let mut wet = std::mem::take(&mut self.wet);
        wet.resize(n, 1.0);
        parallel::gather_into(&mut wet, |k| {
            let (x, y) = (rows[k].x, rows[k].y);
            let (x, y) = (x + 2.0 * walls.depth[k] * walls.nx[k], y + 2.0 * walls.depth[k] * walls.ny[k]);
            let dx = walls.h[k] / ratio;
            let square = |j: u32| (fluid[j as usize].x - x).powi(2) + (fluid[j as usize].y - y).powi(2);
            let nearest = near_mirror_points.of(k).map(square).fold(f64::INFINITY, f64::min).sqrt() / dx;
            let apart = ((nearest - 0.75) / 0.25).clamp(0.0, 1.0);
            if apart == 0.0 {
                return 1.0;
            }
            let x = mirror.map_or(x, |m| if x < m.at { m.reflect(x) } else { x });
            let d = 1.4 * dx;
            let places = [(d, 0.0), (-d, 0.0), (0.0, d), (0.0, -d), (d, d), (d, -d), (-d, d), (-d, -d)];
            let share = places.iter().map(|(a, b)| self.share_at(x + a, y + b, dx)).fold(0.0, f64::max);
            1.0 - apart * share
        });
        for (k, row) in system.packed.walls.iter_mut().enumerate() {
            let k = if k < n { k } else { system.neighbours.wall_images[k - n] as usize };
            row.volume *= wet[k];
            row.raw_volume *= wet[k];
        }
        self.wet = wet;
    }

    /// PR5: which particles feel air, and how much.
    pub(crate) fn detect(&mut self, system: &ParticleSystem, walls: &Walls) {
        let ratio = system.domain.fluid.smoothing_ratio;
        let p = &system.particles;
        let n = p.len();
        self.indicator.clear();
        self.indicator.resize(n, 0.0);
        let least = p.h.iter().fold(f64::INFINITY, |a, &h| a.min(h)) / ratio;
        self.least = least;
        let of = |h: &[f64]| -> Vec<usize> { h.iter().map(|h| level(h / ratio, least)).collect() };
        let (of_fluid, of_walls) = (of(&p.h), of(&walls.h));
        let levels = of_fluid.iter().max().map_or(0, |l| l + 1);
        let mut boxes = vec![([f64::MAX; 2], [f64::MIN; 2]); levels];
        for k in 0..n {
            let (lo, hi) = &mut boxes[of_fluid[k]];
            *lo = [lo[0].min(p.x[k]), lo[1].min(p.y[k])];
            *hi = [hi[0].max(p.x[k]), hi[1].max(p.y[k])];
        }
        self.grids.resize(levels, OccupancyGrid::default());
        let (mirror, periodic) = (system.domain.mirror, system.domain.periodic.unwrap_or_default());
        for l in 0..levels {
            let (finer, rest) = self.grids.split_at_mut(l);
            let (grid, (lo, hi)) = (&mut rest[0], boxes[l]);
            if lo[0] > hi[0] {
                *grid = OccupancyGrid::default();
                continue;
            }
            grid.lay(lo, hi, least * f64::powi(2.0, l as i32) / CELLS);
            for finer in finer {
                grid.copy(finer);
            }
            let mut cover = |x: f64, y: f64, h: f64| {
                let radius = COVER * h / ratio;
                grid.add(x, y, radius);
                if let Some(mirror) = mirror {
                    let image = mirror.reflect(x);
                    if image > lo[0] - 16.0 * grid.side {
                        grid.add(image, y, radius);
                    }
                }
                for shift in periodic.shifts() {
                    grid.add(x + shift[0], y + shift[1], radius); // OP9, PR17
                }
            };
            for k in (0..n).filter(|&k| of_fluid[k] >= l) {
                cover(p.x[k], p.y[k], p.h[k]);
            }
            if let Some(mirror) = mirror {
                // a finer grid holds the images beside its own box only
                for k in (0..n).filter(|&k| of_fluid[k] < l) {
                    cover(mirror.reflect(p.x[k]), p.y[k], p.h[k]);
                }
            }
            for k in (0..walls.len()).filter(|&k| of_walls[k] >= l) {
                let [dx, dy] = walls.displacement(k, -walls.dt);
                cover(walls.x[k] + dx, walls.y[k] + dy, walls.h[k]);
            }
            let size = |cells: f64| cells / (CELLS * CELLS);
            grid.classify(|cells| ((size(cells) - HOLE[0]) / (HOLE[1] - HOLE[0])).clamp(0.0, 1.0));
        }
    }

    /// PR5: how much air each particle feels, 1 beside air, 0 far from it. Call after `detect`.
    pub(crate) fn set_indicator(&mut self, system: &ParticleSystem, operators: &Operators, lattice: &Lattice) {
        let ratio = system.domain.fluid.smoothing_ratio;
        let p = &system.particles;
        let feel = FEEL.map(|margin| 2.0 * ratio + margin);
        let faint = lattice.faintest().min(FAINT);
        let least = self.least;
        if self.offsets.is_empty() {
            let reach = (feel[1] * CELLS * 2.0).ceil() as i32 + 1;
            for i in -reach..=reach {
                for j in -reach..=reach {
                    let r = f64::from(i).hypot(f64::from(j));
                    if r <= feel[1] * CELLS * 2.0 {
                        self.offsets.push((i, j, r));
                    }
                }
            }
            self.offsets.sort_by(|a, b| a.2.total_cmp(&b.2));
        }
        let (grids, offsets, around) = (&self.grids, &self.offsets, &operators.around);
        let indicator = &mut self.indicator;
        parallel::gather_into(indicator, |k| {
            let missing = ((1.0 - around[k].kernel_sum / lattice.kernel_sum) / faint).clamp(0.0, 1.0);
            if missing == 0.0 {
                return 0.0;
            }
            let dx = p.h[k] / ratio;
            let grid = &grids[level(dx, least)];
            let [x, y] = grid.cell([p.x[k], p.y[k]]);
            let (ci, cj) = ((x + 0.5) as i32, (y + 0.5) as i32);
            let reach = (feel[1] * dx / grid.side).ceil() as i32 + 1;
            if !(grid.may_have_air(ci, cj, reach) && grid.is_open_within(ci, cj, reach)) {
                return 0.0;
            }
            let mut best = 0.0_f64;
            for &(i, j, r) in offsets {
                // a cell so far away shows no more than this
                if feel[1] - (r - 0.75) * grid.side / dx <= best * (feel[1] - feel[0]) {
                    break;
                }
                let (a, b) = (ci + i, cj + j);
                if a < 0 || b < 0 || a >= grid.columns as i32 || b >= grid.rows as i32 {
                    continue;
                }
                let share = grid.share(a as usize, b as usize);
                if share == 0.0 {
                    continue;
                }
                let (rx, ry) = (f64::from(a) - x, f64::from(b) - y);
                let r = (rx * rx + ry * ry).sqrt() * grid.side / dx;
                best = best.max(share * ((feel[1] - r) / (feel[1] - feel[0])).clamp(0.0, 1.0));
            }
            best * missing
        });
    }
}
