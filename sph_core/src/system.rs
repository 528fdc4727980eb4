//! The particles of a run with their neighbours: what every scheme works on, without any scheme's own state.

use std::sync::Arc;

use crate::domain::Domain;
use crate::error::Breakdown;
use crate::interactions::geometry::PairConstants;
use crate::interactions::packed::Packed;
use crate::interactions::pair::Extrapolated;
use crate::neighbours::{Neighbours, SearchSpace};
use crate::parallel;
use crate::particles::{Fields, Particles};
use crate::refinement::RefinementZone;
use crate::state_bytes::{StateError, decode, encode, expect_count};
use crate::timers::{Phase, Timers};
use crate::walls::Walls;
use crate::walls::midline::PlateMidline;

/// Particles, their neighbours, and the arrays that the sums over pairs read.
#[derive(Default)]
pub struct ParticleSystem {
    /// Fluid properties, gravity, kernel, bounding planes.
    pub(crate) domain: Domain,
    /// State that lives from step to step.
    pub(crate) particles: Particles,
    /// Quantities that a step recomputes.
    pub(crate) fields: Fields,
    /// Neighbour lists. Shared with the states saved since they were made.
    pub(crate) neighbours: Arc<Neighbours>,
    /// Particles as the sums over pairs read them.
    pub(crate) packed: Packed,
    /// State of each wall particle, found from the fluid (WA3).
    pub(crate) wall_state: Vec<Extrapolated>,
    /// Time [s].
    pub(crate) time: f64,
    /// When forces are evaluated [s].
    pub(crate) evaluated_at: f64,
    /// Steps taken.
    pub(crate) steps: u64,
    /// Where coarse particles are split when the lists are rebuilt (THEORY WC21).
    pub(crate) refinement_zone: Option<RefinementZone>,
    /// Force of the tank on the water beside that of its wall particles (THEORY PR18) [N/m]; of the last step.
    pub(crate) force_of_tank: [f64; 2],
    /// A particle was moved outside a step: lists must be rebuilt.
    pub(crate) displaced: bool,
    /// Positions at the start of the step [m], by identity; empty without thin plates (WA11).
    pub(crate) start_positions: Vec<[f64; 2]>,
    /// What a search works in.
    pub(crate) search_space: SearchSpace,
    /// Wall time by phase.
    pub(crate) timers: Timers,
}

/// A state to return to.
pub(crate) struct SavedSystem {
    particles: Particles,
    fields: Fields,
    neighbours: Arc<Neighbours>,
    midlines: Vec<PlateMidline>,
    wall_state: Vec<Extrapolated>,
    clock: (f64, u64),
    displaced: bool,
}

impl ParticleSystem {
    /// PairConstants of the pairs without dissipation: those of the domain.
    pub(crate) fn constants(&self) -> PairConstants {
        let fluid = &self.domain.fluid;
        PairConstants {
            gravity: self.domain.gravity,
            rho0: fluid.density,
            c0: 1.0,
            delta: 0.0,
            alpha: 0.0,
            nu: fluid.kinematic_viscosity,
            stretch: 0.0,
        }
    }

    /// Put the walls where they are `offset` seconds from the step's end; true if the neighbour lists still hold there.
    pub(crate) fn place_walls(&mut self, walls: &Walls, offset: f64, with_mirror_points: bool) -> bool {
        self.timers.begin(Phase::Search);
        self.packed.place_walls(walls, offset);
        if with_mirror_points {
            self.packed.place_mirror_points(walls);
        }
        self.evaluated_at = self.time + walls.dt + offset;
        !self.displaced && self.neighbours.holds(&self.particles, &self.packed.kinematics(walls), self.evaluated_at)
    }

    /// Rebuild the lists, to last about `life` seconds, with a `skin` [h] of particles at rest; a saved state keeps those it was saved
    /// with.
    pub(crate) fn rebuild_lists(&mut self, walls: &Walls, life: f64, skin: f64) {
        self.displaced = false;
        if Arc::get_mut(&mut self.neighbours).is_none() {
            self.neighbours = Arc::new(Neighbours::made(self.neighbours.rebuilds));
        }
        let lists = Arc::get_mut(&mut self.neighbours).expect("lists that are not shared");
        let ParticleSystem { search_space, particles, fields, packed, .. } = self;
        let Domain { mirror, periodic, .. } = self.domain;
        let span = [self.evaluated_at, life, skin];
        lists.rebuild(search_space, particles, fields, &packed.kinematics(walls), (mirror, periodic), span);
    }

