//! [`Compressible`] as a scheme.

use crate::domain::Domain;
use crate::error::Breakdown;
use crate::legacy::compressible::Compressible;
use crate::legacy::settings::Settings;
use crate::legacy::steps::Step;
use crate::legacy::wall_model::WallModel;
use crate::memory::of_vector;
use crate::particles::Seed;
use crate::scheme::{Scheme, SchemeSettings};
use crate::system::ParticleSystem;
use crate::walls::interface::WallInterface;
use crate::walls::{WallLayout, Walls};
use crate::wcsph::shifting::settle;
use crate::wcsph::step_limit::StepLimit;
use crate::wcsph::{Wcsph, is_weakly_compressed};

impl Scheme for Compressible {
    fn initialise(
        &mut self,
        system: &mut ParticleSystem,
        walls: &mut Walls,
        interfaces: &mut [WallInterface],
    ) -> Result<(), Breakdown> {
        self.sum_density(system, walls, 0.0);
        self.start_dynamic_walls(system, walls);
        self.evaluate_forces(system, walls, interfaces, 0.0);
        system.neighbours.flag_surface(&mut system.fields);
        if self.base.settings.shifting {
            settle(system, self.base.settings.settling, |system| self.evaluate_forces(system, walls, interfaces, 0.0));
        }
        walls.set_mean_force();
        Ok(())
    }

    fn step(
        &mut self,
        system: &mut ParticleSystem,
        walls: &mut Walls,
        interfaces: &mut [WallInterface],
        dt: f64,
    ) -> Result<(), Breakdown> {
        Step { scheme: self, system, walls, interfaces, dt }.take();
        Ok(())
    }

    fn stable_dt(&self, system: &ParticleSystem, walls: &Walls) -> Result<f64, Breakdown> {
        let (cfl, c0) = (self.base.settings.courant_number(), self.base.eos.c0);
        StepLimit { cfl, c0, nu: system.domain.fluid.kinematic_viscosity }
            .stable_dt(system, walls, |k| self.sound_speed(system, k))
    }

    fn check(&self, system: &ParticleSystem) -> Result<(), Breakdown> {
        let (p, rho0) = (&system.particles, self.base.eos.rho0);
        let gas = self.gas.is_some();
        system.check(|k| is_weakly_compressed(p.rho[k], rho0) || gas && p.rho[k] > 0.0 && p.energy[k] > 0.0)
    }

    fn checkpoint(&self) -> Box<dyn Scheme> {
        Box::new(self.clone())
    }

    fn reflected(&mut self, id: u32) {
        self.history.reflect(id);
    }

    fn internal_energy(&self, system: &ParticleSystem, k: usize) -> f64 {
        let p = &system.particles;
        match self.gas {
            None => self.base.eos.energy(p.rho[k]),
            Some(gas) => gas.energy_over_rest(p.rho[k], p.energy[k]),
        }
    }

    fn bytes(&self) -> usize {
        of_vector(&self.base.density_rate) + of_vector(&self.heating)
    }
}

impl SchemeSettings for Settings {
    /// The default scheme where every option is neutral.
    fn scheme(&self, domain: &Domain) -> Box<dyn Scheme> {
        match self.options.is_neutral() {
            true => Box::new(Wcsph::new(domain, self.scheme)),
            false => Box::new(Compressible::new(domain, self)),
        }
    }

    fn state(&self, domain: &Domain, seed: &Seed) -> (f64, Option<f64>) {
        match self.gas(domain) {
            None => self.scheme.state(domain, seed),
            Some(gas) => (gas.density(seed.pressure, gas.energy_at_rest()), Some(gas.energy_at_rest())),
        }
    }

    fn wall_layout(&self, domain: &Domain) -> WallLayout {
        match self.options.walls {
            WallModel::Extrapolated | WallModel::MirrorPoint => {
                WallLayout::filling_support(domain.fluid.smoothing_ratio)
            }
            WallModel::Dynamic => WallLayout { layers: 2, staggered: true },
            WallModel::Repulsive => WallLayout { layers: 1, staggered: false },
        }
    }
}
