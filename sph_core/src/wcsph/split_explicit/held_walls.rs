//! Pairs of fluid and wall particles whose geometry is held over an advective step (THEORY WC24).

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::held_pairs::Row;
use crate::forces::interface_dynamics::PressureSensitivity;
use crate::interactions::geometry::{MeanScale, PairConstants, PairGeometry, ScaleRule};
use crate::interactions::packed_particle::PackedParticle;
use crate::interactions::pair::TOUCHED;
use crate::kernel::{Shape, WithKernel};
use crate::memory::of_vector;
use crate::parallel;
use crate::system::ParticleSystem;
use crate::walls::Walls;

/// A wall particle beside a fluid particle.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct WallBeside {
    /// The wall particle, or the source of its image.
    wall: u32,
    /// V_a V_w ∇_a W_aw [m].
    gradient: [f64; 2],
    /// WA4: factor of the fluid's velocity in ∇·v [1/m].
    of_fluid: [f64; 2],
    /// WA4: factor of the wall's velocity along its normal, and of the fluid's beside it along the tangent [1/m].
    of_wall: [f64; 2],
}

/// A fluid particle, or its image, beside a wall particle.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct FluidBeside {
    fluid: u32,
    /// V_b W_wb over the sum of all [-] (WA3).
    share: f64,
    /// V_w V_b ∇_w W_wb [m].
    gradient: [f64; 2],
}

/// Rows of entries, one after another.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Rows<T> {
    start: Vec<u32>,
    entries: Vec<T>,
}

impl<T> Default for Rows<T> {
    fn default() -> Rows<T> {
        Rows { start: vec![0], entries: Vec::new() }
    }
}

impl<T> Rows<T> {
    /// More rows, after these.
    fn append(&mut self, mut more: Rows<T>) {
        let before = self.entries.len() as u32;
        self.entries.append(&mut more.entries);
        self.start.extend(more.start[1..].iter().map(|start| before + start));
    }
    fn of(&self, k: usize) -> &[T] {
        &self.entries[self.start[k] as usize..self.start[k + 1] as usize]
    }
}

/// All pairs of fluid and walls.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct HeldWalls {
    /// Fluid particles beside walls, in order.
    near: Vec<u32>,
    beside_fluid: Rows<WallBeside>,
    beside_wall: Rows<FluidBeside>,
    /// CO4 of each wall particle.
    pub sensitivity: Vec<PressureSensitivity>,
    normal: Vec<[f64; 2]>,
}

impl HeldWalls {
    /// Take the geometry of the packed particles.
    pub fn hold(&mut self, system: &ParticleSystem, walls: &Walls, constants: PairConstants) {
        system.domain.fluid.kernel.run(Hold { held: self, system, walls, constants });
    }

    /// Rows of the fluid beside walls of the targets in a range, with the targets.
    pub fn near(&self, targets: Range<usize>) -> impl Iterator<Item = (usize, usize)> {
        let from = self.near.partition_point(|&k| (k as usize) < targets.start);
        let beside = move |&(_, &k): &(usize, &u32)| (k as usize) < targets.end;
        self.near[from..].iter().enumerate().take_while(beside).map(move |(row, &k)| (from + row, k as usize))
    }

    /// WA4: the walls' share of −∇·v [1/s], of each row of the fluid beside walls.
    pub fn closing(&self, rows: &[Row], walls: &Walls, beside: impl Fn(usize) -> [f64; 2]) -> Vec<f64> {
        let velocity = |w: usize| {
            let ([nx, ny], [u, v]) = (self.normal[w], beside(w));
            [walls.u[w] * nx + walls.v[w] * ny, v * nx - u * ny]
        };
        let velocities: Vec<[f64; 2]> = (0..walls.len()).map(velocity).collect();
        let mut closing = vec![0.0; self.near.len()];
        parallel::gather_into(&mut closing, |row| {
            let Row { u, v, .. } = rows[self.near[row] as usize];
            let of = |w: &WallBeside| {
                let [vn, vt] = velocities[w.wall as usize];
                w.of_fluid[0] * u + w.of_fluid[1] * v - w.of_wall[0] * vn - w.of_wall[1] * vt
            };
            self.beside_fluid.of(row).iter().map(of).sum()
        });
        closing
    }

