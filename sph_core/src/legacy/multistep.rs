//! Integrators that remember the step before: Verlet's leapfrog (THEORY L1) and Beeman's (L2). Steps may vary in length.

use crate::fluid::Fluid;
use crate::walls::Walls;

/// What the step before left: by identity, since the particles may be sorted anew in between; walls in their own order.
#[derive(Clone, Default)]
pub(crate) struct History {
    /// Length of that step [s]; 0 before the first.
    dt: f64,
    /// L1: what it added to u, v, ρ, e. L2: its rates of u, v, ρ, e.
    change: Vec<[f64; 4]>,
    /// L2: the state before a step: x, y, u, v, ρ, e, and its rates of u, v, ρ, e.
    now: Vec<[f64; 10]>,
    /// L2: forces on walls at the start of that step and of this one [N/m].
    wall_force: [Vec<[f64; 2]>; 2],
}

impl History {
    /// Particle `id` has changed places with its image.
    pub fn reflect(&mut self, id: u32) {
        if let Some(change) = self.change.get_mut(id as usize) {
            change[0] = -change[0];
        }
    }
}

/// L1. Over two steps with the rates of the middle; every so often one step with those of its start (Euler).
///
/// Kept are increments, not states: a blow (E25) or a filter between two steps then moves both levels alike.
pub(crate) fn verlet(fluid: &mut Fluid, walls: &mut Walls, dt: f64) {
    fluid.evaluate_density_rate(walls, -dt); //  dρ/dt at n
    fluid.evaluate_heating(); //                 de/dt at n
    let mut history = std::mem::take(&mut fluid.history);
    let every = fluid.parameters.verlet_correction_every;
    if history.dt == 0.0 || (every > 0 && fluid.steps.is_multiple_of(every)) {
        history.change.clear(); //               Euler: q' = q + Δt dq/dt
        history.change.resize(fluid.particles.len(), [0.0; 4]);
        history.dt = 0.0;
    }
    fluid.drift(dt);
    fluid.bend(0.5 * dt * dt); //                x' = x + Δt v + ½Δt² a
    fluid.leap(&mut history.change, dt + history.dt); // q' = q⁻ + (Δt + Δt⁻) dq/dt
    mean_of_leap(walls, dt, history.dt); //      F̄ = [(Δt + Δt⁻) F − Δt⁻ F̄⁻]/Δt
    history.dt = dt;
    fluid.history = history;
    fluid.shift(dt);
    fluid.drift_with_neighbours(dt); //          L6
    fluid.sum_density(walls, 0.0); //            L11
    fluid.filter_density(walls); //              L4, L5
    fluid.evaluate_forces(walls, 0.0); //        a', F' for the next leap
}

/// The impulse of a leap on each wall particle: exactly what the fluid lost in it.
fn mean_of_leap(walls: &mut Walls, dt: f64, last: f64) {
    for k in 0..walls.len() {
        let mean = |now: f64, before: f64| ((dt + last) * now - last * before) / dt;
        let force = [mean(walls.fx[k], walls.mean_fx[k]), mean(walls.fy[k], walls.mean_fy[k])];
        [walls.mean_fx[k], walls.mean_fy[k]] = force;
        walls.mean_swing[k] = walls.swing(k, -dt, force);
    }
}

/// L2. Predict with the rates at n and n − 1 (Adams & Bashforth), correct with those there (Adams & Moulton).
pub(crate) fn beeman(fluid: &mut Fluid, walls: &mut Walls, dt: f64) {
    fluid.evaluate_density_rate(walls, -dt); //  dρ/dt at n
    fluid.evaluate_heating(); //                 de/dt at n
    let mut history = std::mem::take(&mut fluid.history);
    history.note(fluid, walls);
    let weights = Weights::of(dt, history.dt);
    history.predict(fluid, dt, &weights); //     x* = x + Δt v + Δt² (4a − a⁻)/6,  q* = q + Δt (3q̇ − q̇⁻)/2
    fluid.sum_density(walls, 0.0); //            L11
    fluid.evaluate_forces(walls, 0.0); //        a*, F* at n + 1
    fluid.evaluate_density_rate(walls, 0.0); //  dρ/dt there
    fluid.evaluate_heating();
    history.correct(fluid, dt, &weights); //     x' = x + Δt v + Δt² (a* + 2a)/6,  q' = q + Δt (5q̇* + 8q̇ − q̇⁻)/12
    history.mean_force(walls, dt, &weights); //  F̄ = (5F* + 8F − F⁻)/12
    history.advance(dt);
    fluid.history = history;
    fluid.shift(dt);
    fluid.drift_with_neighbours(dt); //          L6
    fluid.sum_density(walls, 0.0); //            L11
    fluid.filter_density(walls); //              L4, L5
    fluid.evaluate_forces(walls, 0.0); //        a', F' for the next predictor
}

