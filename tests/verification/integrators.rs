//! Order of the integrators in time (THEORY WC11, LE2, LE3, LE4): a standing pressure wave in a box of 20 by 20 cells, against
//! the same particles with steps so small that only the spacing's error is left, which all integrators share.

use evidence::parameters::Parameters;
use sph_core::Integrator;

use super::acoustics::{box_of_sound, lossless};

const SPACING: f64 = 0.05;
/// A step of a quarter of h/c₀, and how many of them [s].
const STEP: f64 = 3.75e-4;
const STEPS: usize = 32;

/// Velocities of all particles by identity after `STEPS`·`STEP` seconds in steps of `STEP`/`finer`.
fn velocities(integrator: Integrator, euler_every: u32, finer: usize) -> Vec<[f64; 2]> {
    let parameters = Parameters { integrator, verlet_correction_every: euler_every, ..lossless() };
    let mut system = box_of_sound(SPACING, parameters, |_, _| ());
    for _ in 0..STEPS * finer {
        system.step(STEP / finer as f64).expect("a stable run");
    }
    let p = system.fluid.particles();
    let mut found = vec![[0.0; 2]; p.len()];
    for k in 0..p.len() {
        found[p.id[k] as usize] = [p.u[k], p.v[k]];
    }
    found
}

/// Root mean square distance of two sets of velocities [m/s].
fn distance(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let square = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
    (a.iter().zip(b).map(square).sum::<f64>() / a.len() as f64).sqrt()
}

/// Halving the step divides the error by 2 to the order: 2 for kick–drift–kick, the predictor–corrector and the leapfrog,
/// 3 for Beeman's with its corrector. All go to the same limit.
#[test]
fn errors_in_time_fall_at_each_integrators_order() {
    let exact = velocities(Integrator::Beeman, 0, 16);
    let size = distance(&exact, &vec![[0.0; 2]; exact.len()]);
    for (integrator, order) in [
        (Integrator::Symplectic, 2.0),
        (Integrator::PredictorCorrector, 2.0),
        (Integrator::Verlet, 2.0),
        (Integrator::Beeman, 3.0),
    ] {
        let error = |finer: usize| distance(&velocities(integrator, 0, finer), &exact) / size;
        let (coarse, fine) = (error(2), error(4));
        let observed = (coarse / fine).log2();
        assert!((observed - order).abs() < 0.3, "{integrator:?}: {coarse:.2e}, {fine:.2e}, order {observed:.2}");
        assert!(fine < 0.02, "{integrator:?}: {fine:.2e} of the velocity");
    }
}

/// Verlet's Euler steps are wrong by ½Δt² d²q/dt², and the leapfrog hands that on to every other level only. With an even
/// number of steps from one to the next it stays on the levels that are thrown away, and the order is 2; with an odd
/// number the order is 1.
#[test]
fn an_even_number_of_steps_between_corrections_keeps_verlets_order() {
    let exact = velocities(Integrator::Beeman, 0, 16);
    let error = |every: u32, finer: usize| distance(&velocities(Integrator::Verlet, every, finer), &exact);
    let order = |every: u32| (error(every, 4) / error(every, 8)).log2();
    let (even, odd) = (order(4), order(5));
    assert!((even - 2.0).abs() < 0.3 && (odd - 1.0).abs() < 0.3, "every 4: order {even:.2}, every 5: order {odd:.2}");
}
