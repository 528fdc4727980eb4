//! Bodies inside the projection (THEORY CO19–CO22, CO25): the accelerations of the walls' owners and the pressures that they cause
//! and feel, found together (CO23).

mod subspace;

use serde::{Deserialize, Serialize};
use subspace::Subspace;

use crate::domain::Domain;
use crate::interactions::geometry::pair_geometry;
use crate::interactions::packed::Packed;
use crate::kernel::{Shape, TargetSum};
use crate::neighbours::Neighbours;
use crate::projection::linear_pressure::LinearPressure;
use crate::projection::linear_solver::cg::{NotConverged, PressureSolver, Stop};
use crate::projection::linear_solver::cluster_matrix::ClusterMatrix;
use crate::walls::interface::{InterfaceResidual, WallInterface};
use crate::walls::{WallForces, Walls};

/// Up to this number of unknowns each gets its own response; more are searched along residuals (CO22).
const FEW: usize = 6;
/// Residuals along which is searched in a solve, at most.
const MOST: usize = 40;
/// Residual of the accelerations, relative, at which a search along residuals ends [-].
const ENOUGH: f64 = 1e-7;

/// What is kept from step to step.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
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
    pub matrix: ClusterMatrix<'a>,
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
    linear_pressure: &'a LinearPressure,
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
        linear_pressure: &'a LinearPressure,
        ids: &'a [u32],
        owners: &'a mut [WallInterface],
        walls: &'a mut Walls,
        inverse: f64,
    ) -> MonolithicSolve<'a> {
        let unknowns = owners.iter().flat_map(|member| member.owner.unknowns()).collect();
        let trial = walls.clone();
        let mut meeting = MonolithicSolve {
            packed,
            neighbours,
            domain,
            linear_pressure,
            ids,
            owners,
            walls,
            trial,
            unknowns,
            inverse,
        };
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
        let side = if self.domain.mirror.is_some() { -1.0 } else { 1.0 };
        let inflow = Inflow { packed: self.packed, neighbours: self.neighbours, accelerations: &added, side };
        self.domain.fluid.kernel.gather(&inflow, &mut source);
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
            let mut loads = vec![([0.0; 2], 0.0); range.len()];
            let (packed, neighbours, first, inverse) = (self.packed, self.neighbours, range.start, self.inverse);
            let reaction = Reaction { packed, neighbours, first, pressure, field: &field, inverse };
            self.domain.fluid.kernel.gather(&reaction, &mut loads);
            let (mut forces, pressures): (Vec<[f64; 2]>, Vec<f64>) = loads.into_iter().unzip();
            for (force, more) in forces.iter_mut().zip(self.linear_pressure.correction(range.clone(), &pressures)) {
                *force = [force[0] + more[0], force[1] + more[1]]; // PR19
            }
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

/// CO19: force [N/m] on the wall particles from `first` on, and their pressures [Pa], under any pressures, one per fluid particle; the
/// same sums as WA3 and WC5.
struct Reaction<'a> {
    packed: &'a Packed,
    neighbours: &'a Neighbours,
    /// The first of these wall particles.
    first: usize,
    /// Pressures [Pa].
    pressure: &'a [f64],
    /// ρ₀(g − a_w) of each of these wall particles [N/m³].
    field: &'a [[f64; 2]],
    /// 1/κ (PR4) [-].
    inverse: f64,
}

impl TargetSum for Reaction<'_> {
    type Sum = ([f64; 2], f64);
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> ([f64; 2], f64) {
        let Reaction { packed: Packed { fluid, walls, .. }, neighbours, first, pressure, field, inverse } = self;
        let n = pressure.len();
        let wall = &walls[first + k];
        let (mut weight, mut mean, mut arm) = (0.0, 0.0, [0.0; 2]);
        let (mut slopes, mut push) = ([0.0; 2], [0.0; 2]);
        for j in neighbours.fluid_of_wall.of(first + k) {
            let b = &fluid[j as usize];
            let Some(wb) = pair_geometry::<K>(wall.x, wall.y, wall.h, b.x, b.y, b.h) else { continue };
            let (p, share, pull) =
                (pressure[neighbours.source(j, n)], b.volume * wb.w::<K>(), b.volume * wb.grad_factor);
            weight += share;
            mean += share * p;
            arm = [arm[0] + share * wb.dx, arm[1] + share * wb.dy];
            slopes = [slopes[0] + pull * wb.dx, slopes[1] + pull * wb.dy];
            push = [push[0] + p * pull * wb.dx, push[1] + p * pull * wb.dy];
        }
        // as in WA3: no pressure without a fluid in reach
        let own = if weight < 1e-9 { 0.0 } else { (mean + field[k][0] * arm[0] + field[k][1] * arm[1]) / weight };
        ([0, 1].map(|i| -inverse * wall.volume * (push[i] + own * slopes[i])), own)
    }
}

/// CO20: what accelerations of walls add to the right side of the pressure equation [m²/s²], V_i Σ_w 2V_w a_w·∇W_iw with its sign
/// changed.
struct Inflow<'a> {
    packed: &'a Packed,
    neighbours: &'a Neighbours,
    /// Accelerations of all wall particles [m/s²]; images follow theirs.
    accelerations: &'a [[f64; 2]],
    /// Sign of an image's acceleration along x: −1 where images reflect.
    side: f64,
}

impl TargetSum for Inflow<'_> {
    type Sum = f64;
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> f64 {
        let Inflow { packed: Packed { fluid, walls, .. }, neighbours, accelerations, .. } = self;
        let n = accelerations.len();
        let (a, mut sum) = (&fluid[k], 0.0);
        for j in neighbours.walls_of_fluid.of(k) {
            let j = j as usize;
            let (source, side) = if j < n { (j, 1.0) } else { (neighbours.wall_images[j - n] as usize, self.side) };
            let [ax, ay] = accelerations[source];
            if ax == 0.0 && ay == 0.0 {
                continue;
            }
            let w = &walls[j];
            let Some(aw) = pair_geometry::<K>(a.x, a.y, a.h, w.x, w.y, w.h) else { continue };
            sum -= 2.0 * w.volume * aw.grad_factor * (side * ax * aw.dx + ay * aw.dy);
        }
        a.raw_volume * sum
    }
}