    /// Largest |(v_a − v_w)·n_w|/h_a of a pair [1/s]: what slides along a wall keeps its geometry.
    pub fn strain(&self, rows: &[Row], h: &[f64], walls: &Walls) -> f64 {
        -parallel::least(self.near.len(), |row| {
            let k = self.near[row] as usize;
            let across = |w: usize| (rows[k].u - walls.u[w]) * walls.nx[w] + (rows[k].v - walls.v[w]) * walls.ny[w];
            let most = self.beside_fluid.of(row).iter().map(|w| across(w.wall as usize).abs()).fold(0.0, f64::max);
            -most / h[k]
        })
        .min(0.0)
    }

    /// WA3: the pressure of wall particle `w` [Pa], in the field g − a of gravity less its acceleration [m/s²].
    pub fn pressure(&self, w: usize, p: &[f64], field: [f64; 2], rho0: f64) -> f64 {
        let from_fluid: f64 = self.beside_wall.of(w).iter().map(|b| b.share * p[b.fluid as usize]).sum();
        let arm = self.sensitivity[w].arm;
        from_fluid + rho0 * (field[0] * arm[0] + field[1] * arm[1])
    }

    /// WA5: velocity of the fluid beside wall particle `w` [m/s]; `None` where it is dry.
    pub fn velocity(&self, w: usize, rows: &[Row]) -> Option<[f64; 2]> {
        let beside = self.beside_wall.of(w);
        let sum = |of: fn(&Row) -> f64| beside.iter().map(|b| b.share * of(&rows[b.fluid as usize])).sum();
        beside.iter().any(|b| b.share > 0.0).then(|| [sum(|r| r.u), sum(|r| r.v)])
    }

    /// WA6: force of the fluid's pressures [Pa] on wall particle `w` [N/m], which has the pressure `of_wall` [Pa].
    pub fn force(&self, w: usize, p: &[f64], of_wall: f64) -> [f64; 2] {
        self.beside_wall.of(w).iter().fold([0.0; 2], |[x, y], b| {
            let both = of_wall + p[b.fluid as usize];
            [x - both * b.gradient[0], y - both * b.gradient[1]]
        })
    }

    /// WC5: force of the walls' pressures [N/m] on the fluid of a row, which has the pressure `p` [Pa].
    #[inline]
    pub fn push(&self, row: usize, p: f64, pressure: &[f64]) -> [f64; 2] {
        self.beside_fluid.of(row).iter().fold([0.0; 2], |[x, y], w| {
            let both = p + pressure[w.wall as usize];
            [x - both * w.gradient[0], y - both * w.gradient[1]]
        })
    }

    /// What the weights hold on to [bytes].
    pub fn bytes(&self) -> usize {
        let HeldWalls { near, beside_fluid, beside_wall, sensitivity, normal } = self;
        let rows = of_vector(&beside_fluid.entries) + of_vector(&beside_wall.entries);
        let starts = of_vector(&beside_fluid.start) + of_vector(&beside_wall.start);
        of_vector(near) + rows + starts + of_vector(sensitivity) + of_vector(normal)
    }
}

struct Hold<'a> {
    held: &'a mut HeldWalls,
    system: &'a ParticleSystem,
    walls: &'a Walls,
    constants: PairConstants,
}

impl WithKernel for Hold<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Hold { held, system, walls, constants } = self;
        let lists = &system.neighbours.walls_of_fluid;
        let of_chunk = |targets: Range<usize>| {
            let (mut near, mut rows) = (Vec::new(), Rows::default());
            for k in targets {
                let before = rows.entries.len();
                let beside = |w: u32| wall_beside::<K>(system, walls.len(), &constants, k, w as usize);
                rows.entries.extend(lists.of(k).filter_map(beside));
                if rows.entries.len() > before {
                    rows.start.push(rows.entries.len() as u32);
                    near.push(k as u32);
                }
            }
            (near, rows)
        };
        (held.near, held.beside_fluid) = (Vec::new(), Rows::default());
        for (near, rows) in parallel::by_chunk(system.particles.len(), of_chunk) {
            held.near.extend(near);
            held.beside_fluid.append(rows);
        }
        let of_chunk = |targets: Range<usize>| {
            let mut rows = Rows::default();
            let sensitivity: Vec<_> = targets.map(|w| fluid_beside::<K>(system, w, &mut rows)).collect();
            (sensitivity, rows)
        };
        (held.sensitivity, held.beside_wall) = (Vec::new(), Rows::default());
        for (sensitivity, rows) in parallel::by_chunk(walls.len(), of_chunk) {
            held.sensitivity.extend(sensitivity);
            held.beside_wall.append(rows);
        }
        held.normal = (0..walls.len()).map(|w| [walls.nx[w], walls.ny[w]]).collect();
    }
}

