//! One sweep over the pairs: geometry, divergence, viscosity and the matrix's rows (THEORY I2–I6, I12).

use crate::fluid::Fluid;
use crate::interactions::kernel::{Shape, WithKernel};
use crate::interactions::pair::{Constants, Face, Row, bond};
use crate::neighbours::Search;
use crate::parallel::{self, CHUNK};
use crate::particles::Surroundings;
use crate::walls::Walls;

use crate::projection::free_surface::lattice::Lattice;
use crate::projection::pair_batch::{Nearby, Sums};

/// What the pairs give.
#[derive(Clone, Debug, Default)]
pub struct Survey {
    chunks: Vec<Rows>,
    /// Geometry.
    pub around: Vec<Surroundings>,
    /// ∇·u* [1/s].
    pub divergence: Vec<f64>,
    /// −Σ V r⊗∇W.
    pub spread: Vec<[f64; 3]>,
    /// κ times the viscous force [N/m] (I12).
    pub drag: Vec<[f64; 2]>,
}

/// The pairs of a chunk of targets, by row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rows {
    ends: Vec<u32>,
    near: Vec<u32>,
    values: Vec<f64>,
    /// Rows have their own mirror images among them, which the matrix has not.
    pub own_images: usize,
}

impl Rows {
    /// Of the chunk's row k: who is near, as listed, and 2 V_i V_j |slope|/ρ.
    #[inline(always)]
    pub fn row(&self, k: usize) -> (&[u32], &[f64]) {
        let from = if k == 0 { 0 } else { self.ends[k - 1] as usize };
        let to = self.ends[k] as usize;
        (&self.near[from..to], &self.values[from..to])
    }

    /// Number of pairs.
    pub fn pairs(&self) -> usize {
        self.near.len()
    }
}

impl Survey {
    /// Who is near row k, as listed (images count), and off-diagonals, positive: a_ij = 2 V_i V_j |slope|/ρ.
    #[inline(always)]
    pub fn row(&self, k: usize) -> (&[u32], &[f64]) {
        self.chunks[k / CHUNK].row(k % CHUNK)
    }

    /// The pairs, by chunks of targets.
    pub(crate) fn chunks(&self) -> &[Rows] {
        &self.chunks
    }
}

/// What a chunk of targets finds.
struct Found<'a> {
    rows: &'a mut Rows,
    around: &'a mut [Surroundings],
    divergence: &'a mut [f64],
    spread: &'a mut [[f64; 3]],
    drag: &'a mut [[f64; 2]],
}

struct Task<'a> {
    fluid: &'a [Row],
    faces: &'a [Face],
    search: &'a Search,
    n: usize,
    kicks: &'a [[f64; 2]],
    walls: &'a [Row],
    constants: Constants,
    /// 1/κ (I4).
    inverse: f64,
    found: Vec<Found<'a>>,
}

