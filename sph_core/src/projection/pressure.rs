//! The pressure equation (THEORY PR7–PR11, PR15, PR16).

use serde::{Deserialize, Serialize};

use crate::error::Breakdown;
use crate::parallel;
use crate::particles::Particles;
use crate::projection::free_surface::active_set::{ActiveSet, Rows, Surface};
use crate::projection::lattice::Lattice;
use crate::projection::linear_pressure::LinearPressure;
use crate::projection::linear_solver::cg::{NotConverged, PressureSolver, Stop};
use crate::projection::linear_solver::cluster_matrix::ClusterRows;
use crate::projection::monolithic::{Bodies, Equation, MonolithicSolve};
use crate::projection::operators::Operators;
use crate::projection::settings::{Method, Settings};
use crate::system::ParticleSystem;
use crate::walls::Walls;
use crate::walls::interface::WallInterface;

/// Share of the kernel that may be missing without air [-].
const LARGEST_HOLE: f64 = 0.1;
/// Rounds in which the active set changes, at most.
const ACTIVE_SET_ROUNDS: usize = 12;
/// How much longer an error of density takes to relax where pressures are not solved for (PR16) [-].
const ONE_ITERATION: f64 = 100.0 / 3.0;

/// The pressure equation with its solver's memory.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct PressureEquation {
    /// Excess of each row's diagonal: the free surface (PR7).
    #[serde(skip)]
    excess: Vec<f64>,
    #[serde(skip)]
    source: Vec<f64>,
    #[serde(skip)]
    scale: Vec<f64>,
    #[serde(skip)]
    matrix: ClusterRows,
    solver: PressureSolver,
    active: ActiveSet,
    /// Responses of the pressures to bodies, kept from step to step (CO20).
    bodies: Bodies,
    /// The last step's pressures [Pa].
    #[serde(skip)]
    before: Vec<f64>,
    /// Iterations of all solves.
    pub iterations: u64,
    /// Solves.
    pub solves: u64,
}

impl PressureEquation {
    /// What a stored equation is without.
    pub fn complete(&mut self) {
        self.solver.complete();
    }

    /// Rows held at p = 0 in the last step.
    pub fn constrained_rows(&self) -> usize {
        self.active.count
    }

    /// PR7: rows near air are tied to it.
    pub fn close_surface(&mut self, system: &ParticleSystem, operators: &Operators, air: &[f64], lattice: &Lattice) {
        let rho0 = system.domain.fluid.density;
        self.excess.resize(system.particles.len(), 0.0);
        parallel::gather_into(&mut self.excess, |k| {
            if air[k] == 0.0 {
                return 0.0;
            }
            // V_i · 2 |M|/(ρ d), |M|/d in units of 1/Δx²: V/Δx² = 1
            air[k] * 2.0 * lattice.closure(operators.around[k].kernel_sum).link / rho0
        });
    }

    /// PR9: the right side.
    pub fn gather_source(
        &mut self,
        system: &ParticleSystem,
        operators: &Operators,
        air: &[f64],
        lattice: &Lattice,
        reference_kernel_sum: &[f64],
        settings: &Settings,
        dt: f64,
    ) {
        let p = &system.particles;
        let factor = if settings.method == Method::OneIteration { ONE_ITERATION } else { 1.0 };
        let relaxation = factor * settings.relaxation * system.least_smoothing_length() / system.domain.fastest_speed;
        self.source.resize(p.len(), 0.0);
        parallel::gather_into(&mut self.source, |k| {
            let reference = reference_kernel_sum[p.id[k] as usize];
            let excess = (operators.around[k].kernel_sum - reference) / lattice.kernel_sum;
            let excess = excess.max(-LARGEST_HOLE * (1.0 - air[k]));
            lattice.gradient * raw_volume(p, k) / dt * (excess / relaxation - operators.divergence[k])
        });
    }