/// The listed wall particle `w`, or its image, beside fluid particle `k`; `None` beyond the support.
fn wall_beside<K: Shape>(
    system: &ParticleSystem,
    walls: usize,
    constants: &PairConstants,
    k: usize,
    w: usize,
) -> Option<WallBeside> {
    let (a, wall, face) = (&system.packed.fluid[k], &system.packed.walls[w], &system.packed.packed_walls[w]);
    let [gradient, slope] = weights::<K>(a, wall)?;
    let [dx, dy] = [a.x - wall.x, a.y - wall.y];
    let (rn, rt) = (dx * face.nx + dy * face.ny, dy * face.nx - dx * face.ny);
    let (along_normal, along_tangent) = (2.0 * rn * slope[0], constants.stretch * rt * slope[0]);
    let of_fluid = [along_normal * face.nx - along_tangent * face.ny, along_normal * face.ny + along_tangent * face.nx];
    let reflected = w >= walls && system.neighbours.wall_shifts.is_empty();
    let side = if reflected { -1.0 } else { 1.0 };
    let wall = system.neighbours.wall_source(w, walls) as u32;
    Some(WallBeside { wall, gradient, of_fluid, of_wall: [along_normal, side * along_tangent] })
}

/// V_a V_b ∇_a W_ab [m], and V_b times the slope of the kernel [1/m²] with V_b W_ab [-]; `None` beyond the support.
fn weights<K: Shape>(a: &PackedParticle, b: &PackedParticle) -> Option<[[f64; 2]; 2]> {
    let (dx, dy) = (a.x - b.x, a.y - b.y);
    let ab = PairGeometry::new::<K>(dx, dy, MeanScale.of::<K>(a.h, b.h));
    let flux = a.volume * b.volume * ab.grad_factor;
    (ab.grad_factor != 0.0).then(|| [[flux * dx, flux * dy], [b.volume * ab.grad_factor, b.volume * ab.w::<K>()]])
}

/// The next row: the fluid beside wall particle `w`.
fn fluid_beside<K: Shape>(system: &ParticleSystem, w: usize, rows: &mut Rows<FluidBeside>) -> PressureSensitivity {
    let (wall, mut sum, before) = (&system.packed.walls[w], 0.0, rows.entries.len());
    let mut sensitivity = PressureSensitivity::default();
    for j in system.neighbours.fluid_of_wall.of(w) {
        let b = &system.packed.fluid[j as usize];
        let Some([gradient, [slope, share]]) = weights::<K>(wall, b) else { continue };
        let [dx, dy] = [wall.x - b.x, wall.y - b.y];
        sum += share;
        sensitivity.arm = [sensitivity.arm[0] + share * dx, sensitivity.arm[1] + share * dy];
        sensitivity.push = [sensitivity.push[0] + slope * dx, sensitivity.push[1] + slope * dy];
        rows.entries.push(FluidBeside { fluid: j, share, gradient });
    }
    let mean = if sum < TOUCHED { 0.0 } else { 1.0 / sum };
    rows.entries[before..].iter_mut().for_each(|b| b.share *= mean);
    rows.start.push(rows.entries.len() as u32);
    if sum < TOUCHED {
        sensitivity.push = [0.0; 2]; // as in WA3: no pressure without a fluid in reach
    }
    PressureSensitivity { arm: sensitivity.arm.map(|a| a * mean), ..sensitivity }
}
