//! The weakly compressible scheme (THEORY WC2–WC12, WA3–WA5): pressures follow from densities by Tait's law, and run through the water as
//! sound.
//!
//! Read in this order: `Wcsph::advance`, [`settings`](Settings), [`eos`], `updates`, `shifting`, `step_limit`; then `choice`, which takes
//! `split_explicit` (WC22) instead where a step has several acoustic steps, as for rigid wedges.

mod choice;
pub mod eos;
mod rest;
mod settings;
pub(crate) mod shifting;
mod split_explicit;
pub(crate) mod step_limit;
pub(crate) mod updates;

use eos::Tait;
use rest::{hold_at_rest, release_all, release_drifted};
use shifting::{even_out, settle};
use step_limit::{StepLimit, rebuild_lists};
use updates::{advance_density_and_drift, kick, kick_and_drift};

use crate::domain::Domain;
use crate::error::Breakdown;
use crate::forces::PairTerms;
use crate::forces::interface_dynamics::accelerate_by_pairs;
use crate::forces::still_pressure::StillPressure;
use crate::interactions::gather::{DensityRate, PairSums};
use crate::interactions::geometry::PairConstants;
use crate::memory::of_vector;
use crate::parallel;
use crate::particles::KernelMoments;
use crate::refinement::refine;
use crate::scheme::{Flow, Scheme};
use crate::state_bytes::{StateError, expect_count};
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;

pub use settings::Settings;

/// Largest |ρ/ρ₀ − 1| at which the equation of state has a meaning.
const LARGEST_STRAIN: f64 = 0.3;

/// The weakly compressible scheme with its own state.
#[derive(Clone, Debug)]
pub struct Wcsph {
    /// Its settings; they may change between steps.
    pub settings: Settings,
    /// Equation of state.
    pub(crate) eos: Tait,
    /// dρ/dt [kg/(m³ s)].
    pub(crate) density_rate: Vec<f64>,
}

/// WC2 with its bounds: water is never thinner than at the cavitation pressure, tensionless water than at rest.
#[derive(Clone, Copy)]
pub(crate) struct PressureLaw {
    eos: Tait,
    /// Density at the cavitation pressure [kg/m³].
    least: f64,
    ventilation: bool,
}

impl PressureLaw {
    /// The density [kg/m³] within its bounds, and the pressure [Pa].
    #[inline(always)]
    pub fn state(&self, rho: f64, moments: &KernelMoments, near_surface: bool) -> [f64; 2] {
        let tensionless = moments.tensionless(near_surface, self.ventilation);
        let least = if tensionless { self.eos.rho0 } else { self.least };
        let rho = if rho < least { least } else { rho };
        [rho, self.eos.pressure(rho)]
    }
}

impl Wcsph {
    /// The scheme for a domain.
    pub(crate) fn new(domain: &Domain, settings: Settings) -> Wcsph {
        Wcsph { settings, eos: settings.equation_of_state(domain), density_rate: Vec::new() }
    }

    /// WC11: one step, kick–drift–kick with the density advanced about the midpoint; of second order.
    fn advance(&mut self, flow: &mut Flow<'_>, dt: f64) {
        let half = 0.5 * dt;
        kick_and_drift(flow.system, half); //                             v½ = v + ½Δt a, x½ = x + ½Δt v½
        self.evaluate_density_rate(flow, -half); //                       dρ/dt at (x½, v½)
        advance_density_and_drift(flow.system, &self.density_rate, dt); // ρ' = ρ (2 + ε)/(2 − ε), ε = Δt (dρ/dt)/ρ; x' = x½ + ½Δt v½
        if self.settings.shifting {
            even_out(flow.system, &self.settings, dt); //                  x' ← x' + δr
        }
        flow.walls.start_mean_force(dt); //                               ½F, where the walls were at the start
        let still = self.evaluate_forces(flow, 0.0); //                   a', F' at (x', ρ')
        if let Some(still) = still {
            flow.system.particles.released -= dt * still.power(flow.system, flow.walls, &self.density_rate); // WC29
        }
        kick(flow.system, half); //                                       v' = v½ + ½Δt a'
        flow.walls.finish_mean_force(); //                                F̄ = ½(F + F')
    }

    /// WC3 + WC4: dρ/dt at the present positions, walls taken `offset` seconds from the step's end.
    fn evaluate_density_rate(&mut self, flow: &mut Flow<'_>, offset: f64) {
        self.pack(flow.system, flow.walls, offset);
        self.gather_density_rate(flow.system, self.constants(flow.system), true);
    }

    /// WC2, WA3, WC5–WC7: pressures, wall pressures, accelerations, forces on walls; walls taken `offset` seconds from the step's end.
    fn evaluate_forces(&mut self, flow: &mut Flow<'_>, offset: f64) -> Option<StillPressure> {
        self.equation_of_state(flow.system);
        self.pack(flow.system, flow.walls, offset);
        let still = self.settings.still_pressure.then(|| StillPressure::find(flow.system, flow.walls)).flatten(); // WC29
        accelerate_by_pairs(flow, &self.terms(flow.system), still, offset);
        still
    }

