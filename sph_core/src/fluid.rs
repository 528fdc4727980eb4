//! The fluid: its state, its step, and the verbs that the integrators are written in.

use crate::checkpoint::{Saved, set_lists_aside};
use crate::error::Breakdown;
use crate::interactions::gather::{DensityRate, Forces, Momentum, WallForce};
use crate::interactions::packed::Rows;
use crate::interactions::pair::Extrapolated;
use crate::legacy::dynamic_walls::DynamicWalls;
use crate::legacy::ideal_gas::Heat;
use crate::legacy::integrator::{self, Integrator, Old};
use crate::legacy::multistep::{self, History};
use crate::legacy::pilorget2010::{self, Thesis};
use crate::legacy::turbulence::Stress;
use crate::legacy::wall_model::WallModel;
use crate::neighbours::Search;
use crate::parallel;
use crate::parameters::Parameters;
use crate::particles::refinement::FineZone;
use crate::particles::{Derived, Particles, Seed};
use crate::projection::{self, Projection};
use crate::solver::Solver;
use crate::timers::{Phase, Phases};
use crate::walls::Walls;
use crate::walls::interface::Yielding;

/// A weakly compressible fluid.
pub struct Fluid {
    /// What does not change.
    pub parameters: Parameters,
    /// What a restart needs.
    pub particles: Particles,
    /// What a step recomputes.
    pub derived: Derived,
    /// Time [s].
    pub time: f64,
    /// Steps taken.
    pub steps: u64,
    /// Particles moved, over all steps.
    pub updates: u64,
    /// Neighbour lists.
    pub search: Search,
    /// Owners of walls whose acceleration is found together with their pressures (THEORY C2); the others' is given.
    pub yielding: Vec<Yielding>,
    /// Where water that is too coarse is split when the lists are made anew (THEORY E26); `None` leaves it as it is. For
    /// [`Solver::WeaklyCompressible`] with [`Integrator::Symplectic`], which keep nothing by identity from step to step.
    pub fine_zone: Option<FineZone>,
    pub(crate) rows: Rows,
    pub(crate) old: Old,
    /// dρ/dt [kg/(m³ s)], from its sweep until the equation of state, in the array that pressures have otherwise.
    pub(crate) density_rate: Vec<f64>,
    pub(crate) history: History,
    pub(crate) heating: Vec<f64>,
    pub(crate) heat: Vec<Heat>,
    pub(crate) excess_velocity: Vec<[f64; 2]>,
    pub(crate) stress: Vec<Stress>,
    pub(crate) extrapolated: Vec<Extrapolated>,
    pub(crate) wall_force: Vec<[f64; 2]>,
    pub(crate) scratch: Vec<f64>,
    pub(crate) dynamic_walls: DynamicWalls,
    pub(crate) saved: Vec<Saved>,
    /// Where each particle began the step, by identity; empty without screens (T5).
    pub(crate) beginning: Vec<[f64; 2]>,
    /// A particle was put elsewhere: lists are to be made anew.
    pub(crate) displaced: bool,
    /// The projection (THEORY I1–I16).
    pub projection: Projection,
    /// The thesis's projection (THEORY J1–J16).
    pub thesis: Thesis,
    /// Where the time goes.
    pub phases: Phases,
}

/// Steps that a neighbour list is made to last.
const LIST_LIFE: f64 = 12.0;
/// The same of a projection's, in which fast particles go far.
const LONG_LIFE: f64 = 2.5;

