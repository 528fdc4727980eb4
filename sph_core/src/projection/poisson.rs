//! The pressure (THEORY I8–I11).

use crate::error::Breakdown;
use crate::fluid::Fluid;
use crate::parallel;
use crate::solver::Solver;
use crate::walls::Walls;

use crate::projection::Projection;
use crate::projection::linear_solver::cg::Stop;
use crate::projection::monolithic::solve::{Equation, Meeting};

/// Share of the kernel that is believed to be missing without air [-].
const LARGEST_HOLE: f64 = 0.1;
/// Rounds of pinning rows under tension near air.
const PIN_ROUNDS: usize = 6;
/// How much longer an error of density takes to relax where pressures are swept, not solved for (EX5) [-].
const SWEPT: f64 = 100.0 / 3.0;

impl Fluid {
    /// I7: rows near air are tied to it.
    pub(crate) fn close_surface(&mut self) {
        let lattice = self.projection.lattice.expect("surveyed");
        let (p, rho0) = (&self.particles, self.parameters.eos.rho0);
        let (around, air) = (&self.projection.survey.around, &self.projection.air.exposure);
        let n = p.len();
        self.projection.excess.resize(n, 0.0);
        parallel::gather_into(&mut self.projection.excess, |k| {
            if air[k] == 0.0 {
                return 0.0;
            }
            // V_i · 2 |M|/(ρ d), |M|/d in units of 1/Δx²: V/Δx² = 1
            air[k] * 2.0 * lattice.closure(around[k].filling).link / rho0
        });
    }

    /// I9: the right side.
    pub(crate) fn gather_source(&mut self, dt: f64) {
        let lattice = self.projection.lattice.expect("surveyed");
        let p = &self.particles;
        let swept = if self.parameters.solver == Solver::IncompressibleExplicit { SWEPT } else { 1.0 };
        let relaxation = swept * self.parameters.projecting.relaxation * self.least_length() / self.parameters.speed;
        let projection = &mut self.projection;
        let (survey, air) = (&projection.survey, &projection.air.exposure);
        projection.source.resize(p.len(), 0.0);
        parallel::gather_into(&mut projection.source, |k| {
            let volume = p.mass[k] / p.rho[k];
            let mut crowd = (survey.around[k].filling - p.theta[k]) / lattice.filling;
            crowd = crowd.max(-LARGEST_HOLE * (1.0 - air[k]));
            lattice.gradient * volume / dt * (crowd / relaxation - survey.divergence[k])
        });
    }

    /// I8–I11. A failure leaves the last step's pressures, and nothing has moved.
    pub(crate) fn solve_pressure(&mut self, walls: &mut Walls, dt: f64) -> Result<(), Breakdown> {
        self.gather_source(dt);
        let lattice = self.projection.lattice.expect("surveyed");
        let settings = self.parameters.projecting;
        let n = self.particles.len();
        let p = &self.particles;
        let projection = &mut self.projection;
        let volume = |k: usize| p.mass[k] / p.rho[k];
        let strongest = -parallel::least(n, |k| -(projection.source[k] / volume(k)).abs());
        projection.scale.resize(n, 0.0);
        parallel::gather_into(&mut projection.scale, |k| volume(k) * strongest.max(f64::MIN_POSITIVE));
        projection.matrix.assemble(&projection.survey, &projection.excess, &self.search);
        let x = &mut self.derived.pressure;
        let stop = Stop { tolerance: settings.tolerance, most_iterations: settings.most_iterations };
        projection.keep_pins(x, &p.id);
        projection.solver.name(&p.id);
        projection.solver.prepare(&projection.matrix, &p.x, &p.y, &p.h);
        let surroundings = (&self.rows, &self.search, &self.parameters);
        let mut meeting = Meeting::of(surroundings, &p.id, &mut self.yielding, walls, 1.0 / lattice.gradient);
        projection.before.clone_from(x);
        for round in 0..PIN_ROUNDS {
            let Projection { solver, matrix, source, scale, pinned, bodies, iterations, solves, .. } = &mut *projection;
            let found = solver.persist(matrix, source, scale, pinned, x, &stop).and_then(|solved| {
                *iterations += solved.iterations as u64;
                *solves += 1;
                meeting.agree(bodies, &mut Equation { solver, matrix, pinned, stop, source, pressure: x })
            });
            if let Err(failed) = found {
                x.copy_from_slice(&projection.before);
                let k = failed.worst;
                return Err(Breakdown::Projection {
                    iterations: failed.iterations,
                    residual: failed.residual,
                    tolerance: stop.tolerance,
                    id: p.id[k],
                    x: p.x[k],
                    y: p.y[k],
                    time: self.time,
                });
            }
            if !projection.revise_pins(x, &self.search, self.parameters.ventilation, round == 0) {
                break;
            }
        }
        projection.remember_pins(&p.id);
        meeting.conclude();
        Ok(())
    }
}
