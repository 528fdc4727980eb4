//! The trapezoidal rule in momentum form: the implicit step of models with rigid bodies.

use super::lumped_mass::LumpedMass;
use super::moving_model::MovingModel;
use super::newton::{ITERATIONS, NewtonControl};
use super::{State, StepReport};
use crate::element::Chord;
use crate::error::Error;
use crate::field::{Field, combine, sum};

/// The iteration ends with a correction that leaves less than the first fraction of the step's motion, plus the second of
/// the total displacement \[-\].
const CONVERGED: [f64; 2] = [1e-12, 3e-15];

/// The same once corrections have stopped contracting: rounding of the forces.
const ROUNDED: [f64; 2] = [1e-8, 1e-13];

/// Corrections larger than this fraction of the one before have stopped contracting \[-\].
const STAGNANT: f64 = 0.3;

/// Most times that a step is halved which does not converge.
const MOST_DIVISIONS: u32 = 7;

/// A correction larger than this times the smallest so far rejects the predictor \[-\].
const DIVERGING: f64 = 100.0;

/// The rule: weight theta = 1/(1 + rho) of the end of the step, and the lumped mass.
#[derive(Debug, Clone)]
pub(crate) struct Trapezoidal {
    pub weight: f64,
    pub mass: LumpedMass,
}

/// A step: its start with the elements' chords, its mean load, and its length \[s\].
struct Step<'a> {
    start: &'a State,
    chords: Vec<Chord>,
    load: &'a [[f64; 3]],
    dt: f64,
}

/// Mean forces over a step, by node.
struct MeanForces {
    /// Load minus elastic and viscous forces, and minus the inertia of masses at linked nodes.
    total: Field,
    viscous: Field,
    arms: Vec<[f64; 2]>,
}

impl Trapezoidal {
    /// M (v1 - v0)/dt = mean load - mean elastic force - C (q1 - q0)/dt with q1 = q0 + dt (theta v1 + (1 - theta) v0), for
    /// q1 by Newton's method; then v1 from the momenta. The mean elastic force does the work of the elastic energy; for
    /// small rotations it is theta f(q1) + (1 - theta) f(q0) (THEORY BE21).
    ///
    /// Where layers flow so fast that the iteration does not converge, in 2, 4, ... parts under the same mean load.
    pub fn step(
        &self,
        model: &mut MovingModel,
        state: &State,
        load: &[[f64; 3]],
        dt: f64,
    ) -> Result<(State, StepReport), Error> {
        let mut outcome = self.whole_step(model, state, load, dt);
        let divides = !state.plastic.is_empty() && model.supports_rest();
        for division in 1..=MOST_DIVISIONS {
            if !(divides && matches!(outcome, Err(Error::StepNotConverged { .. }))) {
                break;
            }
            outcome = self.step_in_parts(model, state, load, dt, 1 << division);
        }
        outcome
    }

    /// A step in equal parts under the same mean load: impulse, work and dissipation are their sums.
    fn step_in_parts(
        &self,
        model: &mut MovingModel,
        state: &State,
        load: &[[f64; 3]],
        dt: f64,
        parts: u32,
    ) -> Result<(State, StepReport), Error> {
        let share = f64::from(parts).recip();
        let (mut new, mut whole) =
            (state.clone(), StepReport { dissipated: 0.0, support_work: 0.0, ..StepReport::new() });
        let mut reaction = vec![[0.0; 3]; load.len()];
        for _ in 0..parts {
            let (next, part) = self.whole_step(model, &new, load, share * dt)?;
            whole.iterations += part.iterations;
            whole.tangents += part.tangents;
            whole.last_correction = part.last_correction;
            whole.dissipated += part.dissipated;
            whole.support_work += part.support_work;
            reaction = combine(&reaction, &next.mean_reaction, |sum, part| sum + share * part);
            new = next;
        }
        new.mean_reaction = reaction;
        new.integrated_acceleration = combine(&new.velocity, &state.velocity, |to, from| (to - from) / dt);
        new.time = state.time + dt;
        Ok((new, whole))
    }

    fn whole_step(
        &self,
        model: &mut MovingModel,
        state: &State,
        load: &[[f64; 3]],
        dt: f64,
    ) -> Result<(State, StepReport), Error> {
        let mut report = StepReport::new();
        let step = Step { start: state, chords: model.system.chords(&state.displacement), load, dt };
        // With the acceleration of the state; with the mean one of the last step, for stiff models that rotate; none.
        let mut new = state.clone();
        let mut converged = false;
        for acceleration in [Some(&state.acceleration), Some(&state.integrated_acceleration), None] {
            new = step.predict(model, acceleration);
            converged = self.solve(model, &step, acceleration.is_some(), &mut new, &mut report)?;
            if converged {
                break;
            }
        }
        let dissipated = self.elastic_forces(model, &step, &new);
        let mean = self.mean_forces(model, &step, &new);
        if !converged {
            let (residual, node, dof) = model.system.worst(&self.residual(model, &step, &new, &mean));
            let (time, iteration) = (state.time, report.iterations);
            return Err(Error::StepNotConverged { time, dt, iteration, residual, node, dof });
        }
        self.set_velocity(model, &step, &mut new, &mean);
        model.system.update_plasticity(&new.displacement, &mut new.plastic);
        self.balance(model, &step, &mut new, &mean, dissipated, &mut report);
        let mut residual = model.residual_at_prescribed_acceleration(&self.mass, &mut new, load);
        model.matrix.solve(&mut residual);
        model.add_acceleration((self.weight * dt * dt).recip(), &residual, &mut new);
        new.integrated_acceleration = combine(&new.velocity, &state.velocity, |to, from| (to - from) / dt);
        new.time = state.time + dt;
        Ok((new, report))
    }

