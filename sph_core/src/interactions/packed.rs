//! What the sums over pairs read: fluid and walls packed particle by particle, images behind them.

use crate::interactions::packed_particle::{PackedParticle, PackedWall};
use crate::interactions::pair::Extrapolated;
use crate::memory::of_vector;
use crate::neighbours::visibility::ThinWalls;
use crate::neighbours::{Neighbours, WallKinematics};
use crate::parallel;
use crate::particles::{Fields, Particles};
use crate::planes::Mirror;
use crate::walls::Walls;
use crate::walls::midline::PlateMidline;

/// Packed particles of fluid and walls; indices at and above the number of particles are images, as in [`Neighbours`].
#[derive(Default)]
pub(crate) struct Packed {
    /// Fluid.
    pub fluid: Vec<PackedParticle>,
    /// Walls, for forces.
    pub walls: Vec<PackedParticle>,
    /// Walls, for the continuity equation.
    pub packed_walls: Vec<PackedWall>,
    /// Mirror points of the walls (LE17); empty where no wall asks.
    pub mirror_points: (Vec<f64>, Vec<f64>),
    /// Plate midlines where the walls are now (WA8).
    pub midlines: Vec<PlateMidline>,
    wall_x: Vec<f64>,
    wall_y: Vec<f64>,
}

/// As many rows as that, with room for a few more images and no more: rows are much of the memory.
fn resize(rows: &mut Vec<PackedParticle>, n: usize) {
    if rows.capacity() < n {
        rows.reserve_exact(n + n / 128 - rows.len());
    }
    rows.resize(n, PackedParticle::default());
}

impl Packed {
    /// What the rows hold on to [bytes].
    pub fn bytes(&self) -> [(&'static str, usize); 2] {
        let Packed { fluid, walls, packed_walls, mirror_points, midlines, wall_x, wall_y } = self;
        let numbers = [&mirror_points.0, &mirror_points.1, wall_x, wall_y];
        let of_walls = of_vector(walls) + of_vector(packed_walls) + of_vector(midlines);
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
        self.midlines.clear();
        self.midlines.extend(walls.midlines.iter().map(|midline| midline.at(offset, walls.dt)));
    }

    /// LE17: mirror points of the walls that [`Packed::place_walls`] placed.
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
        let thin = (!self.midlines.is_empty()).then_some(ThinWalls { midlines: &self.midlines, walls });
        WallKinematics { x, y, u: &walls.u, v: &walls.v, h: &walls.h, mirror_x, mirror_y, thin }
    }

    /// Pack everything as it is now.
    pub fn pack(
        &mut self,
        p: &Particles,
        d: &Fields,
        walls: &Walls,
        search: &Neighbours,
        mirror: Option<Mirror>,
        found: &[Extrapolated],
    ) {
        let n = p.len();
        resize(&mut self.fluid, n + search.fluid_images.len());
        parallel::gather_into(&mut self.fluid[..n], |k| {
            let raw_volume = p.mass[k] / p.rho[k];
            let volume = d.volume.get(k).copied().unwrap_or(raw_volume);
            PackedParticle {
                x: p.x[k],
                y: p.y[k],
                u: p.u[k],
                v: p.v[k],
                p: d.pressure[k],
                volume,
                raw_volume,
                h: p.h[k],
            }
        });
        self.walls.resize(walls.len(), PackedParticle::default());
        self.packed_walls.resize(walls.len(), PackedWall::default());
        let (wall_x, wall_y) = (&self.wall_x, &self.wall_y);
        parallel::gather_into(&mut self.walls, |k| {
            let volume = walls.volume[k];
            let (x, y, u, v, p) = (wall_x[k], wall_y[k], walls.u[k], walls.v[k], walls.pressure[k]);
            PackedParticle { x, y, u, v, p, volume, raw_volume: volume, h: walls.h[k] }
        });
        parallel::gather_into(&mut self.packed_walls, |k| {
            let (x, y, nx, ny) = (wall_x[k], wall_y[k], walls.nx[k], walls.ny[k]);
            let near = found.get(k).map_or([walls.u[k], walls.v[k]], |f| f.velocity);
            let vt = near[1] * nx - near[0] * ny;
            PackedWall {
                x,
                y,
                nx,
                ny,
                vn: walls.u[k] * nx + walls.v[k] * ny,
                vt,
                volume: walls.volume[k],
                h: walls.h[k],
            }
        });
        self.repeat(n, search);
        let Some(mirror) = mirror else { return };
        for (k, &source) in search.fluid_images.iter().enumerate() {
            let row = self.fluid[source as usize];
            self.fluid[n + k] = PackedParticle { x: mirror.reflect(row.x), u: -row.u, ..row };
        }
        for &source in &search.wall_images {
            let (row, face) = (self.walls[source as usize], self.packed_walls[source as usize]);
            self.walls.push(PackedParticle { x: mirror.reflect(row.x), u: -row.u, ..row });
            self.packed_walls.push(PackedWall { x: mirror.reflect(face.x), nx: -face.nx, vt: -face.vt, ..face });
        }
    }

    /// OP9: images that repeat their source somewhere else.
    fn repeat(&mut self, n: usize, search: &Neighbours) {
        for (k, (&source, shift)) in search.fluid_images.iter().zip(&search.fluid_shifts).enumerate() {
            let row = self.fluid[source as usize];
            self.fluid[n + k] = PackedParticle { x: row.x + shift[0], y: row.y + shift[1], ..row };
        }
        for (&source, shift) in search.wall_images.iter().zip(&search.wall_shifts) {
            let (row, face) = (self.walls[source as usize], self.packed_walls[source as usize]);
            self.walls.push(PackedParticle { x: row.x + shift[0], y: row.y + shift[1], ..row });
            self.packed_walls.push(PackedWall { x: face.x + shift[0], y: face.y + shift[1], ..face });
        }
    }

    /// No pressures.
    pub fn clear_pressures(&mut self) {
        parallel::update(&mut self.fluid, |_, row| row.p = 0.0);
        parallel::update(&mut self.walls, |_, row| row.p = 0.0);
    }

    /// New pressures for rows that stay where they are.
    pub fn set_pressures(&mut self, d: &Fields, search: &Neighbours) {
        let n = d.pressure.len();
        parallel::update(&mut self.fluid[..n], |k, row| row.p = d.pressure[k]);
        for (k, &source) in search.fluid_images.iter().enumerate() {
            self.fluid[n + k].p = self.fluid[source as usize].p;
        }
    }

    /// WA3, WA5: the walls show the fluid the pressure they extrapolate and, where it must `no_slip`, the
    /// velocity 2V − ũ. `image_side` is −1 where images reflect, 1 where they repeat.
    pub fn set_wall_state(&mut self, found: &[Extrapolated], images: &[u32], image_side: f64, no_slip: bool) {
        let n = found.len();
        for (k, row) in self.walls.iter_mut().enumerate() {
            let (source, side) = if k < n { (k, 1.0) } else { (images[k - n] as usize, image_side) };
            row.p = found[source].pressure;
            if no_slip {
                row.u = 2.0 * row.u - side * found[source].velocity[0];
                row.v = 2.0 * row.v - found[source].velocity[1];
            }
        }
    }
}
