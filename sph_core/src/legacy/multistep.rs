//! State that integrators keep of the step before: Verlet's leapfrog (THEORY LE3) and Beeman's scheme (LE4), whose steps may vary in
//! length, and the predictor–corrector (LE2).

use serde::{Deserialize, Serialize};

use crate::particles::Particles;
use crate::walls::Walls;

/// Rates of density and energy; accelerations are the particles' own.
#[derive(Clone, Copy)]
pub(crate) struct Rates<'a> {
    /// dρ/dt [kg/(m³ s)].
    pub density: &'a [f64],
    /// de/dt [W/kg]; empty for water.
    pub energy: &'a [f64],
}

impl Rates<'_> {
    /// Rates of u, v, ρ, e of particle `k`.
    fn of(&self, p: &Particles, k: usize) -> [f64; 4] {
        [p.ax[k], p.ay[k], self.density[k], self.energy.get(k).copied().unwrap_or(0.0)]
    }
}

/// State x, y, u, v, ρ, e of particle `k`.
fn state_of(p: &Particles, k: usize) -> [f64; 6] {
    [p.x[k], p.y[k], p.u[k], p.v[k], p.rho[k], p.energy.get(k).copied().unwrap_or(0.0)]
}

fn set_state(p: &mut Particles, k: usize, [x, y]: [f64; 2], [u, v, rho, energy]: [f64; 4]) {
    (p.x[k], p.y[k], p.u[k], p.v[k], p.rho[k]) = (x, y, u, v, rho);
    if let Some(e) = p.energy.get_mut(k) {
        *e = energy;
    }
}

/// The state at n, by identity: the particles may be sorted again before it is needed.
pub(crate) struct Old(Vec<[f64; 6]>);

impl Old {
    pub fn of(p: &Particles) -> Old {
        let mut states = vec![[0.0; 6]; p.len()];
        (0..p.len()).for_each(|k| states[p.id[k] as usize] = state_of(p, k));
        Old(states)
    }

    pub fn correct(&self, p: &mut Particles, rates: Rates, dt: f64) {
        for k in 0..p.x.len() {
            let ([x, y, q @ ..], rates) = (self.0[p.id[k] as usize], rates.of(p, k));
            let new = [0, 1, 2, 3].map(|c| q[c] + dt * rates[c]);
            set_state(p, k, [x + 0.5 * dt * (q[0] + new[0]), y + 0.5 * dt * (q[1] + new[1])], new);
        }
    }
}

/// What the step before left: by identity, since the particles may be sorted again in between; walls in their own order.
#[derive(Clone, Default, Serialize, Deserialize)]
pub(crate) struct History {
    /// Length of that step [s]; 0 before the first.
    pub dt: f64,
    /// LE3: what it added to u, v, ρ, e. LE4: its rates of u, v, ρ, e.
    change: Vec<[f64; 4]>,
    /// LE4: the state before a step: x, y, u, v, ρ, e, and its rates of u, v, ρ, e.
    now: Vec<[f64; 10]>,
    /// LE4: forces on walls at the start of that step and of this one [N/m].
    wall_force: [Vec<[f64; 2]>; 2],
}

impl History {
    /// Forget the step before.
    pub fn restart(&mut self, n: usize) {
        self.change.clear();
        self.change.resize(n, [0.0; 4]);
        self.dt = 0.0;
    }

    /// LE3: q ← q⁻ + (Δt + Δt⁻) dq/dt for u, v, ρ, e, where q⁻ = q − `change`; `change` becomes that of this step.
    pub fn leap(&mut self, p: &mut Particles, rates: Rates, dt: f64) {
        let span = dt + self.dt;
        for k in 0..p.x.len() {
            let (change, rates) = (&mut self.change[p.id[k] as usize], rates.of(p, k));
            *change = [0, 1, 2, 3].map(|c| span * rates[c] - change[c]);
            let [x, y, q @ ..] = state_of(p, k);
            set_state(p, k, [x, y], [0, 1, 2, 3].map(|c| q[c] + change[c]));
        }
    }

