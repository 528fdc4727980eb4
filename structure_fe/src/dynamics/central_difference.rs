//! Central differences: the explicit step.

use crate::dynamics::{Dynamics, Method};
use crate::error::Error;
use crate::state::{State, StepReport};
use crate::system::Kinematics;

impl Dynamics {
    /// v_half = v + a dt/2, u' = u + v_half dt, M a' = load - f(u', v_half), v' = v_half + a' dt/2
    /// (THEORY S18). A motion that is no number any more is an error: the step was too long.
    pub(crate) fn explicit_step(&mut self, state: &mut State, load: &[[f64; 3]], dt: f64) -> Result<StepReport, Error> {
        let Method::Explicit(mass) = &self.method else { unreachable!("called for the explicit method only") };
        let mut new = state.clone();
        let fields = new.displacement.as_flattened_mut().iter_mut().zip(new.velocity.as_flattened_mut());
        for ((u, v), a) in fields.zip(state.acceleration.as_flattened()) {
            *v += 0.5 * dt * a;
            *u += dt * *v;
        }
        self.move_supports(&mut new);
        let at = Kinematics { q: &new.displacement, v: &new.velocity, a: &new.acceleration };
        self.system.restoring_forces(at, &self.damping, &mass.nodal, &mut self.internal);
        let accelerations = mass.accelerations(&self.residual(load));
        new.acceleration = self.system.equations.extend(|equation| accelerations[equation]);
        for (v, a) in new.velocity.as_flattened_mut().iter_mut().zip(new.acceleration.as_flattened()) {
            *v += 0.5 * dt * a;
        }
        self.move_supports(&mut new);
        if let Some(equation) = accelerations.iter().position(|a| !a.is_finite()) {
            let (node, dof) = self.system.equations.place(equation);
            let residual = accelerations[equation];
            return Err(Error::StepNotConverged { time: state.time, dt, iteration: 0, residual, node, dof });
        }
        new.integrated_acceleration.clone_from(&new.acceleration);
        new.time = state.time + dt;
        *state = new;
        Ok(StepReport { last_correction: 0.0, ..StepReport::begun() })
    }
}