    /// Newton's method for the displacement at the end; returns whether it converged. With `reject_early` it stops when
    /// corrections grow.
    fn solve(
        &self,
        model: &mut MovingModel,
        step: &Step,
        reject_early: bool,
        new: &mut State,
        report: &mut StepReport,
    ) -> Result<bool, Error> {
        let (mut control, mut smallest) = (NewtonControl::new(), f64::INFINITY);
        for _ in 0..ITERATIONS {
            if control.update_tangent {
                self.assemble_tangent(model, step, new);
            } else {
                self.elastic_forces(model, step, new);
            }
            let mean = self.mean_forces(model, step, new);
            let mut correction = self.residual(model, step, new, &mean);
            let MovingModel { system, matrix, .. } = &mut *model;
            if control.update_tangent {
                system.add_arm_rotation(&mean.total, &mean.arms, 0.5, matrix);
                matrix.factorise().map_err(|pivot| system.equations.singular(pivot))?;
                report.tangents += 1;
            }
            matrix.solve(&mut correction);
            system.displace(1.0, &correction, &mut new.displacement);
            report.iterations += 1;

            let size = system.size(&correction);
            if !size.is_finite() {
                break;
            }
            let contraction = control.contraction(size);
            let next = size * contraction.unwrap_or(1.0).min(1.0);
            let motion = system.size_of_difference(&new.displacement, &step.start.displacement);
            let total = system.size(&system.equations.pick(new.displacement.as_flattened()));
            report.last_correction = if motion > 0.0 { size / motion } else { 0.0 };
            let below = |[of_motion, of_total]: [f64; 2]| next <= of_motion * motion + of_total * total;
            if below(CONVERGED) || (contraction.is_some_and(|ratio| ratio > STAGNANT) && below(ROUNDED)) {
                return Ok(true);
            }
            smallest = smallest.min(size);
            if reject_early && size > DIVERGING * smallest {
                return Ok(false);
            }
            control.accept(size);
        }
        Ok(false)
    }

    /// M/(theta dt^2) + theta K + C/dt into the matrix, and the mean elastic forces.
    fn assemble_tangent(&self, model: &mut MovingModel, step: &Step, new: &State) {
        let MovingModel { system, damping, matrix, internal, .. } = model;
        let (start, dt) = (step.start, step.dt);
        let links = &system.equations.links;
        let between = links.arms_between(&start.displacement, &new.displacement);
        let at_end = links.arms_at(&new.displacement);
        let arms = [&between[..], &at_end[..]];
        matrix.clear();
        let from = (&step.chords[..], &start.displacement[..]);
        let (plastic, tangent) = (&start.plastic, Some((arms, &mut *matrix)));
        system.mean_elastic_forces(from, &new.displacement, plastic, self.weight, internal, tangent);
        system.add_viscosity(&step.middle(new), damping, dt.recip(), arms, matrix);
        let of_ground = if system.is_damped_against_ground() { damping.mass / dt } else { 0.0 };
        let of_mass = (self.weight * dt * dt).recip() + of_ground;
        for (row, mass) in self.mass.by_equation.iter().enumerate() {
            matrix.add(row, row, of_mass * mass);
        }
        if damping.mass > 0.0 && !system.is_damped_against_ground() {
            let arms = system.damping_arms(&start.displacement, &new.displacement);
            system.add_mass_damping(&arms, &self.mass.nodal, damping.mass / dt, matrix);
        }
    }

    /// Mean elastic forces into `model.internal`; returns their work beyond the change of the elastic energy \[J\].
    fn elastic_forces(&self, model: &mut MovingModel, step: &Step, new: &State) -> f64 {
        let from = (&step.chords[..], &step.start.displacement[..]);
        let plastic = &step.start.plastic;
        let internal = &mut model.internal;
        model.system.mean_elastic_forces(from, &new.displacement, plastic, self.weight, internal, None)
    }

