//! The trapezoidal rule in momentum form: the implicit step of models with rigid bodies.

use std::sync::Arc;

use crate::corotational::Chord;
use crate::dynamics::{Dynamics, Method};
use crate::error::Error;
use crate::lumped::LumpedMass;
use crate::state::{State, StepReport};

/// A correction leaving less than this of the step's motion, and less than this of the whole displacement,
/// ends the iteration \[-\].
const CONVERGED: [f64; 2] = [1e-12, 3e-15];

/// The same where corrections do not shrink any more: rounding of the forces.
const ROUNDED: [f64; 2] = [1e-8, 1e-13];

/// The tangent is kept while each correction is less than this of the one before \[-\].
const CONTRACTING: f64 = 0.03;

/// Corrections that shrink by less than this do not shrink \[-\].
const STANDING: f64 = 0.3;

/// A correction of more than this times the smallest so far gives the first guess up \[-\].
const FAR: f64 = 100.0;

/// Corrections of a guess, at most.
const ITERATIONS: usize = 40;

/// The rule: weight theta = 1/(1 + rho) of the step's end, and the mass that it moves.
#[derive(Debug, Clone)]
pub(crate) struct Trapezoidal {
    pub weight: f64,
    pub mass: LumpedMass,
}

/// What acts over a step, node by node.
struct Mean {
    /// Load less elastic and viscous forces and less the inertia that a moving pivot imposes.
    force: Vec<[f64; 3]>,
    viscous: Vec<[f64; 3]>,
    arms: Vec<[f64; 2]>,
}

fn each(a: &[[f64; 3]], b: &[[f64; 3]], f: impl Fn(f64, f64) -> f64) -> Vec<[f64; 3]> {
    a.iter().zip(b).map(|(a, b)| [0, 1, 2].map(|dof| f(a[dof], b[dof]))).collect()
}

