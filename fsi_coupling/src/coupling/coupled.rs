//! Fluid and bodies, stepped together.

use std::ops::Range;

use sph_core::parallel;
use sph_core::particles::totals::FluidEnergy;
use sph_core::{Fluid, Phase, Phases, Walls, Yielding};

use crate::bodies::body::{BodyError, WettedBody};
use crate::coupling::contact::{take_back, throw_back};
use crate::coupling::error::CouplingError;
use crate::coupling::penetration::{Penetration, run_into};
use crate::coupling::refinement::Focus;
use crate::coupling::scheme::{Agreement, Exchange, Scheme};
use crate::coupling::work_audit::WorkAudit;
use crate::geometry::rows::Arrangement;

/// Bodies may touch: this share of a spacing beyond each other is no collision.
const PLAY: f64 = 0.01;

struct Member {
    body: Box<dyn WettedBody>,
    range: Range<usize>,
    work: WorkAudit,
    screens: Range<usize>,
}

/// See the module's text.
pub struct Coupled {
    /// The fluid.
    pub fluid: Fluid,
    /// All boundary particles.
    pub walls: Walls,
    members: Vec<Member>,
    exchange: Exchange,
    saved: Option<Saved>,
    pub(crate) focus: Option<Focus>,
    play: f64,
    stopped: u64,
    audit: MomentumAudit,
    mass: f64,
    energy_at_start: f64,
    fluid_at_start: FluidEnergy,
}

/// What [`Coupled::restore`] returns to, besides fluid and bodies.
struct Saved {
    walls: Walls,
    exchange: Exchange,
    audit: MomentumAudit,
    stopped: u64,
    work: Vec<WorkAudit>,
}

/// Momentum closure (THEORY E21): what the fluid and the bodies hold, less what came from outside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MomentumAudit {
    balance: [f64; 2],
    /// Largest change of the balance in one step, relative to Σ m|v| + Δt Σ|F| [-].
    pub worst: f64,
}

/// C2: the bodies that a force accelerates, as the fluid sees them at the end of a step of `ahead` [s].
fn yielding(members: &mut [Member], ahead: f64, mirrored: bool) -> Result<Vec<Yielding>, BodyError> {
    let mut owners = Vec::new();
    for Member { body, range, .. } in members {
        if let Some(owner) = body.yielding(ahead)? {
            owners.push(Yielding { range: range.clone(), mirrored, owner });
        }
    }
    Ok(owners)
}

impl Coupled {
    /// Sample the bodies at `spacing` [m], put everything in place, evaluate the forces at the start.
    pub fn new(
        mut fluid: Fluid,
        bodies: Vec<Box<dyn WettedBody>>,
        scheme: Scheme,
        spacing: f64,
    ) -> Result<Coupled, CouplingError> {
        if fluid.particles.is_empty() {
            return Err(CouplingError::NoFluid);
        }
        let ratio = fluid.parameters.smoothing_ratio;
        let (arrangement, layers) = Arrangement::of(&fluid.parameters);
        let mut walls = Walls::default();
        let mut members = Vec::new();
        for mut body in bodies {
            body.arrange(arrangement);
            let range = walls.extend(&body.sample(spacing, layers)?, ratio);
            body.place(0.0, walls.slice_mut(range.clone()));
            let first = walls.screens.len();
            walls.screens.extend(body.screens(0.0));
            members.push(Member { body, range, screens: first..walls.screens.len(), work: WorkAudit::default() });
        }
        let mut exchange = Exchange::new(scheme);
        let mirrored = fluid.parameters.mirror.is_some();
        let owners = yielding(&mut members, 0.0, mirrored)?;
        exchange.agree(&mut fluid, &mut walls, owners, Fluid::initialise)?;
        exchange.report = Agreement::default();
        let mut coupled = Coupled {
            fluid,
            walls,
            members,
            exchange,
            saved: None,
            focus: None,
            stopped: 0,
            play: PLAY * spacing,
            audit: MomentumAudit::default(),
            mass: 0.0,
            energy_at_start: 0.0,
            fluid_at_start: FluidEnergy::default(),
        };
        coupled.load_bodies();
        coupled.mass = coupled.fluid.mass();
        coupled.audit.balance = coupled.balance(coupled.fluid.momentum());
        coupled.fluid_at_start = coupled.fluid.energy();
        coupled.energy_at_start = coupled.energy(&coupled.fluid_at_start);
        coupled.fluid.phases = Phases::default();
        Ok(coupled)
    }

    /// The largest step that fluid and bodies allow [s].
    pub fn stable_dt(&self) -> Result<f64, CouplingError> {
        let bodies = self.members.iter().map(|m| m.body.stable_dt()).fold(f64::INFINITY, f64::min);
        Ok(self.fluid.stable_dt(&self.walls)?.min(bodies))
    }

    /// One step of `dt` [s].
    pub fn step(&mut self, dt: f64) -> Result<(), CouplingError> {
        parallel::within_pool(|| self.advance(dt))
    }

