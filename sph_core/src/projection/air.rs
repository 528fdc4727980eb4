//! Where the air is: holes between the particles, and which of them are large enough to be air (THEORY I5).

use crate::fluid::Fluid;
use crate::walls::Walls;

/// Cells per spacing.
const CELLS: f64 = 2.0;
/// A cell is covered by a particle nearer than this many of its spacings.
const COVER: f64 = 1.0;
/// Sizes of holes [spacings²]: below the first no air, above the second nothing else.
const HOLE: [f64; 2] = [1.0, 4.0];
/// Air is felt in full up to the first distance beyond the support [spacings], not beyond the second.
const FEEL: [f64; 2] = [0.1, 0.5];
/// Share of a filling whose lack shows air for certain, unless rows of a flat surface lack less [-].
const FAINT: f64 = 0.001;

/// How near air is.
#[derive(Clone, Debug, Default)]
pub struct Air {
    /// 1 beside air, 0 far from it [-], per particle.
    pub exposure: Vec<f64>,
    grids: Vec<Grid>,
    stack: Vec<u32>,
    offsets: Vec<(i32, i32, f64)>,
    least: f64,
}

#[derive(Clone, Debug, Default)]
struct Grid {
    origin: [f64; 2],
    side: f64,
    columns: usize,
    rows: usize,
    /// 0 open, not yet seen; 1 covered; 2 + share of air · 253.
    state: Vec<u8>,
}

impl Grid {
    fn lay(&mut self, lo: [f64; 2], hi: [f64; 2], side: f64) {
        let margin = 8.0 * side;
        self.origin = [lo[0] - margin, lo[1] - margin];
        self.side = side;
        self.columns = ((hi[0] - lo[0] + 2.0 * margin) / side) as usize + 1;
        self.rows = ((hi[1] - lo[1] + 2.0 * margin) / side) as usize + 1;
        self.state.clear();
        self.state.resize(self.columns * self.rows, 0);
    }

    fn cover(&mut self, x: f64, y: f64, radius: f64) {
        let (fx, fy) = ((x - self.origin[0]) / self.side - 0.5, (y - self.origin[1]) / self.side - 0.5);
        let r = radius / self.side;
        if fx + r < 0.0 || fy + r < 0.0 || fx - r > self.columns as f64 || fy - r > self.rows as f64 {
            return;
        }
        let rows =
            ((fy - r).ceil().max(0.0) as usize)..((fy + r).floor() as i64 + 1).clamp(0, self.rows as i64) as usize;
        for j in rows {
            let dy = j as f64 - fy;
            let half = (r * r - dy * dy).max(0.0).sqrt();
            let from = (fx - half).ceil().max(0.0) as usize;
            let to = ((fx + half).floor() as i64 + 1).clamp(0, self.columns as i64) as usize;
            if from < to {
                self.state[j * self.columns + from..j * self.columns + to].fill(1);
            }
        }
    }

    /// Give every hole its share of air, by its size.
    fn judge(&mut self, stack: &mut Vec<u32>) {
        let cell = 1.0 / (CELLS * CELLS);
        let (columns, rows) = (self.columns, self.rows);
        for start in 0..self.state.len() {
            if self.state[start] != 0 {
                continue;
            }
            stack.clear();
            stack.push(start as u32);
            self.state[start] = 2;
            let mut at = 0;
            while at < stack.len() {
                let c = stack[at] as usize;
                at += 1;
                let (i, j) = (c % columns, c / columns);
                let mut visit = |n: usize| {
                    if self.state[n] == 0 {
                        self.state[n] = 2;
                        stack.push(n as u32);
                    }
                };
                if i > 0 {
                    visit(c - 1);
                }
                if i + 1 < columns {
                    visit(c + 1);
                }
                if j > 0 {
                    visit(c - columns);
                }
                if j + 1 < rows {
                    visit(c + columns);
                }
            }
            let area = stack.len() as f64 * cell;
            let share = ((area - HOLE[0]) / (HOLE[1] - HOLE[0])).clamp(0.0, 1.0);
            let mark = 2 + (share * 253.0) as u8;
            for &c in stack.iter() {
                self.state[c as usize] = mark;
            }
        }
    }
}

