//! Accelerations and forces from the pressures that a projection found (THEORY I10–I12, I16).

use crate::fluid::Fluid;
use crate::phases::Phase;
use crate::sweep;
use crate::walls::Walls;

use super::lattice::Closure;

/// A particle counts as calm from this share of the pressure under a spacing of water on [-].
const CALM: f64 = 0.25;

/// What of the pair forces does not belong to the flow.
#[derive(Clone, Copy, Debug, Default)]
pub struct Correction {
    /// To be added [m/s²].
    acceleration: [f64; 2],
    /// Share in what keeps the sum of all corrections zero [-].
    share: f64,
}

impl Fluid {
    /// I10–I12: the pairs' forces on fluid and walls, and what the sums over disordered pairs and at the surface lack.
    pub(super) fn push(&mut self, walls: &mut Walls, dt: f64) {
        let inverse = 1.0 / self.projection.lattice.expect("surveyed").gradient;
        self.rows.set_pressures(&self.derived, &self.search, self.parameters.mirror);
        self.extrapolate_to_walls(walls); // E9
        self.gather_forces(walls); //        E6, both ways
        for k in 0..walls.len() {
            let force = [inverse * walls.fx[k], inverse * walls.fy[k]];
            [walls.fx[k], walls.fy[k]] = force;
            [walls.mean_fx[k], walls.mean_fy[k]] = force;
            walls.mean_swing[k] = walls.swing(k, -dt, force);
        }
        self.phases.begin(Phase::Momentum);
        self.find_head();
        self.find_normals();
        let mut corrections = std::mem::take(&mut self.projection.corrections);
        corrections.resize(self.particles.len(), Correction::default());
        sweep::gather_into(&mut corrections, |k| self.correct(k, inverse));
        // corrections push nobody: their sum goes back, spread evenly
        let (mut impulse, mut mass) = ([0.0; 2], 0.0);
        for (correction, m) in corrections.iter().zip(&self.particles.mass) {
            for i in 0..2 {
                impulse[i] += m * correction.acceleration[i];
            }
            mass += correction.share * m;
        }
        let back = if mass > 0.0 { impulse.map(|sum| sum / mass) } else { [0.0; 2] };
        let g = self.parameters.gravity;
        let (p, gathered) = (&mut self.particles, &self.gathered);
        sweep::update_both(&mut p.ax, &mut p.ay, |k, ax, ay| {
            let Correction { acceleration, share } = corrections[k];
            let a =
                [0, 1].map(|i| inverse * gathered[k].force[i] / p.mass[k] + g[i] + acceleration[i] - share * back[i]);
            [*ax, *ay] = a;
        });
        self.derived.surroundings.clone_from(&self.projection.survey.around);
        self.projection.corrections = corrections;
    }

    /// I11: −ρ g·r of the highest particle at the start and half its spacing [Pa]: no still water is under more pressure than this head gives.
    fn find_head(&mut self) {
        if self.steps > 0 {
            return;
        }
        let (p, g, rho) = (&self.particles, self.parameters.gravity, self.parameters.eos.rho0);
        let half = |k: usize| 0.5 * rho * g[0].hypot(g[1]) * (p.mass[k] / p.rho[k]).sqrt();
        let height = |k: usize| half(k) - rho * (g[0] * p.x[k] + g[1] * p.y[k]);
        self.projection.head = (0..p.len()).map(height).fold(f64::NEG_INFINITY, f64::max);
    }

    /// I10, I11 and I16 for particle `k`.
    fn correct(&self, k: usize, inverse: f64) -> Correction {
        let (p, g, rho) = (&self.particles, self.parameters.gravity, self.parameters.eos.rho0);
        let lattice = self.projection.lattice.expect("surveyed");
        let (survey, air) = (&self.projection.survey, self.projection.air.exposure[k]);
        let (around, [xx, xy, yy]) = (&survey.around[k], survey.spread[k]);
        let (search, pressures) = (&self.search, &self.derived.pressure);
        let (pressure, near) = (pressures[k], search.fluid.of(k));
        let least = near.map(|j| pressures[search.source(j, pressures.len())]).fold(pressure, f64::min);
        let weight = g[0].hypot(g[1]) * rho;
        let dx = (p.mass[k] / p.rho[k]).sqrt();
        // I10: a row of a flat surface feels the whole of a linear pressure
        let closure = if air > 0.0 { lattice.closure(around.filling) } else { Closure::default() };
        let tie = air * closure.pull;
        let top = pressure.clamp(0.0, weight * closure.depth * dx);
        // I11: a pressure that is the same all around pushes nowhere; nor does the weight of still water
        let head = self.projection.head + rho * (g[0] * p.x[k] + g[1] * p.y[k]);
        let still = pressure.clamp(0.0, head.max(2.0 * weight * p.h[k]));
        let base = if pressure > 0.0 { still.max(least) } else { least };
        let share = 1.0 - air;
        let bearing = if weight > 0.0 { (still / (CALM * weight * dx)).min(1.0) } else { 0.0 };
        let calm = share * bearing;
        let slope = [xx * g[0] + xy * g[1], xy * g[0] + yy * g[1]];
        let pull = tie * (top - share * base.min(top));
        let lift = (pull + share * 2.0 * base) * inverse / rho;
        let mut acceleration = [0, 1].map(|i| lift * around.crowding[i] + calm * (inverse * slope[i] - g[i]));
        if air > 0.0 {
            let slip = self.slip(k, air * 2.0 * still - pull, air * bearing);
            acceleration = [0, 1].map(|i| acceleration[i] + inverse * slip[i]);
        }
        Correction { acceleration, share }
    }
}
