//! The weakly compressible scheme with the options of 2010 (THEORY LE3–LE14, LE15–LE17).

use crate::domain::Domain;
use crate::forces::interface_dynamics::solve_interfaces;
use crate::forces::wall_state::{extrapolate_to_walls, set_wall_state};
use crate::forces::{Forces, PairTerms, gather_fluid_forces, gather_wall_forces};
use crate::interactions::geometry::PairConstants;
use crate::interactions::pair::Extrapolated;
use crate::legacy::density_filter::smooth_density;
use crate::legacy::dynamic_walls::{DynamicWalls, OwnVelocityRate};
use crate::legacy::ideal_gas::{IdealGas, gas_state, heating_rates};
use crate::legacy::mirror_point::read_mirror_points;
use crate::legacy::multistep::{History, Rates};
use crate::legacy::repulsive::{Repulsion, repel};
use crate::legacy::settings::*;
use crate::legacy::summation::sum_density;
use crate::legacy::turbulence::add_eddy_forces;
use crate::legacy::xsph::drift_with_neighbours;
use crate::parallel;
use crate::scheme::Flow;
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;
use crate::wcsph::Wcsph;
use crate::wcsph::shifting::even_out;
use crate::wcsph::step_limit::rebuild_lists;

/// The weakly compressible scheme with the options of 2010, and their state.
#[derive(Clone)]
pub struct Compressible {
    /// The scheme without them.
    pub base: Wcsph,
    /// The options.
    pub options: Options,
    /// The gas, if the fluid is one (LE11).
    pub(crate) gas: Option<IdealGas>,
    pub(crate) history: History,
    /// de/dt [W/kg] (LE12); empty for water.
    pub(crate) heating: Vec<f64>,
    pub(crate) dynamic_walls: DynamicWalls,
}

impl Compressible {
    /// The scheme for a domain.
    pub fn new(domain: &Domain, settings: &Settings) -> Compressible {
        let mut base = Wcsph::new(domain, settings.scheme);
        base.settings.cfl = settings.courant_number().into();
        Compressible {
            base,
            options: settings.options,
            gas: settings.gas(domain),
            history: History::default(),
            heating: Vec::new(),
            dynamic_walls: DynamicWalls::default(),
        }
    }

    /// Speed of sound at particle `k` [m/s]: c₀, and more in a gas hotter than at rest.
    pub(crate) fn sound_speed(&self, system: &ParticleSystem, k: usize) -> f64 {
        let c0 = self.base.eos.c0;
        self.gas.map_or(c0, |gas| gas.sound_speed(system.particles.energy[k]).max(c0))
    }

