//! A step of a modal structure: the trapezoidal rule, linear momentum to rounding (THEORY BE29).

use super::mode::{ModalMode, ModalState};
use super::structure::{ModalStructure, dot, times};
use crate::error::{Error, above_zero};

/// Iterations end where the velocities change by less than this share, in the norm of the kinetic energy \[-\].
const CONVERGED: f64 = 1e-13;
/// Maximum number of iterations.
const ITERATIONS: usize = 30;

/// Length, gravity and prescribed motion of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Length \[s\].
    pub dt: f64,
    /// Gravity \[m/s²\].
    pub gravity: [f64; 2],
    /// Position, velocity and acceleration at its end of what is held of the frame; `None` where it stays.
    pub frame: Option<[[f64; 3]; 3]>,
}

/// What a step did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepOutcome {
    /// Energy that the damping took \[J/m\].
    pub dissipated: f64,
    /// Work of what holds the frame \[J/m\].
    pub support_work: f64,
    /// Impulse along x and y of what holds the frame \[N s/m\].
    pub support_impulse: [f64; 2],
}

impl ModalStructure {
    /// One step under a mean `load` on the unknowns. An error leaves the state unchanged; its accelerations are the mean ones of the
    /// step: call [`ModalStructure::equilibrate`] with the load at its end.
    ///
    /// M̄ (v₁ − v₀) = Δt (f̄ + W + f_c − K q̄ − C q̄̇), with amplitudes, rates and M̄ of the step's middle, but along x and y the
    /// change of momentum M₁v₁ − M₀v₀ (BE29).
    pub fn step(&self, state: &mut ModalState, load: &[f64], step: &Step) -> Result<StepOutcome, Error> {
        let Step { dt, gravity, frame } = *step;
        above_zero("time step [s]", dt)?;
        let (n, held, begun) = (self.unknowns(), self.held(), &*state);
        let prescribed = frame.unwrap_or([begun.frame, [0.0; 3], [0.0; 3]]);
        let momenta = times(&self.mass_matrix(begun), &begun.velocity);
        let guess: Vec<f64> = begun.velocity.iter().zip(&begun.acceleration).map(|(v, a)| v + dt * a).collect();
        let mut new = self.arrived(begun, guess, dt, &prescribed);
        for _ in 0..ITERATIONS {
            let middle = between(begun, &new);
            let (mass, mass_at_end) = (self.mass_matrix(&middle), self.mass_matrix(&new));
            let mut matrix = self.effective_inertia(&middle, dt);
            let (weight, turning) = (self.weight(&middle, gravity), self.convective_forces(&middle));
            let mut right = times(&mass, &begun.velocity);
            for k in 0..n {
                right[k] += dt * (load[k] + weight[k] + turning[k]);
            }
            for (j, mode) in self.modes().iter().enumerate() {
                let (q, rate) = (begun.amplitude[j], begun.velocity[3 + j]);
                right[3 + j] -= dt * (mode.stiffness() * (q + 0.25 * dt * rate) + 0.5 * mode.damping() * rate);
            }
            for k in 0..2 {
                right[k] = momenta[k] + dt * (load[k] + weight[k]);
                (0..n).for_each(|j| matrix[(k, j)] = mass_at_end[(k, j)]);
            }
            for k in (0..3).filter(|k| held[*k]) {
                (0..n).for_each(|i| right[i] -= matrix[(i, k)] * prescribed[1][k]);
            }
            let mut found = self.solve_free(matrix, right)?;
            (0..3).filter(|k| held[*k]).for_each(|k| found[k] = prescribed[1][k]);
            let change: Vec<f64> = found.iter().zip(&new.velocity).map(|(a, b)| a - b).collect();
            let size = |v: &[f64]| (0..n).map(|k| mass[(k, k)] * v[k] * v[k]).sum::<f64>();
            let (moved, whole) = (size(&change), size(&found) + size(&begun.velocity));
            new = self.arrived(begun, found, dt, &prescribed);
            if moved <= CONVERGED * CONVERGED * whole {
                let outcome = self.balance(begun, &new, load, step);
                new.acceleration =
                    new.velocity.iter().zip(&begun.velocity).map(|(to, from)| (to - from) / dt).collect();
                (0..3).filter(|k| held[*k]).for_each(|k| new.acceleration[k] = prescribed[2][k]);
                *state = new;
                return Ok(outcome);
            }
        }
        let reason = format!("the step of {dt:e} s from t = {} s did not converge; use a smaller one", begun.time);
        Err(Error::LinearAlgebra { unknowns: n, reason })
    }

    /// The state at the end of a step with these velocities there.
    fn arrived(&self, begun: &ModalState, velocity: Vec<f64>, dt: f64, prescribed: &[[f64; 3]; 3]) -> ModalState {
        let moved = |k: usize| 0.5 * dt * (begun.velocity[k] + velocity[k]);
        let held = self.held();
        let frame = [0, 1, 2].map(|k| if held[k] { prescribed[0][k] } else { begun.frame[k] + moved(k) });
        let amplitude = begun.amplitude.iter().enumerate().map(|(j, q)| q + moved(3 + j)).collect();
        ModalState { frame, amplitude, velocity, acceleration: begun.acceleration.clone(), time: begun.time + dt }
    }

    /// Energy and impulse that a step exchanged with damping and with what holds the frame.
    fn balance(&self, begun: &ModalState, new: &ModalState, load: &[f64], step: &Step) -> StepOutcome {
        let (dt, middle, held) = (step.dt, between(begun, new), self.held());
        let weight = self.weight(&middle, step.gravity);
        let damped = |(j, mode): (usize, &ModalMode)| mode.damping() * middle.velocity[3 + j].powi(2);
        let dissipated = dt * self.modes().iter().enumerate().map(damped).sum::<f64>();
        let [from, to] = [begun, new].map(|state| times(&self.mass_matrix(state), &state.velocity));
        let gained: Vec<f64> = new.velocity.iter().zip(&begun.velocity).map(|(to, from)| to - from).collect();
        let turned = times(&self.mass_matrix(&middle), &gained)[2] - dt * self.convective_forces(&middle)[2];
        let change = [to[0] - from[0], to[1] - from[1], turned];
        let impulse = [0, 1, 2].map(|k| if held[k] { change[k] - dt * (load[k] + weight[k]) } else { 0.0 });
        let moved = [0, 1, 2].map(|k| (new.frame[k] - begun.frame[k]) / dt);
        StepOutcome { dissipated, support_work: dot(&impulse, &moved), support_impulse: [impulse[0], impulse[1]] }
    }
}

/// The motion midway between two states.
fn between(a: &ModalState, b: &ModalState) -> ModalState {
    let mean = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect() };
    ModalState {
        frame: [0, 1, 2].map(|k| 0.5 * (a.frame[k] + b.frame[k])),
        amplitude: mean(&a.amplitude, &b.amplitude),
        velocity: mean(&a.velocity, &b.velocity),
        acceleration: mean(&a.acceleration, &b.acceleration),
        time: 0.5 * (a.time + b.time),
    }
}
