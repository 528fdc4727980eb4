//! The split-explicit step (THEORY WC22–WC24): pair geometry is held over an advective step of several acoustic steps.
//!
//! Sound crosses a particle in a fraction of the time in which its neighbours move. Lists, kernel moments, shifting and viscosity
//! are found once per advective step; each acoustic step is two sparse products with the weights held. Atmospheric models split
//! sound from flow likewise (Klemp & Wilhelmson 1978, Wicker & Skamarock 2002).
//!
//! Read in this order: `SplitExplicit::advance`, `SplitExplicit::hold_geometry`, `advective`, `acoustic_step`, `held_pairs`, `held_walls`, `hold`, `hold_walls`.

mod acoustic_step;
mod advective;
mod candidates;
mod entry_index;
mod held_pairs;
mod held_walls;
mod hold;
mod hold_walls;
mod shift_gain;

use std::sync::Arc;

use acoustic_step::{Accelerations, Densities};
use advective::AdvectiveStep;
use held_pairs::{HeldPairs, Row};
use held_walls::HeldWalls;
use hold::hold;
use serde::{Deserialize, Serialize};
use shift_gain::shift_gain;

use super::shifting::shifts_in_stages;
use super::{Settings, Wcsph};
use crate::domain::Domain;
use crate::error::Breakdown;
use crate::forces::interface_dynamics::solve_owners;
use crate::forces::wall_state::extrapolate_to_walls;
use crate::forces::{Forces, PairTerms, gather_concentration_gradient, gather_fluid_forces, gather_wall_forces};
use crate::interactions::dissipation::{DiffusivePair, Dissipation, PairDissipation, RiemannPair};
use crate::interactions::geometry::PairConstants;
use crate::memory::of_vector;
use crate::neighbours::Neighbours;
use crate::parallel;
use crate::particles::Fields;
use crate::scheme::{Flow, Scheme};
use crate::state_bytes::{StateError, decode, encode};
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;

/// Advective steps that neighbour lists are made to last.
const LISTS_LAST: f64 = 3.2;
/// Skin of a particle at rest [h]: wide enough for the shifts of newly split particles.
const WIDE_SKIN: f64 = 0.08;

/// The weakly compressible scheme in split-explicit steps, with its own state.
#[derive(Clone, Debug)]
pub struct SplitExplicit {
    /// Equation of state, settings and terms.
    base: Wcsph,
    /// Largest share of h² ∇C by which particles are shifted in an advective step (WC26) [-].
    gain: f64,
    advective: AdvectiveStep,
    /// Shared with the states saved since it was held.
    held: Arc<HeldGeometry>,
    /// What neighbours show, of particles and of their images.
    rows: Vec<Row>,
    /// Pressures of particles and images at the end of the acoustic step [Pa].
    pressure: Vec<f64>,
}

/// What is held over an advective step.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct HeldGeometry {
    pairs: HeldPairs,
    walls: HeldWalls,
    /// Velocities that shift the particles (WC26) [m/s].
    shift_velocity: [Vec<f64>; 2],
    /// Viscous forces on the fluid, and those that keep graded water at rest (WC28) [N/m].
    viscous: [Vec<f64>; 2],
    /// Viscous forces on the walls [N/m].
    viscous_on_walls: [Vec<f64>; 2],
}

