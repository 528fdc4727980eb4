//! Bodies inside the projection (THEORY CO19–CO22, CO25): the accelerations of the walls' owners and the pressures that they cause
//! and feel, found together.

use crate::domain::Domain;
use crate::interactions::packed::Packed;
use crate::neighbours::Neighbours;
use crate::walls::interface::{InterfaceResidual, WallInterface};
use crate::walls::{WallForces, Walls};

use crate::projection::linear_solver::cg::{NotConverged, PressureSolver, Stop};
use crate::projection::linear_solver::matrix::Matrix;
use crate::projection::monolithic::reaction::{Inflow, Reaction};
use crate::projection::monolithic::subspace::Subspace;

/// Up to so many unknowns each gets its own response; more are searched along residuals (CO22).
const FEW: usize = 6;
/// Residuals along which is searched in a solve, at most.
const MOST: usize = 40;
/// Residual of the accelerations, relative, at which a search along residuals ends [-].
const ENOUGH: f64 = 1e-7;

/// What is kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Bodies {
    /// Pressures that a unit of each unknown causes, by the identity of particles: where the next solve begins.
    responses: Vec<Vec<f64>>,
    /// Solves for responses.
    pub solves: u64,
    /// Iterations of these.
    pub iterations: u64,
}

/// The pressure equation, as it stands.
pub(crate) struct Equation<'a> {
    pub solver: &'a mut PressureSolver,
    pub matrix: &'a Matrix,
    pub constrained: &'a [bool],
    pub stop: Stop,
    /// Its right side; what accelerations add is put there.
    pub source: &'a mut [f64],
    /// Its solution.
    pub pressure: &'a mut [f64],
}

/// The owners of walls and the water beside them, in one step.
pub(crate) struct MonolithicSolve<'a> {
    packed: &'a Packed,
    neighbours: &'a Neighbours,
    domain: &'a Domain,
    ids: &'a [u32],
    owners: &'a mut [WallInterface],
    walls: &'a mut Walls,
    /// Walls with the accelerations that the present unknowns add.
    trial: Walls,
    unknowns: Vec<f64>,
    /// 1/κ (PR4).
    inverse: f64,
}

/// A change of the unknowns, and what it makes.
struct Response {
    direction: Vec<f64>,
    source: Vec<f64>,
    pressure: Vec<f64>,
}

impl<'a> MonolithicSolve<'a> {
    /// Of owners whose unknowns are those that their walls' kinematics are written with.
    pub fn of(
        (packed, neighbours, domain): (&'a Packed, &'a Neighbours, &'a Domain),
        ids: &'a [u32],
        owners: &'a mut [WallInterface],
        walls: &'a mut Walls,
        inverse: f64,
    ) -> MonolithicSolve<'a> {
        let unknowns = owners.iter().flat_map(|member| member.owner.unknowns()).collect();
        let trial = walls.clone();
        let mut meeting = MonolithicSolve { packed, neighbours, domain, ids, owners, walls, trial, unknowns, inverse };
        meeting.set_trial(&meeting.unknowns.clone());
        meeting
    }

    /// CO21, CO22, CO25: the pressure equation has been solved with the present unknowns; change unknowns, right side and pressures
    /// together until the residual vanishes.
    pub fn solve(&mut self, bodies: &mut Bodies, equation: &mut Equation<'_>) -> Result<(), NotConverged> {
        if self.unknowns.is_empty() {
            return Ok(());
        }
        let found = self.search_shares(bodies, equation);
        self.set_trial(&self.unknowns.clone());
        found
    }

    fn search_shares(&mut self, bodies: &mut Bodies, equation: &mut Equation<'_>) -> Result<(), NotConverged> {
        let start = self.unknowns.clone();
        let InterfaceResidual { residual, driving } = self.residual(equation.pressure);
        let scale = norm(&driving) + norm(&residual.iter().zip(&start).map(|(r, x)| r + x).collect::<Vec<f64>>());
        let mut space = Subspace::new(residual.clone());
        let mut responses = Vec::new();
        let few = start.len() <= FEW;
        for k in 0..if few { start.len() } else { MOST } {
            let direction = if few { unit(k, start.len()) } else { space.residual() };
            if !few && norm(&direction) <= ENOUGH * scale {
                break;
            }
            let Some(response) = self.respond(&start, (k, direction), few, bodies, equation)? else { continue };
            let moved: Vec<f64> = start.iter().zip(&response.direction).map(|(x, d)| x + d).collect();
            self.set_trial(&moved);
            let pressure: Vec<f64> = equation.pressure.iter().zip(&response.pressure).map(|(p, q)| p + q).collect();
            let there = self.residual(&pressure).residual;
            space.add(there.iter().zip(&residual).map(|(r, r0)| r - r0).collect());
            responses.push(response);
        }
        let mut x = start;
        for (share, response) in space.shares().into_iter().zip(&responses) {
            add(&mut x, share, &response.direction);
            add(equation.source, share, &response.source);
            add(equation.pressure, share, &response.pressure);
        }
        self.unknowns = x;
        Ok(())
    }

