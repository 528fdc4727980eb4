//! The fluid: a particle system with the scheme that advances it.

use std::any::Any;

use crate::domain::Domain;
use crate::error::Breakdown;
use crate::memory::of_vector;
use crate::neighbours::Neighbours;
use crate::particles::totals::{FluidEnergy, Totals};
use crate::particles::{Fields, Particles, Seed};
use crate::refinement::RefinementZone;
use crate::scheme::{Flow, Scheme, SchemeSettings};
use crate::state_bytes::{StateError, decode, encode};
use crate::system::{ParticleSystem, SavedSystem};
use crate::timers::{Phase, Timers};
use crate::walls::interface::WallInterface;
use crate::walls::midline::{Passage, note_start_positions, passages};
use crate::walls::{WallLayout, Walls};
use crate::{contact, parallel};

/// A fluid that can be stepped.
///
/// ```
/// use sph_core::{Domain, Fluid, Seed, Walls, wcsph};
///
/// let seed = |k: usize| Seed { at: [0.1 * (k % 9) as f64, 0.1 * (k / 9) as f64], velocity: [1.0, 0.0], area: 0.01, pressure: 0.0 };
/// let settings = wcsph::Settings { sound_speed: 20.0.into(), ..wcsph::Settings::default() };
/// let mut fluid = Fluid::new(Domain::default(), &settings, &(0..81).map(seed).collect::<Vec<_>>());
/// let mut walls = Walls::default();
/// fluid.initialise(&mut walls)?;
/// let dt = fluid.stable_dt(&walls)?;
/// fluid.step(&mut walls, dt)?;
/// assert_eq!(fluid.steps(), 1);
/// # Ok::<(), sph_core::Breakdown>(())
/// ```
pub struct Fluid {
    system: ParticleSystem,
    scheme: Box<dyn Scheme>,
    saved: Vec<(SavedSystem, Box<dyn Scheme>)>,
    wall_layout: WallLayout,
    /// Particles moved, over all steps.
    updates: u64,
}

impl Fluid {
    /// A fluid from seeds; densities follow from the pressures of the seeds. Panics on a period that is too short for the
    /// kernel, or combined with a mirror (OP9): both are errors of the caller, not of its data.
    pub fn new(domain: Domain, settings: &dyn SchemeSettings, seeds: &[Seed]) -> Fluid {
        let ratio = domain.fluid.smoothing_ratio;
        if let Some(periodic) = domain.periodic {
            let two_supports = 4.0 * ratio * seeds.iter().map(|s| s.area).fold(0.0, f64::max).sqrt();
            assert!(domain.mirror.is_none(), "a mirror and a period exclude each other");
            assert!(
                periodic.shortest() > two_supports,
                "a period of {} m needs to exceed two supports, {two_supports} m",
                periodic.shortest()
            );
        }
        let particles = Particles::of(seeds, |seed| settings.state(&domain, seed), ratio);
        let mut fields = Fields::default();
        fields.resize(particles.len());
        if settings.keeps_volumes() {
            fields.pressure = seeds.iter().map(|seed| seed.pressure).collect();
            fields.volume = seeds.iter().map(|seed| seed.area).collect();
        }
        let scheme = settings.scheme(&domain);
        let wall_layout = settings.wall_layout(&domain);
        let system = ParticleSystem { domain, particles, fields, ..ParticleSystem::default() };
        Fluid { system, scheme, saved: Vec::new(), wall_layout, updates: 0 }
    }

    /// Find the forces at the start: once, when the walls stand where they start. Panics on a period with thin plates (WA8), an
    /// error of the caller.
    pub fn initialise(&mut self, walls: &mut Walls) -> Result<(), Breakdown> {
        self.initialise_with(walls, &mut [])
    }

    /// The same, where some owners of walls are accelerated by the force that they feel (THEORY CO5).
    pub fn initialise_with(&mut self, walls: &mut Walls, interfaces: &mut [WallInterface]) -> Result<(), Breakdown> {
        let unbounded = self.system.domain.periodic.is_none();
        assert!(unbounded || walls.midlines.is_empty(), "a period and thin plates exclude each other");
        self.scheme.initialise(&mut Flow { system: &mut self.system, walls, interfaces })?;
        self.scheme.check(&self.system)
    }

