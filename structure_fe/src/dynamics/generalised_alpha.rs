//! Generalised-alpha: the implicit step.

use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::inertia::Weights;
use crate::state::{State, StepReport};
use crate::system::Kinematics;

/// A correction leaving less than this of the step's motion ends the iteration \[-\].
const CONVERGED: f64 = 1e-9;

/// A correction this small against the model's extent is rounding \[-\].
const ROUNDING: f64 = 1e-15;

/// The tangent is kept while each correction is less than this of the one before \[-\].
const CONTRACTING: f64 = 0.03;

/// A correction of more than this of the one before gives the first guess up \[-\].
const HOPELESS: f64 = 0.3;

/// Corrections of a guess, at most.
const ITERATIONS: usize = 40;

/// The coefficients of Chung & Hulbert (1993) of a spectral radius rho, optimal in damping what is slow
/// least (THEORY S17).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coefficients {
    pub alpha_m: f64,
    pub alpha_f: f64,
    pub beta: f64,
    pub gamma: f64,
}

impl Coefficients {
    pub fn new(rho: f64) -> Self {
        let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let gamma = 0.5 - alpha_m + alpha_f;
        Self { alpha_m, alpha_f, gamma, beta: 0.25 * (0.5 + gamma).powi(2) }
    }

    /// Derivatives of velocity and acceleration at the step's end by the displacement.
    fn weights(&self, dt: f64) -> Weights {
        Weights {
            acceleration: (1.0 - self.alpha_m) / ((1.0 - self.alpha_f) * self.beta * dt * dt),
            velocity: self.gamma / (self.beta * dt),
            displacement: 1.0,
        }
    }

    /// The integrated acceleration at the step's end, of the true ones at both ends.
    fn integrated(&self, old: &State, acceleration: &[[f64; 3]], node: usize, dof: usize) -> f64 {
        let mean = (1.0 - self.alpha_f) * acceleration[node][dof] + self.alpha_f * old.acceleration[node][dof];
        (mean - self.alpha_m * old.integrated_acceleration[node][dof]) / (1.0 - self.alpha_m)
    }
}

impl Dynamics {
    /// Equilibrium at the step's end by Newton's method, from the old acceleration kept; where that does
    /// not settle, from the old displacement kept.
    pub(crate) fn implicit_step(
        &mut self,
        rule: &Coefficients,
        state: &mut State,
        load: &[[f64; 3]],
        dt: f64,
    ) -> Result<StepReport, Error> {
        let mut report = StepReport::begun();
        let mut new = self.predict_acceleration(rule, state, dt);
        if !self.iterate(rule, state, load, dt, true, &mut new, &mut report)? {
            new = self.predict_displacement(rule, state, dt);
            if !self.iterate(rule, state, load, dt, false, &mut new, &mut report)? {
                let at = Kinematics { q: &new.displacement, v: &new.velocity, a: &new.acceleration };
                self.system.forces(at, &self.damping, &mut self.internal);
                let (residual, node, dof) = self.system.worst(&self.residual(load));
                let (time, iteration) = (state.time, report.iterations);
                return Err(Error::StepNotConverged { time, dt, iteration, residual, node, dof });
            }
        }
        self.finish(rule, state, new, dt);
        Ok(report)
    }

    /// Newton's method; says whether it converged. Where `hopeful` it gives up as soon as corrections do
    /// not shrink: a sudden load's accelerations may be a bad guess. The tangent of the first guess serves all corrections
    /// while they shrink fast.
    fn iterate(
        &mut self,
        rule: &Coefficients,
        state: &State,
        load: &[[f64; 3]],
        dt: f64,
        hopeful: bool,
        new: &mut State,
        report: &mut StepReport,
    ) -> Result<bool, Error> {
        let weights = rule.weights(dt);
        let (mut last, mut fresh) = (f64::INFINITY, true);
        let external = self.system.equations.restrict(load);
        let mut correction = external.clone();
        for _ in 0..ITERATIONS {
            let at = Kinematics { q: &new.displacement, v: &new.velocity, a: &new.acceleration };
            if fresh {
                self.system.forces_and_tangent(at, &self.damping, weights, &mut self.internal, &mut self.matrix);
                self.matrix.factorise().map_err(|pivot| self.system.singular(pivot))?;
                report.tangents += 1;
            } else {
                self.system.forces(at, &self.damping, &mut self.internal);
            }
            correction.copy_from_slice(&external);
            self.system.equations.subtract(&self.internal, &mut correction);
            self.matrix.solve(&mut correction);
            let equations = &self.system.equations;
            equations.add(1.0, &correction, &mut new.displacement);
            equations.add(weights.velocity, &correction, &mut new.velocity);
            equations.add(weights.acceleration, &correction, &mut new.acceleration);
            report.iterations += 1;

            let size = self.system.size(&correction);
            if !size.is_finite() {
                break;
            }
            // What the next correction would be, by the shrinking seen so far.
            let ratio = if last.is_finite() { size / last } else { 1.0 };
            let motion = self.system.size_of_difference(&new.displacement, &state.displacement);
            report.last_correction = if motion > 0.0 { size / motion } else { 0.0 };
            if size * ratio.min(1.0) <= CONVERGED * motion + ROUNDING {
                return Ok(true);
            }
            if hopeful && last.is_finite() && ratio > HOPELESS {
                return Ok(false);
            }
            fresh = ratio > CONTRACTING && last.is_finite();
            last = size;
        }
        Ok(false)
    }

    /// The motion if the acceleration stays what it is; supports where they are told to be.
    fn predict_acceleration(&self, rule: &Coefficients, state: &State, dt: f64) -> State {
        let mut new = state.clone();
        for node in 0..state.displacement.len() {
            for dof in 0..3 {
                let (v, a) = (state.velocity[node][dof], state.integrated_acceleration[node][dof]);
                let end = rule.integrated(state, &state.acceleration, node, dof);
                new.displacement[node][dof] += dt * v + dt * dt * ((0.5 - rule.beta) * a + rule.beta * end);
                new.velocity[node][dof] += dt * ((1.0 - rule.gamma) * a + rule.gamma * end);
            }
        }
        self.move_supports(&mut new);
        new
    }

    /// The motion that ends where it began, but for the supports: no strain is guessed, so that stiff
    /// models do not start from large forces.
    fn predict_displacement(&self, rule: &Coefficients, state: &State, dt: f64) -> State {
        let mut new = state.clone();
        for node in 0..state.displacement.len() {
            for dof in 0..3 {
                let (v, a) = (state.velocity[node][dof], state.integrated_acceleration[node][dof]);
                let end = -(v / dt + (0.5 - rule.beta) * a) / rule.beta;
                new.velocity[node][dof] += dt * ((1.0 - rule.gamma) * a + rule.gamma * end);
                let mean = (1.0 - rule.alpha_m) * end + rule.alpha_m * a;
                new.acceleration[node][dof] =
                    (mean - rule.alpha_f * state.acceleration[node][dof]) / (1.0 - rule.alpha_f);
            }
        }
        self.move_supports(&mut new);
        new
    }

    fn finish(&self, rule: &Coefficients, state: &mut State, mut new: State, dt: f64) {
        for node in 0..new.displacement.len() {
            for dof in 0..3 {
                new.integrated_acceleration[node][dof] = rule.integrated(state, &new.acceleration, node, dof);
            }
        }
        new.time = state.time + dt;
        *state = new;
    }
}
