//! What the sweeps read: fluid and walls packed row by row, images behind them.

use crate::interactions::pair::Extrapolated;
use crate::interactions::simd::Number;
use crate::memory::of_vector;
use crate::neighbours::images::Mirror;
use crate::neighbours::lists::Spread;
use crate::neighbours::{Search, WallKinematics};
use crate::parallel;
use crate::particles::{Derived, Particles};
use crate::walls::Walls;
use crate::walls::midline::Screen;
use crate::walls::visibility::ThinWalls;

/// A particle as its neighbours see it: one cache line. For a wall particle, velocity and pressure are
/// those that the fluid is to feel (THEORY E9–E11) and both volumes are the area it stands for.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, Default)]
pub struct Row<R = f64> {
    /// Position [m].
    pub x: R,
    /// Position [m].
    pub y: R,
    /// Velocity [m/s].
    pub u: R,
    /// Velocity [m/s].
    pub v: R,
    /// Pressure [Pa].
    pub p: R,
    /// Corrected volume V = θ m/ρ [m²].
    pub volume: R,
    /// Uncorrected volume m/ρ [m²].
    pub fill: R,
    /// Smoothing length [m].
    pub h: R,
}

/// A wall particle in the continuity equation: where it is, which way it faces, how fast it comes.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, Default)]
pub struct Face<R = f64> {
    /// Position [m].
    pub x: R,
    /// Position [m].
    pub y: R,
    /// Unit normal into the fluid [-].
    pub nx: R,
    /// Unit normal into the fluid [-].
    pub ny: R,
    /// Velocity of the wall along the normal V·n [m/s].
    pub vn: R,
    /// Velocity of the fluid nearby along the tangent t = (−n_y, n_x), ũ·t [m/s].
    pub vt: R,
    /// Area it stands for [m²].
    pub volume: R,
    /// Smoothing length [m].
    pub h: R,
}

impl Row {
    /// The targets from `first` on, side by side; beyond the last one, the last one again.
    #[inline(always)]
    pub(crate) fn targets<R: Number>(rows: &[Row], first: usize, zero: R) -> Row<R> {
        let of = |field: fn(&Row) -> f64| zero.each(|k| field(&rows[(first + k).min(rows.len() - 1)]));
        Row {
            x: of(|r| r.x),
            y: of(|r| r.y),
            u: of(|r| r.u),
            v: of(|r| r.v),
            p: of(|r| r.p),
            volume: of(|r| r.volume),
            fill: of(|r| r.fill),
            h: of(|r| r.h),
        }
    }
}

impl Spread for Row {
    type Over<R: Number> = Row<R>;
    #[inline(always)]
    fn spread<R: Number>(&self, zero: R) -> Row<R> {
        Row {
            x: zero.of(self.x),
            y: zero.of(self.y),
            u: zero.of(self.u),
            v: zero.of(self.v),
            p: zero.of(self.p),
            volume: zero.of(self.volume),
            fill: zero.of(self.fill),
            h: zero.of(self.h),
        }
    }
    #[inline(always)]
    fn only<R: Number>(over: Row<R>, bits: u32) -> Row<R> {
        Row { volume: over.volume.only(bits), fill: over.fill.only(bits), ..over }
    }
}

impl Spread for Face {
    type Over<R: Number> = Face<R>;
    #[inline(always)]
    fn spread<R: Number>(&self, zero: R) -> Face<R> {
        Face {
            x: zero.of(self.x),
            y: zero.of(self.y),
            nx: zero.of(self.nx),
            ny: zero.of(self.ny),
            vn: zero.of(self.vn),
            vt: zero.of(self.vt),
            volume: zero.of(self.volume),
            h: zero.of(self.h),
        }
    }
    #[inline(always)]
    fn only<R: Number>(over: Face<R>, bits: u32) -> Face<R> {
        Face { volume: over.volume.only(bits), ..over }
    }
}

/// Rows of fluid and walls; indices at and above the number of particles are images, as in [`Search`].
#[derive(Default)]
pub(crate) struct Rows {
    /// Fluid.
    pub fluid: Vec<Row>,
    /// Walls, for forces.
    pub walls: Vec<Row>,
    /// Walls, for the continuity equation.
    pub faces: Vec<Face>,
    /// Mirror points of the walls (W3); empty where no wall asks.
    pub mirror_points: (Vec<f64>, Vec<f64>),
    /// Screens where the walls are now (T1).
    pub screens: Vec<Screen>,
    wall_x: Vec<f64>,
    wall_y: Vec<f64>,
}

/// As many rows as that, with room for a few more images and no more: rows are much of the memory.
fn resize(rows: &mut Vec<Row>, n: usize) {
    if rows.capacity() < n {
        rows.reserve_exact(n + n / 128 - rows.len());
    }
    rows.resize(n, Row::default());
}

