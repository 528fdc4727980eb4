//! Who stands where: the cast at a step's beginning, and where a trial takes it (THEORY LE20, LE21, LE25, LE21).

use crate::legacy::pilorget2010::state::{Thesis, Trial};
use crate::system::ParticleSystem;
use crate::walls::Walls;

use crate::legacy::pilorget2010::cast::Player;

impl Thesis {
    /// Put all particles where they are at the step's beginning (`offset` −Δt), or where the trial takes them.
    pub(crate) fn assign(&mut self, system: &ParticleSystem, walls: &Walls, offset: f64, trial: Option<&Trial>) {
        let drift = trial.map(|trial| self.drift_of_sides(system, trial));
        let (p, n, limits) = (&system.particles, system.particles.len(), &self.limits);
        let cast = &mut self.cast;
        cast.players.clear();
        cast.players.extend((0..n).map(|k| {
            let [x, y] = trial.map_or([p.x[k], p.y[k]], |trial| trial.predicted(k));
            Player { x, y, h: p.h[k], mass: p.mass[k], row: k as u32, sign: 1.0, counts: true }
        }));
        let of_wall = |k: usize, limit: u32| {
            let [dx, dy] = walls.displacement(k, offset);
            let along = match &drift {
                Some(drift) if limits.side[k] => drift[limit as usize],
                _ => [0.0; 2],
            };
            let (x, y) = (walls.x[k] + dx + along[0], walls.y[k] + dy + along[1]);
            let mass = self.wall_mass.get(k).copied().unwrap_or(0.0);
            Player { x, y, h: walls.h[k], mass, row: n as u32 + limit, sign: 1.0, counts: true }
        };
        for (l, &wall) in limits.walls.iter().enumerate() {
            cast.players.push(of_wall(wall as usize, l as u32));
        }
        cast.rows = cast.players.len();
        for k in 0..limits.of_wall.len() {
            if let Some(limit) = limits.of_wall[k].filter(|&l| limits.walls[l as usize] as usize != k) {
                cast.players.push(of_wall(k, limit));
            }
        }
        cast.own = cast.players.len();
        cast.repeat(0, system.domain.mirror);
        let kernel = system.domain.fluid.kernel;
        if trial.is_some() {
            let from = cast.players.len();
            cast.reflect(&self.reflections); //   LE25
            cast.repeat(from, system.domain.mirror);
            self.there.find(cast, kernel);
        } else {
            self.here.find(cast, kernel);
        }
    }

    /// LE21: where each limit particle's column is taken by the water beside it, along gravity [m].
    fn drift_of_sides(&self, system: &ParticleSystem, trial: &Trial) -> Vec<[f64; 2]> {
        let (n, up) = (system.particles.len(), system.domain.up());
        let mut drift = vec![[0.0; 2]; self.limits.walls.len()];
        if !self.settings.side_freedom {
            return drift;
        }
        for (l, drift) in drift.iter_mut().enumerate() {
            let (mut weight, mut sum) = (0.0, 0.0);
            for pair in self.here.of(n + l) {
                if (pair.j as usize) < n {
                    let v = trial.velocity[pair.j as usize];
                    weight += pair.w;
                    sum += pair.w * (v[0] * up[0] + v[1] * up[1]);
                }
            }
            if weight > 0.0 {
                *drift = up.map(|c| trial.dt * sum / weight * c);
            }
        }
        drift
    }
}
