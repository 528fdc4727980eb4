//! What is found once, at the start: masses, stored density deficits, the measures of the inside (THEORY LE18, LE19, LE28, LE23, LE26).

use crate::error::Breakdown;
use crate::legacy::pilorget2010::limit::Limits;
use crate::legacy::pilorget2010::settings::MassRule;
use crate::legacy::pilorget2010::state::Thesis;
use crate::legacy::pilorget2010::{gradient, mass, surface};
use crate::particles::Particles;
use crate::system::ParticleSystem;
use crate::walls::Walls;

impl Thesis {
    /// Masses, stored deficits and the measures of the inside, once (LE18, LE19, LE28, LE23).
    pub(crate) fn prepare(&mut self, system: &mut ParticleSystem, walls: &Walls) -> Result<(), Breakdown> {
        let limits = Limits::sort(system, walls);
        let mut thesis = Thesis { settings: self.settings, eos: self.eos, limits, ..Thesis::default() };
        thesis.assign(system, walls, 0.0, None);
        let (n, rho0, up) = (system.particles.len(), system.domain.fluid.density, system.domain.up());
        let interior = middle_particle(&system.particles);
        match self.settings.masses {
            MassRule::Interior => mass::of_interior(&mut thesis.cast, &thesis.here, interior, rho0), // LE18
            MassRule::Inverse => mass::of_inverse(&mut thesis.cast, system.domain.fluid.kernel, rho0)?, // LE28
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
        let deficit = |i: usize| rho0 - mass::density_sum(&thesis.cast, &thesis.here, i); // LE19
        thesis.deficit = vec![0.0; n];
        for k in 0..n {
            thesis.deficit[system.particles.id[k] as usize] = deficit(k);
        }
        thesis.limit_deficit = (n..thesis.cast.rows).map(deficit).collect();
        thesis.inside = surface::divergence_of_place(&thesis.cast, &thesis.here, interior, rho0);
        thesis.correction = gradient::correction(&thesis.here, interior, up);
        thesis.density = vec![rho0; thesis.cast.rows];
        *self = thesis;
        Ok(())
    }
}

/// A particle in the middle of the water: that nearest to its centroid.
fn middle_particle(p: &Particles) -> usize {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len().max(1) as f64;
    let (x, y) = (mean(&p.x), mean(&p.y));
    let away = |k: usize| (p.x[k] - x).powi(2) + (p.y[k] - y).powi(2);
    (0..p.len()).min_by(|&a, &b| away(a).total_cmp(&away(b))).unwrap_or(0)
}
