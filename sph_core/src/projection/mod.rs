//! The incompressible solver: a projection a step (THEORY I1–I14).
//!
//! Read in this order: [`step`], [`survey`] (what the pairs give), [`lattice`] (what a flat surface lacks), [`air`] (where
//! the air is), [`poisson`] (the pressure).

mod aggregates;
mod air;
mod bodies;
pub mod cg;
mod coarse;
mod explicit;
mod hierarchy;
mod lattice;
pub mod matrix;
mod multigrid;
mod null_space;
mod poisson;
mod reaction;
mod subspace;
mod survey;
#[cfg(test)]
mod test_systems;
#[cfg(test)]
mod tests;
mod woodbury;

pub use cg::{NotConverged, PressureSolver, Solved, Stop};
pub use hierarchy::Preconditioner;
pub use matrix::{Matrix, RankOne};

use serde::{Deserialize, Serialize};

use crate::error::Breakdown;
use crate::fluid::Fluid;
use crate::solver::Solver;
use crate::walls::Walls;

use air::Air;
use bodies::Bodies;
use lattice::Lattice;
use survey::Survey;

/// What a projection does not change during a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Projecting {
    /// Residual that ends the iteration, over the largest right-hand side [-].
    pub tolerance: f64,
    /// Iterations after which a solve has failed.
    pub most_iterations: usize,
    /// Time in which an error of density relaxes, over h/U (I9) [-].
    pub relaxation: f64,
    /// Viscosity over h √(|g| h) (I12) [-].
    pub calming: f64,
    /// Shift over the distance moved in a step, times 2h∇C [-].
    pub shift: f64,
    /// Experimental switches.
    pub x: [f64; 6],
}

impl Default for Projecting {
    fn default() -> Projecting {
        Projecting { tolerance: 1e-4, most_iterations: 2000, relaxation: 10.0, calming: 0.1, shift: 1.0, x: [0.0; 6] }
    }
}

/// What a step of the projection computes anew, and what it counts.
#[derive(Clone, Debug, Default)]
pub struct Projection {
    pub(crate) survey: Survey,
    pub(crate) lattice: Option<Lattice>,
    pub(crate) air: Air,
    /// Excess of each row's diagonal: the free surface (I7).
    pub(crate) excess: Vec<f64>,
    pub(crate) least: Vec<f64>,
    pub(crate) wet: Vec<f64>,
    pub(crate) pinned: Vec<bool>,
    pub(crate) source: Vec<f64>,
    pub(crate) scale: Vec<f64>,
    pub(crate) matrix: Matrix,
    pub(crate) solver: PressureSolver,
    /// Iterations of all solves.
    pub iterations: u64,
    /// Solves.
    pub solves: u64,
    /// Rows pinned by the unilateral condition, in the last step.
    pub pins: usize,
    /// What bodies need from step to step (PB2).
    pub bodies: Bodies,
    last_dt: f64,
    head: f64,
    /// The last step's pressures [Pa].
    pub(crate) before: Vec<f64>,
}

