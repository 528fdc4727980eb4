//! Accelerations and forces from the pressures that a projection found (THEORY PR10, PR11, PR13, PR12).

use crate::forces::wall_state::extrapolate_to_walls;
use crate::forces::{PairTerms, gather_wall_forces};
use crate::interactions::dissipation::{Dissipation, ElasticPair};
use crate::interactions::geometry::{PairConstants, pair_geometry};
use crate::interactions::packed_particle::PackedParticle;
use crate::interactions::pair;
use crate::kernel::{Shape, WithKernel};
use crate::parallel::{self, CHUNK};
use crate::particles::COARSE;
use crate::projection::lattice::{Closure, Lattice};
use crate::projection::linear_pressure::LinearPressure;
use crate::projection::operators::Operators;
use crate::projection::pair_clusters::ChunkPairs;
use crate::simd::{self, LANES, SimdReal, Task};
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;

/// A particle counts as calm from this share of the pressure under a spacing of water on [-].
const CALM: f64 = 0.25;

/// What of the pair forces does not belong to the flow.
#[derive(Clone, Copy, Debug, Default)]
pub struct Correction {
    /// To be added [m/s²].
    acceleration: [f64; 2],
    /// Share in what keeps the sum of all corrections zero [-].
    share: f64,
}

/// What pushes a particle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Push {
    /// κ times the force of pairs [N/m].
    force: [f64; 2],
    /// The least pressure in the support [Pa].
    least: f64,
    correction: Correction,
}

/// Accelerations and wall forces under the pressures of a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct PressureForces {
    pushes: Vec<Push>,
    /// Normals of the surface (PR12).
    normals: Vec<[f64; 2]>,
    /// PR11: −ρ g·r of the highest particle at the start and half its spacing [Pa]: no still water is under more pressure than this
    /// head gives.
    head: f64,
}

impl PressureForces {
    /// The head, which a step does not find again [Pa].
    pub fn head(&self) -> f64 {
        self.head
    }

    /// As stored [Pa].
    pub fn set_head(&mut self, head: f64) {
        self.head = head;
    }

    /// PR10, PR11, PR13: the forces of pairs on fluid and walls, and corrections of the sums over disordered pairs and at the surface.
    pub fn apply(
        &mut self,
        system: &mut ParticleSystem,
        walls: &mut Walls,
        operators: &Operators,
        linear_pressure: &LinearPressure,
        indicator: &[f64],
        lattice: &Lattice,
        constants: PairConstants,
        dt: f64,
    ) {
        let inverse = 1.0 / lattice.gradient;
        system.packed.set_pressures(&system.fields, &system.neighbours);
        extrapolate_to_walls(system, walls); // WA3
        gather_wall_forces(system, &PairTerms { constants, dissipation: Dissipation::default() }, walls);
        walls.scale_forces(inverse, dt);
        let on_bodies = linear_pressure.correct_bodies(walls, dt);
        system.timers.begin(Phase::Momentum);
        find_normals(&mut self.normals, system, operators, indicator);
        let mut pushes = std::mem::take(&mut self.pushes);
        pushes.resize(system.particles.len(), Push::default());
        let correction =
            Corrections { system, operators, indicator, lattice, normals: &self.normals, head: self.head, inverse };
        let simd = system.domain.simd;
        system.domain.fluid.kernel.run(Pushing { correction, constants, simd, out: &mut pushes });
        let (back, of_tank) = close_momentum(system, &pushes, on_bodies);
        system.force_of_tank = of_tank;
        let g = system.domain.gravity;
        let p = &mut system.particles;
        parallel::update_both(&mut p.ax, &mut p.ay, |k, ax, ay| {
            let Push { force, correction: Correction { acceleration, share }, .. } = pushes[k];
            [*ax, *ay] = [0, 1].map(|i| inverse * force[i] / p.mass[k] + g[i] + acceleration[i] - share * back[i]);
        });
        system.fields.moments.clone_from(&operators.around);
        self.pushes = pushes;
    }

    /// PR11: the head of the particles as they lie at the start.
    pub fn find_head(&mut self, system: &ParticleSystem) {
        let (p, g, rho) = (&system.particles, system.domain.gravity, system.domain.fluid.density);
        let half = |k: usize| 0.5 * rho * g[0].hypot(g[1]) * (p.mass[k] / p.rho[k]).sqrt();
        let height = |k: usize| half(k) - rho * (g[0] * p.x[k] + g[1] * p.y[k]);
        self.head = (0..p.len()).map(height).fold(f64::NEG_INFINITY, f64::max);
    }
}