    /// CO20: the pressures that a change of the unknowns causes; `None` of one that is held.
    fn respond(
        &mut self,
        start: &[f64],
        (k, direction): (usize, Vec<f64>),
        few: bool,
        bodies: &mut Bodies,
        equation: &mut Equation<'_>,
    ) -> Result<Option<Response>, NotConverged> {
        let n = equation.pressure.len();
        let moved: Vec<f64> = start.iter().zip(&direction).map(|(x, d)| x + d).collect();
        self.set_trial(start);
        let before: Vec<[f64; 2]> = self.accelerations();
        let held = self.residual(equation.pressure).residual;
        self.set_trial(&moved);
        // the residual along a direction in which an owner is held does not change
        if few && self.residual(equation.pressure).residual[k] == held[k] {
            return Ok(None);
        }
        let added: Vec<[f64; 2]> =
            self.accelerations().iter().zip(&before).map(|(a, b)| [a[0] - b[0], a[1] - b[1]]).collect();
        let (mut source, mut pressure) = (vec![0.0; n], vec![0.0; n]);
        self.domain.fluid.kernel.run(Inflow {
            fluid: &self.packed.fluid,
            walls: &self.packed.walls,
            neighbours: self.neighbours,
            accelerations: &added,
            side: if self.domain.mirror.is_some() { -1.0 } else { 1.0 },
            out: &mut source,
        });
        let volume = |i: usize| self.packed.fluid[i].raw_volume;
        let strongest = (0..n).map(|i| (source[i] / volume(i)).abs()).fold(0.0, f64::max);
        if strongest > 0.0 {
            if few {
                bodies.responses.resize(start.len(), Vec::new());
                let kept = &mut bodies.responses[k];
                kept.resize(n, 0.0);
                pressure.iter_mut().zip(self.ids).for_each(|(p, &id)| *p = kept[id as usize]);
            }
            let scale: Vec<f64> = (0..n).map(|i| volume(i) * strongest).collect();
            let Equation { solver, matrix, constrained, stop, .. } = equation;
            let solved = solver.persist(matrix, &source, &scale, constrained, &mut pressure, stop)?;
            bodies.solves += 1;
            bodies.iterations += solved.iterations as u64;
            if few {
                let kept = &mut bodies.responses[k];
                pressure.iter().zip(self.ids).for_each(|(p, &id)| kept[id as usize] = *p);
            }
        }
        Ok(Some(Response { direction, source, pressure }))
    }

    /// The walls take the unknowns: their accelerations are those of the supposed walls.
    pub fn finish(self) {
        for k in 0..self.walls.len() {
            self.walls.ax[k] += self.trial.ax[k];
            self.walls.ay[k] += self.trial.ay[k];
        }
    }

    /// Give the owners other unknowns, and the supposed walls what these add to the accelerations written.
    fn set_trial(&mut self, unknowns: &[f64]) {
        self.trial.ax.fill(0.0);
        self.trial.ay.fill(0.0);
        let mut rest = unknowns;
        for WallInterface { range, owner, .. } in &mut *self.owners {
            let (own, others) = rest.split_at(owner.unknowns().len());
            owner.accelerate(own, self.trial.slice_mut(range.clone()));
            rest = others;
        }
    }

    /// What the unknowns supposed add to the accelerations written [m/s²].
    fn accelerations(&self) -> Vec<[f64; 2]> {
        self.trial.ax.iter().zip(&self.trial.ay).map(|(x, y)| [*x, *y]).collect()
    }

    /// CO21: residual of the trial unknowns under pressures.
    fn residual(&self, pressure: &[f64]) -> InterfaceResidual {
        let (g, rho0) = (self.domain.gravity, self.domain.fluid.density);
        let mut all = InterfaceResidual::default();
        for WallInterface { range, mirrored, owner } in &*self.owners {
            let field = |k: usize| {
                let a = [self.walls.ax[k] + self.trial.ax[k], self.walls.ay[k] + self.trial.ay[k]];
                [rho0 * (g[0] - a[0]), rho0 * (g[1] - a[1])]
            };
            let field: Vec<[f64; 2]> = range.clone().map(field).collect();
            let mut forces = vec![[0.0; 2]; range.len()];
            self.domain.fluid.kernel.run(Reaction {
                fluid: &self.packed.fluid,
                walls: &self.packed.walls,
                neighbours: self.neighbours,
                first: range.start,
                pressure,
                field: &field,
                inverse: self.inverse,
                out: &mut forces,
            });
            let [fx, fy] = [0, 1].map(|i| forces.iter().map(|f| f[i]).collect::<Vec<f64>>());
            let each = range.clone().zip(&forces);
            let mean_swing: Vec<f64> = each.map(|(k, f)| self.walls.swing(k, -self.walls.dt, *f)).collect();
            let (x, y) = (&self.walls.x[range.clone()], &self.walls.y[range.clone()]);
            let (mean_fx, mean_fy, mirrored) = (&fx[..], &fy[..], *mirrored);
            let forces = WallForces { x, y, fx: &fx, fy: &fy, mean_fx, mean_fy, mean_swing: &mean_swing, mirrored };
            let own = owner.residual_in_mean(&forces);
            all.residual.extend(own.residual);
            all.driving.extend(own.driving);
        }
        all
    }
}

fn unit(k: usize, n: usize) -> Vec<f64> {
    (0..n).map(|i| if i == k { 1.0 } else { 0.0 }).collect()
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn add(to: &mut [f64], share: f64, what: &[f64]) {
    to.iter_mut().zip(what).for_each(|(t, w)| *t += share * w);
}