/// One step (THEORY I1). Before: the walls' kinematics are those of the step's end.
pub(crate) fn step(fluid: &mut Fluid, walls: &mut Walls, dt: f64) -> Result<(), Breakdown> {
    fluid.pack(walls, -dt); //           who is near whom at r
    fluid.find_air(walls); //            holes
    fluid.dry_walls(walls);
    fluid.survey(walls, dt); //          C, ∇C, ∇·u*, A
    fluid.expose(); //                   e
    fluid.close_surface(); //            s
    match fluid.parameters.solver {
        Solver::IncompressibleExplicit => fluid.sweep_pressure(dt), // the same, one sweep (EX3)
        _ => fluid.solve_pressure(walls, dt)?, // (A + s) p = −V ∇·u*/Δt + V (C − 1)/(τ Δt); a_w with it (PB3)
    }
    fluid.push(walls, dt); //            a = g − ∇p/ρ, F
    fluid.kick(dt); //                   u' = u + Δt a
    fluid.drift(dt); //                  r' = r + Δt u'
    fluid.rearrange(dt); //              r' ← r' + δr
    fluid.projection.last_dt = dt;
    if std::env::var("DBG").is_ok() {
        let p = &fluid.particles;
        let pr = &fluid.derived.pressure;
        let k = (0..p.len()).max_by(|&a, &b| pr[a].abs().total_cmp(&pr[b].abs())).unwrap();
        let m = (0..p.len()).max_by(|&a, &b| p.u[a].hypot(p.v[a]).total_cmp(&p.u[b].hypot(p.v[b]))).unwrap();
        let a = &fluid.projection.survey.around;
        eprintln!(
            "t {:.5} dt {:.2e} it {} pins {} | pmax {:.3e} at ({:.4},{:.4}) C {:.3} lam {:.2} e {:.2} s {:.2e} | vmax {:.3} at ({:.4},{:.4}) p {:.2e} C {:.3} lam {:.2} e {:.2} a ({:.1},{:.1})",
            fluid.time,
            dt,
            fluid.projection.iterations,
            fluid.projection.pins,
            pr[k],
            p.x[k],
            p.y[k],
            a[k].filling,
            a[k].lambda,
            fluid.projection.air.exposure[k],
            fluid.projection.excess[k],
            p.u[m].hypot(p.v[m]),
            p.x[m],
            p.y[m],
            pr[m],
            a[m].filling,
            a[m].lambda,
            fluid.projection.air.exposure[m],
            p.ax[m],
            p.ay[m]
        );
    }
    Ok(())
}

impl Fluid {
    /// I12: forces of the pressures just found, on the fluid and on walls.
    fn push(&mut self, walls: &mut Walls, dt: f64) {
        let lattice = self.projection.lattice.expect("surveyed");
        self.rows.set_pressures(&self.derived, &self.search, self.parameters.mirror);
        self.extrapolate_to_walls(walls);
        self.gather_forces(walls);
        let inverse = 1.0 / lattice.gradient;
        for k in 0..walls.len() {
            walls.fx[k] *= inverse;
            walls.fy[k] *= inverse;
            [walls.mean_fx[k], walls.mean_fy[k]] = [walls.fx[k], walls.fy[k]];
            walls.mean_swing[k] = walls.swing(k, -dt, [walls.fx[k], walls.fy[k]]);
        }
        let (p, g, rho) = (&mut self.particles, self.parameters.gravity, self.parameters.eos.rho0);
        let weight = g[0].hypot(g[1]) * rho;
        let (survey, air) = (&self.projection.survey, &self.projection.air.exposure);
        let calm = self.parameters.projecting.x[2] == 0.0;
        let (mut impulse, mut mass) = ([0.0; 2], 0.0);
        let mut shares = vec![0.0; p.len()];
        let least = &mut self.projection.least;
        least.resize(p.len(), 0.0);
        let (search, pressures, n) = (&self.search, &self.derived.pressure, p.len());
        crate::sweep::gather_into(least, |k| {
            let around = search.fluid.of(k).iter().map(|&j| pressures[search.source(j, n)]);
            around.fold(pressures[k], f64::min)
        });
        let least = &self.projection.least;
        let weighty = weight > 0.0;
        if self.steps == 0 {
            let height = |k: usize| -(g[0] * p.x[k] + g[1] * p.y[k]) * rho;
            self.projection.head = (0..p.len()).map(height).fold(f64::NEG_INFINITY, f64::max);
        }
        for (k, sum) in self.gathered.iter().enumerate() {
            let around = &survey.around[k];
            let dx = (p.mass[k] / p.rho[k]).sqrt();
            let pressure = self.derived.pressure[k];
            let closure = if air[k] > 0.0 { lattice.closure(around.filling) } else { Default::default() };
            let tie = air[k] * closure.pull;
            let top = pressure.clamp(0.0, weight * closure.depth * dx);
            let pull = tie * top * inverse / rho;
            let mut a = [0, 1].map(|i| inverse * sum.force[i] / p.mass[k] + g[i] + pull * around.crowding[i]);
            if calm {
                let head = self.projection.head + rho * (g[0] * p.x[k] + g[1] * p.y[k]);
                let still = pressure.clamp(0.0, head.max(2.0 * weight * p.h[k]));
                let base = if pressure > 0.0 { still.max(least[k]) } else { least[k] };
                let share = 1.0 - air[k];
                let heavy = if weighty { share * (still / (0.25 * weight * dx)).min(1.0) } else { 0.0 };
                let m = survey.spread[k];
                let slope = [m[0] * g[0] + m[1] * g[1], m[1] * g[0] + m[2] * g[1]];
                for i in 0..2 {
                    let lift = (2.0 * base - tie * base.min(top)) * around.crowding[i] / rho;
                    let error = share * inverse * lift + heavy * (inverse * slope[i] - g[i]);
                    a[i] += error;
                    impulse[i] += p.mass[k] * (error + pull * around.crowding[i]);
                }
                mass += share * p.mass[k];
                shares[k] = share;
            }
            [p.ax[k], p.ay[k]] = a;
            self.derived.surroundings[k] = *around;
        }
        if mass > 0.0 {
            for k in 0..p.x.len() {
                p.ax[k] -= shares[k] * impulse[0] / mass;
                p.ay[k] -= shares[k] * impulse[1] / mass;
            }
        }
    }

