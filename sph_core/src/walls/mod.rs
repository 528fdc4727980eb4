//! Walls: boundary particles that their owners move.
//!
//! Owners (bodies, tank walls) keep their particles contiguous and in their own order. Before a step
//! they write position, velocity and acceleration *at the end of the step*; after it they read forces.

pub mod interface;
pub mod midline;
pub(crate) mod outline;

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::state_bytes::{StateError, expect_count};
use crate::walls::midline::PlateMidline;
pub use crate::walls::outline::OutlineShare;

/// Rows of boundary particles that a scheme needs behind a wall's surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WallLayout {
    /// Number of rows.
    pub layers: usize,
    /// Every other row is shifted by half a spacing (THEORY LE16).
    pub staggered: bool,
}

impl WallLayout {
    /// Aligned rows as deep as the kernel's support 2h, for a smoothing length over spacing of `ratio` [-].
    pub(crate) fn filling_support(ratio: f64) -> WallLayout {
        WallLayout { layers: (2.0 * ratio - 1e-9).ceil() as usize, staggered: false }
    }
}

/// One boundary particle as its owner samples it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallPoint {
    /// Position [m].
    pub at: [f64; 2],
    /// Unit normal of the nearest face, pointing into the fluid [-].
    pub normal: [f64; 2],
    /// Area it stands for [m²]: half of its own where it lies on a plane of symmetry.
    pub area: f64,
    /// Distance to its neighbours [m].
    pub spacing: f64,
    /// Depth below the surface, along the normal [m].
    pub depth: f64,
    /// Its share of a closed outline (THEORY PR19); zero behind the first row, and where the outline is not closed.
    pub outline: OutlineShare,
    /// Index of the midline, among its owner's, of the thin plate that it belongs to (THEORY WA9); `None` for ordinary walls.
    pub midline: Option<u32>,
}

/// All boundary particles. One entry per particle in every array.
///
/// ```
/// use sph_core::{WallPoint, Walls};
/// let point = WallPoint { at: [0.0, -0.05], normal: [0.0, 1.0], area: 0.01, spacing: 0.1, depth: 0.05, outline: Default::default(), midline: None };
/// let mut walls = Walls::default();
/// let floor = walls.extend(&[point], 1.5);
/// walls.fy[0] = 3.0;
/// assert_eq!(walls.forces(floor).resultant([1.0, 0.0]).moment, -3.0);
/// ```
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Walls {
    /// Length of the step that the kinematics are given for [s]; written by the fluid.
    pub dt: f64,
    /// Position at the end of the step [m].
    pub x: Vec<f64>,
    /// Position at the end of the step [m].
    pub y: Vec<f64>,
    /// Velocity over the step [m/s].
    pub u: Vec<f64>,
    /// Velocity over the step [m/s].
    pub v: Vec<f64>,
    /// Acceleration [m/s²] (THEORY WA3).
    pub ax: Vec<f64>,
    /// Acceleration [m/s²].
    pub ay: Vec<f64>,
    /// Unit normal into the fluid [-].
    pub nx: Vec<f64>,
    /// Unit normal into the fluid [-].
    pub ny: Vec<f64>,
    /// Area it stands for [m²].
    pub volume: Vec<f64>,
    /// Smoothing length [m].
    pub h: Vec<f64>,
    /// Depth below the surface, along the normal [m].
    pub depth: Vec<f64>,
    /// Pressure extrapolated from the fluid [Pa] (THEORY WA3); written by the fluid.
    pub pressure: Vec<f64>,
    /// Force of the fluid on the particle at the end of the step, per metre of span [N/m]; written by the fluid.
    pub fx: Vec<f64>,
    /// Force at the end of the step [N/m].
    pub fy: Vec<f64>,
    /// Mean force over the step [N/m]: times Δt it is exactly the impulse that the fluid lost.
    pub mean_fx: Vec<f64>,
    /// Mean force over the step [N/m].
    pub mean_fy: Vec<f64>,
    /// Mean over the step of (r − r_end)×F [N]. The moment of the mean force is taken where the particle ends; this is added to it.
    pub mean_swing: Vec<f64>,
    /// Shares of closed outlines (THEORY PR19).
    pub outline: Vec<OutlineShare>,
    /// The particles of each owner.
    pub owners: Vec<Range<usize>>,
    /// Middle lines of thin walls (THEORY WA8), in the order of their owners.
    pub midlines: Vec<PlateMidline>,
    /// Index of the midline of the thin plate that each belongs to (THEORY WA9); `None` for ordinary walls.
    pub midline: Vec<Option<u32>>,
    /// Velocities at the step's start [m/s] (CO23); empty where the arrays above give them.
    pub start_velocity: Vec<[f64; 2]>,
}

