//! Balances of momentum and energy over fluid and bodies (THEORY CO27, CO28).

use serde::{Deserialize, Serialize};

use sph_core::parallel;
use sph_core::particles::totals::FluidEnergy;
use sph_core::{Damped, Fluid, Walls};

use crate::coupling::placed_bodies::Member;

/// Momentum closure (THEORY CO27).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MomentumAudit {
    /// Momentum of fluid and bodies less the external impulses [N s/m].
    balance: [f64; 2],
    /// Largest change of the balance in one step beyond the rounding of the bodies' momentum, relative to Σ m|v| + Δt Σ|F| of the
    /// fluid [-].
    pub worst: f64,
}

/// Changes of a momentum that are its rounding, as a share of it: a heavy body that first touches water holds far more than is exchanged.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The balances since the start.
#[derive(Clone, Copy, Serialize, Deserialize)]
pub(super) struct Balance {
    pub momentum: MomentumAudit,
    pub fluid_at_start: FluidEnergy,
    energy_at_start: f64,
    /// On the fluid at the end of the last step [N/m], and the energy of WC28 that it had released [J/m].
    external_force: ([f64; 2], f64),
    /// Taken from the water by a beach.
    pub absorbed: Damped,
}

impl Balance {
    pub fn at_start(fluid: &Fluid, members: &[Member]) -> Balance {
        let fluid_at_start = fluid.energy();
        Balance {
            momentum: MomentumAudit { balance: momentum_balance(fluid.momentum(), members), worst: 0.0 },
            fluid_at_start,
            energy_at_start: energy(&fluid_at_start, members),
            external_force: (fluid.external_force(), fluid.particles().released),
            absorbed: Damped::default(),
        }
    }

    /// WA15: the beach's impulse on the water is an external one, and what it absorbs is counted.
    pub fn absorb(&mut self, taken: &Damped) {
        for k in 0..2 {
            self.absorbed.impulse[k] += taken.impulse[k];
            self.momentum.balance[k] += taken.impulse[k];
        }
        self.absorbed.energy += taken.energy;
    }

    /// CO27: compare the balance with the one before a step of `dt` [s].
    pub fn close_step(&mut self, fluid: &Fluid, walls: &Walls, members: &[Member], dt: f64) {
        let (of_fluid, held) = fluid.momentum_and_its_scale();
        let (now, w) = (momentum_balance(of_fluid, members), walls);
        let [pushed] = parallel::sum(w.len(), |k| [(w.fx[k] * w.fx[k] + w.fy[k] * w.fy[k]).sqrt()]);
        let scale = held + dt * pushed;
        let (before, released) = self.external_force;
        let is_another = fluid.external_force_varies() || fluid.force_is_constant_in_step();
        if is_another || released != fluid.particles().released {
            self.external_force = (fluid.external_force(), fluid.particles().released);
        }
        // particles are released before all kicks of a step that holds pairs (WC22), between the two of another (WC11)
        let after = self.external_force.0;
        let is_constant = fluid.holds_pairs() || fluid.force_is_constant_in_step();
        let before = if is_constant { after } else { before };
        for k in 0..2 {
            let held_by_bodies: f64 = members.iter().map(|m| m.body.momentum().momentum[k].abs()).sum();
            let external = 0.5 * dt * (before[k] + after[k]);
            let gap = (now[k] - self.momentum.balance[k] - external).abs() - ROUNDING * held_by_bodies;
            if scale > 0.0 && gap > 0.0 {
                self.momentum.worst = self.momentum.worst.max(gap / scale);
            }
        }
        self.momentum.balance = now;
    }

    /// CO28: energy now, less that at the start [J/m].
    pub fn energy_drift(&self, fluid: &FluidEnergy, members: &[Member]) -> f64 {
        energy(fluid, members) + self.absorbed.energy - self.energy_at_start
    }
}

fn energy(fluid: &FluidEnergy, members: &[Member]) -> f64 {
    let of = |m: &Member| {
        let e = m.body.energy();
        if m.body.is_prescribed() { e.work + e.links } else { e.kinetic + e.potential + e.elastic - e.support }
    };
    fluid.total() + members.iter().map(of).sum::<f64>()
}

/// Momentum less external impulses, except for gravity on the fluid.
fn momentum_balance(of_fluid: [f64; 2], members: &[Member]) -> [f64; 2] {
    let mut total = of_fluid;
    for m in members {
        let body = m.body.momentum();
        for k in 0..2 {
            total[k] += body.momentum[k] - body.external[k];
        }
    }
    total
}