impl Rows {
    /// What the rows hold on to [bytes].
    pub fn bytes(&self) -> [(&'static str, usize); 2] {
        let Rows { fluid, walls, faces, mirror_points, screens, wall_x, wall_y } = self;
        let numbers = [&mirror_points.0, &mirror_points.1, wall_x, wall_y];
        let of_walls = of_vector(walls) + of_vector(faces) + of_vector(screens);
        [("rows", of_vector(fluid)), ("rows of walls", of_walls + numbers.map(of_vector).iter().sum::<usize>())]
    }

    /// Put the walls where they are `offset` seconds from the step's end.
    pub fn place_walls(&mut self, walls: &Walls, offset: f64) {
        self.wall_x.resize(walls.len(), 0.0);
        self.wall_y.resize(walls.len(), 0.0);
        parallel::update_both(&mut self.wall_x, &mut self.wall_y, |k, x, y| {
            let [dx, dy] = walls.displacement(k, offset);
            (*x, *y) = (walls.x[k] + dx, walls.y[k] + dy);
        });
        self.screens.clear();
        self.screens.extend(walls.screens.iter().map(|screen| screen.at(offset, walls.dt)));
    }

    /// W3: mirror points of the walls that [`Rows::place_walls`] placed.
    pub fn place_mirror_points(&mut self, walls: &Walls) {
        let (x, y) = &mut self.mirror_points;
        x.clear();
        y.clear();
        for k in 0..walls.len() {
            x.push(self.wall_x[k] + 2.0 * walls.depth[k] * walls.nx[k]);
            y.push(self.wall_y[k] + 2.0 * walls.depth[k] * walls.ny[k]);
        }
    }

    /// The walls as the search sees them.
    pub fn kinematics<'a>(&'a self, walls: &'a Walls) -> WallKinematics<'a> {
        let (mirror_x, mirror_y) = (&self.mirror_points.0, &self.mirror_points.1);
        let (x, y) = (&self.wall_x, &self.wall_y);
        let thin = (!self.screens.is_empty()).then_some(ThinWalls { screens: &self.screens, walls });
        WallKinematics { x, y, u: &walls.u, v: &walls.v, h: &walls.h, mirror_x, mirror_y, thin }
    }

    /// Pack everything as it is now.
    pub fn pack(
        &mut self,
        p: &Particles,
        d: &Derived,
        walls: &Walls,
        search: &Search,
        mirror: Option<Mirror>,
        found: &[Extrapolated],
    ) {
        let n = p.len();
        resize(&mut self.fluid, n + search.fluid_images.len());
        parallel::gather_into(&mut self.fluid[..n], |k| {
            let fill = p.mass[k] / p.rho[k];
            let volume = d.volume.get(k).copied().unwrap_or(fill);
            let pressure = d.pressure.get(k).copied().unwrap_or(0.0); // none, and of no use, beside rates of density
            Row { x: p.x[k], y: p.y[k], u: p.u[k], v: p.v[k], p: pressure, volume, fill, h: p.h[k] }
        });
        self.walls.resize(walls.len(), Row::default());
        self.faces.resize(walls.len(), Face::default());
        let (wall_x, wall_y) = (&self.wall_x, &self.wall_y);
        parallel::gather_into(&mut self.walls, |k| {
            let volume = walls.volume[k];
            let (x, y, u, v, p) = (wall_x[k], wall_y[k], walls.u[k], walls.v[k], walls.pressure[k]);
            Row { x, y, u, v, p, volume, fill: volume, h: walls.h[k] }
        });
        parallel::gather_into(&mut self.faces, |k| {
            let (x, y, nx, ny) = (wall_x[k], wall_y[k], walls.nx[k], walls.ny[k]);
            let near = found.get(k).map_or([walls.u[k], walls.v[k]], |f| f.velocity);
            let vt = near[1] * nx - near[0] * ny;
            Face { x, y, nx, ny, vn: walls.u[k] * nx + walls.v[k] * ny, vt, volume: walls.volume[k], h: walls.h[k] }
        });
        self.repeat(n, search);
        let Some(mirror) = mirror else { return };
        for (k, &source) in search.fluid_images.iter().enumerate() {
            let row = self.fluid[source as usize];
            self.fluid[n + k] = Row { x: mirror.reflect(row.x), u: -row.u, ..row };
        }
        for &source in &search.wall_images {
            let (row, face) = (self.walls[source as usize], self.faces[source as usize]);
            self.walls.push(Row { x: mirror.reflect(row.x), u: -row.u, ..row });
            self.faces.push(Face { x: mirror.reflect(face.x), nx: -face.nx, vt: -face.vt, ..face });
        }
    }

    /// V1: images that repeat their source somewhere else.
    fn repeat(&mut self, n: usize, search: &Search) {
        for (k, (&source, shift)) in search.fluid_images.iter().zip(&search.fluid_shifts).enumerate() {
            let row = self.fluid[source as usize];
            self.fluid[n + k] = Row { x: row.x + shift[0], y: row.y + shift[1], ..row };
        }
        for (&source, shift) in search.wall_images.iter().zip(&search.wall_shifts) {
            let (row, face) = (self.walls[source as usize], self.faces[source as usize]);
            self.walls.push(Row { x: row.x + shift[0], y: row.y + shift[1], ..row });
            self.faces.push(Face { x: face.x + shift[0], y: face.y + shift[1], ..face });
        }
    }

    /// New pressures for rows that stay where they are.
    pub fn set_pressures(&mut self, d: &Derived, search: &Search, mirror: Option<Mirror>) {
        let n = d.pressure.len();
        parallel::update(&mut self.fluid[..n], |k, row| row.p = d.pressure[k]);
        if mirror.is_some() || !search.fluid_shifts.is_empty() {
            for (k, &source) in search.fluid_images.iter().enumerate() {
                self.fluid[n + k].p = self.fluid[source as usize].p;
            }
        }
    }

    /// E9, E11: the walls show the fluid the pressure they extrapolate and, where it must `stick`, the
    /// velocity 2V − ũ. `image_side` is −1 where images reflect, 1 where they repeat.
    pub fn dress_walls(&mut self, found: &[Extrapolated], images: &[u32], image_side: f64, stick: bool) {
        let n = found.len();
        for (k, row) in self.walls.iter_mut().enumerate() {
            let (source, side) = if k < n { (k, 1.0) } else { (images[k - n] as usize, image_side) };
            row.p = found[source].pressure;
            if stick {
                row.u = 2.0 * row.u - side * found[source].velocity[0];
                row.v = 2.0 * row.v - found[source].velocity[1];
            }
        }
    }
}
