//! Pairs of fluid and wall particles whose geometry is held over an advective step (THEORY WC24).

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::held_pairs::Row;
use crate::forces::interface_dynamics::PressureSensitivity;
use crate::memory::of_vector;
use crate::parallel;
use crate::walls::Walls;

/// A wall particle beside a fluid particle.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct WallBeside {
    /// The wall particle, or the source of its image.
    pub wall: u32,
    /// V_a V_w ∇_a W_aw [m].
    pub gradient: [f64; 2],
    /// WA4: factor of the fluid's velocity in ∇·v [1/m].
    pub of_fluid: [f64; 2],
    /// WA4: factor of the wall's velocity along its normal, and of the fluid's beside it along the tangent [1/m].
    pub of_wall: [f64; 2],
}

/// A fluid particle, or its image, beside a wall particle.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct FluidBeside {
    pub fluid: u32,
    /// V_b W_wb over the sum of all [-] (WA3).
    pub share: f64,
    /// V_w V_b ∇_w W_wb [m].
    pub gradient: [f64; 2],
}

/// Rows of entries, one after another.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Rows<T> {
    pub start: Vec<u32>,
    pub entries: Vec<T>,
}

impl<T> Default for Rows<T> {
    fn default() -> Rows<T> {
        Rows { start: vec![0], entries: Vec::new() }
    }
}

impl<T> Rows<T> {
    /// More rows, after these.
    pub fn append(&mut self, mut more: Rows<T>) {
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
    pub near: Vec<u32>,
    pub beside_fluid: Rows<WallBeside>,
    pub beside_wall: Rows<FluidBeside>,
    /// CO4 of each wall particle.
    pub sensitivity: Vec<PressureSensitivity>,
    pub normal: Vec<[f64; 2]>,
    /// How the sums over the walls beside a fluid particle change as the pairs move, of each row.
    pub of_fluid: Vec<FluidRates>,
    /// The same of the sums over the fluid beside a wall particle.
    pub of_wall: Vec<WallRates>,
}

/// Rates of a fluid particle, at the start of the advective step.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct FluidRates {
    /// Of the walls' share in −∇·v [1/s²].
    pub closing: f64,
    /// Σ (p_a + p_w) dS_aw/dt [N/(m s)].
    pub push: [f64; 2],
}

/// Rates of a wall particle, at the start of the advective step.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct WallRates {
    /// Of the mean pressure of the fluid beside it [Pa/s].
    pub pressure: f64,
    /// Σ (p_w + p_b) dS_wb/dt [N/(m s)].
    pub push: [f64; 2],
}

impl HeldWalls {
    /// Rows of the fluid beside walls of the targets in a range, with the targets.
    pub fn near(&self, targets: Range<usize>) -> impl Iterator<Item = (usize, usize)> {
        let from = self.near.partition_point(|&k| (k as usize) < targets.start);
        let beside = move |&(_, &k): &(usize, &u32)| (k as usize) < targets.end;
        self.near[from..].iter().enumerate().take_while(beside).map(move |(row, &k)| (from + row, k as usize))
    }

    /// WA4: the walls' share of −∇·v [1/s], of each row of the fluid beside walls, `later` [s] than the middle of the advective step.
    pub fn closing(&self, rows: &[Row], walls: &Walls, beside: impl Fn(usize) -> [f64; 2], later: f64) -> Vec<f64> {
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
            self.beside_fluid.of(row).iter().map(of).sum::<f64>() + later * self.of_fluid[row].closing
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

    /// WA3: the pressure of wall particle `w` [Pa], in the field g − a of gravity less its acceleration [m/s²], `later` [s] than the middle.
    pub fn pressure(&self, w: usize, p: &[f64], field: [f64; 2], (rho0, later): (f64, f64)) -> f64 {
        let from_fluid: f64 = self.beside_wall.of(w).iter().map(|b| b.share * p[b.fluid as usize]).sum();
        let arm = self.sensitivity[w].arm;
        from_fluid + later * self.of_wall[w].pressure + rho0 * (field[0] * arm[0] + field[1] * arm[1])
    }

    /// WA5: velocity of the fluid beside wall particle `w` [m/s]; `None` where it is dry.
    pub fn velocity(&self, w: usize, rows: &[Row]) -> Option<[f64; 2]> {
        let beside = self.beside_wall.of(w);
        let sum = |of: fn(&Row) -> f64| beside.iter().map(|b| b.share * of(&rows[b.fluid as usize])).sum();
        beside.iter().any(|b| b.share > 0.0).then(|| [sum(|r| r.u), sum(|r| r.v)])
    }

    /// WA6: force of the fluid's pressures [Pa] on wall particle `w` [N/m], which has the pressure `of_wall` [Pa], `later` [s] than the middle.
    pub fn force(&self, w: usize, p: &[f64], of_wall: f64, later: f64) -> [f64; 2] {
        let moved = self.of_wall[w].push.map(|push| -later * push);
        self.beside_wall.of(w).iter().fold(moved, |[x, y], b| {
            let both = of_wall + p[b.fluid as usize];
            [x - both * b.gradient[0], y - both * b.gradient[1]]
        })
    }

    /// WC5: force of the walls' pressures [N/m] on the fluid of a row, which has the pressure `p` [Pa], `later` [s] than the middle.
    #[inline]
    pub fn push(&self, row: usize, p: f64, pressure: &[f64], later: f64) -> [f64; 2] {
        let moved = self.of_fluid[row].push.map(|push| -later * push);
        self.beside_fluid.of(row).iter().fold(moved, |[x, y], w| {
            let both = p + pressure[w.wall as usize];
            [x - both * w.gradient[0], y - both * w.gradient[1]]
        })
    }

    /// What the weights hold on to [bytes].
    pub fn bytes(&self) -> usize {
        let HeldWalls { near, beside_fluid, beside_wall, sensitivity, normal, of_fluid, of_wall } = self;
        let rows = of_vector(&beside_fluid.entries) + of_vector(&beside_wall.entries);
        let starts = of_vector(&beside_fluid.start) + of_vector(&beside_wall.start);
        let rates = of_vector(of_fluid) + of_vector(of_wall);
        of_vector(near) + rows + starts + rates + of_vector(sensitivity) + of_vector(normal)
    }
}
