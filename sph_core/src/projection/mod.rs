//! The incompressible scheme: a projection per step (THEORY PR2–PR14). Pressures are those that leave the water's volume as it is.
//!
//! Read in this order: `Projection::advance`, `operators` (sums and links over pairs), `free_surface::detection`, `pressure` (the equation; its
//! rows: `linear_solver::cluster_matrix`), `linear_solver::cg`, `forces`, `motion`; `monolithic` couples bodies.

mod forces;
mod free_surface;
mod lattice;
mod linear_pressure;
mod linear_solver;
mod monolithic;
mod motion;
mod operators;
mod pair_clusters;
mod pressure;
mod settings;

use forces::PressureForces;
use free_surface::detection::SurfaceDetection;
use lattice::Lattice;
use linear_pressure::LinearPressure;
use motion::{StepLimit, move_particles};
use operators::Operators;
use pressure::PressureEquation;

use crate::domain::Domain;
use crate::error::Breakdown;
use crate::forces::PairTerms;
use crate::forces::interface_dynamics::accelerate_by_pairs;
use crate::interactions::geometry::PairConstants;
use crate::neighbours::SKIN;
use crate::particles::Seed;
use crate::scheme::{Flow, Scheme, SchemeSettings};
use crate::state_bytes::{StateError, decode, encode};
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;

pub use settings::{FlowSettings, Method, Settings};

/// Steps that a neighbour list is made to last: few, since fast particles move far in each.
const LIST_LIFE: f64 = 2.5;

/// The projection with its own state.
#[derive(Clone, Debug)]
pub struct Projection {
    /// Its settings; they may change between steps.
    pub settings: Settings,
    lattice: Lattice,
    surface: SurfaceDetection,
    operators: Operators,
    equation: PressureEquation,
    linear_pressure: LinearPressure,
    forces: PressureForces,
    /// Kernel sum Σ V W that each particle keeps [-], by identity (PR9).
    reference_kernel_sum: Vec<f64>,
    /// The last step [s].
    last_dt: f64,
}

impl Projection {
    /// The scheme for a domain.
    pub(crate) fn new(domain: &Domain, settings: Settings) -> Projection {
        Projection {
            settings,
            lattice: Lattice::new(domain.fluid.kernel, domain.fluid.smoothing_ratio),
            surface: SurfaceDetection::default(),
            operators: Operators::default(),
            equation: PressureEquation::default(),
            linear_pressure: LinearPressure::default(),
            forces: PressureForces::default(),
            reference_kernel_sum: Vec::new(),
            last_dt: 0.0,
        }
    }

    /// PR2: one step.
    fn advance(&mut self, flow: &mut Flow<'_>, dt: f64) -> Result<(), Breakdown> {
        let constants = self.constants(flow.system);
        self.pack(flow.system, flow.walls, -dt); //                                  neighbours at r
        flow.system.timers.begin(Phase::Density);
        self.surface.detect(flow.system, flow.walls); //                             holes between particles (PR5)
        self.surface.mark_dry_walls(flow.system, flow.walls); //                     walls without water (PR5)
        self.operators.assemble(flow.system, flow.walls, &self.lattice, constants, dt); // C, ∇C, ∇·u*, A
        self.surface.set_indicator(flow.system, &self.operators, &self.lattice); //  particles near air (PR5)
        self.place_bodies(flow, self.lattice.gradient); //                           closed bodies (PR19)
        self.note_kernel_sums(flow.system);
        self.solve_pressure(flow, dt)?; //                                           (A + s) p = …; a_w with it (CO21)
        let (Flow { system, walls, .. }, air) = (flow, self.surface.indicator());
        self.forces.apply(system, walls, &self.operators, &self.linear_pressure, air, &self.lattice, constants, dt);
        let strength = if self.settings.flow.shifting { self.settings.shift } else { 0.0 };
        move_particles(system, strength, air, dt); //                                u' = u + Δt a, r' = r + Δt u' + δr
        self.last_dt = dt;
        Ok(())
    }

    /// PR7–PR11: (A + s) p = −V ∇·u*/Δt + V (C − 1)/(τ Δt), solved for, or one Jacobi iteration of it (PR15).
    fn solve_pressure(&mut self, Flow { system, walls, interfaces }: &mut Flow<'_>, dt: f64) -> Result<(), Breakdown> {
        let Projection {
            settings, lattice, surface, operators, equation, linear_pressure, reference_kernel_sum, ..
        } = self;
        let air = surface.indicator();
        equation.close_surface(system, operators, air, lattice);
        system.timers.begin(Phase::Pressure);
        equation.gather_source(system, operators, air, lattice, reference_kernel_sum, settings, dt);
        match settings.method {
            Method::OneIteration => equation.relax_once(system, operators, air, settings.flow.ventilation),
            Method::Solve => {
                equation.solve(system, walls, interfaces, linear_pressure, operators, air, lattice, settings)?
            }
        }
        Ok(())
    }

