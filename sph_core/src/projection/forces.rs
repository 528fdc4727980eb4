//! Accelerations and forces from the pressures that a projection found (THEORY I10–I12, I16).

use crate::fluid::Fluid;
use crate::interactions::dissipation::ElasticPair;
use crate::interactions::gather::{WallForce, listed};
use crate::interactions::kernel::{Shape, WithKernel};
use crate::interactions::pair::{self, Constants, bond};
use crate::parallel;
use crate::timers::Phase;
use crate::walls::Walls;

use crate::projection::free_surface::lattice::Closure;

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
    correction: Correction,
}

impl Fluid {
    /// I10–I12: the pairs' forces on fluid and walls, and what the sums over disordered pairs and at the surface lack.
    pub(crate) fn push(&mut self, walls: &mut Walls, dt: f64) {
        let inverse = 1.0 / self.projection.lattice.expect("surveyed").gradient;
        self.rows.set_pressures(&self.derived, &self.search, self.parameters.mirror);
        self.extrapolate_to_walls(walls); // E9
        self.push_walls(walls, dt, inverse);
        self.phases.begin(Phase::Momentum);
        self.find_head();
        self.find_normals();
        let mut pushes = std::mem::take(&mut self.projection.pushes);
        pushes.resize(self.particles.len(), Push::default());
        self.parameters.kernel.run(Pushing { fluid: self, inverse, out: &mut pushes });
        // corrections push nobody: their sum goes back, spread evenly
        let (mut impulse, mut mass) = ([0.0; 2], 0.0);
        for (Push { correction, .. }, m) in pushes.iter().zip(&self.particles.mass) {
            for i in 0..2 {
                impulse[i] += m * correction.acceleration[i];
            }
            mass += correction.share * m;
        }
        let back = if mass > 0.0 { impulse.map(|sum| sum / mass) } else { [0.0; 2] };
        let g = self.parameters.gravity;
        let p = &mut self.particles;
        parallel::update_both(&mut p.ax, &mut p.ay, |k, ax, ay| {
            let Push { force, correction: Correction { acceleration, share } } = pushes[k];
            [*ax, *ay] = [0, 1].map(|i| inverse * force[i] / p.mass[k] + g[i] + acceleration[i] - share * back[i]);
        });
        self.derived.surroundings.clone_from(&self.projection.survey.around);
        self.projection.pushes = pushes;
    }

    /// E6: the water's forces on the walls, the same now and in the mean of the step.
    fn push_walls(&mut self, walls: &mut Walls, dt: f64, inverse: f64) {
        self.wall_force.resize(walls.len(), [0.0; 2]);
        if self.parameters.walls.model.has_pressure() {
            let gather = WallForce {
                fluid: &self.rows.fluid,
                walls: &self.rows.walls,
                search: &self.search,
                constants: self.constants_of_projection(),
                wall_nu: self.parameters.wall_nu(),
            };
            self.parameters.sweep_walls(&gather, &mut self.wall_force[..]);
        } else {
            self.repel();
        }
        for k in 0..walls.len() {
            let force = self.wall_force[k].map(|f| inverse * f);
            [walls.fx[k], walls.fy[k]] = force;
            [walls.mean_fx[k], walls.mean_fy[k]] = force;
            walls.mean_swing[k] = walls.swing(k, -dt, force);
        }
    }

    /// I12: E7 with √(|g| h) in the place of c₀.
    pub(crate) fn constants_of_projection(&self) -> Constants {
        let g = self.parameters.gravity;
        let c0 = (g[0].hypot(g[1]) * self.least_length()).sqrt();
        Constants { c0, alpha: 8.0 * self.parameters.projecting.calming, ..self.parameters.constants() }
    }

    /// I11: −ρ g·r of the highest particle at the start and half its spacing [Pa]: no still water is under more pressure than this head gives.
    fn find_head(&mut self) {
        if self.steps > 0 {
            return;
        }
        let (p, g, rho) = (&self.particles, self.parameters.gravity, self.parameters.eos.rho0);
        let half = |k: usize| 0.5 * rho * g[0].hypot(g[1]) * (p.mass[k] / p.rho[k]).sqrt();
        let height = |k: usize| half(k) - rho * (g[0] * p.x[k] + g[1] * p.y[k]);
        self.projection.head = (0..p.len()).map(height).fold(f64::NEG_INFINITY, f64::max);
    }