    /// Make the lists if they no longer hold, splitting particles first where that is asked for (WC21); then pack.
    fn pack(&self, system: &mut ParticleSystem, walls: &Walls, offset: f64) {
        if !system.place_walls(walls, offset, false) {
            self.refine(system);
            rebuild_lists(system, walls, self.settings.courant_number(), |_, _| self.eos.c0);
        }
        system.pack(walls);
    }

    /// WC28, WC21: release particles that have drifted; split those inside the refinement zone, if there is one.
    pub(crate) fn refine(&self, system: &mut ParticleSystem) {
        release_drifted(&mut system.particles);
        let ParticleSystem { refinement_zone, particles, fields, neighbours, domain, .. } = system;
        if let Some(zone) = refinement_zone {
            let Tait { rho0, c0, .. } = self.eos;
            refine(zone, particles, fields, neighbours, domain.gravity, (rho0, c0), |rho| self.eos.pressure(rho));
        }
    }

    /// The density rates with given constants; `walls_reflect`: behind walls the fluid moves with the reflected velocity (WA4).
    pub(crate) fn gather_density_rate(
        &mut self,
        system: &mut ParticleSystem,
        constants: PairConstants,
        walls_reflect: bool,
    ) {
        system.timers.begin(Phase::Density);
        self.density_rate.resize(system.particles.len(), 0.0);
        let gather = DensityRate {
            fluid: &system.packed.fluid,
            packed_walls: &system.packed.packed_walls,
            rho: &system.particles.rho,
            neighbours: &system.neighbours,
            constants,
            walls_reflect,
        };
        PairSums::with(&system.domain, self.settings.dissipation).run(&gather, &mut self.density_rate[..]);
    }

    /// WC2: pressures from densities.
    pub(crate) fn equation_of_state(&self, system: &mut ParticleSystem) {
        system.timers.begin(Phase::Integration);
        let law = self.pressure_law();
        let (p, fields) = (&mut system.particles, &mut system.fields);
        let (moments, near_surface) = (&fields.moments, &fields.near_surface);
        parallel::each([&mut p.rho, &mut fields.pressure], |at, [rho, pressure]| {
            let (moments, near_surface) = (&moments[at.clone()], &near_surface[at]);
            for k in 0..moments.len() {
                [rho[k], pressure[k]] = law.state(rho[k], &moments[k], near_surface[k]);
            }
        });
    }

    /// The equation of state with its bounds.
    pub(crate) fn pressure_law(&self) -> PressureLaw {
        let Settings { cavitation_pressure, ventilation, .. } = self.settings;
        let least = cavitation_pressure.map_or(f64::NEG_INFINITY, |pressure| self.eos.density(pressure));
        PressureLaw { eos: self.eos, least, ventilation }
    }

    /// Constants of the pairs.
    pub(crate) fn constants(&self, system: &ParticleSystem) -> PairConstants {
        let Settings { density_diffusion: delta, artificial_viscosity: alpha, wall_stretch, .. } = self.settings;
        let stretch = f64::from(u8::from(wall_stretch));
        PairConstants { c0: self.eos.c0, delta, alpha, stretch, ..system.constants() }
    }

    pub(crate) fn terms(&self, system: &ParticleSystem) -> PairTerms {
        PairTerms { constants: self.constants(system), dissipation: self.settings.dissipation }
    }
}

impl Scheme for Wcsph {
    fn initialise(&mut self, flow: &mut Flow<'_>) -> Result<(), Breakdown> {
        let settling = self.settings.shifting.then_some(self.settings.settling);
        release_all(flow.system);
        if self.settings.still_pressure {
            self.evaluate_forces(flow, 0.0); // finds the surface
        }
        settle(flow, settling, |flow| {
            self.evaluate_forces(flow, 0.0);
        });
        hold_at_rest(flow.system, flow.walls);
        Ok(())
    }

    fn step(&mut self, flow: &mut Flow<'_>, dt: f64) -> Result<(), Breakdown> {
        self.advance(flow, dt);
        Ok(())
    }

    fn stable_dt(&self, system: &ParticleSystem, walls: &Walls) -> Result<f64, Breakdown> {
        StepLimit { cfl: self.settings.courant_number(), c0: self.eos.c0 }.stable_dt(system, walls, |_| self.eos.c0)
    }

    fn check(&self, system: &ParticleSystem) -> Result<(), Breakdown> {
        let (rho, rho0) = (&system.particles.rho, self.eos.rho0);
        system.check(|k| is_weakly_compressed(rho[k], rho0))
    }

    fn checkpoint(&self) -> Box<dyn Scheme> {
        Box::new(self.clone())
    }

    /// Nothing: a step finds the density rates before it reads them.
    fn to_bytes(&self) -> Vec<u8> {
        Vec::new()
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        expect_count("bytes of the weakly compressible scheme", bytes.len(), 0)
    }

    fn external_force_varies(&self) -> bool {
        self.settings.still_pressure
    }

    fn internal_energy(&self, system: &ParticleSystem, k: usize) -> f64 {
        self.eos.energy(system.particles.rho[k])
    }

    fn bytes(&self) -> usize {
        of_vector(&self.density_rate)
    }
}

/// A density at which the equation of state has a meaning.
pub(crate) fn is_weakly_compressed(rho: f64, rho0: f64) -> bool {
    (rho / rho0 - 1.0).abs() < LARGEST_STRAIN
}
