//! Time integration: each scheme as the theory prints it, a line an equation.

use serde::{Deserialize, Serialize};

use crate::fluid::Fluid;
use crate::walls::Walls;

/// How a step is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Kick–drift–kick with the density advanced about the midpoint: second order, one sweep of each kind a step (E15).
    #[default]
    Symplectic,
    /// Monaghan's (1989) predictor–corrector: second order, two sweeps of each kind a step (E16).
    PredictorCorrector,
}

/// E15. The step of the modern scheme.
pub(crate) fn symplectic(fluid: &mut Fluid, walls: &mut Walls, dt: f64) {
    let half = 0.5 * dt;
    fluid.kick(half); //                         v½ = v + ½Δt a
    fluid.drift(half); //                        x½ = x + ½Δt v½
    fluid.evaluate_density_rate(walls, -half); // dρ/dt at (x½, v½)
    fluid.compress(dt); //                       ρ' = ρ + Δt dρ/dt
    fluid.drift(half); //                        x' = x½ + ½Δt v½
    fluid.shift(dt); //                          x' ← x' + δr
    let before = (walls.fx.clone(), walls.fy.clone());
    fluid.evaluate_forces(walls, 0.0); //        a', F' at (x', ρ')
    fluid.kick(half); //                         v' = v½ + ½Δt a'
    for k in 0..walls.len() {
        walls.mean_fx[k] = 0.5 * (before.0[k] + walls.fx[k]); // the two kicks' impulse
        walls.mean_fy[k] = 0.5 * (before.1[k] + walls.fy[k]);
    }
}

/// E16. Half a step with the rates at n, the rates there, a whole step with those.
pub(crate) fn predictor_corrector(fluid: &mut Fluid, walls: &mut Walls, dt: f64) {
    let half = 0.5 * dt;
    fluid.evaluate_density_rate(walls, -dt); //  dρ/dt at n
    let old = Old::of(fluid);
    fluid.drift(half); //                        x½ = x + ½Δt v
    fluid.kick(half); //                         v½ = v + ½Δt a
    fluid.compress(half); //                     ρ½ = ρ + ½Δt dρ/dt
    fluid.evaluate_forces(walls, -half); //      a½, F½
    fluid.evaluate_density_rate(walls, -half); // dρ/dt at ½
    old.correct(fluid, dt); //                   v' = v + Δt a½, x' = x + ½Δt (v + v'), ρ' = ρ + Δt (dρ/dt)½
    fluid.shift(dt);
    walls.mean_fx.clone_from(&walls.fx);
    walls.mean_fy.clone_from(&walls.fy);
    fluid.evaluate_forces(walls, 0.0); //        a', F' for the next predictor
}

/// The state at n, by identity: the particles may be sorted anew before it is needed.
struct Old(Vec<[f64; 5]>);

impl Old {
    fn of(fluid: &Fluid) -> Old {
        let p = &fluid.particles;
        let mut old = vec![[0.0; 5]; p.len()];
        for k in 0..p.len() {
            old[p.id[k] as usize] = [p.x[k], p.y[k], p.u[k], p.v[k], p.rho[k]];
        }
        Old(old)
    }

    fn correct(&self, fluid: &mut Fluid, dt: f64) {
        let p = &mut fluid.particles;
        for k in 0..p.x.len() {
            let [x, y, u, v, rho] = self.0[p.id[k] as usize];
            p.u[k] = u + dt * p.ax[k];
            p.v[k] = v + dt * p.ay[k];
            p.x[k] = x + 0.5 * dt * (u + p.u[k]);
            p.y[k] = y + 0.5 * dt * (v + p.v[k]);
            p.rho[k] = rho + dt * fluid.density_rate[k];
        }
    }
}
