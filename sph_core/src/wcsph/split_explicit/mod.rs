//! The split-explicit step (THEORY WC22–WC24): pair geometry is held over an advective step of several acoustic steps.
//!
//! Sound crosses a particle in a fraction of the time in which its neighbours move. Lists, kernel moments, shifting and viscosity
//! are found once per advective step; each acoustic step is two sparse products with the weights held. Atmospheric models split
//! sound from flow likewise (Klemp & Wilhelmson 1978, Wicker & Skamarock 2002).
//!
//! Read in this order: `SplitExplicit::advance`, `SplitExplicit::hold_geometry`, `advective`, `hold`, `held_pairs`, `held_walls`.

mod advective;
mod entry_index;
mod held_pairs;
mod held_walls;
mod hold;

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::domain::Domain;
use crate::error::Breakdown;
use crate::interactions::dissipation::{DiffusivePair, Dissipation, PairDissipation, RiemannPair};
use crate::interactions::forces::{Forces, PairTerms, gather_fluid_forces, gather_wall_forces};
use crate::interactions::geometry::PairConstants;
use crate::memory::of_vector;
use crate::parallel;
use crate::scheme::{Flow, Scheme};
use crate::state_bytes::{StateError, decode, encode};
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;
use crate::walls::interface_dynamics::solve_owners;
use crate::walls::state::extrapolate_to_walls;

use super::shifting::even_out_once;
use super::step_limit::rebuild_lists;
use super::updates::{advance_density_midpoint, drift, kick};
use super::{Settings, Wcsph};

use advective::AdvectiveStep;
use held_pairs::{HeldPairs, Row};
use held_walls::HeldWalls;
use hold::hold;

/// The weakly compressible scheme in split-explicit steps, with its own state.
#[derive(Clone, Debug)]
pub struct SplitExplicit {
    /// Equation of state, settings and terms.
    base: Wcsph,
    advective: AdvectiveStep,
    /// Shared with the states saved since it was held.
    held: Arc<HeldGeometry>,
    /// What neighbours show, of particles and of their images.
    rows: Vec<Row>,
}

/// What is held over an advective step.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct HeldGeometry {
    pairs: HeldPairs,
    walls: HeldWalls,
    /// Viscous forces on the fluid [N/m].
    viscous: [Vec<f64>; 2],
    /// Viscous forces on the walls [N/m].
    viscous_on_walls: [Vec<f64>; 2],
}

impl HeldGeometry {
    /// WC6, WC7 and the kernel moments, of packed particles without pressures.
    fn viscous_forces(&mut self, system: &mut ParticleSystem, walls: &mut Walls, terms: &PairTerms) {
        let at_start = [walls.fx.clone(), walls.fy.clone()];
        let mut on_fluid = Forces { x: vec![0.0; system.particles.len()], y: vec![0.0; system.particles.len()] };
        gather_fluid_forces(system, terms, true, &mut on_fluid);
        gather_wall_forces(system, terms, walls);
        self.viscous = [on_fluid.x, on_fluid.y];
        self.viscous_on_walls = [walls.fx.clone(), walls.fy.clone()];
        [walls.fx, walls.fy] = at_start;
    }
}

impl SplitExplicit {
    /// The scheme for a domain.
    pub fn new(domain: &Domain, settings: Settings) -> SplitExplicit {
        SplitExplicit {
            base: Wcsph::new(domain, settings),
            advective: AdvectiveStep::default(),
            held: Arc::default(),
            rows: Vec::new(),
        }
    }

    /// Its settings; they may change between steps.
    pub fn settings_mut(&mut self) -> &mut Settings {
        &mut self.base.settings
    }

    /// WC22: one acoustic step, kick–drift–kick as WC11, with the geometry held.
    fn advance(&mut self, flow: &mut Flow<'_>, dt: f64) {
        if self.advective.is_over(dt) {
            self.begin_advective_step(flow, dt);
        }
        let half = 0.5 * dt;
        kick(flow.system, half); //                                       v½ = v + ½δt a
        self.evaluate_density_rate(flow); //                              dρ/dt of (v½, p), geometry held
        let rate = &self.base.density_rate;
        advance_density_midpoint(flow.system, rate, dt); //               ρ' = ρ (2 + ε)/(2 − ε), ε = δt (dρ/dt)/ρ
        drift(flow.system, dt); //                                        x' = x + δt v½
        flow.walls.start_mean_force(dt); //                               ½F, where the walls were at the start
        self.evaluate_forces(flow); //                                    a', F' of p(ρ'), geometry held
        kick(flow.system, half); //                                       v' = v½ + ½δt a'
        flow.walls.finish_mean_force(); //                                F̄ = ½(F + F')
        self.advective.elapse(dt);
    }