impl Fluid {
    /// A fluid from seeds; densities follow from the seeds' pressures. Panics on a period that is too short for the
    /// kernel, or combined with a mirror (V1): both are errors of the caller, not of its data.
    pub fn new(parameters: Parameters, seeds: &[Seed]) -> Fluid {
        if let Some(periodic) = parameters.periodic {
            let two_supports =
                4.0 * parameters.smoothing_ratio * seeds.iter().map(|s| s.area).fold(0.0, f64::max).sqrt();
            assert!(parameters.mirror.is_none(), "a mirror and a period do not go together");
            assert!(
                periodic.shortest() > two_supports,
                "a period of {} m needs to exceed two supports, {two_supports} m",
                periodic.shortest()
            );
        }
        let mut particles = Particles::with_capacity(seeds.len());
        for seed in seeds {
            let still = if parameters.solver.is_incompressible() { 0.0 } else { seed.pressure };
            let (rho, energy) = parameters.state_at(still);
            particles.push(seed, rho, energy, parameters.smoothing_ratio);
        }
        let mut fluid = Fluid {
            parameters,
            particles,
            derived: Derived::default(),
            time: 0.0,
            steps: 0,
            updates: 0,
            search: Search::default(),
            yielding: Vec::new(),
            fine_zone: None,
            rows: Rows::default(),
            old: Old::default(),
            density_rate: Vec::new(),
            extrapolated: Vec::new(),
            wall_force: Vec::new(),
            history: History::default(),
            heating: Vec::new(),
            heat: Vec::new(),
            excess_velocity: Vec::new(),
            stress: Vec::new(),
            scratch: Vec::new(),
            dynamic_walls: DynamicWalls::default(),
            saved: Vec::new(),
            beginning: Vec::new(),
            displaced: false,
            projection: Projection::default(),
            thesis: Thesis::default(),
            phases: Phases::default(),
        };
        let n = fluid.particles.len();
        fluid.derived.resize(n);
        if parameters.solver.is_incompressible() {
            fluid.derived.pressure = seeds.iter().map(|seed| seed.pressure).collect();
            fluid.derived.volume = seeds.iter().map(|seed| seed.area).collect();
        }
        if !parameters.keeps_volumes() {
            (fluid.particles.theta, fluid.derived.volume) = (Vec::new(), Vec::new());
        }
        if parameters.gas.is_none() {
            fluid.particles.energy = Vec::new();
        }
        fluid
    }

    /// How near air is, 1 beside it and 0 far from it [-], per particle: the projection's (THEORY I5), empty without one.
    pub fn exposure(&self) -> &[f64] {
        &self.projection.air.exposure
    }

    /// Forces at the start: once, when the walls stand where they start. Panics on a period with screens (T1), an error of
    /// the caller.
    pub fn initialise(&mut self, walls: &mut Walls) -> Result<(), Breakdown> {
        let unbounded = self.parameters.periodic.is_none();
        assert!(unbounded || walls.screens.is_empty(), "a period and screens do not go together");
        if self.parameters.solver.is_incompressible() {
            self.pack(walls, 0.0);
            self.extrapolate_to_walls(walls);
            self.gather_forces(walls);
            self.yield_walls(walls, 0.0);
            self.accelerate();
            if self.parameters.solver == Solver::IncompressibleThesis {
                self.prepare_thesis(walls)?;
            }
            return self.check();
        }
        self.sum_density(walls, 0.0);
        self.start_dynamic_walls(walls);
        self.evaluate_forces(walls, 0.0);
        self.search.flag_surface(&mut self.derived);
        self.settle(walls);
        walls.mean_fx.clone_from(&walls.fx);
        walls.mean_fy.clone_from(&walls.fy);
        self.check()
    }

    /// Advance by `dt` [s]. Before: the walls' kinematics are those of the step's end. After: the walls
    /// carry the force now and the mean force of the step.
    pub fn step(&mut self, walls: &mut Walls, dt: f64) -> Result<(), Breakdown> {
        walls.dt = dt;
        let outer = self.phases.begin(Phase::Integration);
        self.note_beginning(walls);
        parallel::within_pool(|| match self.parameters.solver {
            Solver::WeaklyCompressible => {
                self.integrate(walls, dt);
                Ok(())
            }
            Solver::Incompressible | Solver::IncompressibleExplicit => projection::step(self, walls, dt),
            Solver::IncompressibleThesis => pilorget2010::step(self, walls, dt),
        })?;
        self.fold();
        self.time += dt;
        self.steps += 1;
        self.updates += self.particles.len() as u64;
        let sound = self.check();
        self.phases.go_on_with(outer);
        sound
    }

    fn integrate(&mut self, walls: &mut Walls, dt: f64) {
        match self.parameters.integrator {
            Integrator::Symplectic => integrator::symplectic(self, walls, dt),
            Integrator::PredictorCorrector => integrator::predictor_corrector(self, walls, dt),
            Integrator::Verlet => multistep::verlet(self, walls, dt),
            Integrator::Beeman => multistep::beeman(self, walls, dt),
        }
    }

    /// Whoever crossed the plane of symmetry changes places with its image.
    fn fold(&mut self) {
        let (Some(mirror), p) = (self.parameters.mirror, &mut self.particles) else { return };
        for k in 0..p.x.len() {
            if p.x[k] < mirror.at {
                p.x[k] = mirror.reflect(p.x[k]);
                (p.u[k], p.ax[k]) = (-p.u[k], -p.ax[k]);
                self.history.reflect(p.id[k]);
            }
        }
    }

