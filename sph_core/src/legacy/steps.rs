//! A step of each integrator, one line per equation.

use crate::legacy::compressible::Compressible;
use crate::legacy::integrator::Integrator;
use crate::legacy::multistep::Weights;
use crate::particles::Particles;
use crate::system::ParticleSystem;
use crate::walls::Walls;
use crate::walls::interface::WallInterface;
use crate::wcsph::updates::{advance_density_midpoint, drift, kick};

/// The scheme with what it works on.
pub(crate) struct Step<'a> {
    pub scheme: &'a mut Compressible,
    pub system: &'a mut ParticleSystem,
    pub walls: &'a mut Walls,
    pub interfaces: &'a mut [WallInterface],
    /// The step [s].
    pub dt: f64,
}

impl Step<'_> {
    /// One step.
    pub fn take(mut self) {
        match self.scheme.options.integrator {
            Integrator::Symplectic => self.symplectic(),
            Integrator::PredictorCorrector => self.predictor_corrector(),
            Integrator::Verlet => self.verlet(),
            Integrator::Beeman => self.beeman(),
        }
    }

    /// WC11.
    fn symplectic(&mut self) {
        let (dt, half) = (self.dt, 0.5 * self.dt);
        kick(self.system, half); //                                   v½ = v + ½Δt a
        drift(self.system, half); //                                  x½ = x + ½Δt v½
        self.evaluate_rates(-half); //                                dρ/dt, de/dt at (x½, v½)
        let Compressible { base, dynamic_walls, .. } = &mut *self.scheme;
        advance_density_midpoint(self.system, &base.density_rate, dt); // ρ' = ρ (2 + ε)/(2 − ε)
        dynamic_walls.advance_density_midpoint(dt);
        self.scheme.advance_energy_midpoint(self.system, dt); //      e' likewise
        drift(self.system, half); //                                  x' = x½ + ½Δt v½
        self.shift(); //                                              LE8 and WC10
        self.walls.start_mean_force(dt); //                           ½F, where the walls were at the start
        self.finish_densities(); //                                   LE13, LE6, LE7
        self.evaluate_forces(0.0); //                                 a', F' at (x', ρ')
        kick(self.system, half); //                                   v' = v½ + ½Δt a'
        self.walls.finish_mean_force(); //                            F̄ = ½(F + F')
    }

    /// LE2. Half a step with the rates at n, the rates there, a whole step with those.
    fn predictor_corrector(&mut self) {
        let (dt, half) = (self.dt, 0.5 * self.dt);
        self.evaluate_rates(-dt); //                  dρ/dt, de/dt at n
        let old = std::mem::take(&mut self.scheme.old).of(&self.system.particles);
        self.scheme.dynamic_walls.keep();
        drift(self.system, half); //                  x½ = x + ½Δt v
        kick(self.system, half); //                   v½ = v + ½Δt a
        self.scheme.advance_density(self.system, half); // ρ½ = ρ + ½Δt dρ/dt
        self.scheme.advance_energy(self.system, half); //  e½ likewise
        self.scheme.sum_density(self.system, self.walls, -half); // LE13
        self.evaluate_forces(-half); //               a½, F½
        self.evaluate_rates(-half); //                dρ/dt, de/dt at ½
        old.correct(&mut self.system.particles, self.scheme.rates(), dt); // v' = v + Δt a½, x' = x + ½Δt (v + v'), ρ' = ρ + Δt (dρ/dt)½
        self.scheme.dynamic_walls.correct(dt);
        self.scheme.old = old;
        self.shift(); //                              WC10, LE8
        let walls = &mut *self.walls;
        for k in 0..walls.len() {
            [walls.mean_fx[k], walls.mean_fy[k]] = [walls.fx[k], walls.fy[k]]; // F̄ = F½
            walls.mean_swing[k] = walls.swing(k, -half, [walls.fx[k], walls.fy[k]]);
        }
        self.finish_densities(); //                   LE13, LE6, LE7
        self.evaluate_forces(0.0); //                 a', F' for the next predictor
    }

    /// LE3. Over two steps with the rates of the middle; now and then one step with those of its start (Euler).
    ///
    /// Increments are kept, not states: a contact impulse (WA7) or a filter between two steps then moves both levels alike.
    fn verlet(&mut self) {
        let dt = self.dt;
        self.evaluate_rates(-dt); //                  dρ/dt, de/dt at n
        let mut history = std::mem::take(&mut self.scheme.history);
        let every = u64::from(self.scheme.options.verlet_correction_every);
        if history.dt == 0.0 || (every > 0 && self.system.steps.is_multiple_of(every)) {
            history.restart(self.system.particles.len()); // Euler: q' = q + Δt dq/dt
        }
        drift(self.system, dt);
        bend(&mut self.system.particles, 0.5 * dt * dt); // x' = x + Δt v + ½Δt² a
        history.leap(&mut self.system.particles, self.scheme.rates(), dt); // q' = q⁻ + (Δt + Δt⁻) dq/dt
        mean_of_leap(self.walls, dt, history.dt); //  F̄ = [(Δt + Δt⁻) F − Δt⁻ F̄⁻]/Δt
        history.dt = dt;
        self.scheme.history = history;
        self.shift(); //                              WC10, LE8
        self.finish_densities(); //                   LE13, LE6, LE7
        self.evaluate_forces(0.0); //                 a', F' for the next leap
    }

    /// LE4. Predict with the rates at n and n − 1 (Adams & Bashforth), correct with those there (Adams & Moulton).
    fn beeman(&mut self) {
        let dt = self.dt;
        self.evaluate_rates(-dt); //                  dρ/dt, de/dt at n
        let mut history = std::mem::take(&mut self.scheme.history);
        history.note(&self.system.particles, self.scheme.rates(), self.walls);
        let weights = Weights::of(dt, history.dt);
        history.predict(&mut self.system.particles, dt, &weights); // x* = x + Δt v + Δt² (4a − a⁻)/6,  q* = q + Δt (3q̇ − q̇⁻)/2
        self.scheme.sum_density(self.system, self.walls, 0.0); // LE13
        self.evaluate_forces(0.0); //                 a*, F* at n + 1
        self.evaluate_rates(0.0); //                  dρ/dt, de/dt there
        history.correct(&mut self.system.particles, self.scheme.rates(), dt, &weights); // x' = x + Δt v + Δt² (a* + 2a)/6,  q' = q + Δt (5q̇* + 8q̇ − q̇⁻)/12
        history.mean_force(self.walls, dt, &weights); // F̄ = (5F* + 8F − F⁻)/12
        history.advance(dt);
        self.scheme.history = history;
        self.shift(); //                              WC10, LE8
        self.finish_densities(); //                   LE13, LE6, LE7
        self.evaluate_forces(0.0); //                 a', F' for the next predictor
    }

    fn evaluate_rates(&mut self, offset: f64) {
        self.scheme.evaluate_density_rate(self.system, self.walls, offset);
        self.scheme.evaluate_heating(self.system); // LE12
    }

    fn shift(&mut self) {
        self.scheme.shift(self.system, self.dt);
    }

    fn finish_densities(&mut self) {
        self.scheme.sum_density(self.system, self.walls, 0.0);
        self.scheme.filter_density(self.system, self.walls);
    }

    fn evaluate_forces(&mut self, offset: f64) {
        self.scheme.evaluate_forces(self.system, self.walls, self.interfaces, offset);
    }
}

/// x ← x + s a.
fn bend(p: &mut Particles, s: f64) {
    for k in 0..p.x.len() {
        p.x[k] += s * p.ax[k];
        p.y[k] += s * p.ay[k];
    }
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
