//! Central differences: the explicit step.

use super::lumped_mass::LumpedMass;
use super::moving_model::MovingModel;
use super::{State, StepReport};
use crate::error::Error;

/// v_half = v + a dt/2, u' = u + v_half dt, M a' = load - f(u', v_half), v' = v_half + a' dt/2 (THEORY BE18).
///
/// A motion that is not finite is an error: the step was too long.
pub(super) fn step(
    mass: &LumpedMass,
    model: &mut MovingModel,
    state: &State,
    load: &[[f64; 3]],
    dt: f64,
) -> Result<(State, StepReport), Error> {
    let mut new = state.clone();
    let fields = new.displacement.as_flattened_mut().iter_mut().zip(new.velocity.as_flattened_mut());
    for ((u, v), a) in fields.zip(state.acceleration.as_flattened()) {
        *v += 0.5 * dt * a;
        *u += dt * *v;
    }
    model.move_supports(&mut new);
    let accelerations = mass.accelerations(&model.residual_at_prescribed_acceleration(mass, &mut new, load));
    new.acceleration = model.system.equations.extend(|equation| accelerations[equation]);
    for (v, a) in new.velocity.as_flattened_mut().iter_mut().zip(new.acceleration.as_flattened()) {
        *v += 0.5 * dt * a;
    }
    model.move_supports(&mut new);
    if let Some(equation) = accelerations.iter().position(|a| !a.is_finite()) {
        let (node, dof) = model.system.equations.place(equation);
        let residual = accelerations[equation];
        return Err(Error::StepNotConverged { time: state.time, dt, iteration: 0, residual, node, dof });
    }
    new.integrated_acceleration.clone_from(&new.acceleration);
    new.time = state.time + dt;
    Ok((new, StepReport { last_correction: 0.0, ..StepReport::new() }))
}