    /// Particle `id` has changed places with its image.
    pub fn reflect(&mut self, id: u32) {
        if let Some(change) = self.change.get_mut(id as usize) {
            change[0] = -change[0];
        }
    }
}

/// LE4's weights of the rates at n + 1, n, n − 1, for steps of different lengths.
pub(crate) struct Weights {
    /// Of the predictor, of q: n, n − 1.
    predict: [f64; 2],
    /// Of the predictor, of x: n, n − 1.
    bend: [f64; 2],
    /// Of the corrector: n + 1, n, n − 1.
    correct: [f64; 3],
}

impl Weights {
    /// With Δt⁻ = Δt the thesis's; the first step, without a past, is Euler's and then the trapezium's.
    pub fn of(dt: f64, last: f64) -> Weights {
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
    pub fn note(&mut self, p: &Particles, rates: Rates, walls: &Walls) {
        self.now.resize(p.len(), [0.0; 10]);
        self.change.resize(p.len(), [0.0; 4]);
        for k in 0..p.len() {
            let now = &mut self.now[p.id[k] as usize];
            now[..6].copy_from_slice(&state_of(p, k));
            now[6..].copy_from_slice(&rates.of(p, k));
        }
        self.wall_force[0].resize(walls.len(), [0.0; 2]);
        self.wall_force[1] = (0..walls.len()).map(|k| [walls.fx[k], walls.fy[k]]).collect();
    }

    pub fn predict(&self, p: &mut Particles, dt: f64, w: &Weights) {
        for k in 0..p.x.len() {
            let ([x, y, u, v, rho, e, now @ ..], before) = (self.now[p.id[k] as usize], self.change[p.id[k] as usize]);
            let bend = |c: usize| w.bend[0] * now[c] + w.bend[1] * before[c];
            let rate = |c: usize| w.predict[0] * now[c] + w.predict[1] * before[c];
            let at = [x + dt * u + dt * dt * bend(0), y + dt * v + dt * dt * bend(1)];
            set_state(p, k, at, [u + dt * rate(0), v + dt * rate(1), rho + dt * rate(2), e + dt * rate(3)]);
        }
    }

    pub fn correct(&self, p: &mut Particles, rates: Rates, dt: f64, w: &Weights) {
        for k in 0..p.x.len() {
            let ([x, y, u, v, rho, e, now @ ..], before) = (self.now[p.id[k] as usize], self.change[p.id[k] as usize]);
            let then = rates.of(p, k);
            let bend = |c: usize| dt * dt * (then[c] + 2.0 * now[c]) / 6.0;
            let rate = |c: usize| w.correct[0] * then[c] + w.correct[1] * now[c] + w.correct[2] * before[c];
            let at = [x + dt * u + bend(0), y + dt * v + bend(1)];
            set_state(p, k, at, [u + dt * rate(0), v + dt * rate(1), rho + dt * rate(2), e + dt * rate(3)]);
        }
    }

    /// The impulse of a step on each wall particle, with the weights that the fluid's momentum had.
    pub fn mean_force(&self, walls: &mut Walls, dt: f64, w: &Weights) {
        let [before, now] = &self.wall_force;
        for k in 0..walls.len() {
            let early = [0, 1].map(|c| w.correct[1] * now[k][c] + w.correct[2] * before[k][c]);
            walls.set_mean_force_of(k, -dt, early);
            walls.mean_fx[k] = w.correct[0] * walls.fx[k] + early[0];
            walls.mean_fy[k] = w.correct[0] * walls.fy[k] + early[1];
        }
    }

    /// This step becomes the one before.
    pub fn advance(&mut self, dt: f64) {
        for (change, now) in self.change.iter_mut().zip(&self.now) {
            change.copy_from_slice(&now[6..]);
        }
        self.wall_force.swap(0, 1);
        self.dt = dt;
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
