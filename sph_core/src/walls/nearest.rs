//! Fluid particles that touch a wall: found here; the walls' owners judge them (THEORY E25).

use crate::fluid::Fluid;
use crate::parallel;
use crate::walls::Walls;

/// A fluid particle is a suspect below this height over its nearest wall particle, along that one's normal, in
/// wall spacings; a wall's surface is half a spacing above its first row.
const SUSPECT: f64 = 0.6;

impl Fluid {
    /// Fluid particles that may be beyond a wall's surface, in the particles' order.
    pub fn suspects(&self, walls: &Walls) -> Vec<usize> {
        let near = |k: &usize| self.height_over_nearest(*k, walls) < SUSPECT;
        parallel::by_chunk(self.particles.len(), |targets| targets.filter(near).collect::<Vec<usize>>()).concat()
    }

    /// Height over the nearest wall particle along its normal, in wall spacings; infinity far from walls.
    fn height_over_nearest(&self, k: usize, walls: &Walls) -> f64 {
        let (x, y, n) = (self.particles.x[k], self.particles.y[k], walls.len());
        let (mut least, mut height) = (f64::INFINITY, f64::INFINITY);
        for j in self.search.walls_of_fluid.of(k) {
            let (source, side, [sx, sy]) = self.wall_source(j as usize, n);
            let wall_x = if side > 0.0 { walls.x[source] + sx } else { self.reflect(walls.x[source]) };
            let (dx, dy) = (x - wall_x, y - (walls.y[source] + sy));
            let r2 = dx * dx + dy * dy;
            if r2 < least {
                least = r2;
                height = (dx * side * walls.nx[source] + dy * walls.ny[source]) / walls.h[source];
            }
        }
        height * self.parameters.smoothing_ratio
    }

    /// The wall particle behind a listed index, −1 for a reflection, and how far a repeated one is translated [m].
    fn wall_source(&self, j: usize, walls: usize) -> (usize, f64, [f64; 2]) {
        if j < walls {
            return (j, 1.0, [0.0; 2]);
        }
        let source = self.search.wall_images[j - walls] as usize;
        self.search.wall_shifts.get(j - walls).map_or((source, -1.0, [0.0; 2]), |&shift| (source, 1.0, shift))
    }

    fn reflect(&self, x: f64) -> f64 {
        self.parameters.mirror.map_or(x, |mirror| mirror.reflect(x))
    }
}