    /// PR19: how the water lies around closed bodies, whose pair forces are divided by `norm`.
    fn place_bodies(&mut self, Flow { system, walls, .. }: &Flow<'_>, norm: f64) {
        let (air, still) = (self.surface.indicator(), (self.forces.head(), &self.lattice));
        self.linear_pressure.place(system, walls, air, still, 1.0 / norm);
    }

    /// Make the lists if they no longer hold, then pack.
    fn pack(&mut self, system: &mut ParticleSystem, walls: &Walls, offset: f64) {
        if !system.place_walls(walls, offset, true) {
            system.rebuild_lists(walls, LIST_LIFE * self.step_limit().dt(system, walls), SKIN);
        }
        system.pack(walls);
    }

    /// PR9: at the first step, the kernel sum that each particle keeps: where spacings grow, a lattice at rest does not have that of
    /// a uniform one to the last per cent.
    fn note_kernel_sums(&mut self, system: &ParticleSystem) {
        if system.steps > 0 {
            return;
        }
        let (around, lattice) = (&self.operators.around, self.lattice);
        self.reference_kernel_sum.resize(system.particles.len(), 0.0);
        for (moments, &id) in around.iter().zip(&system.particles.id) {
            let graded = moments.lambda > 0.9 && (moments.kernel_sum - lattice.kernel_sum).abs() < 0.1;
            self.reference_kernel_sum[id as usize] = if graded { moments.kernel_sum } else { lattice.kernel_sum };
        }
    }

    fn step_limit(&self) -> StepLimit {
        StepLimit { cfl: self.settings.courant_number(), last_dt: self.last_dt }
    }

    /// PR13: WC6 with √(|g| h) instead of c₀.
    fn constants(&self, system: &ParticleSystem) -> PairConstants {
        let g = system.domain.gravity;
        let c0 = (g[0].hypot(g[1]) * system.least_smoothing_length()).sqrt();
        PairConstants { c0, alpha: 8.0 * self.settings.viscosity_coefficient, ..system.constants() }
    }

    /// Iterations of all pressure solves.
    pub fn iterations(&self) -> u64 {
        self.equation.iterations
    }

    /// Pressure solves.
    pub fn solves(&self) -> u64 {
        self.equation.solves
    }

    /// Rows held at p = 0 by the unilateral condition, in the last step (PR8).
    pub fn constrained_rows(&self) -> usize {
        self.equation.constrained_rows()
    }
}

impl Scheme for Projection {
    fn initialise(&mut self, flow: &mut Flow<'_>) -> Result<(), Breakdown> {
        let constants = self.constants(flow.system);
        self.pack(flow.system, flow.walls, 0.0);
        self.surface.detect(flow.system, flow.walls);
        self.operators.assemble(flow.system, flow.walls, &self.lattice, constants, 0.0);
        self.surface.set_indicator(flow.system, &self.operators, &self.lattice);
        self.forces.find_head(flow.system);
        accelerate_by_pairs(flow, &PairTerms { constants, dissipation: Default::default() }, None, 0.0);
        self.place_bodies(flow, 1.0);
        self.linear_pressure.correct_bodies(flow.walls, 0.0);
        Ok(())
    }

    fn step(&mut self, flow: &mut Flow<'_>, dt: f64) -> Result<(), Breakdown> {
        self.advance(flow, dt)
    }

    fn stable_dt(&self, system: &ParticleSystem, walls: &Walls) -> Result<f64, Breakdown> {
        self.step_limit().stable_dt(system, walls)
    }

    fn check(&self, system: &ParticleSystem) -> Result<(), Breakdown> {
        system.check(|_| true)
    }

    fn checkpoint(&self) -> Box<dyn Scheme> {
        Box::new(self.clone())
    }

    fn to_bytes(&self) -> Vec<u8> {
        encode(&(&self.equation, &self.reference_kernel_sum, self.forces.head(), self.last_dt))
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        let (equation, sums, head, last_dt): (PressureEquation, Vec<f64>, f64, f64) =
            decode("the incompressible scheme", bytes)?;
        (self.equation, self.reference_kernel_sum, self.last_dt) = (equation, sums, last_dt);
        self.equation.complete();
        self.forces.set_head(head);
        Ok(())
    }

    fn force_is_constant_in_step(&self) -> bool {
        true
    }

    fn face_kernel_sum(&self) -> Option<[f64; 2]> {
        Some(self.lattice.face)
    }

    fn surface_indicator(&self) -> &[f64] {
        self.surface.indicator()
    }
}

impl SchemeSettings for Settings {
    fn scheme(&self, domain: &Domain) -> Box<dyn Scheme> {
        Box::new(Projection::new(domain, *self))
    }

    fn state(&self, domain: &Domain, _: &Seed) -> (f64, Option<f64>) {
        (domain.fluid.density, None)
    }

    fn keeps_volumes(&self) -> bool {
        true
    }
}
