//! What is found once, where everybody starts: masses, stored lacks, the measures of the inside (THEORY J1–J3, J7, J9).

use crate::error::Breakdown;
use crate::fluid::Fluid;
use crate::walls::Walls;

use super::{Thesis, gradient, mass, surface};
use crate::legacy::pilorget2010::limit::Limits;
use crate::legacy::pilorget2010::settings::MassRule;

impl Fluid {
    /// Masses, stored lacks and the measures of the inside, once (J1–J3, J7).
    pub(crate) fn prepare_thesis(&mut self, walls: &Walls) -> Result<(), Breakdown> {
        let mut thesis = Thesis { limits: Limits::sort(self, walls), ..Thesis::default() };
        thesis.assign(self, walls, 0.0, None);
        let (n, rho0, up) = (self.particles.len(), self.parameters.eos.rho0, self.up());
        let interior = self.middle_particle();
        match self.parameters.thesis.masses {
            MassRule::Interior => mass::of_interior(&mut thesis.cast, &thesis.here, interior, rho0), // J1
            MassRule::Inverse => mass::of_inverse(&mut thesis.cast, self.parameters.kernel, rho0)?,  //  J3
        }
        let players = &thesis.cast.players;
        for k in 0..n {
            self.particles.mass[k] = players[k].mass;
            self.derived.volume[k] = players[k].mass / rho0;
        }
        thesis.wall_mass = vec![0.0; walls.len()];
        let limits = &thesis.limits;
        let dummies =
            (0..walls.len()).filter(|&k| limits.of_wall[k].is_some_and(|l| limits.walls[l as usize] as usize != k));
        let in_order = limits.walls.iter().map(|&w| w as usize).chain(dummies);
        for (wall, player) in in_order.zip(&players[n..thesis.cast.own]) {
            thesis.wall_mass[wall] = player.mass;
        }
        thesis.assign(self, walls, 0.0, None);
        let lack = |i: usize| rho0 - mass::density_sum(&thesis.cast, &thesis.here, i); // J2
        thesis.lack = vec![0.0; n];
        for k in 0..n {
            thesis.lack[self.particles.id[k] as usize] = lack(k);
        }
        thesis.limit_lack = (n..thesis.cast.rows).map(lack).collect();
        thesis.inside = surface::divergence_of_place(&thesis.cast, &thesis.here, interior, rho0);
        thesis.correction = gradient::correction(&thesis.here, interior, up);
        thesis.density = vec![rho0; thesis.cast.rows];
        self.thesis = thesis;
        Ok(())
    }

    /// A particle in the middle of the water: that nearest to its centroid.
    fn middle_particle(&self) -> usize {
        let p = &self.particles;
        let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len().max(1) as f64;
        let (x, y) = (mean(&p.x), mean(&p.y));
        let away = |k: usize| (p.x[k] - x).powi(2) + (p.y[k] - y).powi(2);
        (0..p.len()).min_by(|&a, &b| away(a).total_cmp(&away(b))).unwrap_or(0)
    }
}
