//! The pressure of still water, which acts exactly where pairs would act by an arrangement of the particles (THEORY WC29).

use std::ops::Range;

use crate::forces::Forces;
use crate::interactions::packed_particle::PackedParticle;
use crate::parallel;
use crate::system::ParticleSystem;
use crate::walls::Walls;
use crate::walls::outline::{closed_owners, turning_forces};

/// Depth below the lowest surface from which all of the pressure acts [h].
const ONSET: f64 = 6.0;
/// Pressure that pairs keep, over ρ₀|v|² of the fastest particle [-]: beside a cylinder that moves through water p is down to 1.5 of it below that
/// of still water, and pairs that pull give particles no order.
const KEPT: f64 = 2.0;

/// WC29: the pressure of still water below the lowest surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StillPressure {
    /// ρ₀ g [N/m³].
    weight: [f64; 2],
    /// ρ₀ g·r of the lowest surface, or of the bottom of a body that comes out of the water, and what pairs keep [Pa].
    surface: f64,
    /// L, the pressure at the depth from which all of it acts [Pa].
    onset: f64,
}

impl StillPressure {
    /// That of the present particles; none without gravity or surface. The free surface is where no wall is near.
    pub fn find(system: &ParticleSystem, walls: &Walls) -> Option<StillPressure> {
        let (p, moments, domain) = (&system.particles, &system.fields.moments, &system.domain);
        let weight = domain.gravity.map(|g| domain.fluid.density * g);
        let depth = |x: f64, y: f64| weight[0] * x + weight[1] * y;
        let free = |k: usize| moments[k].at_surface() && moments[k].wall_kernel_sum == 0.0;
        let row = -parallel::least(p.len(), |k| if free(k) { -depth(p.x[k], p.y[k]) } else { f64::INFINITY });
        let per_h = weight[0].hypot(weight[1]) * system.least_smoothing_length();
        let (level, onset) = (row - 0.5 * per_h / domain.fluid.smoothing_ratio, ONSET * per_h);
        let below = |owner: Range<usize>| {
            let depths = owner.map(|k| depth(walls.x[k], walls.y[k]));
            let [top, bottom] = depths.fold([f64::INFINITY, level], |[top, low], d| [top.min(d), low.max(d)]);
            let emerged = (1.0 - (top - level) / onset).clamp(0.0, 1.0);
            emerged * (bottom - level)
        };
        let lowest = closed_owners(walls).map(below).fold(0.0, f64::max);
        let fastest = -parallel::least(p.len(), |k| -(p.u[k] * p.u[k] + p.v[k] * p.v[k]));
        let surface = level + lowest + KEPT * domain.fluid.density * fastest;
        (surface.is_finite() && onset > 0.0).then_some(StillPressure { weight, surface, onset })
    }

    /// P [Pa] and ∇P [Pa/m] at a place: with d = ρ₀ g·r above that of the surface and ξ = d/L, P = L ξ³ (6 − 8ξ + 3ξ²) for ξ < 1, then d.
    pub fn at(&self, x: f64, y: f64) -> (f64, [f64; 2]) {
        let d = self.weight[0] * x + self.weight[1] * y - self.surface;
        let xi = (d / self.onset).clamp(0.0, 1.0);
        let pressure = if xi < 1.0 { self.onset * xi.powi(3) * (6.0 - 8.0 * xi + 3.0 * xi * xi) } else { d };
        let slope = xi * xi * (18.0 - 32.0 * xi + 15.0 * xi * xi);
        (pressure, self.weight.map(|w| w * slope))
    }

    /// p ← p − P in what pairs read.
    pub fn take_off(&self, system: &mut ParticleSystem) {
        let less = |_: usize, row: &mut PackedParticle| row.p -= self.at(row.x, row.y).0;
        parallel::update(&mut system.packed.fluid, less);
        parallel::update(&mut system.packed.walls, less);
    }

    /// −m ∇P/ρ₀ on the fluid, −∫P n ds on closed outlines; the tank carries the rest (WC29).
    pub fn act(&self, system: &mut ParticleSystem, walls: &mut Walls, forces: &mut Forces) {
        let (p, inverse) = (&system.particles, 1.0 / system.domain.fluid.density);
        let on_fluid = |k: usize| self.at(p.x[k], p.y[k]).1.map(|slope| -inverse * p.mass[k] * slope);
        parallel::update_both(&mut forces.x, &mut forces.y, |k, x, y| {
            let [fx, fy] = on_fluid(k);
            (*x, *y) = (*x + fx, *y + fy);
        });
        let mut sum = parallel::sum(p.len(), on_fluid);
        for (k, [fx, fy]) in self.on_outlines(system, walls) {
            (walls.fx[k], walls.fy[k]) = (walls.fx[k] + fx, walls.fy[k] + fy);
            sum = [sum[0] + fx, sum[1] + fy];
        }
        system.force_of_tank = sum;
    }

    /// −∫P n ds over the shares of the wall particles of closed outlines [N/m], with its moment.
    fn on_outlines(&self, system: &ParticleSystem, walls: &Walls) -> Vec<(usize, [f64; 2])> {
        let mut forces = Vec::new();
        for owner in closed_owners(walls) {
            let (mut places, mut couple, first) = (Vec::new(), 0.0, forces.len());
            for k in owner {
                let (row, share, normal) = (&system.packed.walls[k], &walls.outline[k], [walls.nx[k], walls.ny[k]]);
                let (pressure, gradient) =
                    self.at(row.x + walls.depth[k] * normal[0], row.y + walls.depth[k] * normal[1]);
                forces.push((k, share.integral(normal, pressure, gradient).map(|f| -f)));
                places.push(([row.x, row.y], share.area[0].abs()));
                couple -= pressure * share.couple(walls.depth[k]);
            }
            if system.domain.mirror.is_none() {
                for ((_, force), turning) in forces[first..].iter_mut().zip(turning_forces(&places, couple)) {
                    *force = [force[0] + turning[0], force[1] + turning[1]];
                }
            }
        }
        forces
    }

    /// Power of these forces and of P on changing densities [W/m]: 0 but for the errors of the sums over pairs, which move nothing.
    pub fn power(&self, system: &ParticleSystem, walls: &Walls, density_rate: &[f64]) -> f64 {
        let (p, inverse) = (&system.particles, 1.0 / system.domain.fluid.density);
        let [of_fluid] = parallel::sum(p.len(), |k| {
            let (pressure, [sx, sy]) = self.at(p.x[k], p.y[k]);
            let rise = inverse * (sx * p.u[k] + sy * p.v[k]);
            [p.mass[k] * (pressure * density_rate[k] / (p.rho[k] * p.rho[k]) - rise)]
        });
        let of_walls = self.on_outlines(system, walls);
        of_fluid + of_walls.into_iter().map(|(k, [fx, fy])| fx * walls.u[k] + fy * walls.v[k]).sum::<f64>()
    }
}
