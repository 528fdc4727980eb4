//! The projection of Pilorget's (2010) thesis, with its choices (THEORY LE18–LE28).
//!
//! Read in this order: `advance`, [`settings`], `state`, `limit` (walls), `sums`, `poisson`; `cast` holds the particles of a
//! step and their pairs.

mod advance;
mod cast;
mod limit;
mod poisson;
pub mod settings;
mod state;
mod sums;

use crate::domain::Domain;
use crate::error::Breakdown;
use crate::forces::interface_dynamics::accelerate_by_pairs;
use crate::forces::{Forces, PairTerms, gather_fluid_forces, gather_wall_forces};
use crate::interactions::geometry::PairConstants;
use crate::parallel;
use crate::particles::Seed;
use crate::scheme::{Flow, Scheme, SchemeSettings};
use crate::state_bytes::{StateError, decode, encode};
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;
use crate::wcsph::eos::Tait;
use crate::wcsph::is_weakly_compressed;
use crate::wcsph::step_limit::rebuild_lists;

pub use settings::{FlowSettings, ThesisSettings};
pub use state::Thesis;

/// Share of √(h/(|g| + |a|)) a step may take: with 0.1 water at rest begins to churn after 20 s, with 0.07 not (LE27).
const FORCE: f64 = 0.05;
/// Share of h²/ν a step may take (WC12).
const VISCOUS: f64 = 0.125;
/// ν of artificial viscosity over α h c₀ (WC6; Monaghan 2005).
const ARTIFICIAL: f64 = 0.125;
/// A step this many times smaller than that of water at rest means breakdown.
const COLLAPSE: f64 = 1e-3;
/// Where nothing moves and nothing weighs: this many acoustic steps.
const AT_LEISURE: f64 = 5.0;

impl Thesis {
    /// The scheme for a domain.
    pub fn new(domain: &Domain, settings: ThesisSettings) -> Thesis {
        // the law by which the speed of sound and the elastic energy of density errors are found
        let c0 = settings.flow.sound_speed.or(10.0 * domain.fastest_speed);
        Thesis { settings, eos: Tait { rho0: domain.fluid.density, c0, gamma: 7.0 }, ..Thesis::default() }
    }

    fn terms(&self, system: &ParticleSystem) -> PairTerms {
        let settings::FlowSettings { artificial_viscosity: alpha, dissipation, .. } = self.settings.flow;
        PairTerms { constants: PairConstants { c0: self.eos.c0, alpha, ..system.constants() }, dissipation }
    }

    fn pack(&self, system: &mut ParticleSystem, walls: &Walls, offset: f64) {
        if !system.place_walls(walls, offset, false) {
            rebuild_lists(system, walls, self.settings.flow.cfl, |_, _| self.eos.c0);
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

impl Scheme for Thesis {
    fn initialise(&mut self, flow: &mut Flow<'_>) -> Result<(), Breakdown> {
        self.pack(flow.system, flow.walls, 0.0);
        accelerate_by_pairs(flow, &self.terms(flow.system), None, 0.0);
        self.prepare(flow.system, flow.walls)
    }

    fn step(&mut self, Flow { system, walls, .. }: &mut Flow<'_>, dt: f64) -> Result<(), Breakdown> {
        self.pack(system, walls, -dt); //             neighbours at r_n
        let mut forces = Forces::in_place_of_accelerations(&mut system.particles);
        self.gather_viscosity(system, walls, &mut forces);
        system.timers.begin(Phase::Pressure);
        let trial = self.predict(system, &forces, dt);
        (system.particles.ax, system.particles.ay) = (forces.x, forces.y); // to be written again
        self.advance(system, walls, trial)
    }

    /// LE27: Δt ≤ ½ C Δx/|v|, 1/20 √(h/(|g| + |a|)), ⅛ h²/(ν + ⅛ α h c₀) [s].
    fn stable_dt(&self, system: &ParticleSystem, walls: &Walls) -> Result<f64, Breakdown> {
        let (FlowSettings { cfl, artificial_viscosity, .. }, c0) = (self.settings.flow, self.eos.c0);
        let (p, domain) = (&system.particles, &system.domain);
        let (ratio, nu) = (domain.fluid.smoothing_ratio, domain.fluid.kinematic_viscosity);
        let g = domain.gravity[0].hypot(domain.gravity[1]);
        let limit = |h: f64, speed: f64, acceleration: f64| {
            let moving = 0.5 * cfl * h / ratio / speed;
            moving
                .min(FORCE * (h / (g + acceleration)).sqrt())
                .min(VISCOUS * h * h / (nu + ARTIFICIAL * artificial_viscosity * h * c0))
        };
        let of_fluid = |k: usize| limit(p.h[k], p.u[k].hypot(p.v[k]), p.ax[k].hypot(p.ay[k]));
        let of_wall = |k: usize| limit(walls.h[k], walls.u[k].hypot(walls.v[k]), walls.ax[k].hypot(walls.ay[k]));
        let dt = parallel::least(p.len(), of_fluid).min(parallel::least(walls.len(), of_wall));
        let leisure = AT_LEISURE * cfl * system.least_smoothing_length() / c0;
        let dt = if g > 0.0 { dt } else { dt.min(leisure) };
        let at_rest = parallel::least(p.len(), |k| limit(p.h[k], 0.0, 0.0));
        if p.is_empty() || !at_rest.is_finite() || dt > COLLAPSE * at_rest {
            return Ok(dt);
        }
        let k = (0..p.len()).min_by(|&a, &b| of_fluid(a).total_cmp(&of_fluid(b))).unwrap_or(0);
        Err(system.collapsed(k, dt))
    }

    fn check(&self, system: &ParticleSystem) -> Result<(), Breakdown> {
        let (rho, rho0) = (&system.particles.rho, self.eos.rho0);
        system.check(|k| is_weakly_compressed(rho[k], rho0))
    }

    fn checkpoint(&self) -> Box<dyn Scheme> {
        Box::new(self.clone())
    }

    /// What it counts: the rest is found at the start, or in each step.
    fn to_bytes(&self) -> Vec<u8> {
        encode(&(self.iterations, self.solutions, self.density_error))
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        (self.iterations, self.solutions, self.density_error) = decode("the thesis's projection", bytes)?;
        Ok(())
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
