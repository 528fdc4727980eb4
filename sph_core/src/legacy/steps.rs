//! [`Compressible`] as a scheme: a step of each integrator, one line per equation.

use crate::domain::Domain;
use crate::error::Breakdown;
use crate::legacy::compressible::Compressible;
use crate::legacy::multistep::{Old, Weights};
use crate::legacy::settings::{Integrator, Settings, WallModel};
use crate::legacy::updates::{advance_density_midpoint, drift};
use crate::memory::of_vector;
use crate::particles::{Particles, Seed};
use crate::scheme::{Flow, Scheme, SchemeSettings};
use crate::state_bytes::{StateError, decode, encode};
use crate::system::ParticleSystem;
use crate::walls::{WallLayout, Walls};
use crate::wcsph::is_weakly_compressed;
use crate::wcsph::shifting::settle;
use crate::wcsph::step_limit::StepLimit;
use crate::wcsph::updates::kick;

impl Scheme for Compressible {
    fn initialise(&mut self, flow: &mut Flow<'_>) -> Result<(), Breakdown> {
        self.sum_density(flow.system, flow.walls, 0.0);
        self.start_dynamic_walls(flow.system, flow.walls);
        let settling = self.base.settings.shifting.then_some(self.base.settings.settling);
        settle(flow, settling, |flow| self.evaluate_forces(flow, 0.0));
        Ok(())
    }

    fn step(&mut self, flow: &mut Flow<'_>, dt: f64) -> Result<(), Breakdown> {
        Step { scheme: self, flow, dt }.take();
        Ok(())
    }

    fn stable_dt(&self, system: &ParticleSystem, walls: &Walls) -> Result<f64, Breakdown> {
        let limit = StepLimit { cfl: self.base.settings.courant_number(), c0: self.base.eos.c0 };
        limit.stable_dt(system, walls, |k| self.sound_speed(system, k))
    }

    fn check(&self, system: &ParticleSystem) -> Result<(), Breakdown> {
        let (p, rho0) = (&system.particles, self.base.eos.rho0);
        let gas = self.gas.is_some();
        system.check(|k| is_weakly_compressed(p.rho[k], rho0) || gas && p.rho[k] > 0.0 && p.energy[k] > 0.0)
    }

    fn checkpoint(&self) -> Box<dyn Scheme> {
        Box::new(self.clone())
    }

    fn to_bytes(&self) -> Vec<u8> {
        encode(&(&self.base.density_rate, &self.history, &self.heating, &self.dynamic_walls))
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        (self.base.density_rate, self.history, self.heating, self.dynamic_walls) =
            decode("the scheme with options of 2010", bytes)?;
        Ok(())
    }

    fn reflected(&mut self, id: u32) {
        self.history.reflect(id);
    }

    fn internal_energy(&self, system: &ParticleSystem, k: usize) -> f64 {
        let p = &system.particles;
        match self.gas {
            None => self.base.eos.energy(p.rho[k]),
            Some(gas) => gas.energy_over_rest(p.rho[k], p.energy[k]),
        }
    }

    fn bytes(&self) -> usize {
        of_vector(&self.base.density_rate) + of_vector(&self.heating)
    }
}

impl SchemeSettings for Settings {
    /// The default scheme where every option is neutral.
    fn scheme(&self, domain: &Domain) -> Box<dyn Scheme> {
        match self.options.is_neutral() {
            true => self.scheme.scheme(domain),
            false => Box::new(Compressible::new(domain, self)),
        }
    }

    fn state(&self, domain: &Domain, seed: &Seed) -> (f64, Option<f64>) {
        match self.gas(domain) {
            None => self.scheme.state(domain, seed),
            Some(gas) => (gas.density(seed.pressure, gas.energy_at_rest()), Some(gas.energy_at_rest())),
        }
    }

    fn wall_layout(&self, domain: &Domain) -> WallLayout {
        match self.options.walls {
            WallModel::Extrapolated | WallModel::MirrorPoint => {
                WallLayout::filling_support(domain.fluid.smoothing_ratio)
            }
            WallModel::Dynamic => WallLayout { layers: 2, staggered: true },
            WallModel::Repulsive => WallLayout { layers: 1, staggered: false },
        }
    }
}

/// The scheme with what it works on.
pub(crate) struct Step<'a, 'f> {
    pub scheme: &'a mut Compressible,
    pub flow: &'a mut Flow<'f>,
    /// The step [s].
    pub dt: f64,
}

