//! One sweep over the pairs: geometry, divergence and the matrix's rows (THEORY I2–I6).

use crate::fluid::Fluid;
use crate::kernel::{Shape, WithKernel};
use crate::pair::{Face, Row, bond};
use crate::particles::Surroundings;
use crate::search::Search;
use crate::sweep::{self, CHUNK};
use crate::walls::Walls;

use super::lattice::Lattice;

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
}

#[derive(Clone, Debug, Default)]
struct Rows {
    ends: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f64>,
    around: Vec<Surroundings>,
    divergence: Vec<f64>,
    spread: Vec<[f64; 3]>,
}

impl Survey {
    /// Off-diagonals of row k, positive: a_ij = 2 V_i V_j |slope|/ρ.
    pub fn row(&self, k: usize) -> (&[u32], &[f64]) {
        let rows = &self.chunks[k / CHUNK];
        let k = k % CHUNK;
        let from = if k == 0 { 0 } else { rows.ends[k - 1] as usize };
        let to = rows.ends[k] as usize;
        (&rows.columns[from..to], &rows.values[from..to])
    }
}

struct Task<'a> {
    fluid: &'a [Row],
    faces: &'a [Face],
    search: &'a Search,
    n: usize,
    kicks: &'a [[f64; 2]],
    walls: &'a [Row],
    inverse_rho: f64,
    chunks: &'a mut [Rows],
}

impl WithKernel for Task<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Task { fluid, faces, search, n, kicks, walls, inverse_rho, chunks } = self;
        sweep::for_each_chunk(chunks, n, |targets, rows| {
            rows.ends.clear();
            rows.columns.clear();
            rows.values.clear();
            rows.around.clear();
            rows.divergence.clear();
            rows.spread.clear();
            for k in targets {
                let a = &fluid[k];
                let own = a.fill * K::ALPHA * K::w(0.0) / (a.h * a.h);
                let (mut filling, mut crowding, mut spread, mut divergence) = (own, [0.0; 2], [0.0; 3], 0.0);
                for j in search.fluid.of(k) {
                    let b = &fluid[j as usize];
                    let Some(ab) = bond::<K>(a.x, a.y, a.h, b.x, b.y, b.h) else { continue };
                    filling += b.fill * ab.w::<K>();
                    let pull = b.fill * ab.slope;
                    crowding[0] += pull * ab.dx;
                    crowding[1] += pull * ab.dy;
                    spread[0] -= pull * ab.dx * ab.dx;
                    spread[1] -= pull * ab.dx * ab.dy;
                    spread[2] -= pull * ab.dy * ab.dy;
                    divergence += pull * ((b.u - a.u) * ab.dx + (b.v - a.v) * ab.dy);
                    let source = search.source(j, n);
                    if source != k {
                        rows.columns.push(source as u32);
                        rows.values.push(-2.0 * a.fill * pull * inverse_rho);
                    }
                }
                let fluid_filling = filling;
                for j in search.walls_of_fluid.of(k) {
                    let w = &faces[j as usize];
                    let Some(aw) = bond::<K>(a.x, a.y, a.h, w.x, w.y, w.h) else { continue };
                    let wet = walls[j as usize].volume;
                    filling += wet * aw.w::<K>();
                    let pull = wet * aw.slope;
                    crowding[0] += pull * aw.dx;
                    crowding[1] += pull * aw.dy;
                    spread[0] -= pull * aw.dx * aw.dx;
                    spread[1] -= pull * aw.dx * aw.dy;
                    spread[2] -= pull * aw.dy * aw.dy;
                    let un = a.u * w.nx + a.v * w.ny;
                    let rn = aw.dx * w.nx + aw.dy * w.ny;
                    divergence += 2.0 * w.volume * aw.slope * (w.vn - un) * rn;
                    let kick = kicks[j as usize];
                    divergence += 2.0 * pull * (kick[0] * aw.dx + kick[1] * aw.dy);
                }
                let (mean, half) = (0.5 * (spread[0] + spread[2]), 0.5 * (spread[0] - spread[2]));
                let lambda = mean - (half * half + spread[1] * spread[1]).sqrt();
                rows.ends.push(rows.columns.len() as u32);
                rows.around.push(Surroundings { filling, fluid_filling, crowding, lambda });
                rows.divergence.push(divergence);
                rows.spread.push(spread);
            }
        });
    }
}

impl Fluid {
    /// I2–I6.
    pub(super) fn survey(&mut self, walls: &Walls, dt: f64) {
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
        let survey = &mut self.projection.survey;
        survey.chunks.resize(n.div_ceil(CHUNK), Rows::default());
        kernel.run(Task {
            fluid: &self.rows.fluid,
            faces: &self.rows.faces,
            search: &self.search,
            n,
            kicks: &kicks,
            walls: &self.rows.walls,
            inverse_rho: 1.0 / self.parameters.eos.rho0,
            chunks: &mut survey.chunks,
        });
        survey.around.resize(n, Surroundings::default());
        survey.divergence.resize(n, 0.0);
        if self.steps == 0 {
            // where spacings grow, a lattice at rest is not filled to the last per cent
            for k in 0..n {
                let around = survey.chunks[k / CHUNK].around[k % CHUNK];
                let graded = around.lambda > 0.9 && (around.filling - lattice.filling).abs() < 0.1;
                self.particles.theta[k] = if graded { around.filling } else { lattice.filling };
            }
        }
        let (chunks, inverse) = (&survey.chunks, 1.0 / lattice.gradient);
        sweep::gather_into(&mut survey.around, |k| chunks[k / CHUNK].around[k % CHUNK]);
        survey.spread.resize(n, [0.0; 3]);
        sweep::gather_into(&mut survey.spread, |k| chunks[k / CHUNK].spread[k % CHUNK]);
        sweep::gather_into(&mut survey.divergence, |k| inverse * chunks[k / CHUNK].divergence[k % CHUNK]);
    }
}
