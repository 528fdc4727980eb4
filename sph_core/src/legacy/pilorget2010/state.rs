//! State of the thesis's projection: what is found once, at the start, who stands where at a step's beginning, and where a trial
//! takes the particles (THEORY LE18–LE21, LE23, LE25, LE26, LE28).

use crate::error::Breakdown;
use crate::legacy::pilorget2010::cast::{Cast, Pairs, Player, Reflection};
use crate::legacy::pilorget2010::limit::Limits;
use crate::legacy::pilorget2010::settings::{MassRule, ThesisSettings};
use crate::legacy::pilorget2010::sums::*;
use crate::particles::Particles;
use crate::system::ParticleSystem;
use crate::walls::Walls;
use crate::wcsph::eos::Tait;

/// What the thesis's projection keeps from step to step, and what it counts.
#[derive(Clone, Debug, Default)]
pub struct Thesis {
    /// Its settings.
    pub settings: ThesisSettings,
    pub(crate) eos: Tait,
    pub(crate) limits: Limits,
    /// Masses of the wall particles [kg/m]; 0 for those that play no part.
    pub wall_mass: Vec<f64>,
    /// ρ₀ − Σ m W at the start [kg/m³] (LE19), by identity.
    pub(crate) deficit: Vec<f64>,
    /// The same of the limit particles.
    pub(crate) limit_deficit: Vec<f64>,
    /// ∇·r inside [-] (LE23).
    pub(crate) inside: f64,
    /// Gradient correction inside [-] (LE26).
    pub(crate) correction: f64,
    /// Particles now (r_n) and predicted (r*).
    pub(crate) cast: Cast,
    pub(crate) here: Pairs,
    pub(crate) there: Pairs,
    pub(crate) density: Vec<f64>,
    pub(crate) at_surface: Vec<bool>,
    pub(crate) reflections: Vec<Reflection>,
    /// Iterations of all solutions.
    pub iterations: u64,
    /// Solutions, one a pass of the inner loop.
    pub solutions: u64,
    /// Largest |ρ* − ρ₀|/ρ₀ that the last step's inner loop left [-] (LE27).
    pub density_error: f64,
}

impl Thesis {
    /// Masses, stored deficits and the measures of the inside, once (LE18, LE19, LE28, LE23).
    pub(crate) fn prepare(&mut self, system: &mut ParticleSystem, walls: &Walls) -> Result<(), Breakdown> {
        let limits = Limits::sort(system, walls);
        let mut thesis = Thesis { settings: self.settings, eos: self.eos, limits, ..Thesis::default() };
        thesis.assign(system, walls, 0.0, None);
        let (n, rho0, up) = (system.particles.len(), system.domain.fluid.density, system.domain.up());
        let interior = middle_particle(&system.particles);
        match self.settings.masses {
            MassRule::Interior => masses_of_interior(&mut thesis.cast, &thesis.here, interior, rho0), // LE18
            MassRule::Inverse => masses_of_inverse(&mut thesis.cast, system.domain.fluid.kernel, rho0)?, // LE28
        }
        let players = &thesis.cast.players;
        for k in 0..n {
            system.particles.mass[k] = players[k].mass;
            system.fields.volume[k] = players[k].mass / rho0;
        }
        thesis.wall_mass = vec![0.0; walls.len()];
        let limits = &thesis.limits;
        let dummies =
            (0..walls.len()).filter(|&k| limits.of_wall[k].is_some_and(|l| limits.walls[l as usize] as usize != k));
        let in_order = limits.walls.iter().map(|&w| w as usize).chain(dummies);
        for (wall, player) in in_order.zip(&players[n..thesis.cast.own]) {
            thesis.wall_mass[wall] = player.mass;
        }
        thesis.assign(system, walls, 0.0, None);
        let deficit = |i: usize| rho0 - density_sum(&thesis.cast, &thesis.here, i); // LE19
        thesis.deficit = vec![0.0; n];
        for k in 0..n {
            thesis.deficit[system.particles.id[k] as usize] = deficit(k);
        }
        thesis.limit_deficit = (n..thesis.cast.rows).map(deficit).collect();
        thesis.inside = divergence_of_place(&thesis.cast, &thesis.here, interior, rho0);
        thesis.correction = gradient_correction(&thesis.here, interior, up);
        thesis.density = vec![rho0; thesis.cast.rows];
        *self = thesis;
        Ok(())
    }

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

/// A particle in the middle of the water: that nearest to its centroid.
fn middle_particle(p: &Particles) -> usize {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len().max(1) as f64;
    let (x, y) = (mean(&p.x), mean(&p.y));
    let away = |k: usize| (p.x[k] - x).powi(2) + (p.y[k] - y).powi(2);
    (0..p.len()).min_by(|&a, &b| away(a).total_cmp(&away(b))).unwrap_or(0)
}

/// Motion of one step before it is taken: r_n, v_n and the velocity found so far.
pub(crate) struct Trial {
    pub from: Vec<[f64; 2]>,
    pub before: Vec<[f64; 2]>,
    pub velocity: Vec<[f64; 2]>,
    pub dt: f64,
}

impl Trial {
    /// r* = r_n + v* Δt.
    pub fn predicted(&self, k: usize) -> [f64; 2] {
        [0, 1].map(|axis| self.from[k][axis] + self.dt * self.velocity[k][axis])
    }

    /// The same particles where they are.
    pub fn standing(&self) -> Trial {
        let (from, before) = (self.from.clone(), self.before.clone());
        Trial { velocity: vec![[0.0; 2]; from.len()], from, before, dt: self.dt }
    }

    /// v ← v + `time` a.
    pub fn kick(&mut self, a: &[[f64; 2]], time: f64) {
        for (v, a) in self.velocity.iter_mut().zip(a) {
            *v = [0, 1].map(|axis| v[axis] + time * a[axis]);
        }
    }
}