/// PR11, PR18, PR19: what makes the corrections of the water's forces have the resultant that is opposite to that of the bodies': an
/// acceleration that is taken off, even but for each particle's share [m/s²], and the force of the tank for those of coarse rows [N/m].
fn close_momentum(system: &ParticleSystem, pushes: &[Push], on_bodies: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    let (p, starts_level) = (&system.particles, system.domain.starts_level);
    let coarse = if starts_level { COARSE * system.least_smoothing_length() } else { f64::INFINITY };
    let (mut impulse, mut mass, mut of_tank) = (on_bodies, 0.0, [0.0; 2]);
    for ((Push { correction, .. }, m), &h) in pushes.iter().zip(&p.mass).zip(&p.h) {
        let sum = if h > coarse { &mut of_tank } else { &mut impulse };
        for i in 0..2 {
            sum[i] += m * correction.acceleration[i];
        }
        mass += correction.share * m;
    }
    (if mass > 0.0 { impulse.map(|sum| sum / mass) } else { [0.0; 2] }, of_tank)
}

/// What the corrections of a particle read.
struct Corrections<'a> {
    system: &'a ParticleSystem,
    operators: &'a Operators,
    indicator: &'a [f64],
    lattice: &'a Lattice,
    normals: &'a [[f64; 2]],
    head: f64,
    /// 1/κ (PR4).
    inverse: f64,
}

impl Corrections<'_> {
    /// PR10, PR11 and PR12 for particle `k`, whose neighbours' least pressure is `least` [Pa].
    fn of(&self, k: usize, least: f64) -> Correction {
        let Corrections { system, operators, lattice, inverse, .. } = self;
        let (p, g, rho) = (&system.particles, system.domain.gravity, system.domain.fluid.density);
        let air = self.indicator[k];
        let (around, [xx, xy, yy]) = (&operators.around[k], operators.second_moment[k]);
        let pressure = system.fields.pressure[k];
        let weight = (g[0] * g[0] + g[1] * g[1]).sqrt() * rho;
        let dx = (p.mass[k] / p.rho[k]).sqrt();
        // PR10: a row of a flat surface is acted on by the whole of a linear pressure
        let closure = if air > 0.0 { lattice.closure(around.kernel_sum) } else { Closure::default() };
        let tie = air * closure.pull;
        let top = pressure.clamp(0.0, weight * closure.depth * dx);
        // PR11: a uniform pressure causes no acceleration; nor does the weight of still water
        let head = self.head + rho * (g[0] * p.x[k] + g[1] * p.y[k]);
        let still = pressure.clamp(0.0, head.max(2.0 * weight * p.h[k]));
        let base = if pressure > 0.0 { still.max(least) } else { least };
        let share = 1.0 - air;
        let bearing = if weight > 0.0 { (still / (CALM * weight * dx)).min(1.0) } else { 0.0 };
        let calm = share * bearing;
        let slope = [xx * g[0] + xy * g[1], xy * g[0] + yy * g[1]];
        let pull = tie * (top - share * base.min(top));
        let lift = (pull + share * 2.0 * base) * inverse / rho;
        let gradient = around.concentration_gradient();
        let mut acceleration = [0, 1].map(|i| lift * gradient[i] + calm * (inverse * slope[i] - g[i]));
        if air > 0.0 {
            let pressure = air * 2.0 * still - pull;
            let along = tangential_correction((operators, k), self.normals[k], (rho, g), pressure, air * bearing);
            acceleration = [0, 1].map(|i| acceleration[i] + inverse * along[i]);
        }
        Correction { acceleration, share }
    }
}

/// PR10: the forces of pairs; then PR11 and PR12.
struct Pushing<'a> {
    correction: Corrections<'a>,
    constants: PairConstants,
    simd: bool,
    out: &'a mut [Push],
}