    pub(crate) fn rates(&self) -> Rates<'_> {
        Rates { density: &self.base.density_rate, energy: &self.heating }
    }

    /// Make the lists if they no longer hold, splitting particles first where that is asked for (WC21); then pack.
    pub(crate) fn pack(&self, system: &mut ParticleSystem, walls: &Walls, offset: f64) {
        if !system.place_walls(walls, offset, self.options.walls == WallModel::MirrorPoint) {
            self.base.refine(system);
            rebuild_lists(system, walls, self.base.settings.courant_number(), |system, k| self.sound_speed(system, k));
        }
        system.pack(walls);
    }

    /// WC3 + WC4, or LE14; LE16.
    pub(crate) fn evaluate_density_rate(&mut self, system: &mut ParticleSystem, walls: &Walls, offset: f64) {
        self.pack(system, walls, offset);
        let constants = self.base.constants(system);
        let constants = match self.options.density_diffusion_form {
            DiffusionForm::Fourtakas => constants,
            DiffusionForm::Molteni => PairConstants { gravity: [0.0; 2], ..constants },
        };
        self.base.gather_density_rate(system, constants, self.options.walls.reflects());
        if self.options.walls == WallModel::Dynamic {
            self.evaluate_dynamic_walls(system);
        }
    }

    /// LE16: the walls' own velocities compress the fluid, and the fluid compresses the walls.
    fn evaluate_dynamic_walls(&mut self, system: &ParticleSystem) {
        let (fluid, walls, search) = (&system.packed.fluid, &system.packed.walls, &system.neighbours);
        let (kernel, rho) = (system.domain.fluid.kernel, &system.particles.rho);
        let mut beside_walls = vec![0.0; rho.len()];
        let lists = &search.walls_of_fluid;
        kernel.gather(&OwnVelocityRate { targets: fluid, rho, others: walls, lists }, &mut beside_walls);
        for (rate, beside_walls) in self.base.density_rate.iter_mut().zip(&beside_walls) {
            *rate += beside_walls;
        }
        let DynamicWalls { rho, rate, .. } = &mut self.dynamic_walls;
        let lists = &search.fluid_of_wall;
        kernel.gather(&OwnVelocityRate { targets: walls, rho, others: fluid, lists }, rate);
    }

    /// LE16: dynamic walls start at the pressure of the water beside them, or at none.
    pub(crate) fn start_dynamic_walls(&mut self, system: &mut ParticleSystem, walls: &mut Walls) {
        if self.options.walls != WallModel::Dynamic {
            return;
        }
        if self.options.limit_pressure == 1 {
            self.equation_of_state(system);
            self.pack(system, walls, 0.0);
            extrapolate_to_walls(system, walls);
        }
        self.dynamic_walls.start(&walls.pressure, self.base.eos);
    }

    /// LE16: pressures of the walls from their densities; they show the fluid their own velocity.
    fn state_of_dynamic_walls(&mut self, system: &mut ParticleSystem, walls: &mut Walls) {
        system.timers.begin(Phase::Walls);
        let found = self.dynamic_walls.pressures(self.base.eos).enumerate();
        system.wall_state.clear();
        system
            .wall_state
            .extend(found.map(|(k, pressure)| Extrapolated { pressure, velocity: [walls.u[k], walls.v[k]] }));
        set_wall_state(system, walls);
    }

    /// LE12: de/dt with the packed particles that the density rate was found with.
    pub(crate) fn evaluate_heating(&mut self, system: &ParticleSystem) {
        if let Some(gas) = self.gas {
            let terms = self.base.terms(system);
            heating_rates(system, &terms, gas, &self.base.density_rate, &mut self.heating);
        }
    }

    /// WC2, or LE11.
    fn equation_of_state(&self, system: &mut ParticleSystem) {
        match self.gas {
            None => self.base.equation_of_state(system),
            Some(gas) => gas_state(system, gas, self.base.settings.ventilation),
        }
    }

    /// WC2, WA3, WC5–WC7, LE10: pressures, wall pressures, accelerations, forces on walls.
    pub(crate) fn evaluate_forces(&mut self, flow: &mut Flow<'_>, offset: f64) {
        let Flow { system, walls, interfaces } = flow;
        self.equation_of_state(system);
        self.pack(system, walls, offset);
        match self.options.walls {
            WallModel::Extrapolated | WallModel::Repulsive => extrapolate_to_walls(system, walls),
            WallModel::MirrorPoint => read_mirror_points(system, walls),
            WallModel::Dynamic => self.state_of_dynamic_walls(system, walls),
        }
        let mut forces = Forces::in_place_of_accelerations(&mut system.particles);
        let (terms, has_pressure): (PairTerms, _) = (self.base.terms(system), self.options.walls.has_pressure());
        gather_fluid_forces(system, &terms, has_pressure, &mut forces);
        match has_pressure {
            true => gather_wall_forces(system, &terms, walls),
            false => repel(system, self.repulsion(system), walls, &mut forces),
        }
        if self.options.turbulence == Turbulence::Sps {
            add_eddy_forces(system, &mut forces);
        }
        if !interfaces.is_empty() && self.options.walls == WallModel::Extrapolated {
            solve_interfaces(system, walls, interfaces, &mut forces, offset);
        }
        forces.accelerate(system);
    }

    /// The law of repulsive walls (LE15).
    fn repulsion(&self, system: &ParticleSystem) -> Repulsion {
        let (eos, water_depth) = (self.base.eos, self.options.water_depth);
        let heavy = system.domain.gravity != [0.0; 2];
        Repulsion { rho0: eos.rho0, c0: eos.c0, ratio: system.domain.fluid.smoothing_ratio, water_depth, heavy }
    }

    /// LE13: densities from masses, where that is chosen.
    pub(crate) fn sum_density(&self, system: &mut ParticleSystem, walls: &Walls, offset: f64) {
        if self.options.density_evolution == DensityEvolution::Summation {
            self.pack(system, walls, offset);
            sum_density(system);
        }
    }

    /// LE6, LE7: smooth the densities, if a filter is chosen and this step is one of its own.
    pub(crate) fn filter_density(&self, system: &mut ParticleSystem, walls: &Walls) {
        let due = (system.steps + 1).is_multiple_of(u64::from(self.options.density_filter_every.max(1)));
        if self.options.density_filter != DensityFilter::None && due {
            self.pack(system, walls, 0.0);
            smooth_density(system, self.options.density_filter == DensityFilter::Mls, self.gas.map(|gas| gas.gamma));
        }
    }

    /// WC10, LE8.
    pub(crate) fn shift(&self, system: &mut ParticleSystem, dt: f64) {
        if self.base.settings.shifting {
            even_out(system, &self.base.settings, dt);
        }
        if self.options.xsph != 0.0 {
            drift_with_neighbours(system, self.options.xsph, dt);
        }
    }

    /// ρ ← ρ + Δt dρ/dt, of fluid and dynamic walls.
    pub(crate) fn advance_density(&mut self, system: &mut ParticleSystem, dt: f64) {
        system.timers.begin(Phase::Integration);
        parallel::each([&mut system.particles.rho], |at, [rho]| {
            let rate = &self.base.density_rate[at];
            for k in 0..rate.len() {
                rho[k] += dt * rate[k];
            }
        });
        self.dynamic_walls.advance_density(dt);
    }

    /// e ← e + Δt de/dt.
    pub(crate) fn advance_energy(&self, system: &mut ParticleSystem, dt: f64) {
        for (e, rate) in system.particles.energy.iter_mut().zip(&self.heating) {
            *e += dt * rate;
        }
    }

    /// e ← e (2 + η)/(2 − η), η = Δt (de/dt)/e with the rate at the step's middle: of second order, since (de/dt)/e of a gas
    /// depends on its motion alone.
    pub(crate) fn advance_energy_midpoint(&self, system: &mut ParticleSystem, dt: f64) {
        for (e, rate) in system.particles.energy.iter_mut().zip(&self.heating) {
            let growth = dt * rate / *e;
            *e *= (2.0 + growth) / (2.0 - growth);
        }
    }
}
