//! Steps at which the scheme is known to break down: refused, not warned about.

use super::model::{Integrator, Scene};
use super::problem::{Problem, significant};
use super::resolve_projection::check_projection_step;

/// Courant number C = Δt (c₀ + |v|)/h (THEORY E17) at which a dam break and a wedge at constant speed break down or
/// gain energy, with the default kernel and diffusion (THEORY H4; `tests/stability/courant.rs`) [-]. Other kernels and
/// less diffusion may bear a little more; nothing is gained by it.
pub(super) fn breakdown_cfl(integrator: Integrator) -> f64 {
    match integrator {
        Integrator::Symplectic | Integrator::PredictorCorrector => 1.2,
        Integrator::Beeman => 1.4,
        // with an Euler step every other step; with fewer it breaks down sooner (L1), of which `check` warns
        Integrator::Verlet => 0.7,
    }
}

/// Refuses a Courant number, or a fixed step, at which the integrator breaks down.
pub(super) fn check_step(scene: &Scene) -> Result<(), Problem> {
    if scene.solver.is_incompressible() {
        return check_projection_step(scene); // its steps know no sound
    }
    let fluid = &scene.fluid;
    let largest = breakdown_cfl(fluid.integrator);
    let name = fluid.integrator.name();
    if fluid.cfl >= largest {
        let expected = format!("a number above 0 and below {largest}, where {name} breaks down");
        return Err(Problem::new("fluid.cfl", fluid.cfl, expected));
    }
    // at the speed of sound alone: water that moves bears less
    let still = largest * fluid.smoothing_ratio * scene.resolution.spacing / fluid.sound_speed;
    match scene.time.step {
        Some(step) if step >= still => {
            let expected =
                format!("an interval below {} s, {largest} h/c0, where {name} breaks down", significant(still));
            Err(Problem::new("time.step", step, expected))
        }
        _ => Ok(()),
    }
}
