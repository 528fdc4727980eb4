//! Steps at which the scheme is known to break down: refused, not warned about.

use fsi_coupling::settings::{Problem, significant};
use sph_core::Integrator;

use super::incompressible::check_projection_step;
use super::settings::Scene;

/// Courant number C = Δt (c₀ + |v|)/h (THEORY WC12) at which a dam break and a wedge at constant speed break down or
/// gain energy, with the default kernel and diffusion (THEORY WC16; `tests/stability/courant.rs`) [-]. Other kernels and
/// less diffusion may bear a little more; nothing is gained by it.
pub(super) fn breakdown_cfl(integrator: Integrator) -> f64 {
    match integrator {
        Integrator::Symplectic | Integrator::PredictorCorrector => 1.2,
        Integrator::Beeman => 1.4,
        // with an Euler step every other step; with fewer it breaks down sooner (LE3), of which `check` warns
        Integrator::Verlet => 0.7,
    }
}

/// Refuses a Courant number, or a fixed step, at which the integrator breaks down.
pub(super) fn check_step(scene: &Scene) -> Result<(), Problem> {
    let Some(fluid) = scene.solver.weakly_compressible() else {
        return check_projection_step(scene); // its steps know no sound
    };
    let largest = breakdown_cfl(fluid.options.integrator);
    let name = fluid.options.integrator.name();
    let cfl = scene.courant_number();
    if cfl >= largest {
        let expected = format!("a number above 0 and below {largest}, where {name} breaks down");
        return Err(Problem::new("fluid.cfl", cfl, expected));
    }
    // at the speed of sound alone: water that moves bears less
    let still = largest * fluid.water.fluid.smoothing_ratio * scene.resolution.spacing / scene.sound_speed();
    match scene.time.step {
        Some(step) if step >= still => {
            let expected =
                format!("an interval below {} s, {largest} h/c0, where {name} breaks down", significant(still));
            Err(Problem::new("time.step", step, expected))
        }
        _ => Ok(()),
    }
}