impl Air {
    /// How much a place is air [-], for a particle of spacing `dx` there.
    pub(super) fn share_at(&self, x: f64, y: f64, dx: f64) -> f64 {
        let level = ((dx / self.least).log2() + 1e-9).floor().max(0.0) as usize;
        let Some(grid) = self.grids.get(level).filter(|g| g.columns > 0) else { return 0.0 };
        let (fx, fy) = ((x - grid.origin[0]) / grid.side - 0.5, (y - grid.origin[1]) / grid.side - 0.5);
        let (i, j) = (fx.floor(), fy.floor());
        let (s, t) = (fx - i, fy - j);
        let at = |i: f64, j: f64| {
            if i < 0.0 || j < 0.0 || i >= grid.columns as f64 || j >= grid.rows as f64 {
                return if j >= grid.rows as f64 { 1.0 } else { 0.0 };
            }
            let state = grid.state[j as usize * grid.columns + i as usize];
            if state <= 2 { 0.0 } else { f64::from(state - 2) / 253.0 }
        };
        (1.0 - t) * ((1.0 - s) * at(i, j) + s * at(i + 1.0, j))
            + t * ((1.0 - s) * at(i, j + 1.0) + s * at(i + 1.0, j + 1.0))
    }
}

impl Fluid {
    /// I5: a wall particle whose mirror point is air is dry: it fills nothing and bears no pressure.
    pub(super) fn dry_walls(&mut self, walls: &Walls) {
        let ratio = self.parameters.smoothing_ratio;
        let air = &self.projection.air;
        let n = walls.len();
        let wet = &mut self.projection.wet;
        wet.resize(n, 1.0);
        for k in 0..n {
            let (x, y) = (self.rows.walls[k].x, self.rows.walls[k].y);
            let (x, y) = (x + 2.0 * walls.depth[k] * walls.nx[k], y + 2.0 * walls.depth[k] * walls.ny[k]);
            let dx = walls.h[k] / ratio;
            let fluid = &self.rows.fluid;
            let square = |j: &u32| (fluid[*j as usize].x - x).powi(2) + (fluid[*j as usize].y - y).powi(2);
            let nearest =
                self.search.fluid_of_mirror.of(k).iter().map(square).fold(f64::INFINITY, f64::min).sqrt() / dx;
            let apart = ((nearest - 0.75) / 0.25).clamp(0.0, 1.0);
            wet[k] = 1.0;
            if apart > 0.0 {
                let x = self.parameters.mirror.map_or(x, |m| if x < m.at { m.reflect(x) } else { x });
                let d = 1.4 * dx;
                let places = [(d, 0.0), (-d, 0.0), (0.0, d), (0.0, -d), (d, d), (d, -d), (-d, d), (-d, -d)];
                let share = places.iter().map(|(a, b)| air.share_at(x + a, y + b, dx)).fold(0.0, f64::max);
                wet[k] -= apart * share;
            }
        }
        for (k, row) in self.rows.walls.iter_mut().enumerate() {
            let k = if k < n { k } else { self.search.wall_images[k - n] as usize };
            row.volume *= wet[k];
            row.fill *= wet[k];
        }
    }