    /// Advance by `dt` [s]. Before: the walls' kinematics are those of the step's end. After: the walls carry the force at the
    /// step's end and the mean force of the step.
    pub fn step(&mut self, walls: &mut Walls, dt: f64) -> Result<(), Breakdown> {
        self.step_with(walls, &mut [], dt)
    }

    /// The same, where some owners of walls are accelerated by the force that they feel (THEORY CO5).
    pub fn step_with(&mut self, walls: &mut Walls, interfaces: &mut [WallInterface], dt: f64) -> Result<(), Breakdown> {
        walls.dt = dt;
        let Fluid { system, scheme, .. } = self;
        let outer = system.timers.begin(Phase::Integration);
        note_start_positions(&mut system.start_positions, &system.particles, &walls.midlines);
        parallel::within_pool(|| scheme.step(&mut Flow { system, walls, interfaces }, dt))?;
        if !scheme.holds_pairs() {
            system.fold(|id| scheme.reflected(id));
        }
        system.time += dt;
        system.steps += 1;
        self.updates += system.particles.len() as u64;
        let sound = scheme.check(system);
        system.timers.resume(outer);
        sound
    }

    /// The largest stable step [s], over the fluid and the walls beside it.
    pub fn stable_dt(&self, walls: &Walls) -> Result<f64, Breakdown> {
        parallel::within_pool(|| self.scheme.stable_dt(&self.system, walls))
    }

    /// The scheme, if it is a `T`.
    pub fn scheme<T: Scheme>(&self) -> Option<&T> {
        let scheme: &dyn Any = self.scheme.as_ref();
        scheme.downcast_ref()
    }

    /// The same, to change its settings between steps.
    pub fn scheme_mut<T: Scheme>(&mut self) -> Option<&mut T> {
        let scheme: &mut dyn Any = self.scheme.as_mut();
        scheme.downcast_mut()
    }

    /// Fluid properties, gravity, kernel, bounding planes.
    pub fn domain(&self) -> &Domain {
        &self.system.domain
    }

    /// Rows of boundary particles that the scheme's walls need.
    pub fn wall_layout(&self) -> WallLayout {
        self.wall_layout
    }

    /// Particles with their neighbours.
    pub(crate) fn system(&self) -> &ParticleSystem {
        &self.system
    }

    /// The same, to evaluate single terms.
    #[cfg(test)]
    pub(crate) fn system_mut(&mut self) -> &mut ParticleSystem {
        &mut self.system
    }

    /// State that lives from step to step.
    pub fn particles(&self) -> &Particles {
        &self.system.particles
    }

    /// The same, to set a state at the start that seeds do not describe.
    pub fn particles_mut(&mut self) -> &mut Particles {
        &mut self.system.particles
    }

    /// Quantities that the last step computed.
    pub fn fields(&self) -> &Fields {
        &self.system.fields
    }

    /// Neighbour lists.
    pub fn neighbours(&self) -> &Neighbours {
        &self.system.neighbours
    }

    /// Time [s].
    pub fn time(&self) -> f64 {
        self.system.time
    }

    /// Sets the clock of a fluid that has not stepped yet [s].
    pub fn start_at(&mut self, time: f64) {
        self.system.time = time;
    }

    /// Steps taken.
    pub fn steps(&self) -> u64 {
        self.system.steps
    }

    /// Particles moved, over all steps.
    pub fn updates(&self) -> u64 {
        self.updates
    }

    /// Wall time by phase.
    pub fn timers(&self) -> &Timers {
        &self.system.timers
    }

    /// The same, to count other parts of a run.
    pub fn timers_mut(&mut self) -> &mut Timers {
        &mut self.system.timers
    }

    /// Where coarse particles are split when the lists are rebuilt (THEORY WC21); `None` splits none. For the weakly
    /// compressible scheme.
    pub fn set_refinement_zone(&mut self, zone: Option<RefinementZone>) {
        self.system.refinement_zone = zone;
    }