    /// WC23: shift for the advective step that ended, choose the length of the next, and hold the geometry of its middle; the walls'
    /// kinematics are those of the end of its first acoustic step `dt` [s].
    fn begin_advective_step(&mut self, flow: &mut Flow<'_>, dt: f64) {
        let settings = self.base.settings;
        let length = self.longest_advective_step(flow);
        if settings.shifting {
            even_out_once(flow.system, &settings, self.advective.elapsed(), self.advective.steps());
        }
        flow.system.fold(|_| {});
        self.advective = AdvectiveStep::of(dt, length, settings.acoustic_steps);
        self.hold_geometry(flow, 0.5 * self.advective.length(), dt);
    }

    /// WC25: the longest advective step [s] by strain and by background pressure.
    fn longest_advective_step(&mut self, flow: &Flow<'_>) -> f64 {
        let ParticleSystem { particles: p, fields, domain, .. } = &*flow.system;
        if self.rows.len() < p.len() {
            return 0.0; // nothing is held yet
        }
        let strain = self.held.pairs.strain(&self.rows, &p.h, domain.simd);
        let squeeze = parallel::least(p.len(), |k| -fields.pressure[k].max(0.0) / (p.rho[k] * p.h[k] * p.h[k]));
        advective::longest(strain, (-squeeze).sqrt() * domain.fluid.smoothing_ratio)
    }

    /// WC23: hold the geometry as it is predicted to be `ahead` seconds from now; `dt` [s] from now the walls are where their
    /// kinematics say.
    fn hold_geometry(&mut self, flow: &mut Flow<'_>, ahead: f64, dt: f64) {
        let (system, walls) = (&mut *flow.system, &mut *flow.walls);
        self.base.refine(system);
        coast(system, ahead);
        if !system.place_walls(walls, ahead - dt, false) {
            rebuild_lists(system, walls, 0.0, |_, _| self.base.eos.c0);
        }
        system.pack(walls);
        coast(system, -ahead);
        let pressures = walls.pressure.clone();
        extrapolate_to_walls(system, walls); // WA5: velocities; pressures are found in each acoustic step
        walls.pressure = pressures;
        system.packed.clear_pressures();
        let mut held = Arc::get_mut(&mut self.held).map(std::mem::take).unwrap_or_default();
        held.viscous_forces(system, walls, &self.base.terms(system));
        system.timers.begin(Phase::Pack);
        let (constants, d) = (self.base.constants(system), self.base.settings.dissipation);
        let ParticleSystem { packed, neighbours, domain, .. } = &*system;
        hold(&mut held.pairs, (domain.fluid.kernel, d, domain.simd), &packed.fluid, &neighbours.fluid, constants);
        held.walls.hold(system, walls, constants);
        self.held = Arc::new(held);
    }

    /// WC3 + WC4 with the geometry held.
    fn evaluate_density_rate(&mut self, flow: &mut Flow<'_>) {
        let Flow { system, walls, .. } = flow;
        self.show(system);
        system.timers.begin(Phase::Density);
        let diffusion = diffusion_factor(self.base.settings.dissipation, &self.base.constants(system));
        let (p, rate) = (&system.particles, &mut self.base.density_rate);
        rate.resize(p.len(), 0.0);
        self.held.pairs.density_rate(&self.rows, &p.rho, diffusion, system.domain.simd, rate);
        let beside = |w: usize| system.wall_state[w].velocity;
        self.held.walls.add_density_rate(&self.rows, &p.rho, walls, beside, rate);
    }

    /// WC2, WA3, WC5 with the geometry held, and the viscous forces held.
    fn evaluate_forces(&mut self, flow: &mut Flow<'_>) {
        self.base.equation_of_state(flow.system);
        self.show(flow.system);
        let Flow { system, walls, interfaces } = flow;
        self.evaluate_walls(system, walls);
        if !interfaces.is_empty() {
            system.timers.begin(Phase::Coupling);
            let at: Vec<[f64; 2]> = (0..walls.len()).map(|k| [walls.x[k], walls.y[k]]).collect();
            let rho0 = system.domain.fluid.density;
            solve_owners(walls, interfaces, &self.held.walls.sensitivity, |k| at[k], rho0, 0.0); // CO4, CO5
        }
        system.timers.begin(Phase::Momentum);
        let mut forces = Forces::in_place_of_accelerations(&mut system.particles);
        let HeldGeometry { pairs, walls: held_walls, viscous, .. } = &*self.held;
        pairs.pressure_force(&self.rows, system.domain.simd, &mut forces.x, &mut forces.y);
        held_walls.add_pressure_force(&self.rows, &walls.pressure, &mut forces.x, &mut forces.y);
        forces.add_components(viscous);
        forces.accelerate(system);
    }

