//! Fluid particles that touch a wall: found here; the walls' owners judge them (THEORY E25).

use crate::fluid::Fluid;
use crate::sweep;
use crate::walls::Walls;

/// A fluid particle is a suspect below this height over its nearest wall particle, along that one's normal, in
/// wall spacings; a wall's surface is half a spacing above its first row.
const SUSPECT: f64 = 0.6;

impl Fluid {
    /// Fluid particles that may be beyond a wall's surface, in the particles' order.
    pub fn suspects(&self, walls: &Walls) -> Vec<usize> {
        let near = |k: &usize| self.height_over_nearest(*k, walls) < SUSPECT;
        sweep::by_chunk(self.particles.len(), |targets| targets.filter(near).collect::<Vec<usize>>()).concat()
    }

    /// Height over the nearest wall particle along its normal, in wall spacings; infinity far from walls.
    fn height_over_nearest(&self, k: usize, walls: &Walls) -> f64 {
        let (x, y) = (self.particles.x[k], self.particles.y[k]);
        let apart = |j: u32| [x - self.rows.walls[j as usize].x, y - self.rows.walls[j as usize].y];
        let (mut least, mut nearest) = (f64::INFINITY, None);
        for j in self.search.walls_of_fluid.of(k) {
            let [dx, dy] = apart(j);
            let r2 = dx * dx + dy * dy;
            if r2 < least {
                (least, nearest) = (r2, Some(j));
            }
        }
        let Some(j) = nearest else { return f64::INFINITY };
        let ([dx, dy], (source, side)) = (apart(j), self.wall_source(j as usize, walls.len()));
        (dx * side * walls.nx[source] + dy * walls.ny[source]) / walls.h[source] * self.parameters.smoothing_ratio
    }

    /// The wall particle behind a listed index, and −1 for a reflection.
    fn wall_source(&self, j: usize, walls: usize) -> (usize, f64) {
        if j < walls {
            return (j, 1.0);
        }
        let side = if self.search.wall_shifts.is_empty() { -1.0 } else { 1.0 };
        (self.search.wall_images[j - walls] as usize, side)
    }
}
