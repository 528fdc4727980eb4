//! Fluid and bodies, stepped together.

use std::ops::Range;

use sph_core::parallel;
use sph_core::particles::totals::FluidEnergy;
use sph_core::state_bytes::{StateError, decode, encode, expect_count};
use sph_core::{Breakdown, Damped, DampingZone, Fluid, Phase, RefinementZone, Timers, WallInterface, Walls};

use crate::bodies::body::Body;
use crate::bodies::state::Motion;
use crate::coupling::balance::{Balance, MomentumAudit};
use crate::coupling::contact::{resolve_contact, resolve_tunnelling};
use crate::coupling::error::CouplingError;
use crate::coupling::links::joint::{JointSpec, JointState};
use crate::coupling::links::{ContactLaw, Links, LinksMemory, TouchRecord};
use crate::coupling::penetration::{Penetration, penetration};
use crate::coupling::placed_bodies::{Member, PlacedBodies, WorkAudit, apply_kinematics, interfaces, load};
use crate::coupling::quasi_newton::QuasiNewton;
use crate::coupling::relaxation_zone::RelaxationZone;
use crate::coupling::scheme::{CouplingStatistics, Interface, Scheme};
use crate::geometry::outline::Outline;

/// Overlap of two bodies that is still no collision [spacings].
const TOLERATED_OVERLAP: f64 = 0.01;

/// Times that a step is halved before the run fails.
const MOST_RETRIES: u32 = 3;

/// The refinement zone around bodies: a function of the motion and outline of each that has them, in their order, alone, so that a step that is restored and repeated
/// gives the same bits. It is evaluated before each step.
pub type RefinementRule = Box<dyn Fn(&[(Motion, &Outline)]) -> RefinementZone + Send + Sync>;

/// A fluid and the bodies in it.
pub struct Coupled {
    /// The fluid.
    pub fluid: Fluid,
    /// All boundary particles.
    pub walls: Walls,
    members: Vec<Member>,
    interface: Interface,
    links: Links,
    checkpoint: Option<Checkpoint>,
    refinement: Option<RefinementRule>,
    beach: Option<DampingZone>,
    relaxation: Option<RelaxationZone>,
    tolerated_overlap: f64,
    stopped: u64,
    balance: Balance,
}

/// The state that [`Coupled::restore`] returns to, without fluid and bodies.
struct Checkpoint {
    walls: Walls,
    interface: Interface,
    links: Links,
    balance: Balance,
    stopped: u64,
    work: Vec<WorkAudit>,
}

impl Coupled {
    /// Place the bodies at t = 0 with boundary particles at `spacing` [m], and evaluate the forces at the start.
    pub fn new(
        fluid: Fluid,
        bodies: Vec<Box<dyn Body>>,
        scheme: Scheme,
        spacing: f64,
    ) -> Result<Coupled, CouplingError> {
        if fluid.particles().is_empty() {
            return Err(CouplingError::NoFluid);
        }
        let placed = PlacedBodies::new(bodies, fluid.wall_layout(), fluid.domain().fluid.smoothing_ratio, spacing)?;
        Coupled::with_bodies(fluid, placed, scheme)
    }

    /// Couple a fluid with bodies that are placed already; evaluate the forces at the start.
    pub fn with_bodies(mut fluid: Fluid, placed: PlacedBodies, scheme: Scheme) -> Result<Coupled, CouplingError> {
        if fluid.particles().is_empty() {
            return Err(CouplingError::NoFluid);
        }
        let PlacedBodies { mut walls, mut members, spacing } = placed;
        let mirrored = fluid.domain().mirror.is_some();
        let mut interface = Interface::new(scheme);
        let bodies = interfaces(&mut members, 0.0, mirrored)?;
        interface.solve(&mut fluid, &mut walls, bodies, Fluid::initialise_with)?;
        interface.statistics = CouplingStatistics::default();
        load(&mut members, &walls, mirrored);
        let balance = Balance::at_start(&fluid, &members);
        *fluid.timers_mut() = Timers::default();
        Ok(Coupled {
            fluid,
            walls,
            members,
            interface,
            links: Links::default(),
            checkpoint: None,
            refinement: None,
            beach: None,
            relaxation: None,
            tolerated_overlap: TOLERATED_OVERLAP * spacing,
            stopped: 0,
            balance,
        })
    }