    /// Pack what the sums over pairs read, at the present positions and with the present lists.
    pub(crate) fn pack(&mut self, walls: &Walls) {
        self.timers.begin(Phase::Pack);
        let mirror = self.domain.mirror;
        self.packed.pack(&self.particles, &self.fields, walls, &self.neighbours, mirror, &self.wall_state);
    }

    /// Smallest smoothing length [m].
    pub(crate) fn least_smoothing_length(&self) -> f64 {
        parallel::least(self.particles.len(), |k| self.particles.h[k])
    }

    /// Particles that crossed the plane of symmetry change places with their images; `reflected` takes their identity.
    pub(crate) fn fold(&mut self, mut reflected: impl FnMut(u32)) {
        let (Some(mirror), p) = (self.domain.mirror, &mut self.particles) else { return };
        if parallel::every(p.x.len(), |k| p.x[k] >= mirror.at) {
            return;
        }
        for k in 0..p.x.len() {
            if p.x[k] < mirror.at {
                p.x[k] = mirror.reflect(p.x[k]);
                (p.u[k], p.ax[k]) = (-p.u[k], -p.ax[k]);
                if let (Some(rest), Some(home)) = (p.rest[0].get_mut(k), p.home[0].get_mut(k)) {
                    (*rest, *home) = (-*rest, mirror.reflect(*home));
                }
                reflected(p.id[k]);
            }
        }
    }

    /// Every particle must have a finite state and satisfy `accepts`.
    pub(crate) fn check(&self, accepts: impl Fn(usize) -> bool + Sync) -> Result<(), Breakdown> {
        let (p, time) = (&self.particles, self.time);
        let finite = |k: usize| (p.x[k] + p.y[k] + p.u[k] + p.v[k] + p.ax[k] + p.ay[k]).is_finite();
        let sound = |k: usize| finite(k) && accepts(k);
        if parallel::every(p.len(), sound) {
            return Ok(());
        }
        let k = (0..p.len()).find(|&k| !sound(k)).unwrap_or(0);
        let (id, x, y, rho) = (p.id[k], p.x[k], p.y[k], p.rho[k]);
        Err(match rho.is_finite() && finite(k) {
            true => Breakdown::Density { id, x, y, rho, time },
            false => Breakdown::NotFinite { id, x, y, time },
        })
    }

    /// The step fell to `dt` [s] because of particle `k`.
    pub(crate) fn collapsed(&self, k: usize, dt: f64) -> Breakdown {
        let p = &self.particles;
        let (speed, acceleration) = (p.u[k].hypot(p.v[k]), p.ax[k].hypot(p.ay[k]));
        Breakdown::Step { dt, id: p.id[k], x: p.x[k], y: p.y[k], speed, acceleration, time: self.time }
    }

    pub(crate) fn save(&self) -> SavedSystem {
        SavedSystem {
            particles: self.particles.clone(),
            fields: self.fields.clone(),
            neighbours: self.neighbours.clone(),
            midlines: self.packed.midlines.clone(),
            wall_state: self.wall_state.clone(),
            clock: (self.time, self.steps),
            displaced: self.displaced,
        }
    }

    /// What a step changes, as bytes.
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let neighbours: &Neighbours = &self.neighbours;
        let state = (&self.particles, &self.fields, neighbours, &self.packed.midlines, &self.wall_state);
        encode(&(state, (self.time, self.steps, self.displaced, &self.timers)))
    }

    /// Take that state, which has any number of particles.
    pub(crate) fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        type Stored = (Particles, Fields, Neighbours, Vec<PlateMidline>, Vec<Extrapolated>);
        let (state, clock): (Stored, (f64, u64, bool, Timers)) = decode("the particles", bytes)?;
        let (particles, fields, neighbours, midlines, wall_state) = state;
        particles.check(&self.particles)?;
        fields.check(particles.len(), &self.fields)?;
        neighbours.check(particles.len(), &self.neighbours)?;
        expect_count("wall particles with a state", wall_state.len(), self.wall_state.len())?;
        (self.particles, self.fields, self.neighbours) = (particles, fields, Arc::new(neighbours));
        (self.packed.midlines, self.wall_state) = (midlines, wall_state);
        (self.time, self.steps, self.displaced, self.timers) = clock;
        Ok(())
    }

    pub(crate) fn restore(&mut self, saved: &SavedSystem) {
        self.particles.clone_from(&saved.particles);
        self.fields.clone_from(&saved.fields);
        self.neighbours = saved.neighbours.clone();
        self.packed.midlines.clone_from(&saved.midlines);
        self.wall_state.clone_from(&saved.wall_state);
        (self.time, self.steps) = saved.clock;
        self.displaced = saved.displaced;
    }
}
