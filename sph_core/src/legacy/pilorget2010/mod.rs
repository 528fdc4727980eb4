//! The projection of Pilorget's (2010) thesis, with its choices (THEORY LE18–LE28).
//!
//! Read in this order: `advance`, [`settings`], `prepare` (once), `mass`, `limit` (walls), `surface`, `poisson`, `bicgstab`,
//! `gradient`; `stage`, `cast` and `pairs` hold the particles of a step and their pairs.

mod advance;
mod bicgstab;
mod cast;
mod gradient;
mod limit;
mod mass;
mod pairs;
mod poisson;
mod prepare;
pub mod settings;
mod stage;
mod state;
mod step_limit;
mod surface;

use crate::domain::Domain;
use crate::error::Breakdown;
use crate::interactions::forces::{Forces, PairTerms, gather_fluid_forces, gather_wall_forces};
use crate::interactions::geometry::PairConstants;
use crate::particles::Seed;
use crate::projection;
use crate::scheme::{Scheme, SchemeSettings};
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;
use crate::walls::interface::WallInterface;
use crate::wcsph::eos::Tait;
use crate::wcsph::is_weakly_compressed;
use crate::wcsph::step_limit::acoustic_limit;

pub use settings::ThesisSettings;
pub use state::Thesis;

/// Steps that a neighbour list is made to last.
const LIST_LIFE: f64 = 12.0;

impl Thesis {
    /// The scheme for a domain.
    pub fn new(domain: &Domain, settings: ThesisSettings) -> Thesis {
        Thesis { settings, eos: equation_of_state(domain, &settings), ..Thesis::default() }
    }

    fn terms(&self, system: &ParticleSystem) -> PairTerms {
        let settings::FlowSettings { artificial_viscosity: alpha, dissipation, .. } = self.settings.flow;
        PairTerms { constants: PairConstants { c0: self.eos.c0, alpha, ..system.constants() }, dissipation }
    }

    fn pack(&self, system: &mut ParticleSystem, walls: &Walls, offset: f64) {
        if !system.place_walls(walls, offset, false) {
            let life = LIST_LIFE * acoustic_limit(system, self.settings.flow.cfl, |_| self.eos.c0);
            system.rebuild_lists(walls, life);
        }
        system.pack(walls);
    }

    /// The viscous part of the pair forces (WC6, WC7), on fluid and walls.
    fn gather_viscosity(&self, system: &mut ParticleSystem, walls: &mut Walls, forces: &mut Forces) {
        let packed = &mut system.packed;
        packed.fluid.iter_mut().chain(&mut packed.walls).for_each(|particle| particle.p = 0.0);
        let terms = self.terms(system);
        gather_fluid_forces(system, &terms, true, forces);
        gather_wall_forces(system, &terms, walls);
    }
}

/// The law by which the speed of sound and the elastic energy of its density errors are found.
fn equation_of_state(domain: &Domain, settings: &ThesisSettings) -> Tait {
    let c0 = settings.flow.sound_speed.or(10.0 * domain.fastest_speed);
    Tait { rho0: domain.fluid.density, c0, gamma: 7.0 }
}

impl Scheme for Thesis {
    fn initialise(
        &mut self,
        system: &mut ParticleSystem,
        walls: &mut Walls,
        interfaces: &mut [WallInterface],
    ) -> Result<(), Breakdown> {
        self.pack(system, walls, 0.0);
        projection::start(system, walls, interfaces, &self.terms(system));
        self.prepare(system, walls)
    }

    fn step(
        &mut self,
        system: &mut ParticleSystem,
        walls: &mut Walls,
        _: &mut [WallInterface],
        dt: f64,
    ) -> Result<(), Breakdown> {
        self.pack(system, walls, -dt); //             neighbours at r_n
        let mut forces = Forces::in_place_of_accelerations(&mut system.particles);
        self.gather_viscosity(system, walls, &mut forces);
        system.timers.begin(Phase::Pressure);
        let trial = self.predict(system, &forces, dt);
        (system.particles.ax, system.particles.ay) = (forces.x, forces.y); // to be written anew
        self.advance(system, walls, trial)
    }

    fn stable_dt(&self, system: &ParticleSystem, walls: &Walls) -> Result<f64, Breakdown> {
        step_limit::stable_dt(system, walls, &self.settings.flow, self.eos.c0)
    }

    fn check(&self, system: &ParticleSystem) -> Result<(), Breakdown> {
        let (rho, rho0) = (&system.particles.rho, self.eos.rho0);
        system.check(|k| is_weakly_compressed(rho[k], rho0))
    }

    fn checkpoint(&self) -> Box<dyn Scheme> {
        Box::new(self.clone())
    }

    fn internal_energy(&self, system: &ParticleSystem, k: usize) -> f64 {
        self.eos.energy(system.particles.rho[k])
    }

    fn force_is_constant_in_step(&self) -> bool {
        true
    }
}

impl SchemeSettings for ThesisSettings {
    fn scheme(&self, domain: &Domain) -> Box<dyn Scheme> {
        Box::new(Thesis::new(domain, *self))
    }

    fn state(&self, domain: &Domain, _: &Seed) -> (f64, Option<f64>) {
        (domain.fluid.density, None)
    }

    fn keeps_volumes(&self) -> bool {
        true
    }
}