    /// The same system with a refinement zone that moves with its bodies (THEORY WC21).
    pub fn with_refinement(self, rule: RefinementRule) -> Coupled {
        Coupled { refinement: Some(rule), ..self }
    }

    /// The same system with joints between its bodies, and a law of contact (THEORY CO36–CO38). Before the first step.
    pub fn with_links(mut self, law: ContactLaw, joints: Vec<JointSpec>) -> Result<Coupled, CouplingError> {
        self.links = Links::new(law, joints, &mut self.members)?;
        Ok(self)
    }

    /// The same system with a beach that absorbs waves (THEORY WA15).
    pub fn with_beach(self, zone: DampingZone) -> Coupled {
        Coupled { beach: Some(zone), ..self }
    }

    /// The same system with a zone in which the water is led to an incident wave (THEORY WA16).
    pub fn with_relaxation(self, zone: RelaxationZone) -> Coupled {
        Coupled { relaxation: Some(zone), ..self }
    }

    /// The largest step that is stable for fluid and bodies [s].
    pub fn stable_dt(&self) -> Result<f64, CouplingError> {
        let bodies = self.members.iter().map(|m| m.body.stable_dt()).fold(f64::INFINITY, f64::min);
        Ok(self.fluid.stable_dt(&self.walls)?.min(bodies).min(self.links.stable_dt(&self.members)))
    }

    /// One step of `dt` [s].
    pub fn step(&mut self, dt: f64) -> Result<(), CouplingError> {
        parallel::within_pool(|| self.advance(dt))
    }

    /// CO26: one step of `dt` [s], or of a half, a quarter, an eighth of it where the pressure equation of the projection
    /// ([`Breakdown::Projection`]) does not converge; returns the step taken [s]. The equation is solved before anything
    /// moves, and bodies are placed again for each attempt, so that a shorter step starts from the same state.
    pub fn step_or_shorter(&mut self, dt: f64) -> Result<f64, CouplingError> {
        let mut shorter = dt;
        for _ in 0..MOST_RETRIES {
            match self.step(shorter) {
                Err(CouplingError::Fluid(Breakdown::Projection { .. })) => shorter *= 0.5,
                ended => return ended.map(|()| shorter),
            }
        }
        self.step(shorter).map(|()| shorter)
    }

    fn advance(&mut self, dt: f64) -> Result<(), CouplingError> {
        let outer = self.fluid.timers_mut().begin(Phase::Coupling);
        self.update_refinement(); //                                             WC21
        apply_kinematics(&mut self.members, &mut self.walls, dt); //             H: bodies → boundary particles
        let mirrored = self.is_mirrored();
        let bodies = interfaces(&mut self.members, dt, mirrored)?;
        self.set_start_velocities(&bodies, dt);
        self.interface.solve(&mut self.fluid, &mut self.walls, bodies, |fluid, walls, interfaces| {
            fluid.step_with(walls, interfaces, dt)
        })?;
        load(&mut self.members, &self.walls, mirrored); //                       Hᵀ: boundary particles → bodies
        self.fluid.timers_mut().begin(Phase::Structure);
        for m in &mut self.members {
            m.body.advance(dt)?;
        }
        self.fluid.timers_mut().begin(Phase::Coupling);
        let time = self.fluid.time();
        self.links.hold(&mut self.members, self.tolerated_overlap, dt, time)?; // CO36: joints, contact of solids
        let tunnelling = self.resolve_tunnelling(dt); //                         WA11: thin plates
        let contact = self.resolve_contact(dt); //                               WA7: single particles
        if let Some(zone) = &self.beach {
            self.balance.absorb(&self.fluid.damp(zone, dt)); //                  WA15: the beach
        }
        if let Some(zone) = &self.relaxation {
            self.balance.absorb(&zone.relax(&mut self.fluid, dt)); //            WA16: the incident wave
        }
        self.fluid.timers_mut().begin(Phase::Audit);
        self.record_work(dt, tunnelling.iter().zip(&contact).map(|(a, b)| a + b));
        self.balance.close_step(&self.fluid, &self.walls, &self.members, dt);
        self.fluid.timers_mut().resume(outer);
        Ok(())
    }