impl HeldGeometry {
    /// WC6, WC7, WC28 and the kernel moments, of packed particles without pressures.
    fn viscous_forces(&mut self, system: &mut ParticleSystem, walls: &mut Walls, terms: &PairTerms) {
        let at_start = [walls.fx.clone(), walls.fy.clone()];
        let mut on_fluid = Forces { x: vec![0.0; system.particles.len()], y: vec![0.0; system.particles.len()] };
        gather_fluid_forces(system, terms, true, &mut on_fluid);
        gather_wall_forces(system, terms, walls);
        let p = &system.particles;
        for (force, rest) in [(&mut on_fluid.x, &p.rest[0]), (&mut on_fluid.y, &p.rest[1])] {
            force.iter_mut().zip(rest).zip(&p.mass).for_each(|((force, rest), mass)| *force += mass * rest);
        }
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
            gain: shift_gain(domain.fluid.kernel, domain.fluid.smoothing_ratio),
            advective: AdvectiveStep::default(),
            held: Arc::default(),
            rows: Vec::new(),
            pressure: Vec::new(),
        }
    }

    /// WC22: one acoustic step, kick–drift–kick as WC11, with the geometry held.
    fn advance(&mut self, flow: &mut Flow<'_>, dt: f64) {
        if self.advective.is_over(dt) {
            self.begin_advective_step(flow, dt);
            self.accelerate_again(flow); //              a, F of p, with the weights that the step holds
        }
        let half = 0.5 * dt;
        self.kick(flow.system, half); //                v½ = v + ½δt a
        self.advance_densities(flow, dt); //            ρ' = ρ (2 + ε)/(2 − ε), ε = δt (dρ/dt)/ρ of (v½, p); p' = p(ρ'); x' = x + δt (v½ + d)
        flow.walls.start_mean_force(dt); //             ½F, where the walls were at the start
        self.evaluate_walls(flow, dt); //               F' of p'
        self.accelerate(flow, half, dt); //             a' of p'; v' = v½ + ½δt a'
        flow.walls.finish_mean_force(); //              F̄ = ½(F + F')
        self.advective.elapse(dt);
    }

    /// WC23: choose the length of the next advective step and hold the geometry of its middle; the walls' kinematics are those of the end of
    /// its first acoustic step `dt` [s].
    fn begin_advective_step(&mut self, flow: &mut Flow<'_>, dt: f64) {
        let settings = self.base.settings;
        let longest = settings.advective_limit * self.longest_advective_step(flow);
        flow.system.fold(|_| {});
        self.advective = AdvectiveStep::new(dt, longest, settings.acoustic_steps());
        self.hold_geometry(flow, 0.5 * self.advective.length(), dt);
    }

    /// WC25: the longest advective step [s] by strain, by background pressure and by viscosity.
    fn longest_advective_step(&mut self, flow: &Flow<'_>) -> f64 {
        let ParticleSystem { particles: p, fields, domain, .. } = &*flow.system;
        if self.rows.len() < p.len() {
            return 0.0; // nothing is held yet
        }
        let HeldGeometry { pairs, walls, .. } = &*self.held;
        let strain = pairs.strain(&self.rows, &p.h, domain.simd).max(walls.strain(&self.rows, &p.h, flow.walls));
        let squeeze = parallel::least(p.len(), |k| -fields.pressure[k].max(0.0) / (p.rho[k] * p.h[k] * p.h[k]));
        let diffusion = parallel::least(p.len(), |k| {
            let artificial = 0.125 * self.base.settings.artificial_viscosity * self.base.eos.c0 * p.h[k];
            p.h[k] * p.h[k] / (domain.fluid.kinematic_viscosity + artificial)
        });
        advective::longest(strain, (-squeeze).sqrt() * domain.fluid.smoothing_ratio, diffusion)
    }

    /// WC23: hold the geometry as it is predicted to be `ahead` seconds from now; `dt` [s] from now the walls are where their
    /// kinematics say.
    fn hold_geometry(&mut self, flow: &mut Flow<'_>, ahead: f64, dt: f64) {
        let (system, walls) = (&mut *flow.system, &mut *flow.walls);
        coast(system, ahead);
        if !system.place_walls(walls, ahead - dt, false) {
            self.base.refine(system);
            system.rebuild_lists(walls, 2.0 * LISTS_LAST * ahead, WIDE_SKIN);
        }
        system.pack(walls);
        coast(system, -ahead);
        let pressures = walls.pressure.clone();
        extrapolate_to_walls(system, walls); // WA5: velocities; pressures are found in each acoustic step
        walls.pressure = pressures;
        system.packed.clear_pressures();
        let mut held = Arc::get_mut(&mut self.held).map(std::mem::take).unwrap_or_default();
        held.viscous_forces(system, walls, &self.base.terms(system));
        system.neighbours.flag_surface(&mut system.fields); // OP5, of the moments just found
        system.timers.begin(Phase::Pack);
        let (length, steps) = self.advective.span();
        let shifts = shifts_in_stages(system, &self.base.settings, (length, steps), self.gain, gradient_when_shifted);
        displace(system, &shifts, ahead / length);
        held.shift_velocity = shifts.map(|axis| axis.into_iter().map(|d| d / length).collect());
        system.packed.set_pressures(&system.fields, &system.neighbours);
        let shift_velocity = with_images(&system.neighbours, &held.shift_velocity);
        let (constants, d) = (self.base.constants(system), self.base.settings.dissipation);
        let ParticleSystem { packed, neighbours, domain, .. } = &*system;
        let fluid = (&packed.fluid[..], &shift_velocity[..]);
        hold(
            &mut held.pairs,
            (domain.fluid.kernel, d, domain.simd),
            fluid,
            (&neighbours.fluid, neighbours.rebuilds),
            constants,
        );
        held.walls.hold(system, walls, &shift_velocity, constants);
        self.held = Arc::new(held);
    }

    /// WC5, WA3, WA6 of the present pressures with the geometry just held: energy passes between motion and pressure by one set of
    /// weights in all of an advective step.
    fn accelerate_again(&mut self, flow: &mut Flow<'_>) {
        self.kick(flow.system, 0.0); // the rows of the particles and images of now
        self.pressure.iter_mut().zip(&self.rows).for_each(|(p, row)| *p = row.p);
        self.evaluate_walls(flow, 0.0);
        self.accelerate(flow, 0.0, 0.0);
    }

    /// v ← v + Δt a; the particles and their images show it to their neighbours.
    fn kick(&mut self, system: &mut ParticleSystem, dt: f64) {
        system.timers.begin(Phase::Integration);
        let n = system.particles.len();
        self.rows.resize(n + system.neighbours.fluid_images.len(), Row::default());
        self.pressure.resize(self.rows.len(), 0.0);
        let (own, of_images) = self.rows.split_at_mut(n);
        acoustic_step::kick(system, own, dt);
        let side = if system.neighbours.fluid_shifts.is_empty() { -1.0 } else { 1.0 };
        for (row, &source) in of_images.iter_mut().zip(&system.neighbours.fluid_images) {
            let Row { u, v, p } = own[source as usize];
            *row = Row { u: side * u, v, p };
        }
    }

    /// WC3 + WC4 with the geometry held, WC2, and x ← x + Δt v.
    fn advance_densities(&mut self, flow: &mut Flow<'_>, dt: f64) {
        let Flow { system, walls, .. } = flow;
        system.timers.begin(Phase::Density);
        let diffusion = diffusion_factor(self.base.settings.dissipation, &self.base.constants(system));
        let HeldGeometry { pairs, walls: held_walls, shift_velocity, .. } = &*self.held;
        let (n, rows, wall_state) = (system.particles.len(), &self.rows, &system.wall_state);
        let later = self.advective.after_middle(0.5 * dt);
        let closing = held_walls.closing(rows, walls, |w| wall_state[w].velocity, later);
        let (own, of_images) = self.pressure.split_at_mut(n);
        let Fields { moments, near_surface, pressure, .. } = &mut system.fields;
        let law = self.base.pressure_law();
        let state = |k: usize, rho: f64| law.state(rho, &moments[k], near_surface[k]);
        let densities = Densities {
            pairs,
            walls: held_walls,
            rows,
            closing: &closing,
            shift_velocity,
            diffusion,
            dt,
            later,
            state,
        };
        densities.advance(&mut system.particles, pressure, own, system.domain.simd);
        for (p, &source) in of_images.iter_mut().zip(&system.neighbours.fluid_images) {
            *p = own[source as usize];
        }
    }

    /// WA3, WA6: pressures of the walls and forces on them, with the geometry held, `passed` [s] after the start of the acoustic step.
    fn evaluate_walls(&mut self, flow: &mut Flow<'_>, passed: f64) {
        let Flow { system, walls, interfaces } = flow;
        system.timers.begin(Phase::Walls);
        let (g, rho0) = (system.domain.gravity, system.domain.fluid.density);
        let later = self.advective.after_middle(passed);
        let HeldGeometry { walls: held, viscous_on_walls: [vx, vy], .. } = &*self.held;
        for w in 0..walls.len() {
            let p = held.pressure(w, &self.pressure, [g[0] - walls.ax[w], g[1] - walls.ay[w]], (rho0, later));
            let [x, y] = held.force(w, &self.pressure, p, later);
            (walls.pressure[w], walls.fx[w], walls.fy[w]) = (p, x + vx[w], y + vy[w]);
            system.wall_state[w].pressure = p;
            if self.base.settings.wall_stretch {
                system.wall_state[w].velocity = held.velocity(w, &self.rows).unwrap_or([walls.u[w], walls.v[w]]);
            }
        }
        if !interfaces.is_empty() {
            system.timers.begin(Phase::Coupling);
            let at: Vec<[f64; 2]> = (0..walls.len()).map(|k| [walls.x[k], walls.y[k]]).collect();
            solve_owners(walls, interfaces, &held.sensitivity, |k| at[k], rho0, 0.0); // CO4, CO5
        }
    }

    /// WC5 with the geometry held, and the viscous forces held, `passed` [s] after the start of the acoustic step; v ← v + Δt a.
    fn accelerate(&mut self, flow: &mut Flow<'_>, dt: f64, passed: f64) {
        let later = self.advective.after_middle(passed);
        flow.system.timers.begin(Phase::Momentum);
        let HeldGeometry { pairs, walls, viscous, .. } = &*self.held;
        let wall_pressure = &flow.walls.pressure;
        Accelerations { pairs, walls, pressure: &self.pressure, wall_pressure, viscous, dt, later }
            .evaluate(flow.system);
    }
}