    /// I13: shifting, along the surface near air.
    fn rearrange(&mut self, dt: f64) {
        if !self.parameters.shifting {
            return;
        }
        let strength = self.parameters.projecting.shift;
        let p = &mut self.particles;
        for k in 0..p.x.len() {
            let around = &self.derived.surroundings[k];
            let speed = p.u[k].hypot(p.v[k]);
            let scale = -2.0 * strength * p.h[k] * dt * speed * p.h[k] / p.h[k];
            let mut d = around.crowding.map(|c| scale * c);
            let exposed = self.projection.air.exposure[k];
            if exposed > 0.0 {
                let n = around.crowding;
                let n2 = n[0] * n[0] + n[1] * n[1];
                if n2 > 0.0 {
                    let along = exposed * (d[0] * n[0] + d[1] * n[1]) / n2;
                    d = [d[0] - along * n[0], d[1] - along * n[1]];
                }
            }
            let limit = 0.05 * p.h[k];
            let shrink = limit / d[0].hypot(d[1]).max(limit);
            p.x[k] += shrink * d[0];
            p.y[k] += shrink * d[1];
        }
    }

    /// Smallest smoothing length [m].
    pub(crate) fn least_length(&self) -> f64 {
        crate::sweep::least(self.particles.len(), |k| self.particles.h[k])
    }

    /// I14: the step of a projection [s].
    pub(crate) fn projection_dt(&self, walls: &Walls) -> f64 {
        let (p, q, cfl) = (&self.particles, &self.parameters, self.courant());
        let limit =
            |h: f64, u: f64, v: f64, ax: f64, ay: f64| (cfl * h / u.hypot(v)).min(0.25 * (h / ax.hypot(ay)).sqrt());
        let of_fluid = |k: usize| limit(p.h[k], p.u[k], p.v[k], p.ax[k], p.ay[k]);
        let of_wall = |k: usize| limit(walls.h[k], walls.u[k], walls.v[k], walls.ax[k], walls.ay[k]);
        let cap = cfl * self.least_length() / q.speed;
        let now = crate::sweep::least(p.len(), of_fluid).min(crate::sweep::least(walls.len(), of_wall)).min(cap);
        if self.projection.last_dt > 0.0 { now.min(1.1 * self.projection.last_dt) } else { now }
    }
}