impl Step<'_, '_> {
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
        kick(self.flow.system, half); //                              v½ = v + ½Δt a
        drift(self.flow.system, half); //                             x½ = x + ½Δt v½
        self.evaluate_rates(-half); //                                dρ/dt, de/dt at (x½, v½)
        let Compressible { base, dynamic_walls, .. } = &mut *self.scheme;
        advance_density_midpoint(self.flow.system, &base.density_rate, dt); // ρ' = ρ (2 + ε)/(2 − ε)
        dynamic_walls.advance_density_midpoint(dt);
        self.scheme.advance_energy_midpoint(self.flow.system, dt); // e' likewise
        drift(self.flow.system, half); //                             x' = x½ + ½Δt v½
        self.scheme.shift(self.flow.system, dt); //                   LE8 and WC10
        self.flow.walls.start_mean_force(dt); //                      ½F, where the walls were at the start
        self.finish(); //                                             a', F' at (x', ρ')
        kick(self.flow.system, half); //                              v' = v½ + ½Δt a'
        self.flow.walls.finish_mean_force(); //                       F̄ = ½(F + F')
    }

    /// LE2. Half a step with the rates at n, the rates there, a whole step with those.
    fn predictor_corrector(&mut self) {
        let (dt, half) = (self.dt, 0.5 * self.dt);
        self.evaluate_rates(-dt); //                                  dρ/dt, de/dt at n
        let old = Old::of(&self.flow.system.particles);
        self.scheme.dynamic_walls.keep();
        drift(self.flow.system, half); //                             x½ = x + ½Δt v
        kick(self.flow.system, half); //                              v½ = v + ½Δt a
        self.scheme.advance_density(self.flow.system, half); //       ρ½ = ρ + ½Δt dρ/dt
        self.scheme.advance_energy(self.flow.system, half); //        e½ likewise
        self.scheme.sum_density(self.flow.system, self.flow.walls, -half); // LE13
        self.scheme.evaluate_forces(self.flow, -half); //             a½, F½
        self.evaluate_rates(-half); //                                dρ/dt, de/dt at ½
        old.correct(&mut self.flow.system.particles, self.scheme.rates(), dt); // v' = v + Δt a½, x' = x + ½Δt (v + v'), ρ' = ρ + Δt (dρ/dt)½
        self.scheme.dynamic_walls.correct(dt);
        self.scheme.shift(self.flow.system, dt); //                   WC10, LE8
        let walls = &mut *self.flow.walls;
        (0..walls.len()).for_each(|k| walls.set_mean_force_of(k, -half, [walls.fx[k], walls.fy[k]])); // F̄ = F½
        self.finish(); //                                             a', F' for the next predictor
    }

    /// LE3. Over two steps with the rates of the middle; now and then one step with those of its start (Euler).
    ///
    /// Increments are kept, not states: a contact impulse (WA7) or a filter between two steps then moves both levels alike.
    fn verlet(&mut self) {
        let dt = self.dt;
        self.evaluate_rates(-dt); //                                  dρ/dt, de/dt at n
        let mut history = std::mem::take(&mut self.scheme.history);
        let every = u64::from(self.scheme.options.verlet_correction_every);
        if history.dt == 0.0 || (every > 0 && self.flow.system.steps.is_multiple_of(every)) {
            history.restart(self.flow.system.particles.len()); //     Euler: q' = q + Δt dq/dt
        }
        drift(self.flow.system, dt);
        bend(&mut self.flow.system.particles, 0.5 * dt * dt); //      x' = x + Δt v + ½Δt² a
        history.leap(&mut self.flow.system.particles, self.scheme.rates(), dt); // q' = q⁻ + (Δt + Δt⁻) dq/dt
        mean_of_leap(self.flow.walls, dt, history.dt); //             F̄ = [(Δt + Δt⁻) F − Δt⁻ F̄⁻]/Δt
        history.dt = dt;
        self.scheme.history = history;
        self.scheme.shift(self.flow.system, dt); //                   WC10, LE8
        self.finish(); //                                             a', F' for the next leap
    }

    /// LE4. Predict with the rates at n and n − 1 (Adams & Bashforth), correct with those there (Adams & Moulton).
    fn beeman(&mut self) {
        let dt = self.dt;
        self.evaluate_rates(-dt); //                                  dρ/dt, de/dt at n
        let mut history = std::mem::take(&mut self.scheme.history);
        history.note(&self.flow.system.particles, self.scheme.rates(), self.flow.walls);
        let weights = Weights::of(dt, history.dt);
        history.predict(&mut self.flow.system.particles, dt, &weights); // x* = x + Δt v + Δt² (4a − a⁻)/6,  q* = q + Δt (3q̇ − q̇⁻)/2
        self.scheme.sum_density(self.flow.system, self.flow.walls, 0.0); // LE13
        self.scheme.evaluate_forces(self.flow, 0.0); //               a*, F* at n + 1
        self.evaluate_rates(0.0); //                                  dρ/dt, de/dt there
        history.correct(&mut self.flow.system.particles, self.scheme.rates(), dt, &weights); // x' = x + Δt v + Δt² (a* + 2a)/6,  q' = q + Δt (5q̇* + 8q̇ − q̇⁻)/12
        history.mean_force(self.flow.walls, dt, &weights); //         F̄ = (5F* + 8F − F⁻)/12
        history.advance(dt);
        self.scheme.history = history;
        self.scheme.shift(self.flow.system, dt); //                   WC10, LE8
        self.finish(); //                                             a', F' for the next predictor
    }

    fn evaluate_rates(&mut self, offset: f64) {
        self.scheme.evaluate_density_rate(self.flow.system, self.flow.walls, offset);
        self.scheme.evaluate_heating(self.flow.system); // LE12
    }

    /// LE13, LE6, LE7; then the forces at the step's end.
    fn finish(&mut self) {
        self.scheme.sum_density(self.flow.system, self.flow.walls, 0.0);
        self.scheme.filter_density(self.flow.system, self.flow.walls);
        self.scheme.evaluate_forces(self.flow, 0.0);
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
        walls.set_mean_force_of(k, -dt, force);
    }
}