    fn is_mirrored(&self) -> bool {
        self.fluid.domain().mirror.is_some()
    }

    fn update_refinement(&mut self) {
        let Some(rule) = &self.refinement else { return };
        let placed: Vec<_> = self.bodies().filter_map(|body| Some((body.motion()?, body.outline()?))).collect();
        let zone = (!placed.is_empty()).then(|| rule(&placed));
        self.fluid.set_refinement_zone(zone);
    }

    /// CO23: velocities of the walls at the start of the step, which a projection needs whatever accelerations the scheme finds.
    fn set_start_velocities(&mut self, bodies: &[WallInterface], dt: f64) {
        self.walls.start_velocity.clear();
        if bodies.is_empty() || !self.fluid.force_is_constant_in_step() {
            return;
        }
        self.walls.start_velocity = (0..self.walls.len()).map(|k| self.walls.velocity_at_start(k, dt)).collect();
        for WallInterface { range, owner, .. } in bodies {
            owner.velocities_at_start(&mut self.walls.start_velocity[range.clone()]);
        }
    }

    /// Store the present state of fluid, walls, bodies, interface and audits; it replaces the one stored before.
    pub fn checkpoint(&mut self) {
        if self.checkpoint.is_some() {
            self.fluid.forget();
        }
        self.fluid.save();
        self.members.iter_mut().for_each(|m| m.body.checkpoint());
        self.checkpoint = Some(Checkpoint {
            walls: self.walls.clone(),
            interface: self.interface.clone(),
            links: self.links.clone(),
            balance: self.balance,
            stopped: self.stopped,
            work: self.members.iter().map(|m| m.work).collect(),
        });
    }

    /// Return to the state last stored; without one nothing changes.
    pub fn restore(&mut self) {
        let Some(Checkpoint { walls, interface, links, balance, stopped, work }) = &self.checkpoint else { return };
        self.fluid.restore();
        self.links.clone_from(links);
        (self.walls, self.interface) = (walls.clone(), interface.clone());
        (self.balance, self.stopped) = (*balance, *stopped);
        for (m, work) in self.members.iter_mut().zip(work) {
            m.work = *work;
            m.body.restore();
        }
    }