/// ∇C [1/m] of the packed particles, each moved by its shift [m].
fn gradient_when_shifted(system: &mut ParticleSystem, shifts: &[Vec<f64>; 2]) -> [Vec<f64>; 2] {
    displace(system, shifts, 1.0);
    let gradient = gather_concentration_gradient(system);
    displace(system, shifts, -1.0);
    gradient
}

/// Move the packed particles, and their images, by a `share` [-] of their shifts [m].
fn displace(system: &mut ParticleSystem, shifts: &[Vec<f64>; 2], share: f64) {
    let shifts = with_images(&system.neighbours, shifts);
    parallel::update(&mut system.packed.fluid, |k, row| {
        [row.x, row.y] = [row.x + share * shifts[k][0], row.y + share * shifts[k][1]]
    });
}

/// A vector of each particle, and of each image.
fn with_images(neighbours: &Neighbours, [x, y]: &[Vec<f64>; 2]) -> Vec<[f64; 2]> {
    let side = if neighbours.fluid_shifts.is_empty() { -1.0 } else { 1.0 };
    let of_images = neighbours.fluid_images.iter().map(|&k| [side * x[k as usize], y[k as usize]]);
    x.iter().zip(y).map(|(&x, &y)| [x, y]).chain(of_images).collect()
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

    /// WC12 at the start of an advective step; its acoustic steps are equal.
    fn stable_dt(&self, system: &ParticleSystem, walls: &Walls) -> Result<f64, Breakdown> {
        self.advective.acoustic_step().map_or_else(|| self.base.stable_dt(system, walls), Ok)
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
        let HeldGeometry { pairs, walls, shift_velocity: [dx, dy], viscous: [x, y], viscous_on_walls: [wx, wy] } =
            &*self.held;
        let vectors = [dx, dy, x, y, wx, wy].map(of_vector).iter().sum::<usize>();
        self.base.bytes() + pairs.bytes() + walls.bytes() + vectors + of_vector(&self.rows) + of_vector(&self.pressure)
    }
}