impl WithKernel for Task<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Task { fluid, faces, search, n, kicks, walls, constants, inverse, mut found } = self;
        parallel::for_each_chunk(&mut found, n, |targets, out| {
            let Found { rows, around, divergence, spread, drag } = out;
            rows.ends.clear();
            rows.near.clear();
            rows.values.clear();
            rows.own_images = 0;
            let mut nearby = Nearby::default();
            for (slot, k) in targets.enumerate() {
                let a = &fluid[k];
                let mut sums = Sums::default();
                let (mut listed, mut more) = (search.fluid.of(k), true);
                while more {
                    more = nearby.gather(a, &mut listed, fluid);
                    nearby.weigh::<K>(a, &constants);
                    sums.add(&nearby, a, &constants);
                    rows.near.extend_from_slice(nearby.listed());
                    rows.values.extend_from_slice(nearby.links());
                    if !search.fluid_images.is_empty() {
                        rows.own_images += nearby.listed().iter().filter(|&&j| search.source(j, n) == k).count();
                    }
                }
                rows.ends.push(rows.near.len() as u32);
                let own = a.fill * K::ALPHA * K::w(0.0) / (a.h * a.h);
                let fluid_filling = own + sums.filling();
                let (mut filling, mut crowding, mut arms) = (fluid_filling, sums.crowding(), sums.spread());
                let mut rate = sums.divergence();
                for j in search.walls_of_fluid.of(k) {
                    let w = &faces[j as usize];
                    let Some(aw) = bond::<K>(a.x, a.y, a.h, w.x, w.y, w.h) else { continue };
                    let wet = walls[j as usize].volume;
                    filling += wet * aw.w::<K>();
                    let pull = wet * aw.slope;
                    crowding[0] += pull * aw.dx;
                    crowding[1] += pull * aw.dy;
                    arms[0] -= pull * aw.dx * aw.dx;
                    arms[1] -= pull * aw.dx * aw.dy;
                    arms[2] -= pull * aw.dy * aw.dy;
                    let un = a.u * w.nx + a.v * w.ny;
                    let rn = aw.dx * w.nx + aw.dy * w.ny;
                    rate += 2.0 * w.volume * aw.slope * (w.vn - un) * rn;
                    let kick = kicks[j as usize];
                    rate += 2.0 * pull * (kick[0] * aw.dx + kick[1] * aw.dy);
                }
                let (mean, half) = (0.5 * (arms[0] + arms[2]), 0.5 * (arms[0] - arms[2]));
                let lambda = mean - (half * half + arms[1] * arms[1]).sqrt();
                around[slot] = Surroundings::new(filling, fluid_filling, crowding, lambda);
                divergence[slot] = inverse * rate;
                spread[slot] = arms;
                drag[slot] = sums.drag();
            }
        });
    }
}

impl Fluid {
    /// I2–I6, I12.
    pub(crate) fn survey(&mut self, walls: &Walls, dt: f64) {
        let n = self.particles.len();
        let (kernel, g) = (self.parameters.kernel, self.parameters.gravity);
        let ratio = self.parameters.smoothing_ratio;
        let lattice = *self.projection.lattice.get_or_insert_with(|| Lattice::new(kernel, ratio));
        // a face's tangential velocity is not asked here: its place takes Δt (a − g)·…
        let mut kicks = Vec::with_capacity(self.rows.faces.len());
        for (k, face) in self.rows.faces.iter_mut().enumerate() {
            let source = if k < walls.len() { k } else { self.search.wall_images[k - walls.len()] as usize };
            // images have the same normal velocity
            let [u, v] = walls.velocity_at_start(source, dt);
            face.vn = u * walls.nx[source] + v * walls.ny[source];
            let side = if k < walls.len() { 1.0 } else { -1.0 };
            kicks.push([dt * (side * walls.ax[source] - g[0]), dt * (walls.ay[source] - g[1])]);
        }
        let constants = self.constants_of_projection();
        let Survey { chunks, around, divergence, spread, drag } = &mut self.projection.survey;
        chunks.resize(n.div_ceil(CHUNK), Rows::default());
        around.resize(n, Surroundings::default());
        divergence.resize(n, 0.0);
        spread.resize(n, [0.0; 3]);
        drag.resize(n, [0.0; 2]);
        let pieces = around.chunks_mut(CHUNK).zip(divergence.chunks_mut(CHUNK));
        let pieces = pieces.zip(spread.chunks_mut(CHUNK).zip(drag.chunks_mut(CHUNK)));
        let found = chunks.iter_mut().zip(pieces);
        let found = found.map(|(rows, ((around, divergence), (spread, drag)))| Found {
            rows,
            around,
            divergence,
            spread,
            drag,
        });
        kernel.run(Task {
            fluid: &self.rows.fluid,
            faces: &self.rows.faces,
            search: &self.search,
            n,
            kicks: &kicks,
            walls: &self.rows.walls,
            constants,
            inverse: 1.0 / lattice.gradient,
            found: found.collect(),
        });
        if self.steps == 0 {
            // where spacings grow, a lattice at rest is not filled to the last per cent
            let around = &self.projection.survey.around;
            parallel::update(&mut self.particles.theta, |k, theta| {
                let graded = around[k].lambda > 0.9 && (around[k].filling - lattice.filling).abs() < 0.1;
                *theta = if graded { around[k].filling } else { lattice.filling };
            });
        }
    }
}