    /// WA3, WA6: pressures of the walls and forces on them, with the geometry held.
    fn evaluate_walls(&mut self, system: &mut ParticleSystem, walls: &mut Walls) {
        system.timers.begin(Phase::Walls);
        let (g, rho0) = (system.domain.gravity, system.domain.fluid.density);
        let HeldGeometry { walls: held, viscous_on_walls: [vx, vy], .. } = &*self.held;
        for w in 0..walls.len() {
            let p = held.pressure(w, &self.rows, [g[0] - walls.ax[w], g[1] - walls.ay[w]], rho0);
            let [x, y] = held.force(w, &self.rows, p);
            (walls.pressure[w], walls.fx[w], walls.fy[w]) = (p, x + vx[w], y + vy[w]);
            system.wall_state[w].pressure = p;
            if self.base.settings.wall_stretch {
                system.wall_state[w].velocity = held.velocity(w, &self.rows).unwrap_or([walls.u[w], walls.v[w]]);
            }
        }
    }

    /// What the particles and their images show to their neighbours.
    fn show(&mut self, system: &mut ParticleSystem) {
        system.timers.begin(Phase::Pack);
        let ParticleSystem { particles: p, fields, neighbours, .. } = &*system;
        let (n, images) = (p.len(), &neighbours.fluid_images);
        self.rows.resize(n + images.len(), Row::default());
        let (own, of_images) = self.rows.split_at_mut(n);
        parallel::gather_into(own, |k| Row { u: p.u[k], v: p.v[k], p: fields.pressure[k] });
        let side = if neighbours.fluid_shifts.is_empty() { -1.0 } else { 1.0 };
        for (row, &source) in of_images.iter_mut().zip(images) {
            let Row { u, v, p } = own[source as usize];
            *row = Row { u: side * u, v, p };
        }
    }
}

/// x ← x + Δt v + ½Δt² a for Δt of either sign and the present v and a.
fn coast(system: &mut ParticleSystem, dt: f64) {
    let p = &mut system.particles;
    let bend = 0.5 * dt * dt.abs();
    parallel::each([&mut p.x, &mut p.y], |at, [x, y]| {
        let (u, v, ax, ay) = (&p.u[at.clone()], &p.v[at.clone()], &p.ax[at.clone()], &p.ay[at]);
        for k in 0..u.len() {
            x[k] += dt * u[k] + bend * ax[k];
            y[k] += dt * v[k] + bend * ay[k];
        }
    });
}

/// Factor of the diffusion's sum [s/m] (WC4, WC8).
fn diffusion_factor(dissipation: Dissipation, constants: &PairConstants) -> f64 {
    match dissipation {
        Dissipation::Diffusion => DiffusivePair::rate(constants),
        Dissipation::Riemann => RiemannPair::rate(constants),
    }
}

impl Scheme for SplitExplicit {
    fn initialise(&mut self, flow: &mut Flow<'_>) -> Result<(), Breakdown> {
        self.base.initialise(flow)
    }

    fn step(&mut self, flow: &mut Flow<'_>, dt: f64) -> Result<(), Breakdown> {
        self.advance(flow, dt);
        Ok(())
    }

    fn stable_dt(&self, system: &ParticleSystem, walls: &Walls) -> Result<f64, Breakdown> {
        self.base.stable_dt(system, walls)
    }

    fn check(&self, system: &ParticleSystem) -> Result<(), Breakdown> {
        self.base.check(system)
    }

    fn checkpoint(&self) -> Box<dyn Scheme> {
        Box::new(self.clone())
    }

    fn to_bytes(&self) -> Vec<u8> {
        encode(&(&self.advective, &*self.held, &self.rows))
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        let (advective, held, rows) = decode("the split-explicit scheme", bytes)?;
        (self.advective, self.held, self.rows) = (advective, Arc::new(held), rows);
        Ok(())
    }

    fn holds_pairs(&self) -> bool {
        true
    }

    fn internal_energy(&self, system: &ParticleSystem, k: usize) -> f64 {
        self.base.internal_energy(system, k)
    }

    fn bytes(&self) -> usize {
        let HeldGeometry { pairs, walls, viscous: [x, y], viscous_on_walls: [wx, wy] } = &*self.held;
        let vectors = [x, y, wx, wy].map(of_vector).iter().sum::<usize>();
        self.base.bytes() + pairs.bytes() + walls.bytes() + vectors + of_vector(&self.rows)
    }
}
