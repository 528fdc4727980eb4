//! The generalised-alpha method: the implicit step with consistent mass.

use super::moving_model::MovingModel;
use super::newton::{ITERATIONS, NewtonControl};
use super::{State, StepReport};
use crate::element::Weights;
use crate::error::Error;

/// A correction that leaves less than this fraction of the step's motion ends the iteration \[-\].
const CONVERGED: f64 = 1e-9;

/// A correction this small against the model's extent is rounding \[-\].
const ROUNDING: f64 = 1e-15;

/// A correction larger than this fraction of the one before rejects the first predictor \[-\].
const DIVERGING: f64 = 0.3;

/// The coefficients of Chung & Hulbert (1993) for a spectral radius rho, with the least damping of slow vibrations
/// (THEORY BE17).
#[derive(Debug, Clone, Copy)]
pub(crate) struct GeneralisedAlpha {
    alpha_m: f64,
    alpha_f: f64,
    beta: f64,
    gamma: f64,
}

impl GeneralisedAlpha {
    pub fn new(rho: f64) -> Self {
        let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let gamma = 0.5 - alpha_m + alpha_f;
        Self { alpha_m, alpha_f, gamma, beta: 0.25 * (0.5 + gamma).powi(2) }
    }

    /// Derivatives of velocity and acceleration at the end of the step by the displacement.
    fn weights(&self, dt: f64) -> Weights {
        Weights {
            acceleration: (1.0 - self.alpha_m) / ((1.0 - self.alpha_f) * self.beta * dt * dt),
            velocity: self.gamma / (self.beta * dt),
            displacement: 1.0,
        }
    }

    /// The integrated acceleration at the end of the step, from the true ones at both ends.
    fn integrated(&self, old: &State, acceleration: &[[f64; 3]], node: usize, dof: usize) -> f64 {
        let mean = (1.0 - self.alpha_f) * acceleration[node][dof] + self.alpha_f * old.acceleration[node][dof];
        (mean - self.alpha_m * old.integrated_acceleration[node][dof]) / (1.0 - self.alpha_m)
    }

    /// Equilibrium at the end of the step by Newton's method, with constant acceleration as the predictor; if that does
    /// not converge, with constant displacement.
    pub fn step(
        &self,
        model: &mut MovingModel,
        state: &State,
        load: &[[f64; 3]],
        dt: f64,
    ) -> Result<(State, StepReport), Error> {
        let mut report = StepReport::new();
        let mut new = self.predict_acceleration(model, state, dt);
        if !self.solve(model, state, load, dt, true, &mut new, &mut report)? {
            new = self.predict_displacement(model, state, dt);
            if !self.solve(model, state, load, dt, false, &mut new, &mut report)? {
                model.system.forces(new.kinematics(), &model.damping, &mut model.internal, None);
                let (residual, node, dof) = model.system.worst(&model.residual(load));
                let (time, iteration) = (state.time, report.iterations);
                return Err(Error::StepNotConverged { time, dt, iteration, residual, node, dof });
            }
        }
        for node in 0..new.displacement.len() {
            for dof in 0..3 {
                new.integrated_acceleration[node][dof] = self.integrated(state, &new.acceleration, node, dof);
            }
        }
        new.time = state.time + dt;
        Ok((new, report))
    }

    /// Newton's method; returns whether it converged. With `reject_early` it stops as soon as corrections do not contract:
    /// the acceleration is a bad predictor under a sudden load.
    fn solve(
        &self,
        model: &mut MovingModel,
        state: &State,
        load: &[[f64; 3]],
        dt: f64,
        reject_early: bool,
        new: &mut State,
        report: &mut StepReport,
    ) -> Result<bool, Error> {
        let weights = self.weights(dt);
        let mut control = NewtonControl::new();
        let external = model.system.equations.restrict(load);
        let mut correction = external.clone();
        for _ in 0..ITERATIONS {
            let MovingModel { system, damping, matrix, internal, .. } = &mut *model;
            if control.update_tangent {
                system.forces(new.kinematics(), damping, internal, Some((weights, &mut *matrix)));
                matrix.factorise().map_err(|pivot| system.equations.singular(pivot))?;
                report.tangents += 1;
            } else {
                system.forces(new.kinematics(), damping, internal, None);
            }
            correction.copy_from_slice(&external);
            system.equations.subtract(internal, &mut correction);
            matrix.solve(&mut correction);
            system.equations.add(1.0, &correction, &mut new.displacement);
            system.equations.add(weights.velocity, &correction, &mut new.velocity);
            system.equations.add(weights.acceleration, &correction, &mut new.acceleration);
            report.iterations += 1;

            let size = system.size(&correction);
            if !size.is_finite() {
                break;
            }
            // The next correction, estimated from the contraction.
            let contraction = control.contraction(size);
            let next = size * contraction.unwrap_or(1.0).min(1.0);
            let motion = system.size_of_difference(&new.displacement, &state.displacement);
            report.last_correction = if motion > 0.0 { size / motion } else { 0.0 };
            if next <= CONVERGED * motion + ROUNDING {
                return Ok(true);
            }
            if reject_early && contraction.is_some_and(|ratio| ratio > DIVERGING) {
                return Ok(false);
            }
            control.accept(size);
        }
        Ok(false)
    }

    /// Predictor of constant acceleration; supports at their prescribed motion.
    fn predict_acceleration(&self, model: &MovingModel, state: &State, dt: f64) -> State {
        let mut new = state.clone();
        for node in 0..state.displacement.len() {
            for dof in 0..3 {
                let (v, a) = (state.velocity[node][dof], state.integrated_acceleration[node][dof]);
                let end = self.integrated(state, &state.acceleration, node, dof);
                new.displacement[node][dof] += dt * v + dt * dt * ((0.5 - self.beta) * a + self.beta * end);
                new.velocity[node][dof] += dt * ((1.0 - self.gamma) * a + self.gamma * end);
            }
        }
        model.move_supports(&mut new);
        new
    }

    /// Predictor of constant displacement, except for the supports: no strain is predicted, so the forces of stiff models
    /// stay small.
    fn predict_displacement(&self, model: &MovingModel, state: &State, dt: f64) -> State {
        let mut new = state.clone();
        for node in 0..state.displacement.len() {
            for dof in 0..3 {
                let (v, a) = (state.velocity[node][dof], state.integrated_acceleration[node][dof]);
                let end = -(v / dt + (0.5 - self.beta) * a) / self.beta;
                new.velocity[node][dof] += dt * ((1.0 - self.gamma) * a + self.gamma * end);
                let mean = (1.0 - self.alpha_m) * end + self.alpha_m * a;
                new.acceleration[node][dof] =
                    (mean - self.alpha_f * state.acceleration[node][dof]) / (1.0 - self.alpha_f);
            }
        }
        model.move_supports(&mut new);
        new
    }
}