    /// Mean forces over the step to `new`, with the elastic forces in `model.internal`.
    fn mean_forces(&self, model: &MovingModel, step: &Step, new: &State) -> MeanForces {
        let (start, dt) = (step.start, step.dt);
        let rate = combine(&new.displacement, &start.displacement, |to, from| (to - from) / dt);
        let ends = [&start.displacement[..], &new.displacement[..]];
        let viscous = model.system.viscous_forces(ends, &rate, &model.damping, &self.mass.nodal);
        let internal = combine(&model.internal, &viscous, |a, b| a + b);
        let mut total = combine(step.load, &internal, |load, internal| load - internal);
        let links = &model.system.equations.links;
        for link in &links.all {
            // Masses remain at linked nodes if the body is supported at its node.
            for dof in 0..2 {
                let acceleration = (new.velocity[link.body][dof] - start.velocity[link.body][dof]) / dt;
                total[link.node][dof] -= self.mass.nodal[link.node][dof] * acceleration;
            }
        }
        MeanForces { total, viscous, arms: links.arms_between(&start.displacement, &new.displacement) }
    }

    /// Mean forces minus the rate of momentum at the displacement of `new`, by equation.
    fn residual(&self, model: &MovingModel, step: &Step, new: &State, mean: &MeanForces) -> Vec<f64> {
        let (start, dt) = (step.start, step.dt);
        let equations = &model.system.equations;
        let mut residual = equations.reduce(&mean.total, &mean.arms);
        for (equation, (residual, mass)) in residual.iter_mut().zip(&self.mass.by_equation).enumerate() {
            let (node, dof) = equations.place(equation);
            let dof = dof as usize;
            let rate = (new.displacement[node][dof] - start.displacement[node][dof]) / dt;
            *residual -= mass * (rate - start.velocity[node][dof]) / (self.weight * dt);
        }
        residual
    }

    /// Velocities at the end from the momenta of the mean forces: this conserves momentum whatever the residual of
    /// Newton's method.
    fn set_velocity(&self, model: &MovingModel, step: &Step, new: &mut State, mean: &MeanForces) {
        let equations = &model.system.equations;
        let gained = self.mass.accelerations(&equations.reduce(&mean.total, &mean.arms));
        new.velocity.clone_from(&step.start.velocity);
        equations.add(step.dt, &gained, &mut new.velocity);
        model.move_supports(new);
        equations.links.set_velocity(&equations.links.arms_at(&new.displacement), &mut new.velocity);
    }

    /// Reactions and energy balance of the step (THEORY BE22).
    fn balance(
        &self,
        model: &MovingModel,
        step: &Step,
        new: &mut State,
        mean: &MeanForces,
        dissipated_by_elements: f64,
        report: &mut StepReport,
    ) {
        let (system, start, dt) = (&model.system, step.start, step.dt);
        let moved = combine(&new.displacement, &start.displacement, |to, from| to - from);
        let gained = combine(&new.velocity, &start.velocity, |to, from| to - from);
        let speeds = system.equations.pick(gained.as_flattened());
        let kinetic: f64 = speeds.iter().zip(&self.mass.by_equation).map(|(v, mass)| mass * v * v).sum();
        let of_rule = (self.weight - 0.5) * kinetic;
        report.dissipated = of_rule + dissipated_by_elements + sum(&mean.viscous, &moved, |force, u| force * u);

        // Forces without the inertia of masses at linked nodes, which the velocities contain.
        let mut forces = mean.total.clone();
        for link in &system.equations.links.all {
            for dof in 0..2 {
                forces[link.node][dof] += self.mass.nodal[link.node][dof] * gained[link.body][dof] / dt;
            }
        }
        let momenta = combine(&self.mass.nodal, &gained, |mass, v| mass * v / dt);
        let mut reaction = combine(&momenta, &forces, |momentum, force| momentum - force);
        system.equations.links.transfer_forces(&mean.arms, &mut reaction);
        new.mean_reaction.fill([0.0; 3]);
        report.support_work = 0.0;
        for spring in &system.supports.springs {
            let (node, dof) = (spring.node, spring.dof as usize);
            let (from, to) = (start.displacement[node][dof], new.displacement[node][dof]);
            let mean = (1.0 - self.weight) * from + self.weight * to + model.damping.stiffness * (to - from) / dt;
            new.mean_reaction[node][dof] -= spring.stiffness * mean;
        }
        for &(node, dof) in &system.supports.fixed {
            let dof = dof as usize;
            new.mean_reaction[node][dof] = reaction[node][dof];
            report.support_work += reaction[node][dof] * moved[node][dof];
        }
    }
}

impl Step<'_> {
    /// The motion at a constant acceleration, or no motion; supports at their prescribed motion.
    fn predict(&self, model: &MovingModel, acceleration: Option<&Field>) -> State {
        let (start, dt) = (self.start, self.dt);
        let mut new = start.clone();
        if let Some(acceleration) = acceleration {
            let moved = combine(&start.velocity, acceleration, |v, a| dt * (v + 0.5 * dt * a));
            new.displacement = combine(&start.displacement, &moved, |q, moved| q + moved);
        }
        model.move_supports(&mut new);
        model.system.equations.links.set_displacement(&mut new.displacement);
        new
    }

    /// The displacement in the middle of the step.
    fn middle(&self, new: &State) -> Field {
        combine(&self.start.displacement, &new.displacement, |from, to| 0.5 * (from + to))
    }
}