    /// The state of fluid, walls, bodies, interface and audits, as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let bodies: Vec<Vec<u8>> = self.members.iter().map(|m| m.body.to_bytes()).collect();
        let work: Vec<WorkAudit> = self.members.iter().map(|m| m.work).collect();
        let audits = (&self.balance, self.stopped, work, self.links.memory());
        encode(&(self.fluid.to_bytes(), &self.walls, self.interface.memory(), audits, bodies))
    }

    /// Take such a state: the next step gives the same bits as it gave there. Before: a system made of the same input. After an error
    /// it is of no use.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        type Audits = (Balance, u64, Vec<WorkAudit>, LinksMemory);
        type Stored = (Vec<u8>, Walls, (QuasiNewton, CouplingStatistics), Audits, Vec<Vec<u8>>);
        let (fluid, walls, memory, (balance, stopped, work, links), bodies): Stored = decode("the system", bytes)?;
        walls.check(&self.walls)?;
        expect_count("bodies", bodies.len(), self.members.len())?;
        expect_count("audits of bodies", work.len(), self.members.len())?;
        self.fluid.restore_bytes(&fluid)?;
        self.interface.set_memory(memory);
        self.links.set_memory(links)?;
        (self.walls, self.balance, self.stopped) = (walls, balance, stopped);
        for ((m, work), body) in self.members.iter_mut().zip(work).zip(&bodies) {
            m.work = work;
            m.body.restore_bytes(body)?;
        }
        Ok(())
    }

    /// WA11: particles that crossed a thin plate return to the face they met; the work of the impulses on each body [J/m].
    fn resolve_tunnelling(&mut self, dt: f64) -> Vec<f64> {
        let mut done = vec![0.0; self.members.len()];
        for passage in self.fluid.passages(&self.walls) {
            let half = self.walls.midlines[passage.midline].half_thickness;
            let owner = self.members.iter_mut().zip(&mut done).find(|(m, _)| m.plates.contains(&passage.midline));
            if let Some((m, work)) = owner {
                *work += resolve_tunnelling(&mut self.fluid, &passage, half, m.body.as_mut(), dt);
                self.stopped += 1;
            }
        }
        done
    }

    /// WA7: particles behind a body's surface return to it; the work of the impulses on each body [J/m].
    fn resolve_contact(&mut self, dt: f64) -> Vec<f64> {
        let mut done = vec![0.0; self.members.len()];
        for particle in self.fluid.contact_candidates(&self.walls) {
            for (m, work) in self.members.iter_mut().zip(&mut done) {
                *work += resolve_contact(&mut self.fluid, particle, m.body.as_mut(), dt);
            }
        }
        done
    }

    /// CO17: the work of the step on each body; `contact` is that of contact impulses [J/m].
    fn record_work(&mut self, dt: f64, contact: impl Iterator<Item = f64>) {
        let halves = if self.is_mirrored() { 2.0 } else { 1.0 };
        for (m, contact) in self.members.iter_mut().zip(contact) {
            m.work.record(&self.walls, m.range.clone(), dt, halves, contact);
        }
    }

    /// The bodies, in the order they were given.
    pub fn bodies(&self) -> impl Iterator<Item = &dyn Body> {
        self.members.iter().map(|m| m.body.as_ref())
    }

    /// Boundary particles of body `k`.
    pub fn range(&self, k: usize) -> Range<usize> {
        self.members[k].range.clone()
    }

    /// States of the joints, in the order they were given.
    pub fn joints(&self) -> Vec<JointState> {
        self.links.joints()
    }

    /// Which bodies have touched, in the order in which they first did.
    pub fn touched(&self) -> &[TouchRecord] {
        self.links.touched()
    }

    /// How often a particle was stopped at a thin plate that it would have crossed (THEORY WA11).
    pub fn stopped(&self) -> u64 {
        self.stopped
    }

    /// Iterations and residuals of the coupling, over all steps so far.
    pub fn statistics(&self) -> CouplingStatistics {
        self.interface.statistics
    }

    /// Fluid particles behind a wall's surface, or behind the plane of symmetry.
    pub fn penetration(&self) -> Penetration {
        let bodies: Vec<&dyn Body> = self.bodies().collect();
        penetration(&self.fluid, &bodies)
    }

    /// CO17: the work of the fluid on body `k`, as the fluid does it and as the body takes it.
    pub fn work_audit(&self, k: usize) -> WorkAudit {
        let member = &self.members[k];
        WorkAudit { received: member.body.energy().work, ..member.work }
    }

    /// Momentum closure so far (THEORY CO27).
    pub fn momentum_audit(&self) -> MomentumAudit {
        self.balance.momentum
    }

    /// WA15: what a beach took from the water since the start.
    pub fn absorbed(&self) -> Damped {
        self.balance.absorbed
    }

    /// Energies of the fluid now [J/m].
    pub fn fluid_energy(&self) -> FluidEnergy {
        self.fluid.energy()
    }

    /// Energies of the fluid at the start [J/m].
    pub fn fluid_energy_at_start(&self) -> FluidEnergy {
        self.balance.fluid_at_start
    }

    /// Energy that left the balance since the start [J/m] (THEORY CO28): fluid and free bodies, less the
    /// work of bodies with prescribed motion on the system. Negative: dissipated.
    pub fn energy_drift(&self) -> f64 {
        self.energy_drift_with(&self.fluid.energy())
    }

    /// The same, where the fluid's present energy is known.
    pub fn energy_drift_with(&self, fluid: &FluidEnergy) -> f64 {
        // springs are at rest at the start
        self.balance.energy_drift(fluid, &self.members) + self.links.elastic()
    }
}