    /// E4 + E5: dρ/dt at the present positions, walls taken `offset` seconds from the step's end.
    pub(crate) fn evaluate_density_rate(&mut self, walls: &Walls, offset: f64) {
        self.pack(walls, offset);
        self.phases.begin(Phase::Density);
        self.density_rate = std::mem::take(&mut self.derived.pressure); // of no use until they follow from new densities
        let gather = DensityRate {
            fluid: &self.rows.fluid,
            faces: &self.rows.faces,
            rho: &self.particles.rho,
            search: &self.search,
            constants: self.parameters.diffusion_constants(),
            reflecting: self.parameters.walls.model.reflects(),
        };
        self.parameters.sweep(&gather, &mut self.density_rate[..]);
        if self.parameters.walls.model == WallModel::Dynamic {
            self.evaluate_dynamic_walls();
        }
    }

    /// E3, E9, E6–E8: pressures, wall pressures, accelerations, forces on walls; walls taken `offset`
    /// seconds from the step's end.
    pub(crate) fn evaluate_forces(&mut self, walls: &mut Walls, offset: f64) {
        self.equation_of_state();
        self.pack(walls, offset);
        match self.parameters.walls.model {
            WallModel::Extrapolated | WallModel::Repulsive => self.extrapolate_to_walls(walls),
            WallModel::MirrorPoint => self.read_mirror_points(walls),
            WallModel::Dynamic => self.state_of_dynamic_walls(walls),
        }
        self.gather_forces(walls);
        self.gather_turbulence(); //                 L8
        self.yield_walls(walls, offset); //          C1–C3: where owners of walls yield
        self.accelerate();
        self.relax_volumes();
    }

    /// The same pairs twice, once for each side: action equals reaction to rounding. Until [`Fluid::accelerate`] the
    /// particles' accelerations are forces [N/m].
    pub(crate) fn gather_forces(&mut self, walls: &mut Walls) {
        let wall_nu = self.parameters.wall_nu();
        let constants = match self.parameters.solver.projects() {
            true => self.constants_of_projection(),
            false => self.parameters.constants(),
        };
        let (fluid, wall_rows, search) = (&self.rows.fluid, &self.rows.walls, &self.search);
        let pushing = self.parameters.walls.model.has_pressure();
        let gather = Momentum { fluid, walls: wall_rows, search, constants, wall_nu, pushing };
        self.phases.begin(Phase::Momentum);
        let Particles { ax, ay, .. } = &mut self.particles;
        self.parameters.sweep(&gather, Forces { x: ax, y: ay, around: &mut self.derived.surroundings });
        self.phases.begin(Phase::Walls);
        self.wall_force.resize(walls.len(), [0.0; 2]);
        if pushing {
            let gather = WallForce { fluid, walls: wall_rows, search, constants, wall_nu };
            self.parameters.sweep_walls(&gather, &mut self.wall_force[..]);
        } else {
            self.repel();
        }
        for (k, force) in self.wall_force.iter().enumerate() {
            [walls.fx[k], walls.fy[k]] = *force;
        }
    }

    /// Make the lists if they no longer hold, then pack what the sweeps read.
    pub(crate) fn pack(&mut self, walls: &Walls, offset: f64) {
        self.phases.begin(Phase::Search);
        self.rows.place_walls(walls, offset);
        let Parameters { mirror, periodic, .. } = self.parameters;
        if self.parameters.walls.model == WallModel::MirrorPoint || self.parameters.solver.projects() {
            self.rows.place_mirror_points(walls);
        }
        if self.displaced || !self.search.holds(&self.particles, &self.rows.kinematics(walls)) {
            self.displaced = false;
            self.refine(); //                        E26
            let life = match self.parameters.solver.projects() {
                true => LONG_LIFE * self.projection_dt(walls),
                false => LIST_LIFE * self.acoustic_limit(),
            };
            set_lists_aside(&mut self.saved, &mut self.search);
            let kinematics = self.rows.kinematics(walls);
            self.search.rebuild(&mut self.particles, &mut self.derived, &kinematics, mirror, periodic, life);
        }
        self.phases.begin(Phase::Pack);
        self.rows.pack(&self.particles, &self.derived, walls, &self.search, mirror, &self.extrapolated);
    }
}
