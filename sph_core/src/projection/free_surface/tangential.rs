//! Rows that slide along the surface (THEORY I16).

use crate::fluid::Fluid;
use crate::parallel;

impl Fluid {
    /// I16: unit normals of the surface where air is felt, into the water; elsewhere zero.
    pub(crate) fn find_normals(&mut self) {
        let (search, rows, kernel) = (&self.search, &self.rows.fluid, self.parameters.kernel);
        let (survey, air) = (&self.projection.survey, &self.projection.air.exposure);
        let around = &survey.around;
        let mirrored = self.parameters.mirror.is_some();
        let n = self.particles.len();
        self.projection.normals.resize(n, [0.0; 2]);
        parallel::gather_into(&mut self.projection.normals, |k| {
            if air[k] == 0.0 {
                return [0.0; 2];
            }
            let a = &rows[k];
            let mut sum = around[k].crowding().map(|c| a.fill * kernel.value(0.0, a.h) * c);
            for &j in survey.row(k).0 {
                let b = &rows[j as usize];
                let (dx, dy) = (a.x - b.x, a.y - b.y);
                let weight = b.fill * kernel.value((dx * dx + dy * dy).sqrt(), 0.5 * (a.h + b.h));
                let [x, y] = around[search.source(j, n)].crowding();
                let side = if mirrored && j as usize >= n { -1.0 } else { 1.0 };
                sum[0] += weight * side * x;
                sum[1] += weight * y;
            }
            let length = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
            if length > 0.0 { sum.map(|s| s / length) } else { [0.0; 2] }
        });
    }
    /// I16: κ times the acceleration along the surface [m/s²] of particle `k` that takes the push of a pressure out of the
    /// pairs' sums: `pressure` [Pa] that is the same all around, and `bearing` times the weight of still water.
    pub(crate) fn slip(&self, k: usize, pressure: f64, bearing: f64) -> [f64; 2] {
        let (g, rho) = (self.parameters.gravity, self.parameters.eos.rho0);
        let n = self.projection.normals[k];
        let t = [-n[1], n[0]];
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let [xx, xy, yy] = self.projection.survey.spread[k];
        let spread = [xx * n[0] + xy * n[1], xy * n[0] + yy * n[1]];
        let along = dot(t, self.projection.survey.around[k].crowding());
        t.map(|t_i| t_i * (pressure / rho * along + bearing * dot(n, g) * dot(t, spread)))
    }
}