    /// How near the free surface each particle is, 1 at it and 0 far from it [-]; empty where the scheme does not find it.
    pub fn surface_indicator(&self) -> &[f64] {
        self.scheme.surface_indicator()
    }

    /// True where the force on a wall is constant over a step.
    pub fn force_is_constant_in_step(&self) -> bool {
        self.scheme.force_is_constant_in_step()
    }

    /// True where particles that crossed the plane of symmetry change places with their images only now and then (WC22).
    pub fn holds_pairs(&self) -> bool {
        self.scheme.holds_pairs()
    }

    pub(crate) fn face_kernel_sum(&self) -> Option<[f64; 2]> {
        self.scheme.face_kernel_sum()
    }

    /// Save the present state on top of those saved before. The walls are their owners' to save: all of [`Walls`].
    pub fn save(&mut self) {
        self.saved.push((self.system.save(), self.scheme.checkpoint()));
    }

    /// Return to the state last saved, as often as needed; without one nothing happens.
    pub fn restore(&mut self) {
        let Some((system, scheme)) = self.saved.last() else { return };
        self.system.restore(system);
        self.scheme = scheme.checkpoint();
    }

    /// Forget the state last saved.
    pub fn forget(&mut self) {
        self.saved.pop();
    }

    /// The state that a step changes, as bytes. The walls are their owners' to store: all of [`Walls`].
    pub fn to_bytes(&self) -> Vec<u8> {
        encode(&(self.system.to_bytes(), self.scheme.to_bytes(), self.updates))
    }