    fn advance(&mut self, dt: f64) -> Result<(), CouplingError> {
        let outer = self.fluid.phases.begin(Phase::Coupling);
        self.refocus(); //                                              E26
        for m in &self.members {
            m.body.place(dt, self.walls.slice_mut(m.range.clone())); // H: bodies → boundary particles
        }
        self.walls.screens.clear();
        self.walls.screens.extend(self.members.iter().flat_map(|m| m.body.screens(dt)));
        let owners = yielding(&mut self.members, dt, self.fluid.parameters.mirror.is_some())?;
        self.begin(&owners, dt);
        self.exchange.agree(&mut self.fluid, &mut self.walls, owners, |fluid, walls| fluid.step(walls, dt))?;
        self.load_bodies(); //                                          Hᵀ: boundary particles → bodies
        self.fluid.phases.begin(Phase::Structure);
        for m in &mut self.members {
            m.body.advance(dt)?;
        }
        self.fluid.phases.begin(Phase::Coupling);
        let taken_back = self.take_back(dt); //                           contact with thin plates
        let thrown_back = self.throw_back(dt); //                         contact of single particles
        self.fluid.phases.begin(Phase::Audit);
        self.note_work(dt, taken_back.iter().zip(&thrown_back).map(|(a, b)| a + b));
        self.close_momentum(dt);
        self.refuse_collision()?;
        self.fluid.phases.go_on_with(outer);
        Ok(())
    }

    /// PB6: the velocities that a projection's walls begin a step with, whatever accelerations a scheme then finds.
    fn begin(&mut self, owners: &[Yielding], dt: f64) {
        self.walls.begun.clear();
        if owners.is_empty() || !self.fluid.parameters.solver.is_incompressible() {
            return;
        }
        self.walls.begun = (0..self.walls.len()).map(|k| self.walls.velocity_at_start(k, dt)).collect();
        for Yielding { range, owner, .. } in owners {
            owner.velocities_at_start(&mut self.walls.begun[range.clone()]);
        }
    }

    /// Remember the present state, of fluid, walls, bodies, exchange and audit; replaces the one remembered before.
    pub fn save(&mut self) {
        if self.saved.is_some() {
            self.fluid.forget();
        }
        self.fluid.save();
        let (walls, exchange, audit, stopped) = (self.walls.clone(), self.exchange.clone(), self.audit, self.stopped);
        self.saved =
            Some(Saved { walls, exchange, audit, stopped, work: self.members.iter().map(|m| m.work).collect() });
        self.members.iter_mut().for_each(|m| m.body.save());
    }

    /// Return to the state last saved; without one nothing happens.
    pub fn restore(&mut self) {
        let Some(Saved { walls, exchange, audit, stopped, work }) = &self.saved else { return };
        self.fluid.restore();
        self.members.iter_mut().zip(work).for_each(|(m, work)| m.work = *work);
        (self.walls, self.exchange, self.audit, self.stopped) = (walls.clone(), exchange.clone(), *audit, *stopped);
        self.members.iter_mut().for_each(|m| m.body.restore());
    }

    /// How well fluid and bodies agreed, over all steps so far.
    pub fn agreement(&self) -> Agreement {
        self.exchange.report
    }

    /// T5: particles that went through a thin plate return to the face they met; the work of the blows on each body [J/m].
    fn take_back(&mut self, dt: f64) -> Vec<f64> {
        let mut blows = vec![0.0; self.members.len()];
        for passage in self.fluid.passages(&self.walls) {
            let half = self.walls.screens[passage.screen].half_thickness;
            let owner = self.members.iter_mut().zip(&mut blows).find(|(m, _)| m.screens.contains(&passage.screen));
            if let Some((m, work)) = owner {
                *work += take_back(&mut self.fluid, &passage, half, m.body.as_mut(), dt);
                self.stopped += 1;
            }
        }
        blows
    }

    /// How often a particle was stopped that would have gone through a thin plate (THEORY T5).
    pub fn stopped(&self) -> u64 {
        self.stopped
    }

    /// E25: particles beyond a body's surface return to it; likewise.
    fn throw_back(&mut self, dt: f64) -> Vec<f64> {
        let mut blows = vec![0.0; self.members.len()];
        for particle in self.fluid.suspects(&self.walls) {
            for (m, work) in self.members.iter_mut().zip(&mut blows) {
                *work += throw_back(&mut self.fluid, particle, m.body.as_mut(), dt);
            }
        }
        blows
    }

    /// K6: the work of a step on each body, and that of blows.
    fn note_work(&mut self, dt: f64, blows: impl Iterator<Item = f64>) {
        let halves = if self.fluid.parameters.mirror.is_some() { 2.0 } else { 1.0 };
        for (m, blows) in self.members.iter_mut().zip(blows) {
            m.work.note(&self.walls, m.range.clone(), dt, halves, blows);
        }
    }