    /// I10, I11 and I16 for particle `k`, whose neighbours' least pressure is `least` [Pa].
    fn correct(&self, k: usize, least: f64, inverse: f64) -> Correction {
        let (p, g, rho) = (&self.particles, self.parameters.gravity, self.parameters.eos.rho0);
        let lattice = self.projection.lattice.expect("surveyed");
        let (survey, air) = (&self.projection.survey, self.projection.air.exposure[k]);
        let (around, [xx, xy, yy]) = (&survey.around[k], survey.spread[k]);
        let pressure = self.derived.pressure[k];
        let weight = (g[0] * g[0] + g[1] * g[1]).sqrt() * rho;
        let dx = (p.mass[k] / p.rho[k]).sqrt();
        // I10: a row of a flat surface feels the whole of a linear pressure
        let closure = if air > 0.0 { lattice.closure(around.filling) } else { Closure::default() };
        let tie = air * closure.pull;
        let top = pressure.clamp(0.0, weight * closure.depth * dx);
        // I11: a pressure that is the same all around pushes nowhere; nor does the weight of still water
        let head = self.projection.head + rho * (g[0] * p.x[k] + g[1] * p.y[k]);
        let still = pressure.clamp(0.0, head.max(2.0 * weight * p.h[k]));
        let base = if pressure > 0.0 { still.max(least) } else { least };
        let share = 1.0 - air;
        let bearing = if weight > 0.0 { (still / (CALM * weight * dx)).min(1.0) } else { 0.0 };
        let calm = share * bearing;
        let slope = [xx * g[0] + xy * g[1], xy * g[0] + yy * g[1]];
        let pull = tie * (top - share * base.min(top));
        let lift = (pull + share * 2.0 * base) * inverse / rho;
        let mut acceleration = [0, 1].map(|i| lift * around.crowding()[i] + calm * (inverse * slope[i] - g[i]));
        if air > 0.0 {
            let slip = self.slip(k, air * 2.0 * still - pull, air * bearing);
            acceleration = [0, 1].map(|i| acceleration[i] + inverse * slip[i]);
        }
        Correction { acceleration, share }
    }
}

/// I10: what the pairs push with; then I11 and I16.
struct Pushing<'a> {
    fluid: &'a Fluid,
    /// 1/κ (I4).
    inverse: f64,
    out: &'a mut [Push],
}

impl WithKernel for Pushing<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Pushing { fluid, inverse, out } = self;
        let (rows, walls, search) = (&fluid.rows.fluid, &fluid.rows.walls, &fluid.search);
        let (survey, constants) = (&fluid.projection.survey, fluid.constants_of_projection());
        let wall_nu = fluid.parameters.wall_nu();
        let pushing = fluid.parameters.walls.model.has_pressure();
        parallel::gather_into(out, |k| {
            let a = &rows[k];
            let (near, links) = survey.row(k);
            let (mut even, mut odd, mut least) = ([0.0; 2], [0.0; 2], a.p);
            let mut take = |sum: &mut [f64; 2], j: u32, link: f64| {
                let b = &rows[j as usize];
                let push = link * (a.p + b.p);
                sum[0] += push * (a.x - b.x);
                sum[1] += push * (a.y - b.y);
                least = if b.p < least { b.p } else { least };
            };
            let (pairs, last) = near.as_chunks::<2>();
            let (links, last_link) = links.as_chunks::<2>();
            for (j, link) in pairs.iter().zip(links) {
                take(&mut even, j[0], link[0]);
                take(&mut odd, j[1], link[1]);
            }
            for (&j, &link) in last.iter().zip(last_link) {
                take(&mut even, j, link);
            }
            let half = 0.5 * constants.rho0; // of the links: a_ij = 2 V_i V_j |slope|/ρ
            let mut force = [0, 1].map(|i| half * (even[i] + odd[i]) + survey.drag[k][i]);
            for j in listed(&search.walls_of_fluid, pushing).of(k) {
                let w = &walls[j as usize];
                let Some(aw) = bond::<K>(a.x, a.y, a.h, w.x, w.y, w.h) else { continue };
                let [normal, shear] = pair::force::<f64, ElasticPair>(a, w, &aw, &constants, wall_nu);
                force[0] += a.volume * (normal * aw.dx + shear * (a.u - w.u));
                force[1] += a.volume * (normal * aw.dy + shear * (a.v - w.v));
            }
            Push { force, correction: fluid.correct(k, least, inverse) }
        });
    }
}