    /// Take such a state: the next step gives the same bits as it gave there. Before: a fluid made of the same input, initialised.
    /// After an error it is of no use.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        let (system, scheme, updates): (Vec<u8>, Vec<u8>, u64) = decode("the fluid", bytes)?;
        self.system.restore_bytes(&system)?;
        self.scheme.restore_bytes(&scheme)?;
        self.updates = updates;
        Ok(())
    }

    /// Copies of the simulated water: 2 with a mirror plane.
    fn halves(&self) -> f64 {
        if self.domain().mirror.is_some() { 2.0 } else { 1.0 }
    }

    fn of_both_halves(&self, momentum: [f64; 2]) -> [f64; 2] {
        if self.domain().mirror.is_some() { [0.0, 2.0 * momentum[1]] } else { momentum }
    }

    /// Mass, momentum, energy and volume, in one pass. Sums are taken by chunks, in order, so that their bits do not depend on the
    /// number of threads.
    pub fn totals(&self) -> Totals {
        let (p, halves, g) = (self.particles(), self.halves(), self.domain().gravity);
        let of = |k: usize| {
            let (m, u, v) = (p.mass[k], p.u[k], p.v[k]);
            let internal = self.scheme.internal_energy(&self.system, k);
            let [fx, fy] = p.rest(k);
            let held = m * (fx * p.x[k] + fy * p.y[k]);
            [m, m * u, m * v, 0.5 * m * (u * u + v * v), m * p.x[k], m * p.y[k], m * internal, m / p.rho[k], held]
        };
        let ([mass, mu, mv, kinetic, mx, my, elastic, volume, held], top_speed) =
            parallel::within_pool(|| (parallel::sum(p.len(), of), self.top_speed()));
        let potential = -(g[0] * mx + g[1] * my) - held + self.particles().released;
        Totals {
            mass: halves * mass,
            momentum: self.of_both_halves([mu, mv]),
            energy: FluidEnergy { kinetic: halves * kinetic, potential: halves * potential, elastic: halves * elastic },
            volume: halves * volume,
            height: my / mass,
            top_speed,
        }
    }

    /// Energies [J/m]; with a mirror plane, of both halves.
    pub fn energy(&self) -> FluidEnergy {
        self.totals().energy
    }

    /// Σ m v and Σ m |v| [N s/m]; with a mirror plane, the first of both halves, the second of one.
    pub fn momentum_and_its_scale(&self) -> ([f64; 2], f64) {
        let p = self.particles();
        let [mu, mv, held] = parallel::sum(p.len(), |k| {
            let (m, u, v) = (p.mass[k], p.u[k], p.v[k]);
            [m * u, m * v, m * (u * u + v * v).sqrt()]
        });
        (self.of_both_halves([mu, mv]), held)
    }

    /// Σ m v [N s/m]; with a mirror plane, of both halves.
    pub fn momentum(&self) -> [f64; 2] {
        self.momentum_and_its_scale().0
    }

    /// Σ m [kg/m]; with a mirror plane, of both halves.
    pub fn mass(&self) -> f64 {
        self.halves() * self.particles().mass.iter().sum::<f64>()
    }

    /// Force of gravity, and of what keeps graded water at rest (WC28, PR18) [N/m]; with a mirror plane, on both halves.
    pub fn external_force(&self) -> [f64; 2] {
        let (p, g, of_tank) = (self.particles(), self.domain().gravity, self.system.force_of_tank);
        let [fx, fy] = parallel::sum(p.len(), |k| p.rest(k).map(|f| p.mass[k] * f));
        let mass: f64 = p.mass.iter().sum();
        self.of_both_halves([mass * g[0] + fx + of_tank[0], mass * g[1] + fy + of_tank[1]])
    }

    /// True where that force may be another in each step: the tank carries a part of the water (WC29).
    pub fn external_force_varies(&self) -> bool {
        self.scheme.external_force_varies()
    }

    /// Σ m/ρ [m²]; with a mirror plane, of both halves.
    pub fn volume(&self) -> f64 {
        let p = self.particles();
        self.halves() * p.mass.iter().zip(&p.rho).map(|(m, rho)| m / rho).sum::<f64>()
    }

    /// Speed of the fastest particle [m/s].
    pub fn top_speed(&self) -> f64 {
        let p = self.particles();
        (-parallel::least(p.len(), |k| -(p.u[k] * p.u[k] + p.v[k] * p.v[k]))).sqrt()
    }

    /// WA11: the fluid particles that crossed the midline of a thin plate in the step just taken, in the order of the particles.
    pub fn passages(&self, walls: &Walls) -> Vec<Passage> {
        passages(self.particles(), &self.system.start_positions, &walls.midlines)
    }

    /// Fluid particles that may be beyond a wall's surface, in the order of the particles (THEORY WA7).
    pub fn contact_candidates(&self, walls: &Walls) -> Vec<usize> {
        contact::candidates(&self.system, walls)
    }

    /// Place a particle elsewhere [m]; the neighbour lists are rebuilt before they are next needed.
    pub fn place(&mut self, particle: usize, at: [f64; 2]) {
        [self.system.particles.x[particle], self.system.particles.y[particle]] = at;
        self.system.displaced = true;
    }

    /// WA7: put a particle that is beyond a surface back on it, and stop its approach; the impulse that the wall takes, or `None`
    /// where the particle does not approach. `inverse_mass` is the velocity along the normal that a unit impulse gives the wall
    /// [m/kg].
    pub fn resolve_contact(
        &mut self,
        particle: usize,
        surface: &contact::Surface,
        inverse_mass: impl FnOnce() -> f64,
    ) -> Option<contact::Impulse> {
        contact::resolve(&mut self.system, particle, surface, inverse_mass)
    }

    /// Memory of state, packed particles, lists and the scheme's arrays [bytes]. Not counted: saved states.
    pub fn bytes(&self) -> usize {
        self.bytes_by_use().iter().map(|(_, bytes)| bytes).sum()
    }

    /// The same by use [bytes].
    fn bytes_by_use(&self) -> Vec<(&'static str, usize)> {
        let ParticleSystem { particles, fields, packed, neighbours, wall_state, search_space, .. } = &self.system;
        let mut table = vec![
            ("state", particles.bytes()),
            ("fields", fields.bytes()),
            ("scheme", self.scheme.bytes()),
            ("wall state", of_vector(wall_state)),
            ("search", search_space.bytes()),
        ];
        table.extend(packed.bytes());
        table.extend(neighbours.bytes());
        table
    }
}
