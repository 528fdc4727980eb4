//! Two force rules of the thesis of 2010: the pressure of the first layer, and least squares with viscous traction (THEORY GE8).

use sph_core::Probe;

use crate::coupling::force_rules::nodal_loads::Side;
use crate::coupling::force_rules::placed_outline::{PlacedOutline, PointForce};

impl PlacedOutline<'_> {
    /// FEX_2D2: −p n ℓ on the surface above the first layer; ℓ reaches half way to the neighbours along the outline. The
    /// pressure is the boundary particle's, carried to the surface by ρ₀(g − a_w)·n, times the place's wetness.
    pub(super) fn first_layer(&self, k: usize, probe: &Probe<'_>) -> Vec<PointForce> {
        self.pressed(k, |at, p| probe.wetness(at) * p)
    }

    /// Boundary particles of the first layer of body `k`.
    pub(super) fn first_particles(&self, k: usize) -> impl Iterator<Item = usize> + '_ {
        let (w, ratio) = (&self.system.walls, self.system.fluid.domain().fluid.smoothing_ratio);
        self.system.range(k).filter(move |&j| w.depth[j] < 0.75 * w.h[j] / ratio)
    }

    /// Pressure on the surface above boundary particle `j` [Pa].
    pub(super) fn surface_pressure(&self, j: usize) -> f64 {
        let (w, domain) = (&self.system.walls, self.system.fluid.domain());
        let (rho, g) = (domain.fluid.density, domain.gravity);
        let slope = rho * ((g[0] - w.ax[j]) * w.nx[j] + (g[1] - w.ay[j]) * w.ny[j]);
        w.pressure[j] + slope * w.depth[j]
    }

    /// The same of a pressure that `taken` makes of place [m] and pressure [Pa].
    pub(super) fn pressed(&self, k: usize, taken: impl Fn([f64; 2], f64) -> f64) -> Vec<PointForce> {
        let w = &self.system.walls;
        let pressed = |j: usize| {
            let at = self.above(j);
            let p = taken(at, self.surface_pressure(j));
            PointForce { surface: at, at, force: [-p * w.nx[j], -p * w.ny[j]] }
        };
        let mut forces = self.doubled(self.first_particles(k).map(pressed).collect());
        let starts: Vec<f64> = self.side_starts();
        let stations: Vec<(usize, f64)> = forces
            .iter()
            .map(|p| {
                let (side, t) = self.nearest(p.surface);
                (side, starts[side] + t * self.sides[side].length)
            })
            .collect();
        for (force_at, length) in forces.iter_mut().zip(self.shares(&stations, &starts)) {
            force_at.force = force_at.force.map(|f| f * length);
        }
        forces
    }

    /// Running length at which each side starts [m], through all loops.
    fn side_starts(&self) -> Vec<f64> {
        let mut length = 0.0;
        let start = |s: &Side| {
            length += s.length;
            length - s.length
        };
        self.sides.iter().map(start).collect()
    }

    /// Length of the outline [m] that is nearer to each station than to its neighbours on the same loop.
    fn shares(&self, stations: &[(usize, f64)], starts: &[f64]) -> Vec<f64> {
        let mut shares = vec![0.0; stations.len()];
        let mut first = 0;
        while first < self.sides.len() {
            let opening = self.sides[first].corners[0];
            let last = (first..self.sides.len()).find(|&s| self.sides[s].corners[1] == opening).unwrap_or(first);
            let total = starts[last] + self.sides[last].length - starts[first];
            let mut order: Vec<usize> =
                (0..stations.len()).filter(|&k| (first..=last).contains(&stations[k].0)).collect();
            order.sort_by(|&a, &b| stations[a].1.total_cmp(&stations[b].1));
            let n = order.len();
            for i in 0..n {
                let gap = (stations[order[(i + 1) % n]].1 - stations[order[i]].1).rem_euclid(total);
                let gap = if n == 1 { total } else { gap };
                shares[order[i]] += 0.5 * gap;
                shares[order[(i + 1) % n]] += 0.5 * gap;
            }
            first = last + 1;
        }
        shares
    }

    /// FEX_2D4: −p n + ρ₀ν(∇v + ∇vᵀ)·n by moving least squares (GE7); the carried mean (GE6) where those fail. ν = 0
    /// where walls slip.
    pub(super) fn fitted(&self, probe: &Probe<'_>, at: [f64; 2], n: [f64; 2]) -> [f64; 2] {
        let Some(found) = probe.least_squares(at) else {
            let p = probe.carried(at, self.field);
            return [-p * n[0], -p * n[1]];
        };
        let domain = self.system.fluid.domain();
        let (mu, g) = (domain.fluid.density * domain.fluid.wall_viscosity(), found.gradient);
        let shear = [0, 1].map(|i| mu * ((g[i][0] + g[0][i]) * n[0] + (g[i][1] + g[1][i]) * n[1]));
        let wetness = probe.wetness(at);
        [0, 1].map(|k| wetness * (shear[k] - found.pressure * n[k]))
    }
}