impl Walls {
    /// Velocity of particle `k` at the start of a step of `dt` [m/s].
    pub fn velocity_at_start(&self, k: usize, dt: f64) -> [f64; 2] {
        let from_kinematics = || [self.u[k] - 0.5 * dt * self.ax[k], self.v[k] - 0.5 * dt * self.ay[k]];
        self.start_velocity.get(k).copied().unwrap_or_else(from_kinematics)
    }

    /// An error unless every array has as many entries as in `like`.
    pub fn check(&self, like: &Walls) -> Result<(), StateError> {
        let arrays = |w: &Walls| {
            let Walls { x, y, u, v, ax, ay, nx, ny, volume, h, depth, pressure, .. } = w;
            let kinematics = [x, y, u, v, ax, ay, nx, ny, volume, h, depth, pressure].map(Vec::len);
            let forces = [&w.fx, &w.fy, &w.mean_fx, &w.mean_fy, &w.mean_swing].map(Vec::len);
            [&kinematics[..], &forces, &[w.midline.len(), w.outline.len()]].concat()
        };
        for (found, expected) in arrays(self).into_iter().zip(arrays(like)) {
            expect_count("wall particles", found, expected)?;
        }
        expect_count("plate midlines", self.midlines.len(), like.midlines.len())?;
        for (found, expected) in self.midlines.iter().zip(&like.midlines) {
            expect_count("points of a midline", found.points.len(), expected.points.len())?;
        }
        match self.start_velocity.len() {
            0 => Ok(()),
            found => expect_count("velocities of walls", found, like.len()),
        }
    }

    /// Number of boundary particles.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// True when there is none.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Append an owner's particles, at rest; returns the range they occupy. `ratio` is h over spacing. The owner's midlines,
    /// which its particles count from 0, are to be appended next.
    pub fn extend(&mut self, points: &[WallPoint], ratio: f64) -> Range<usize> {
        let start = self.len();
        let midlines = self.midlines.len() as u32;
        for point in points {
            self.x.push(point.at[0]);
            self.y.push(point.at[1]);
            self.nx.push(point.normal[0]);
            self.ny.push(point.normal[1]);
            self.volume.push(point.area);
            self.h.push(ratio * point.spacing);
            self.depth.push(point.depth);
            self.outline.push(point.outline);
            self.midline.push(point.midline.map(|midline| midlines + midline));
        }
        let n = self.len();
        let Walls { u, v, ax, ay, pressure, fx, fy, mean_fx, mean_fy, mean_swing, .. } = self;
        for array in [u, v, ax, ay, pressure, fx, fy, mean_fx, mean_fy, mean_swing] {
            array.resize(n, 0.0);
        }
        self.owners.push(start..n);
        start..n
    }

    /// Where particle `k` is `offset` [s] from the step's end (offset ≤ 0), relative to where it ends [m]: back
    /// along the step at constant acceleration; u is the step's mean velocity.
    pub(crate) fn displacement(&self, k: usize, offset: f64) -> [f64; 2] {
        let bend = 0.5 * offset * (offset + self.dt);
        [offset * self.u[k] + bend * self.ax[k], offset * self.v[k] + bend * self.ay[k]]
    }

    /// (r − r_end)×F [N] for a force [N/m] on particle `k` at `offset` [s] from the step's end.
    pub(crate) fn swing(&self, k: usize, offset: f64, force: [f64; 2]) -> f64 {
        let [dx, dy] = self.displacement(k, offset);
        dx * force[1] - dy * force[0]
    }

    /// The mean force of particle `k` over the step, which acts `offset` [s] from its end.
    pub(crate) fn set_mean_force_of(&mut self, k: usize, offset: f64, force: [f64; 2]) {
        [self.mean_fx[k], self.mean_fy[k]] = force;
        self.mean_swing[k] = self.swing(k, offset, force);
    }

    /// WC11: half of the present force, where the walls were at the start of a step of `dt` [s], enters the step's mean force.
    pub(crate) fn start_mean_force(&mut self, dt: f64) {
        for k in 0..self.len() {
            self.set_mean_force_of(k, -dt, [0.5 * self.fx[k], 0.5 * self.fy[k]]);
        }
    }

    /// WC11: half of the force at the step's end completes the mean force.
    pub(crate) fn finish_mean_force(&mut self) {
        for k in 0..self.len() {
            self.mean_fx[k] += 0.5 * self.fx[k];
            self.mean_fy[k] += 0.5 * self.fy[k];
        }
    }

    /// Multiply the forces by `factor`; they act over the whole of a step of `dt` [s].
    pub(crate) fn scale_forces(&mut self, factor: f64, dt: f64) {
        for k in 0..self.len() {
            let force = [self.fx[k], self.fy[k]].map(|f| factor * f);
            [self.fx[k], self.fy[k]] = force;
            self.set_mean_force_of(k, -dt, force);
        }
    }