fn pairing(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

impl Dynamics {
    pub(crate) fn rule(&self) -> Option<Arc<Trapezoidal>> {
        if let Method::Momentum(rule) = &self.method { Some(Arc::clone(rule)) } else { None }
    }

    /// M (v1 - v0)/dt = mean load - mean elastic force - C (q1 - q0)/dt, the elastic force weighed between both
    /// ends so that it does the work of the elastic energy (for small rotations theta f(q1) + (1 - theta) f(q0)), with
    /// q1 = q0 + dt (theta v1 + (1 - theta) v0), for q1 by Newton's method; v1 then from the momenta.
    pub(crate) fn momentum_step(
        &mut self,
        rule: &Trapezoidal,
        state: &mut State,
        load: &[[f64; 3]],
        dt: f64,
    ) -> Result<StepReport, Error> {
        let mut report = StepReport::begun();
        let start = self.system.chords(&state.displacement);
        // Where the acceleration over the step leads; with the last step's, which turns what is stiff; nowhere.
        let accelerations = [Some(&state.acceleration), Some(&state.integrated_acceleration), None];
        let mut new = state.clone();
        let mut settled = false;
        for guess in accelerations {
            new = self.guess(state, guess, dt);
            settled = self.settle(rule, state, &start, load, dt, guess.is_some(), &mut new, &mut report)?;
            if settled {
                break;
            }
        }
        if !settled {
            self.elastic_over_the_step(rule, state, &start, &new);
            let mean = self.mean(rule, state, load, dt, &new);
            let residual = self.lack_of_motion(rule, state, &new, &mean, dt);
            let (residual, node, dof) = self.system.worst(&residual);
            let (time, iteration) = (state.time, report.iterations);
            return Err(Error::StepNotConverged { time, dt, iteration, residual, node, dof });
        }
        let by_elements = self.elastic_over_the_step(rule, state, &start, &new);
        let mean = self.mean(rule, state, load, dt, &new);
        self.give_velocities(rule, state, &mut new, &mean, dt);
        self.system.flow(&new.displacement, &mut new.plastic_curvature);
        self.account(rule, state, &mut new, &mean, by_elements, dt, &mut report);
        let mut lack = self.lack_at_known_acceleration(rule, &mut new, load);
        self.matrix.solve(&mut lack);
        let factor = (rule.weight * dt * dt).recip();
        self.system.equations.add(factor, &lack, &mut new.acceleration);
        let ties = &self.system.equations.ties;
        ties.follow_acceleration(&ties.arms_at(&new.displacement), &new.velocity, &mut new.acceleration);
        new.integrated_acceleration = each(&new.velocity, &state.velocity, |to, from| (to - from) / dt);
        new.time = state.time + dt;
        if let Err(error) = self.let_go(&mut new) {
            self.adopt(state)?;
            return Err(error);
        }
        *state = new;
        Ok(report)
    }

    /// The motion of `dt` at an acceleration, or none; supports where they are told to be.
    fn guess(&self, state: &State, acceleration: Option<&Vec<[f64; 3]>>, dt: f64) -> State {
        let mut new = state.clone();
        if let Some(acceleration) = acceleration {
            let moved = each(&state.velocity, acceleration, |v, a| dt * (v + 0.5 * dt * a));
            new.displacement = each(&state.displacement, &moved, |q, moved| q + moved);
        }
        self.move_supports(&mut new);
        self.system.equations.ties.follow(&mut new.displacement);
        new
    }

    /// Newton's method for the displacement at the end; says whether it converged. Where `hopeful` it gives
    /// up when corrections grow.
    fn settle(
        &mut self,
        rule: &Trapezoidal,
        state: &State,
        start: &[Chord],
        load: &[[f64; 3]],
        dt: f64,
        hopeful: bool,
        new: &mut State,
        report: &mut StepReport,
    ) -> Result<bool, Error> {
        let (mut last, mut smallest, mut fresh) = (f64::INFINITY, f64::INFINITY, true);
        for _ in 0..ITERATIONS {
            if fresh {
                self.lay_tangent(rule, state, start, new, dt);
            } else {
                self.elastic_over_the_step(rule, state, start, new);
            }
            let mean = self.mean(rule, state, load, dt, new);
            let mut correction = self.lack_of_motion(rule, state, new, &mean, dt);
            if fresh {
                self.system.subtract_turning(&mean.force, &mean.arms, 0.5, &mut self.matrix);
                self.matrix.factorise().map_err(|pivot| self.system.singular(pivot))?;
                report.tangents += 1;
            }
            self.matrix.solve(&mut correction);
            self.system.displace(1.0, &correction, &mut new.displacement);
            report.iterations += 1;

            let size = self.system.size(&correction);
            if !size.is_finite() {
                break;
            }
            let ratio = if last.is_finite() { size / last } else { 1.0 };
            let motion = self.system.size_of_difference(&new.displacement, &state.displacement);
            let whole = self.system.size(&self.system.equations.pick(new.displacement.as_flattened()));
            report.last_correction = if motion > 0.0 { size / motion } else { 0.0 };
            let below =
                |[of_motion, of_whole]: [f64; 2]| size * ratio.min(1.0) <= of_motion * motion + of_whole * whole;
            if below(CONVERGED) || (ratio > STANDING && last.is_finite() && below(ROUNDED)) {
                return Ok(true);
            }
            smallest = smallest.min(size);
            if hopeful && size > FAR * smallest {
                return Ok(false);
            }
            fresh = ratio > CONTRACTING && last.is_finite();
            last = size;
        }
        Ok(false)
    }

    /// M/(theta dt^2) + theta K + C/dt, and the elastic forces at the end.
    fn lay_tangent(&mut self, rule: &Trapezoidal, state: &State, start: &[Chord], new: &State, dt: f64) {
        let system = &self.system;
        let ties = &system.equations.ties;
        let between = ties.arms_between(&state.displacement, &new.displacement);
        let at_end = ties.arms_at(&new.displacement);
        let arms = [&between[..], &at_end[..]];
        self.matrix.clear();
        let tangent = Some((arms, &mut self.matrix));
        let from = (start, &state.displacement[..]);
        system.mean_elastic_forces(
            from,
            &new.displacement,
            &state.plastic_curvature,
            rule.weight,
            &mut self.internal,
            tangent,
        );
        let middle = each(&state.displacement, &new.displacement, |from, to| 0.5 * (from + to));
        system.add_viscosity(&middle, &self.damping, dt.recip(), arms, &mut self.matrix);
        let of_mass = (rule.weight * dt * dt).recip() + self.damping.mass / dt;
        for (row, mass) in rule.mass.by_equation.iter().enumerate() {
            self.matrix.add(row, row, of_mass * mass);
        }
    }

    /// Elastic forces over the step, into `self.internal`; returns what they take beyond the energy's change \[J\].
    fn elastic_over_the_step(&mut self, rule: &Trapezoidal, state: &State, start: &[Chord], new: &State) -> f64 {
        let from = (start, &state.displacement[..]);
        self.system.mean_elastic_forces(
            from,
            &new.displacement,
            &state.plastic_curvature,
            rule.weight,
            &mut self.internal,
            None,
        )
    }

    /// What acts over the step that leads to `new`, whose elastic forces are in `self.internal`.
    fn mean(&self, rule: &Trapezoidal, state: &State, load: &[[f64; 3]], dt: f64, new: &State) -> Mean {
        let rate = each(&new.displacement, &state.displacement, |to, from| (to - from) / dt);
        let middle = each(&state.displacement, &new.displacement, |from, to| 0.5 * (from + to));
        let viscous = self.system.viscous_forces(&middle, &rate, &self.damping, &rule.mass.nodal);
        let mut force = each(load, &each(&self.internal, &viscous, |a, b| a + b), |load, taken| load - taken);
        let ties = &self.system.equations.ties;
        for tie in &ties.all {
            // Masses that stay at tied nodes, of bodies held at their node, are carried along by it.
            for dof in 0..2 {
                let carried = (new.velocity[tie.body][dof] - state.velocity[tie.body][dof]) / dt;
                force[tie.node][dof] -= rule.mass.nodal[tie.node][dof] * carried;
            }
        }
        Mean { force, viscous, arms: ties.arms_between(&state.displacement, &new.displacement) }
    }

    /// Forces less the change of momentum that the displacement of `new` calls for.
    fn lack_of_motion(&self, rule: &Trapezoidal, state: &State, new: &State, mean: &Mean, dt: f64) -> Vec<f64> {
        let equations = &self.system.equations;
        let mut lack = equations.reduce(&mean.force, &mean.arms);
        for (equation, (lack, mass)) in lack.iter_mut().zip(&rule.mass.by_equation).enumerate() {
            let (node, dof) = equations.place(equation);
            let dof = dof as usize;
            let rate = (new.displacement[node][dof] - state.displacement[node][dof]) / dt;
            *lack -= mass * (rate - state.velocity[node][dof]) / (rule.weight * dt);
        }
        lack
    }

    /// Velocities at the end from the momenta that the mean forces give: momentum is kept whatever Newton's
    /// method left.
    fn give_velocities(&self, rule: &Trapezoidal, state: &State, new: &mut State, mean: &Mean, dt: f64) {
        let equations = &self.system.equations;
        let gained = rule.mass.accelerations(&equations.reduce(&mean.force, &mean.arms));
        new.velocity.clone_from(&state.velocity);
        equations.add(dt, &gained, &mut new.velocity);
        self.move_supports(new);
        equations.ties.follow_linearly(&equations.ties.arms_at(&new.displacement), &mut new.velocity);
    }

    /// Reactions and energies of the step (THEORY S23).
    fn account(
        &self,
        rule: &Trapezoidal,
        state: &State,
        new: &mut State,
        mean: &Mean,
        by_elements: f64,
        dt: f64,
        report: &mut StepReport,
    ) {
        let system = &self.system;
        let moved = each(&new.displacement, &state.displacement, |to, from| to - from);
        let gained = each(&new.velocity, &state.velocity, |to, from| to - from);
        let speeds = system.equations.pick(gained.as_flattened());
        let kinetic: f64 = speeds.iter().zip(&rule.mass.by_equation).map(|(v, mass)| mass * v * v).sum();
        let of_rule = (rule.weight - 0.5) * kinetic;
        report.dissipated = of_rule + by_elements + pairing(&mean.viscous, &moved);

        // The forces without what `mean` took for carried masses: these are in the velocities.
        let mut lack = mean.force.clone();
        for tie in &system.equations.ties.all {
            for dof in 0..2 {
                lack[tie.node][dof] += rule.mass.nodal[tie.node][dof] * gained[tie.body][dof] / dt;
            }
        }
        let momenta = each(&rule.mass.nodal, &gained, |mass, v| mass * v / dt);
        let mut reaction = each(&momenta, &lack, |momentum, force| momentum - force);
        system.equations.ties.fold(&mean.arms, &mut reaction);
        new.mean_reaction.fill([0.0; 3]);
        report.support_work = 0.0;
        for spring in system.supports.springs() {
            let (node, dof) = (spring.node, spring.dof as usize);
            let (from, to) = (state.displacement[node][dof], new.displacement[node][dof]);
            let mean = (1.0 - rule.weight) * from + rule.weight * to + self.damping.stiffness * (to - from) / dt;
            new.mean_reaction[node][dof] -= spring.stiffness * mean;
        }
        for &(node, dof) in system.supports.fixed() {
            let dof = dof as usize;
            new.mean_reaction[node][dof] = reaction[node][dof];
            report.support_work += reaction[node][dof] * moved[node][dof];
        }
    }

    /// Load less internal forces at the motion of `state`, less the inertia of the accelerations that supports
    /// and ties prescribe, which the state is given; by equation.
    pub(crate) fn lack_at_known_acceleration(
        &mut self,
        rule: &Trapezoidal,
        state: &mut State,
        load: &[[f64; 3]],
    ) -> Vec<f64> {
        state.acceleration.fill([0.0; 3]);
        let prescribed = self.prescribed();
        for (node, dof, motion) in prescribed {
            state.acceleration[node][dof as usize] = motion.acceleration;
        }
        let ties = &self.system.equations.ties;
        let arms = ties.arms_at(&state.displacement);
        ties.follow_acceleration(&arms, &state.velocity, &mut state.acceleration);
        self.system.elastic_forces(&state.displacement, &state.plastic_curvature, &mut self.internal, None);
        let lack = self.lack_of_forces(rule, state, load);
        self.system.equations.reduce(&lack, &arms)
    }

    /// Load less elastic forces (as they are in `self.internal`), damping and inertia, node by node.
    pub(crate) fn lack_of_forces(&self, rule: &Trapezoidal, state: &State, load: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mass = &rule.mass.nodal;
        let viscous = self.system.viscous_forces(&state.displacement, &state.velocity, &self.damping, mass);
        let inertia = each(mass, &state.acceleration, |mass, a| mass * a);
        let lack = each(load, &self.internal, |load, elastic| load - elastic);
        each(&lack, &each(&viscous, &inertia, |a, b| a + b), |lack, taken| lack - taken)
    }
}
