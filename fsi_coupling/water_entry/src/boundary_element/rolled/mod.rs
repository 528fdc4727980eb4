//! Fully nonlinear potential flow about a wedge with two deadrises that moves down, or obliquely, by boundary elements (THEORY EN34, EN35).
//!
//! Each side is one of a symmetric flow, x outwards: surface, cut of the jet and separation are its own. One matrix joins them.

mod contour;
mod entry;
mod solution;

pub use entry::{RolledEntry, RolledInstant};
pub use solution::RolledLoad;
use solution::RolledSolution;

use super::elements::Sizes;
use super::face::Face;
use super::lower_side::LowerSide;
use super::start::BEGIN;
use super::state::EntryFlow;
use super::stepping::step;
use super::surface::FreeSurface;
use super::{FAR, FlowEnded};
use crate::asymmetric_similarity::AsymmetricFlow;
use crate::model::{BOUNDARY_ELEMENT_DEADRISES, EntryModel, OutOfRange};

/// Size of the elements next to the jet over that of a symmetric flow, on flat and on steep faces: φ_t in the wedge's axes changes faster
/// than that at rest, most on steep faces.
const SIZES: [f64; 2] = [0.8, 0.6];
/// Deadrises between which it changes [deg].
const FLAT_AND_STEEP: [f64; 2] = [20.0, 35.0];

/// The water about a wedge with two deadrises that moves downwards, and sideways at a constant speed.
#[derive(Clone, Debug)]
pub struct RolledFlow {
    /// Right and left, x outwards.
    sides: [EntryFlow; 2],
}

impl RolledFlow {
    /// A wedge whose faces, left and right, have the `deadrises` [rad] and `lengths` [m] from the apex to the chine. The apex has come to `draught`
    /// [m] at the constant downward `speed` [m/s] without gravity; from now on there is `gravity` [m/s²] in the water. The surface is that of the
    /// similar flow.
    ///
    /// # Errors
    /// Deadrises outside [`BOUNDARY_ELEMENT_DEADRISES`] or of which there is no similar flow; a draught or a speed that is not above zero; a
    /// jet's tip past a chine.
    pub fn new(
        deadrises: [f64; 2],
        lengths: [f64; 2],
        draught: f64,
        speed: f64,
        gravity: f64,
    ) -> Result<RolledFlow, OutOfRange> {
        RolledFlow::oblique(deadrises, lengths, draught, [0.0, speed], gravity)
    }

    /// The same of a wedge that moves to the right and downwards with the speeds `[sideways, speed]` [m/s], the former constant (THEORY EN47).
    ///
    /// # Errors
    /// As [`RolledFlow::new`].
    pub fn oblique(
        deadrises: [f64; 2],
        lengths: [f64; 2],
        draught: f64,
        [sideways, speed]: [f64; 2],
        gravity: f64,
    ) -> Result<RolledFlow, OutOfRange> {
        let refused = |what: String, range: String| OutOfRange { what, range, next: EntryModel::Wcsph };
        let [least, most] = BOUNDARY_ELEMENT_DEADRISES;
        if let Some(deadrise) =
            deadrises.iter().map(|d| d.to_degrees()).find(|d| !(least - 1e-6..=most + 1e-6).contains(d))
        {
            return Err(refused(
                format!("a face of {deadrise:.2} degrees"),
                format!("faces of {least} to {most} degrees"),
            ));
        }
        if !(draught > 0.0 && draught.is_finite() && speed > 0.0 && speed.is_finite()) {
            let range = "draughts and downward speeds above zero";
            return Err(refused(format!("a draught of {draught} m and a speed of {speed} m/s"), range.into()));
        }
        let similar = AsymmetricFlow::oblique(deadrises[0], deadrises[1], sideways / speed)
            .map_err(|none| refused(none.as_case(), "wedges with a similarity solution".into()))?;
        // as far as if it began later: what is far from a small wedge is near to it once its chines are wet
        let wet = (0..2).map(|i| lengths[i] / similar.faces()[i].peak).fold(0.0, f64::max);
        let far = FAR * (BEGIN * wet / draught).max(1.0) / (0.5 * (deadrises[0] + deadrises[1])).tan();
        let side = |i: usize| {
            let sizes = Sizes { jet: element_size(deadrises[i]), ..Sizes::ROLLED };
            let face = Face::straight(deadrises[i], lengths[i]).at_draught(draught);
            let drift = [-sideways, sideways][i];
            let surface = FreeSurface::through(&similar.faces()[i].surface, drift / speed, draught, speed, far);
            let surface = surface.redistributed(LowerSide { face: &face, underside: None, sizes });
            EntryFlow { surface, face, underside: None, draught, speed, drift, gravity, sizes, past: Vec::new() }
        };
        let sides = [side(1), side(0)];
        if let Some(side) =
            sides.iter().find(|side| side.face.nearest(side.surface.end(), true).along > side.face.length())
        {
            let what = format!("one with a face of {} m at a draught of {draught} m", side.face.length());
            return Err(refused(what, "wedges with dry chines at the start".into()));
        }
        Ok(RolledFlow { sides })
    }

    /// The same with all velocities in proportion to a downward speed [m/s], and under a gravity [m/s²].
    fn at_speed(self, speed: f64, gravity: f64) -> RolledFlow {
        RolledFlow { sides: self.sides.map(|side| EntryFlow { gravity, ..side.at_speed(speed) }) }
    }

    /// Draught of the apex below still water [m].
    pub fn draught(&self) -> f64 {
        self.sides[0].draught
    }

    /// Downward speed [m/s].
    pub fn speed(&self) -> f64 {
        self.sides[0].speed
    }

    /// True where the flow has left the chine, left and right.
    pub fn chines_wet(&self) -> [bool; 2] {
        [self.sides[1].chines_wet(), self.sides[0].chines_wet()]
    }

    /// The free surfaces, left and right, from far away to the jet's cut and from there to a wet chine, [x, y] [m], x to the right
    /// from the apex, shape (n, 2).
    pub fn surfaces(&self) -> [Vec<[f64; 2]>; 2] {
        let left = self.sides[1].surface().into_iter().map(|[x, y]| [-x, y]).collect();
        [left, self.sides[0].surface()]
    }

    /// Load of the water now.
    pub fn load(&self) -> RolledLoad {
        solution::solve(&self.sides).load
    }

    /// One step. `acceleration` gives the downward acceleration [m/s²] under a load. Returns the step [s] and the load at
    /// its start.
    ///
    /// # Errors
    /// A wedge that has stopped, or a flow that is no longer finite; the state before the step is kept.
    pub fn step(&mut self, acceleration: impl Fn(&RolledLoad) -> f64) -> Result<(f64, RolledLoad), FlowEnded> {
        step(&mut self.sides, solution::solve, separate, acceleration)
    }
}

/// EN24 on each side: true where the flow has left a chine.
fn separate(sides: &mut [EntryFlow; 2], now: &RolledSolution, _: f64) -> bool {
    let left = [0, 1].map(|i| sides[i].leaves_chine(&now.sides[i]));
    left[0] || left[1]
}

/// Size of the elements next to the jet of a face over that of a symmetric flow [-].
fn element_size(deadrise: f64) -> f64 {
    let ([flat, steep], [of_flat, of_steep]) = (FLAT_AND_STEEP, SIZES);
    let share = ((deadrise.to_degrees() - flat) / (steep - flat)).clamp(0.0, 1.0);
    of_flat + share * (of_steep - of_flat)
}

#[cfg(test)]
mod tests;