    /// The present force is the mean force too.
    pub(crate) fn set_mean_force(&mut self) {
        self.mean_fx.clone_from(&self.fx);
        self.mean_fy.clone_from(&self.fy);
    }

    /// An owner's particles, to be moved.
    pub fn slice_mut(&mut self, range: Range<usize>) -> WallsMut<'_> {
        let Walls { x, y, u, v, ax, ay, nx, ny, .. } = self;
        let [x, y, u, v, ax, ay, nx, ny] = [x, y, u, v, ax, ay, nx, ny].map(|array| &mut array[range.clone()]);
        WallsMut { x, y, u, v, ax, ay, nx, ny }
    }

    /// The forces on an owner's particles, to be read.
    pub fn forces(&self, range: Range<usize>) -> WallForces<'_> {
        let Walls { x, y, fx, fy, mean_fx, mean_fy, mean_swing, .. } = self;
        let [x, y, fx, fy, mean_fx, mean_fy, mean_swing] =
            [x, y, fx, fy, mean_fx, mean_fy, mean_swing].map(|array| &array[range.clone()]);
        WallForces { x, y, fx, fy, mean_fx, mean_fy, mean_swing, mirrored: false }
    }
}

/// Kinematics of one owner's particles, in the owner's order.
pub struct WallsMut<'a> {
    /// Position [m].
    pub x: &'a mut [f64],
    /// Position [m].
    pub y: &'a mut [f64],
    /// Velocity [m/s].
    pub u: &'a mut [f64],
    /// Velocity [m/s].
    pub v: &'a mut [f64],
    /// Acceleration [m/s²].
    pub ax: &'a mut [f64],
    /// Acceleration [m/s²].
    pub ay: &'a mut [f64],
    /// Normal [-].
    pub nx: &'a mut [f64],
    /// Normal [-].
    pub ny: &'a mut [f64],
}

/// Forces of the fluid on one owner's particles, in the owner's order.
#[derive(Clone, Copy)]
pub struct WallForces<'a> {
    /// Where the force acts [m].
    pub x: &'a [f64],
    /// Where the force acts [m].
    pub y: &'a [f64],
    /// Force now [N/m].
    pub fx: &'a [f64],
    /// Force now [N/m].
    pub fy: &'a [f64],
    /// Mean force over the step just taken [N/m].
    pub mean_fx: &'a [f64],
    /// Mean force over the step just taken [N/m].
    pub mean_fy: &'a [f64],
    /// Mean over the step of (r − r_end)×F [N].
    pub mean_swing: &'a [f64],
    /// True when the particles are the right half of an owner that is symmetric about x = 0.
    pub mirrored: bool,
}

/// Force [N/m] and moment about a point [N] of many small forces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Resultant {
    /// Force per metre of span [N/m].
    pub force: [f64; 2],
    /// Moment per metre of span, counter-clockwise [N].
    pub moment: f64,
}

impl std::ops::Add for Resultant {
    type Output = Resultant;

    /// Both about the same point.
    fn add(self, other: Resultant) -> Resultant {
        let force = [self.force[0] + other.force[0], self.force[1] + other.force[1]];
        Resultant { force, moment: self.moment + other.moment }
    }
}

impl std::ops::Mul<Resultant> for f64 {
    type Output = Resultant;

    fn mul(self, load: Resultant) -> Resultant {
        Resultant { force: load.force.map(|force| self * force), moment: self * load.moment }
    }
}

impl Resultant {
    /// The same forces with their moment about a pole displaced by `d` [m].
    pub fn about(self, d: [f64; 2]) -> Resultant {
        Resultant { moment: self.moment - (d[0] * self.force[1] - d[1] * self.force[0]), ..self }
    }
}

impl WallForces<'_> {
    /// Resultant about `pole` [m] of the force now; both halves counted when mirrored.
    pub fn resultant(&self, pole: [f64; 2]) -> Resultant {
        self.sum(self.fx, self.fy, pole)
    }

    /// Mean over the step of the resultant about the fixed `pole` [m]; both halves counted when mirrored.
    pub fn mean_resultant(&self, pole: [f64; 2]) -> Resultant {
        let mean = self.sum(self.mean_fx, self.mean_fy, pole);
        let swing = if self.mirrored { 0.0 } else { self.mean_swing.iter().sum() };
        Resultant { moment: mean.moment + swing, ..mean }
    }

    fn sum(&self, fx: &[f64], fy: &[f64], pole: [f64; 2]) -> Resultant {
        let mut total = Resultant::default();
        for k in 0..fx.len() {
            total.force[0] += fx[k];
            total.force[1] += fy[k];
            total.moment += (self.x[k] - pole[0]) * fy[k] - (self.y[k] - pole[1]) * fx[k];
        }
        if self.mirrored {
            let fy = 2.0 * total.force[1]; // acts along x = 0
            total = Resultant { force: [0.0, fy], moment: -pole[0] * fy };
        }
        total
    }
}