/// L2's weights of the rates at n + 1, n, n − 1, for steps of different lengths.
struct Weights {
    /// Of the predictor, of q: n, n − 1.
    predict: [f64; 2],
    /// Of the predictor, of x: n, n − 1.
    bend: [f64; 2],
    /// Of the corrector: n + 1, n, n − 1.
    correct: [f64; 3],
}

impl Weights {
    /// With Δt⁻ = Δt the thesis's; the first step, without a past, is Euler's and then the trapezium's.
    fn of(dt: f64, last: f64) -> Weights {
        if last == 0.0 {
            return Weights { predict: [1.0, 0.0], bend: [0.5, 0.0], correct: [0.5, 0.5, 0.0] };
        }
        let r = last / dt;
        Weights {
            predict: [1.0 + 0.5 / r, -0.5 / r],
            bend: [0.5 + 1.0 / (6.0 * r), -1.0 / (6.0 * r)],
            correct: [(2.0 + 3.0 * r) / (6.0 * (1.0 + r)), (1.0 + 3.0 * r) / (6.0 * r), -1.0 / (6.0 * r * (1.0 + r))],
        }
    }
}

impl History {
    /// State and rates at n, and the forces on the walls.
    fn note(&mut self, fluid: &Fluid, walls: &Walls) {
        let p = &fluid.particles;
        self.now.resize(p.len(), [0.0; 10]);
        self.change.resize(p.len(), [0.0; 4]);
        for k in 0..p.len() {
            let state = [p.x[k], p.y[k], p.u[k], p.v[k], p.rho[k], p.energy_of(k)];
            let rates = [p.ax[k], p.ay[k], fluid.density_rate[k], fluid.heating.get(k).copied().unwrap_or(0.0)];
            let now = &mut self.now[p.id[k] as usize];
            now[..6].copy_from_slice(&state);
            now[6..].copy_from_slice(&rates);
        }
        self.wall_force[0].resize(walls.len(), [0.0; 2]);
        self.wall_force[1] = (0..walls.len()).map(|k| [walls.fx[k], walls.fy[k]]).collect();
    }

    fn predict(&self, fluid: &mut Fluid, dt: f64, w: &Weights) {
        let p = &mut fluid.particles;
        for k in 0..p.x.len() {
            let ([x, y, u, v, rho, e, now @ ..], before) = (self.now[p.id[k] as usize], self.change[p.id[k] as usize]);
            let rate = |c: usize| w.predict[0] * now[c] + w.predict[1] * before[c];
            let bend = |c: usize| w.bend[0] * now[c] + w.bend[1] * before[c];
            p.x[k] = x + dt * u + dt * dt * bend(0);
            p.y[k] = y + dt * v + dt * dt * bend(1);
            [p.u[k], p.v[k]] = [u + dt * rate(0), v + dt * rate(1)];
            p.rho[k] = rho + dt * rate(2);
            if let Some(energy) = p.energy.get_mut(k) {
                *energy = e + dt * rate(3);
            }
        }
    }