    /// PR15: one Jacobi iteration of the pressure equation, from the last step's pressures; no tension where PR8 forbids it.
    pub fn relax_once(&mut self, system: &mut ParticleSystem, operators: &Operators, air: &[f64], ventilated: bool) {
        let (neighbours, n) = (&system.neighbours, system.particles.len());
        self.active.clear(n);
        self.before.clone_from(&system.fields.pressure);
        let PressureEquation { source, excess, before, active, .. } = self;
        parallel::gather_into(&mut system.fields.pressure, |k| {
            let (mut sum, mut diagonal) = (source[k], excess[k]);
            for (j, value) in operators.row(k) {
                let source = neighbours.source(j, n);
                if source != k {
                    sum += value * before[source];
                    diagonal += value;
                }
            }
            if diagonal > 0.0 { sum / diagonal } else { 0.0 }
        });
        let surface = Surface { indicator: air, neighbours, ventilated };
        active.constrain(&mut system.fields.pressure, surface);
    }

    /// PR8–PR11. A failure leaves the last step's pressures, and nothing has moved.
    pub fn solve(
        &mut self,
        system: &mut ParticleSystem,
        walls: &mut Walls,
        interfaces: &mut [WallInterface],
        linear_pressure: &LinearPressure,
        operators: &Operators,
        air: &[f64],
        lattice: &Lattice,
        settings: &Settings,
    ) -> Result<(), Breakdown> {
        let ParticleSystem { particles: p, fields, packed, neighbours, domain, time, .. } = system;
        let n = p.len();
        let PressureEquation { excess, source, scale, matrix, solver, active, bodies, before, iterations, solves } =
            self;
        let strongest = -parallel::least(n, |k| -(source[k] / raw_volume(p, k)).abs());
        scale.resize(n, 0.0);
        let strongest = if strongest > 0.0 { strongest } else { 1.0 }; // free fall has no source
        parallel::gather_into(scale, |k| raw_volume(p, k) * strongest);
        let matrix = matrix.assemble(operators, excess, neighbours, domain.simd);
        let x = &mut fields.pressure;
        let stop = Stop { tolerance: settings.tolerance, most_iterations: settings.most_iterations };
        let ventilated = settings.flow.ventilation;
        let surface = Surface { indicator: air, neighbours, ventilated };
        active.warm_start(x, &p.id, &Rows { matrix, source, scale }, surface);
        solver.name(&p.id);
        solver.prepare(&matrix, &p.x, &p.y, &p.h);
        let inverse = 1.0 / lattice.gradient;
        let mut monolithic =
            MonolithicSolve::of((packed, neighbours, domain), linear_pressure, &p.id, interfaces, walls, inverse);
        before.clone_from(x);
        for _ in 0..ACTIVE_SET_ROUNDS {
            let constrained = &active.constrained[..];
            let found = solver.persist(&matrix, source, scale, constrained, x, &stop).and_then(|solved| {
                *iterations += solved.iterations as u64;
                *solves += 1;
                monolithic.solve(bodies, &mut Equation { solver, matrix, constrained, stop, source, pressure: x })
            });
            if let Err(failed) = found {
                x.copy_from_slice(before);
                return Err(not_converged(&failed, p, stop.tolerance, *time));
            }
            if !active.update(x, &Rows { matrix, source, scale }, surface) {
                break;
            }
        }
        active.store(&p.id);
        monolithic.finish();
        Ok(())
    }
}

/// m/ρ of particle `k` [m²].
fn raw_volume(p: &Particles, k: usize) -> f64 {
    p.mass[k] / p.rho[k]
}

fn not_converged(failed: &NotConverged, p: &Particles, tolerance: f64, time: f64) -> Breakdown {
    let NotConverged { iterations, residual, worst: k } = *failed;
    Breakdown::Projection { iterations, residual, tolerance, id: p.id[k], x: p.x[k], y: p.y[k], time }
}