impl WithKernel for Pushing<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Pushing { correction, constants, simd, out } = self;
        let Corrections { system, operators, .. } = correction;
        let (fluid, walls) = (&system.packed.fluid, &system.packed.walls);
        let wall_nu = system.domain.fluid.wall_viscosity();
        let half = 0.5 * constants.rho0; // of the links: a_ij = 2 V_i V_j |∇W/r|/ρ
        parallel::update_pieces(out, CHUNK, |c, out| {
            let first = c * CHUNK;
            simd::run(simd, ChunkPush { pairs: &operators.chunks()[c], first, fluid, out: &mut *out });
            for (k, push) in (first..).zip(out) {
                let a = &fluid[k];
                let least = push.least;
                let mut force = [0, 1].map(|i| half * push.force[i] + operators.drag[k][i]);
                for j in system.neighbours.walls_of_fluid.of(k) {
                    let w = &walls[j as usize];
                    let Some(aw) = pair_geometry::<K>(a.x, a.y, a.h, w.x, w.y, w.h) else { continue };
                    let [normal, shear] = pair::force::<f64, ElasticPair>(a, w, &aw, &constants, wall_nu);
                    force[0] += a.volume * (normal * aw.dx + shear * (a.u - w.u));
                    force[1] += a.volume * (normal * aw.dy + shear * (a.v - w.v));
                }
                *push = Push { force, least, correction: correction.of(k, least) };
            }
        });
    }
}

/// PR10, PR11: Σ of links, p_a + p_b and r_ab, and the least pressure in the support, of the targets of a chunk.
struct ChunkPush<'a> {
    pairs: &'a ChunkPairs,
    first: usize,
    fluid: &'a [PackedParticle],
    out: &'a mut [Push],
}

impl Task for ChunkPush<'_> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let ChunkPush { pairs, first, fluid, out } = self;
        for (c, out) in out.chunks_mut(LANES).enumerate() {
            let (near, links) = pairs.cluster(c);
            for lane in (0..LANES).step_by(R::WIDTH) {
                let a = PackedParticle::targets(fluid, first + c * LANES + lane, zero);
                let (mut x, mut y, mut least) = (zero, zero, a.p);
                for (&j, links) in near.iter().zip(links) {
                    let b = &fluid[j as usize];
                    let (link, p) = (zero.widened(&links[lane..]), zero.of(b.p));
                    let push = link * (a.p + p);
                    x = push.mul_add(a.x - zero.of(b.x), x);
                    y = push.mul_add(a.y - zero.of(b.y), y);
                    least = zero.below(link, least.min(p), least);
                }
                let (x, y, least) = (x.lanes(), y.lanes(), least.lanes());
                for (k, push) in out.iter_mut().skip(lane).take(R::WIDTH).enumerate() {
                    (push.force, push.least) = ([x[k], y[k]], least[k]);
                }
            }
        }
    }
}

/// PR12: unit normals of the surface where the indicator is above 0, into the water; elsewhere zero.
fn find_normals(normals: &mut Vec<[f64; 2]>, system: &ParticleSystem, operators: &Operators, indicator: &[f64]) {
    let (neighbours, packed, kernel) = (&system.neighbours, &system.packed.fluid, system.domain.fluid.kernel);
    let around = &operators.around;
    let mirrored = system.domain.mirror.is_some();
    let n = system.particles.len();
    normals.resize(n, [0.0; 2]);
    parallel::gather_into(normals, |k| {
        if indicator[k] == 0.0 {
            return [0.0; 2];
        }
        let a = &packed[k];
        let mut sum = around[k].concentration_gradient().map(|c| a.raw_volume * kernel.value(0.0, a.h) * c);
        for (j, _) in operators.row(k) {
            let b = &packed[j as usize];
            let (dx, dy) = (a.x - b.x, a.y - b.y);
            let weight = b.raw_volume * kernel.value((dx * dx + dy * dy).sqrt(), 0.5 * (a.h + b.h));
            let [x, y] = around[neighbours.source(j, n)].concentration_gradient();
            let side = if mirrored && j as usize >= n { -1.0 } else { 1.0 };
            sum[0] += weight * side * x;
            sum[1] += weight * y;
        }
        let length = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
        if length > 0.0 { sum.map(|s| s / length) } else { [0.0; 2] }
    });
}

/// PR12: κ times the acceleration along the surface of unit normal `n` [m/s²] that takes the effect of a pressure out of the sums
/// over pairs: `pressure` [Pa] that is uniform, and `bearing` times the weight of still water under gravity `g`.
fn tangential_correction(
    (operators, k): (&Operators, usize),
    n: [f64; 2],
    (rho, g): (f64, [f64; 2]),
    pressure: f64,
    bearing: f64,
) -> [f64; 2] {
    let t = [-n[1], n[0]];
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let [xx, xy, yy] = operators.second_moment[k];
    let moment = [xx * n[0] + xy * n[1], xy * n[0] + yy * n[1]];
    let along = dot(t, operators.around[k].concentration_gradient());
    t.map(|t_i| t_i * (pressure / rho * along + bearing * dot(n, g) * dot(t, moment)))
}