    fn correct(&self, fluid: &mut Fluid, dt: f64, w: &Weights) {
        let p = &mut fluid.particles;
        for k in 0..p.x.len() {
            let ([x, y, u, v, rho, e, now @ ..], before) = (self.now[p.id[k] as usize], self.change[p.id[k] as usize]);
            let then = [p.ax[k], p.ay[k], fluid.density_rate[k], fluid.heating.get(k).copied().unwrap_or(0.0)];
            let rate = |c: usize| w.correct[0] * then[c] + w.correct[1] * now[c] + w.correct[2] * before[c];
            p.x[k] = x + dt * u + dt * dt * (then[0] + 2.0 * now[0]) / 6.0;
            p.y[k] = y + dt * v + dt * dt * (then[1] + 2.0 * now[1]) / 6.0;
            [p.u[k], p.v[k]] = [u + dt * rate(0), v + dt * rate(1)];
            p.rho[k] = rho + dt * rate(2);
            if let Some(energy) = p.energy.get_mut(k) {
                *energy = e + dt * rate(3);
            }
        }
    }

    /// The impulse of a step on each wall particle, with the weights that the fluid's momentum had.
    fn mean_force(&self, walls: &mut Walls, dt: f64, w: &Weights) {
        let [before, now] = &self.wall_force;
        for k in 0..walls.len() {
            let early = [0, 1].map(|c| w.correct[1] * now[k][c] + w.correct[2] * before[k][c]);
            walls.mean_fx[k] = w.correct[0] * walls.fx[k] + early[0];
            walls.mean_fy[k] = w.correct[0] * walls.fy[k] + early[1];
            walls.mean_swing[k] = walls.swing(k, -dt, early);
        }
    }

    /// This step becomes the one before.
    fn advance(&mut self, dt: f64) {
        for (change, now) in self.change.iter_mut().zip(&self.now) {
            change.copy_from_slice(&now[6..]);
        }
        self.wall_force.swap(0, 1);
        self.dt = dt;
    }
}

impl Fluid {
    /// x ← x + s a.
    fn bend(&mut self, s: f64) {
        let p = &mut self.particles;
        for k in 0..p.x.len() {
            p.x[k] += s * p.ax[k];
            p.y[k] += s * p.ay[k];
        }
    }

    /// q ← q⁻ + `span` dq/dt for u, v, ρ, e, where q⁻ = q − `change`; `change` becomes that of this step.
    fn leap(&mut self, change: &mut [[f64; 4]], span: f64) {
        let p = &mut self.particles;
        for k in 0..p.x.len() {
            let change = &mut change[p.id[k] as usize];
            let rates = [p.ax[k], p.ay[k], self.density_rate[k], self.heating.get(k).copied().unwrap_or(0.0)];
            *change = [0, 1, 2, 3].map(|c| span * rates[c] - change[c]);
            p.u[k] += change[0];
            p.v[k] += change[1];
            p.rho[k] += change[2];
            if let Some(energy) = p.energy.get_mut(k) {
                *energy += change[3];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_steps_have_the_weights_of_the_thesis() {
        let w = Weights::of(0.1, 0.1);
        for (found, exact) in w.correct.into_iter().zip([5.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0]) {
            assert!((found - exact).abs() < 1e-15);
        }
        assert!((w.bend[0] - 4.0 / 6.0).abs() < 1e-15 && (w.bend[1] + 1.0 / 6.0).abs() < 1e-15);
        assert_eq!(w.predict, [1.5, -0.5]);
    }

    /// Rates that are polynomials of the degree each formula is exact for, from −Δt⁻ to Δt, Δt = 1.
    #[test]
    fn uneven_steps_keep_the_order() {
        let r = 0.6;
        let w = Weights::of(1.0, r);
        let (line, parabola) = (|t: f64| 2.0 - 3.0 * t, |t: f64| 2.0 - 3.0 * t + 5.0 * t * t);
        let predicted = w.predict[0] * line(0.0) + w.predict[1] * line(-r);
        assert!((predicted - (2.0 - 1.5)).abs() < 1e-14);
        let bent = w.bend[0] * line(0.0) + w.bend[1] * line(-r);
        assert!((bent - (1.0 - 0.5)).abs() < 1e-14);
        let corrected = w.correct[0] * parabola(1.0) + w.correct[1] * parabola(0.0) + w.correct[2] * parabola(-r);
        assert!((corrected - (2.0 - 1.5 + 5.0 / 3.0)).abs() < 1e-14);
    }
}
