//! Fluid particles found beyond a wall.

use fsi_coupling::Breach;
use serde::Serialize;

/// The fluid particle that penetrated a wall deepest.
#[derive(Clone, Debug, Serialize)]
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
