//! Time integration: each scheme as the theory prints it, a line an equation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::fluid::Fluid;
use crate::particles::Particles;
use crate::walls::Walls;

/// How a step is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Kick–drift–kick with the density advanced about the midpoint: second order, one sweep of each kind a step (E15).
    #[default]
    Symplectic,
    /// Monaghan's (1989) predictor–corrector: second order, two sweeps of each kind a step (E16).
    PredictorCorrector,
    /// Verlet's (1967) two-step leapfrog with an Euler step now and then: one sweep of each kind a step (L1).
    Verlet,
    /// Beeman's (1976) with the corrector of Adams and Moulton: third order, two sweeps of each kind a step (L2).
    Beeman,
}

impl Integrator {
    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Integrator::Symplectic => "symplectic",
            Integrator::PredictorCorrector => "predictor_corrector",
            Integrator::Verlet => "verlet",
            Integrator::Beeman => "beeman",
        }
    }
}

/// E15. The step of the modern scheme.
pub(crate) fn symplectic(fluid: &mut Fluid, walls: &mut Walls, dt: f64) {
    let half = 0.5 * dt;
    fluid.kick(half); //                         v½ = v + ½Δt a
    fluid.drift(half); //                        x½ = x + ½Δt v½
    fluid.evaluate_density_rate(walls, -half); // dρ/dt at (x½, v½)
    fluid.evaluate_heating(); //                 de/dt there (L10)
    fluid.compress_about_middle(dt); //          ρ' = ρ (2 + ε)/(2 − ε), ε = Δt (dρ/dt)/ρ
    fluid.warm_about_middle(dt); //              e' likewise
    fluid.drift(half); //                        x' = x½ + ½Δt v½
    fluid.shift(dt); //                          x' ← x' + δr
    fluid.drift_with_neighbours(dt); //          L6
    note_first_kick(walls, dt); //               ½F, where the walls began
    fluid.sum_density(walls, 0.0); //            L11
    fluid.filter_density(walls); //              L4, L5
    fluid.evaluate_forces(walls, 0.0); //        a', F' at (x', ρ')
    fluid.kick(half); //                         v' = v½ + ½Δt a'
    add_second_kick(walls); //                   F̄ = ½(F + F')
}

fn note_first_kick(walls: &mut Walls, dt: f64) {
    for k in 0..walls.len() {
        let first = [0.5 * walls.fx[k], 0.5 * walls.fy[k]];
        [walls.mean_fx[k], walls.mean_fy[k]] = first;
        walls.mean_swing[k] = walls.swing(k, -dt, first);
    }
}

fn add_second_kick(walls: &mut Walls) {
    for k in 0..walls.len() {
        walls.mean_fx[k] += 0.5 * walls.fx[k];
        walls.mean_fy[k] += 0.5 * walls.fy[k];
    }
}

/// E16. Half a step with the rates at n, the rates there, a whole step with those.
pub(crate) fn predictor_corrector(fluid: &mut Fluid, walls: &mut Walls, dt: f64) {
    let half = 0.5 * dt;
    fluid.evaluate_density_rate(walls, -dt); //  dρ/dt at n
    fluid.evaluate_heating(); //                 de/dt at n (L10)
    let old = std::mem::take(&mut fluid.old).of(&fluid.particles);
    fluid.dynamic_walls.keep();
    fluid.drift(half); //                        x½ = x + ½Δt v
    fluid.kick(half); //                         v½ = v + ½Δt a
    fluid.compress(half); //                     ρ½ = ρ + ½Δt dρ/dt
    fluid.warm(half); //                         e½ likewise
    fluid.sum_density(walls, -half); //          L11
    fluid.evaluate_forces(walls, -half); //      a½, F½
    fluid.evaluate_density_rate(walls, -half); // dρ/dt at ½
    fluid.evaluate_heating();
    old.correct(fluid, dt); //                   v' = v + Δt a½, x' = x + ½Δt (v + v'), ρ' = ρ + Δt (dρ/dt)½
    fluid.old = old;
    fluid.shift(dt);
    fluid.drift_with_neighbours(dt); //          L6
    for k in 0..walls.len() {
        [walls.mean_fx[k], walls.mean_fy[k]] = [walls.fx[k], walls.fy[k]]; // F̄ = F½
        walls.mean_swing[k] = walls.swing(k, -half, [walls.fx[k], walls.fy[k]]);
    }
    fluid.sum_density(walls, 0.0); //            L11
    fluid.filter_density(walls); //              L4, L5
    fluid.evaluate_forces(walls, 0.0); //        a', F' for the next predictor
}

/// The state at n, by identity: the particles may be sorted anew before it is needed.
#[derive(Default)]
pub(crate) struct Old(Vec<[f64; 6]>);

impl Old {
    fn of(mut self, p: &Particles) -> Old {
        self.0.resize(p.len(), [0.0; 6]);
        for k in 0..p.len() {
            self.0[p.id[k] as usize] = [p.x[k], p.y[k], p.u[k], p.v[k], p.rho[k], p.energy_of(k)];
        }
        self
    }

    fn correct(&self, fluid: &mut Fluid, dt: f64) {
        let p = &mut fluid.particles;
        for k in 0..p.x.len() {
            let [x, y, u, v, rho, energy] = self.0[p.id[k] as usize];
            p.u[k] = u + dt * p.ax[k];
            p.v[k] = v + dt * p.ay[k];
            p.x[k] = x + 0.5 * dt * (u + p.u[k]);
            p.y[k] = y + 0.5 * dt * (v + p.v[k]);
            p.rho[k] = rho + dt * fluid.density_rate[k];
            if let Some(e) = p.energy.get_mut(k) {
                *e = energy + dt * fluid.heating[k];
            }
        }
        fluid.dynamic_walls.correct(dt);
    }
}
