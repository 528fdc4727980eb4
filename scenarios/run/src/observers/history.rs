//! Totals of the fluid over the run: energies, heights, penetration, largest speed.

use fsi_coupling::Breach;
use scene::{Scene, presses_on_walls};
use serde::{Deserialize, Serialize};

use super::surface_impulse::SurfaceImpulse;
use super::{Frame, ObserveError, Observer};

/// The state of rest, for scenes whose water should come, or stay, to rest.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Rest {
    /// Largest kinetic energy of the fluid at any sample [J/m].
    pub kinetic_peak_j_per_m: f64,
    /// Mean kinetic energy of the fluid over the last fifth of the run [J/m].
    pub kinetic_end_j_per_m: f64,
    /// Mean rise of the fluid's centre of mass over the last fifth of the run [m].
    pub center_rise_m: f64,
    /// Largest deviation from that mean in the last fifth [m].
    pub center_swing_m: f64,
}

/// The fluid particle that penetrated a wall deepest.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct WorstPenetration {
    /// The particle.
    pub particle: u32,
    /// Owner of the wall; empty for the plane of symmetry.
    pub wall: String,
    /// Where [m].
    pub x_m: f64,
    /// Where [m].
    pub y_m: f64,
    /// How deep beyond the surface [m].
    pub depth_m: f64,
    /// When [s].
    pub time_s: f64,
    /// When the first particle was found beyond a wall [s].
    pub first_s: f64,
}

impl WorstPenetration {
    /// A penetration sampled at `time_s` [s], in a run whose first was sampled at `first_s` [s].
    pub fn new(breach: &Breach, time_s: f64, first_s: f64) -> WorstPenetration {
        let Breach { id, at: [x_m, y_m], depth, ref owner } = *breach;
        WorstPenetration { particle: id, wall: owner.clone(), x_m, y_m, depth_m: depth, time_s, first_s }
    }
}

impl std::fmt::Display for WorstPenetration {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let wall = if self.wall.is_empty() { "the plane of symmetry" } else { &self.wall };
        write!(
            f,
            "water penetrates a wall since t = {:.5} s; deepest: particle {} at ({:.5}, {:.5}) m, {:.2e} m beyond `{wall}` at \
             t = {:.5} s",
            self.first_s, self.particle, self.x_m, self.y_m, self.depth_m, self.time_s
        )
    }
}

/// One sample.
#[derive(Clone, Serialize, Deserialize)]
struct Entry {
    time: f64,
    kinetic: f64,
    height: f64,
}

/// Gathers the fluid's energies at every sample.
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct History {
    entries: Vec<Entry>,
    ripple: f64,
    moving: f64,
    lowest: f64,
    highest: f64,
    penetrated: usize,
    worst: Option<WorstPenetration>,
    fastest: f64,
    /// Absent with walls that have no pressure of their own.
    surface: Option<SurfaceImpulse>,
}

impl History {
    /// No samples yet.
    pub fn new(scene: &Scene) -> History {
        let (spacing, g) = (scene.resolution.spacing, scene.gravity[1].abs());
        let ripple = 0.5 * scene.water().density * g * spacing * spacing * scene.tank.width;
        let surface = presses_on_walls(scene).then(SurfaceImpulse::default);
        History { ripple, surface, ..History::default() }
    }

    /// The largest energy exchanged [J/m], the scale of a drift. At least that of a ripple as
    /// high as a spacing over the whole tank, ½ρgΔx²L, so that water at rest has a scale.
    pub fn scale(&self) -> f64 {
        self.moving.max(self.highest - self.lowest).max(self.ripple).max(f64::MIN_POSITIVE)
    }

    /// Most particles found beyond a wall at any sample.
    pub fn penetrated(&self) -> usize {
        self.penetrated
    }

    /// The particle found deepest beyond a wall at any sample.
    pub fn worst_penetration(&self) -> Option<&WorstPenetration> {
        self.worst.as_ref()
    }

    /// Impulse of the pressure on a body's outline that the body did not get, as a share (THEORY CO39) [-].
    pub fn surface_gap(&self) -> Option<f64> {
        self.surface.as_ref()?.gap()
    }

    /// Fastest particle at any sample [m/s].
    pub fn fastest(&self) -> f64 {
        self.fastest
    }

    /// The state of rest over the samples from `since` [s] on.
    pub fn rest(&self, since: f64) -> Rest {
        let first = self.entries.first().map_or(0.0, |e| e.height);
        let late: Vec<&Entry> = self.entries.iter().filter(|e| e.time >= since).collect();
        let mean = |read: fn(&Entry) -> f64| late.iter().map(|e| read(e)).sum::<f64>() / late.len().max(1) as f64;
        let height = mean(|e| e.height);
        Rest {
            kinetic_peak_j_per_m: self.entries.iter().map(|e| e.kinetic).fold(0.0, f64::max),
            kinetic_end_j_per_m: mean(|e| e.kinetic),
            center_rise_m: height - first,
            center_swing_m: late.iter().map(|e| (e.height - height).abs()).fold(0.0, f64::max),
        }
    }
}

impl Observer for History {
    fn observe(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        let system = frame.system;
        let energy = frame.held.energy;
        let of_bodies: f64 = system.bodies().map(|b| b.energy().kinetic + b.energy().work.abs()).sum();
        let fall = energy.potential - system.fluid_energy_at_start().potential;
        self.moving = self.moving.max(energy.kinetic + of_bodies);
        (self.lowest, self.highest) = (self.lowest.min(fall), self.highest.max(fall));
        self.penetrated = self.penetrated.max(frame.penetration.count);
        if let Some(breach) = &frame.penetration.worst {
            let since = self.worst.as_ref().map_or(frame.time(), |worst| worst.first_s);
            if self.worst.as_ref().is_none_or(|worst| breach.depth > worst.depth_m) {
                self.worst = Some(WorstPenetration::new(breach, frame.time(), since));
            }
        }
        self.fastest = self.fastest.max(frame.held.top_speed);
        if let Some(surface) = &mut self.surface {
            surface.sample(system);
        }
        self.entries.push(Entry { time: frame.time(), kinetic: energy.kinetic, height: frame.held.height });
        Ok(())
    }
}