    /// K6: the work of the fluid on a body, as given and as taken.
    pub fn work_audit(&self, k: usize) -> WorkAudit {
        let member = &self.members[k];
        WorkAudit { received: member.body.energy().work, ..member.work }
    }

    fn refuse_collision(&self) -> Result<(), CouplingError> {
        for (k, m) in self.members.iter().enumerate() {
            for (_, other) in self.members.iter().enumerate().filter(|(j, _)| *j != k) {
                if let Some([x, y]) = run_into(m.body.as_ref(), other.body.as_ref(), self.play) {
                    let (body, wall) = (m.body.name().to_string(), other.body.name().to_string());
                    return Err(CouplingError::Collision { body, wall, x, y, time: self.fluid.time });
                }
            }
        }
        Ok(())
    }

    fn load_bodies(&mut self) {
        let mirrored = self.fluid.parameters.mirror.is_some();
        for m in &mut self.members {
            let mut forces = self.walls.forces(m.range.clone());
            forces.mirrored = mirrored;
            m.body.load(forces);
        }
    }

    /// The bodies, in the order they were given.
    pub fn bodies(&self) -> impl Iterator<Item = &dyn WettedBody> {
        self.members.iter().map(|m| m.body.as_ref())
    }

    /// Boundary particles of body `k`.
    pub fn range(&self, k: usize) -> Range<usize> {
        self.members[k].range.clone()
    }

    /// Fluid particles beyond a wall's surface, or behind the plane of symmetry.
    pub fn penetration(&self) -> Penetration {
        let (p, mirror) = (&self.fluid.particles, self.fluid.parameters.mirror);
        let bodies: Vec<&dyn WettedBody> = self.bodies().collect();
        let search = |targets: Range<usize>| {
            let mut found = Penetration::default();
            for k in targets {
                let at = [p.x[k], p.y[k]];
                let (mut nearest, mut owner) = (mirror.map_or(f64::INFINITY, |m| p.x[k] - m.at), None);
                for (j, body) in bodies.iter().enumerate() {
                    let clearance = body.clearance(at);
                    if clearance < nearest {
                        (nearest, owner) = (clearance, Some(j));
                    }
                }
                found.count(p.id[k], at, nearest, owner.map_or("", |j| bodies[j].name()));
            }
            found
        };
        parallel::by_chunk(p.len(), search).into_iter().fold(Penetration::default(), Penetration::and)
    }

    /// Momentum closure so far.
    pub fn momentum_audit(&self) -> MomentumAudit {
        self.audit
    }

    /// Energies of the fluid now [J/m].
    pub fn fluid_energy(&self) -> FluidEnergy {
        self.fluid.energy()
    }

    /// Energies of the fluid at the start [J/m].
    pub fn fluid_energy_at_start(&self) -> FluidEnergy {
        self.fluid_at_start
    }

    /// Energy that left the balance since the start [J/m] (THEORY E22): fluid and free bodies, less the
    /// work done on the system by bodies whose motion is given. Negative: dissipated.
    pub fn energy_drift(&self) -> f64 {
        self.energy_drift_with(&self.fluid.energy())
    }

    /// The same, where the fluid's energy now is known.
    pub fn energy_drift_with(&self, fluid: &FluidEnergy) -> f64 {
        self.energy(fluid) - self.energy_at_start
    }

    fn energy(&self, fluid: &FluidEnergy) -> f64 {
        let of = |m: &Member| {
            let e = m.body.energy();
            if m.body.prescribed() { e.work } else { e.kinetic + e.potential + e.elastic - e.support }
        };
        fluid.total() + self.members.iter().map(of).sum::<f64>()
    }

    /// Momentum held less impulses from outside, but for gravity on the fluid, whose own momentum is given.
    fn balance(&self, of_fluid: [f64; 2]) -> [f64; 2] {
        let mut total = of_fluid;
        for m in &self.members {
            let ledger = m.body.ledger();
            for k in 0..2 {
                total[k] += ledger.momentum[k] - ledger.external[k];
            }
        }
        total
    }

    fn close_momentum(&mut self, dt: f64) {
        let (of_fluid, held) = self.fluid.momentum_and_its_scale();
        let (now, w) = (self.balance(of_fluid), &self.walls);
        let [pushed] = parallel::sum(w.len(), |k| [(w.fx[k] * w.fx[k] + w.fy[k] * w.fy[k]).sqrt()]);
        let scale = held + dt * pushed;
        let symmetric = self.fluid.parameters.mirror.is_some();
        for k in 0..2 {
            let gravity = if symmetric && k == 0 { 0.0 } else { dt * self.mass * self.fluid.parameters.gravity[k] };
            let gap = now[k] - self.audit.balance[k] - gravity;
            if scale > 0.0 {
                self.audit.worst = self.audit.worst.max(gap.abs() / scale);
            }
        }
        self.audit.balance = now;
    }
}