    /// I5: which particles feel air, and how much.
    pub(super) fn find_air(&mut self, walls: &Walls) {
        let ratio = self.parameters.smoothing_ratio;
        let p = &self.particles;
        let n = p.len();
        let air = &mut self.projection.air;
        air.exposure.clear();
        air.exposure.resize(n, 0.0);
        let least = p.h.iter().fold(f64::INFINITY, |a, &h| a.min(h)) / ratio;
        air.least = least;
        let level = |h: f64| ((h / ratio / least).log2() + 1e-9).floor().max(0.0) as usize;
        let levels = p.h.iter().map(|&h| level(h)).max().map_or(0, |l| l + 1);
        let mut boxes = vec![([f64::MAX; 2], [f64::MIN; 2]); levels];
        for k in 0..n {
            let (lo, hi) = &mut boxes[level(p.h[k])];
            *lo = [lo[0].min(p.x[k]), lo[1].min(p.y[k])];
            *hi = [hi[0].max(p.x[k]), hi[1].max(p.y[k])];
        }
        air.grids.resize(levels, Grid::default());
        for (l, grid) in air.grids.iter_mut().enumerate() {
            let (lo, hi) = boxes[l];
            if lo[0] > hi[0] {
                *grid = Grid::default();
                continue;
            }
            grid.lay(lo, hi, least * f64::powi(2.0, l as i32) / CELLS);
            let (mirror, periodic) = (self.parameters.mirror, self.parameters.periodic.unwrap_or_default());
            let mut cover = |x: f64, y: f64, h: f64| {
                grid.cover(x, y, COVER * h / ratio);
                if let Some(mirror) = mirror {
                    let image = mirror.reflect(x);
                    if image > lo[0] - 16.0 * grid.side {
                        grid.cover(image, y, COVER * h / ratio);
                    }
                }
                for shift in periodic.shifts() {
                    grid.cover(x + shift[0], y + shift[1], COVER * h / ratio); // V1
                }
            };
            for k in 0..n {
                cover(p.x[k], p.y[k], p.h[k]);
            }
            for k in 0..walls.len() {
                let [dx, dy] = walls.displacement(k, -walls.dt);
                cover(walls.x[k] + dx, walls.y[k] + dy, walls.h[k]);
            }
            grid.judge(&mut air.stack);
        }
    }

    /// I5: exposure of every particle, once surveyed.
    pub(super) fn expose(&mut self) {
        let ratio = self.parameters.smoothing_ratio;
        let p = &self.particles;
        let feel = FEEL.map(|margin| 2.0 * ratio + margin);
        let lattice = self.projection.lattice.expect("surveyed");
        let faint = lattice.faintest().min(FAINT);
        let air = &mut self.projection.air;
        let least = air.least;
        if air.offsets.is_empty() {
            let reach = (feel[1] * CELLS * 2.0).ceil() as i32 + 1;
            for i in -reach..=reach {
                for j in -reach..=reach {
                    let r = f64::from(i).hypot(f64::from(j));
                    if r <= feel[1] * CELLS * 2.0 {
                        air.offsets.push((i, j, r));
                    }
                }
            }
            air.offsets.sort_by(|a, b| a.2.total_cmp(&b.2));
        }
        let level = |h: f64| ((h / ratio / least).log2() + 1e-9).floor().max(0.0) as usize;
        let (grids, offsets, around) = (&air.grids, &air.offsets, &self.projection.survey.around);
        crate::sweep::gather_into(&mut air.exposure, |k| {
            let lack = ((1.0 - around[k].filling / lattice.filling) / faint).clamp(0.0, 1.0);
            if lack == 0.0 {
                return 0.0;
            }
            let grid = &grids[level(p.h[k])];
            let dx = p.h[k] / ratio;
            let (ci, cj) =
                (((p.x[k] - grid.origin[0]) / grid.side) as i32, ((p.y[k] - grid.origin[1]) / grid.side) as i32);
            let mut best = 0.0_f64;
            for &(i, j, r) in offsets {
                if (r - 0.75) * grid.side > feel[1] * dx {
                    break;
                }
                let (a, b) = (ci + i, cj + j);
                if a < 0 || b < 0 || a >= grid.columns as i32 || b >= grid.rows as i32 {
                    continue;
                }
                let state = grid.state[b as usize * grid.columns + a as usize];
                if state <= 2 {
                    continue;
                }
                let share = f64::from(state - 2) / 253.0;
                let x = grid.origin[0] + (f64::from(a) + 0.5) * grid.side - p.x[k];
                let y = grid.origin[1] + (f64::from(b) + 0.5) * grid.side - p.y[k];
                let r = x.hypot(y) / dx;
                best = best.max(share * ((feel[1] - r) / (feel[1] - feel[0])).clamp(0.0, 1.0));
                if best == 1.0 {
                    break;
                }
            }
            best * lack
        });
    }
}
