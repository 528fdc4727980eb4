//! Fully nonlinear potential flow about an entering section by boundary elements (THEORY EN20–EN24, EN30).
//!
//! The surface moves with the water (mixed Eulerian–Lagrangian; Longuet-Higgins & Cokelet 1976, Zhao & Faltinsen 1993), the jet is cut. Per stage
//! one matrix gives the velocity, the pressure and the added mass. At wet chines, and where a round bottom turns up, the flow separates (Zhao, Faltinsen & Aarsnes 1996).

mod before;
mod bending;
mod buffer;
mod cauchy;
mod deflection;
mod elements;
mod entry;
mod face;
mod factorised;
mod first_contact;
mod influence;
mod lanes;
mod lower_side;
mod rolled;
mod solution;
mod spline;
mod start;
mod state;
mod stepping;
mod surface;

use std::f64::consts::FRAC_2_PI;

use faer::c64;

pub use bending::{BendingBottom, BendingStepError, BendingWater, WaterOnBottom};
pub(crate) use buffer::Buffer;
pub use deflection::{AlongBottom, BottomMotion, Deflection};
pub use entry::{FlowEntry, FlowHistory};
pub(crate) use factorised::Factorised;
pub use rolled::{RolledEntry, RolledFlow, RolledInstant, RolledLoad};
pub use solution::FlowLoad;
pub use state::EntryFlow;

use elements::{Sizes, arc_length};
use face::Face;
use lower_side::LowerSide;
use solution::{Solution, Solved, SymmetricSolution};
use spline::Spline;
use start::{AddedKeel, BEGIN, LATEST, keels};
use surface::FreeSurface;

use super::model::{EntryModel, OutOfRange};
use super::section::Section;
use super::similarity::SimilarityFlow;

/// Largest growth of the draught per step.
const DRAUGHT_GROWTH: f64 = 0.03;
/// Distance to which the free surface reaches, over half the wetted breadth, at the start.
const FAR: f64 = 240.0;
/// Steps in which the load of a wedge's first flow comes from 0.7 to 0.1 % of the exact one.
const SETTLED: usize = 10;
/// Length beyond the chine at which the jet's end leaves it, over the finest element.
const PASSED: f64 = 2.0;

/// Length of a curved bottom under less than the pressure of the air next to the jet, over the finest element, from which the flow leaves it.
const DETACHED: f64 = 4.0;

/// Depth of a node in the bottom from which that is wet again, over the length of its element.
const INSIDE: f64 = 0.05;

/// The flow cannot be followed further.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the flow about the body ended at a draught of {draught:.4} m and a downward speed of {speed:.4} m/s")]
pub struct FlowEnded {
    /// Draught of the keel [m].
    pub draught: f64,
    /// Downward speed after the step that failed [m/s].
    pub speed: f64,
}

impl EntryFlow {
    /// A section whose keel has come to `draught` [m] at the constant downward `speed` [m/s] without gravity; from now on there is `gravity`
    /// [m/s²] in the water. Of a wedge the surface is the exact one (EN20); a round bottom is followed from its first draught (EN30).
    ///
    /// # Errors
    /// A section that is neither a wedge of [`BOUNDARY_ELEMENT_DEADRISES`] nor an arc nor a polygon of such faces; a draught or a speed that is not above zero; of a round
    /// bottom a draught below the first; wet chines.
    pub fn new(section: &Section, draught: f64, speed: f64, gravity: f64) -> Result<EntryFlow, OutOfRange> {
        EntryFlow::with_keel(section, draught, speed, gravity, keels(section)[0])
    }

    /// The same with a keel under a blunt bottom.
    fn with_keel(
        section: &Section,
        draught: f64,
        speed: f64,
        gravity: f64,
        keel: AddedKeel,
    ) -> Result<EntryFlow, OutOfRange> {
        EntryModel::BoundaryElement.covers(section, 0.0)?;
        let refused =
            |what: String, range: &str| Err(OutOfRange { what, range: range.into(), next: EntryModel::Wcsph });
        if !(draught > 0.0 && draught.is_finite() && speed > 0.0 && speed.is_finite()) {
            let range = "draughts and downward speeds above zero";
            return refused(format!("a draught of {draught} m and a speed of {speed} m/s"), range);
        }
        let Some(mut flow) = EntryFlow::first(section, draught, speed, keel) else {
            let deadrise = section.slope(0.0).atan().to_degrees();
            return refused(format!("a deadrise of {deadrise:.2} degrees"), "deadrises with a similarity solution");
        };
        let half_breadth = section.followed_half_breadth();
        if draught > section.wagner_draught(half_breadth) {
            let range = "sections with dry chines at the start";
            return refused(format!("one of {} m of breadth at a draught of {draught} m", 2.0 * half_breadth), range);
        }
        let ended = |_: FlowEnded| OutOfRange {
            what: format!("one whose flow ends before a draught of {draught} m"),
            range: "bottoms that boundary elements follow to the draught of the start".into(),
            next: EntryModel::Wcsph,
        };
        if section.is_followed_as_wedge() {
            // it begins at any draught
            for _ in 0..SETTLED {
                flow.step(|_| 0.0).map_err(ended)?;
            }
            flow = flow.scaled_to(draught);
        } else if section.is_blunt() && draught < flow.draught {
            let range = format!("round bottoms from a draught of {} m on", flow.draught);
            return refused(format!("one at a draught of {draught} m"), &range);
        }
        while flow.draught < draught {
            flow.step(|_| 0.0).map_err(ended)?;
        }
        flow.clear_past();
        Ok(EntryFlow { gravity, ..flow })
    }

    /// The first flow about a section on its way to a draught [m], at a downward speed [m/s]: of a wedge, at any draught; of a round bottom with a
    /// keel of an angle [deg].
    fn first(
        section: &Section,
        draught: f64,
        speed: f64,
        AddedKeel { deg: keel_deg, first }: AddedKeel,
    ) -> Option<EntryFlow> {
        let mut far = FAR;
        let (face, keel, draught, of_section) = match section.radius() {
            None if section.is_blunt() => {
                let keel = keel_deg.to_radians();
                let face = Face::curved(section, keel);
                let c = first * face.keel_half_width();
                far = far.max(BEGIN * FAR * section.followed_half_breadth() / c);
                let draught = face.draught_of(section, c);
                (face, keel_deg, FRAC_2_PI * keel.tan() * c, draught)
            }
            None => {
                let (keel, [x, y]) = (section.slope(0.0).atan(), section.first_face());
                let bends = section.followed().len() > 2;
                let draught = if bends { draught.min(LATEST * section.wagner_draught(x)) } else { 1e-3 * y };
                far = far.max(BEGIN * FAR * section.followed_half_breadth() * FRAC_2_PI * keel.tan() / draught);
                let face = match section.curve() {
                    Some(_) => Face::curved(section, keel),
                    None => Face::polygon(section.followed()),
                };
                (face, keel.to_degrees(), draught, draught)
            }
            Some(radius) => {
                let keel = keel_deg.to_radians();
                let c = first * radius * keel.sin();
                let face = Face::arc(radius, (section.half_breadth() / radius).min(1.0).asin(), keel);
                (face, keel_deg, FRAC_2_PI * keel.tan() * c, section.wagner_draught(c))
            }
        };
        let face = face.at_draught(draught);
        let sizes = if section.is_followed_as_wedge() { Sizes::WEDGE } else { Sizes::BENT };
        let similar = SimilarityFlow::solve(keel)?;
        // under a flat keel the first flow is that of the keel at its own speed
        let at_keel = if section.is_round() { speed } else { speed * face.keel_speed(0.0) };
        let surface = FreeSurface::similar(&similar, draught, at_keel, far / keel.to_radians().tan());
        let surface = surface.redistributed(LowerSide { face: &face, underside: None, sizes });
        Some(EntryFlow {
            surface,
            face,
            underside: None,
            draught: of_section,
            speed,
            drift: 0.0,
            gravity: 0.0,
            sizes,
            past: Vec::new(),
        })
    }

    /// The draught at which the flow about a blunt bottom begins [m]; `None` for a wedge.
    fn first_draught(section: &Section, keel: AddedKeel) -> Option<f64> {
        EntryFlow::first_half_width(section, keel).map(|half_width| section.wagner_draught(half_width))
    }

    /// And the half width that is wet then [m].
    fn first_half_width(section: &Section, AddedKeel { deg, first }: AddedKeel) -> Option<f64> {
        let keel = deg.to_radians();
        match section.radius() {
            Some(radius) => Some(first * radius * keel.sin()),
            None if section.is_blunt() => {
                let face = Face::curved(section, keel);
                let (least, from) = (face.keel_half_width(), face.grows_from());
                Some(if from > least { from } else { first * least })
            }
            None => None,
        }
    }

    /// The flow about a wedge at another draught [m]: all lengths in proportion to it.
    fn scaled_to(mut self, draught: f64) -> EntryFlow {
        self.clear_past();
        let length = draught / self.draught;
        EntryFlow { surface: self.surface.scaled(length, 1.0), face: self.face.at_draught(draught), draught, ..self }
    }

    /// The same with all velocities in proportion to a downward speed [m/s].
    fn at_speed(mut self, speed: f64) -> EntryFlow {
        self.clear_past();
        let share = speed / self.speed;
        EntryFlow { surface: self.surface.scaled(1.0, share), speed, drift: share * self.drift, ..self }
    }

    /// Load of the water now.
    pub fn load(&self) -> FlowLoad {
        self.solve().load
    }

    /// Let the flow leave the chine or a round bottom where it does so at a downward acceleration [m/s²]; true if it did.
    fn separate(&mut self, Solved { sides: [now], load, .. }: &SymmetricSolution, rate: f64) -> bool {
        if self.leaves_chine(now) {
            return true;
        }
        let Some(along) = self.detached(now, load, rate) else { return false };
        self.detach(now, along);
        true
    }

    /// EN24: true where the flow has left the chine.
    fn leaves_chine(&mut self, now: &Solution) -> bool {
        self.separated(now).map(|underside| self.underside = Some(underside)).is_some()
    }

    /// EN24: where the jet's end has passed a dry chine, what lies beyond it on the face's plane is a free surface from now on.
    fn separated(&self, now: &Solution) -> Option<FreeSurface> {
        let (face, end) = (&self.face, self.surface.end());
        let on_face = face.nearest(end, true);
        let beyond = on_face.along - face.length();
        let size = self.lower_side().finest(end);
        if self.underside.is_some() || beyond < PASSED * size {
            return None;
        }
        let s = arc_length(now.face());
        let phi = Spline::new(&s, now.phi_on_face().iter().copied());
        let count = (beyond / size).ceil().max(3.0);
        let at = (0..=count as usize).map(|k| beyond * k as f64 / count);
        let (z, phi) = at.map(|q| (on_face.z - on_face.tangent * q, phi.sample(q)[0])).unzip();
        Some(FreeSurface { z, phi, past: Vec::new() })
    }

    /// EN24: where the flow leaves a round bottom, as a distance from the keel [m]: beyond there the pressure is below that of the air.
    fn detached(&self, now: &Solution, load: &FlowLoad, rate: f64) -> Option<f64> {
        let from = load.pressure.iter().skip(1).position(|[_, steady, added]| steady + added * rate > 0.0)? + 1;
        let (along, size) = (now.along[from], self.lower_side().finest(self.surface.end()));
        let below = now.along[0] - along;
        (self.face.is_round(along) && below > DETACHED * size).then_some(along)
    }

    /// EN24: where the surface that left a round bottom has come back to it, the bottom is wet again.
    fn attached(mut self) -> EntryFlow {
        let Some(underside) = &mut self.underside else { return self };
        if self.face.length() >= self.face.whole_length() {
            return self;
        }
        let size = (underside.z[underside.z.len() - 1] - underside.z[underside.z.len() - 2]).norm();
        let inside = |z: &c64| {
            let on_face = self.face.nearest(*z, false);
            let away = -((z - on_face.z) * on_face.tangent.conj()).im;
            let past_edge = self.face.length() < on_face.along && on_face.along < self.face.whole_length(); // not past the chine
            (away < -INSIDE * size && past_edge).then_some(on_face)
        };
        let Some((k, on_face)) = underside.z.iter().enumerate().find_map(|(k, z)| Some((k, inside(z)?))) else {
            return self;
        };
        self.face = self.face.left_at(on_face.along);
        if k < 2 {
            self.underside = None;
            self.face = self.face.left_at(f64::INFINITY);
            self.clear_past();
            return self;
        }
        underside.z.truncate(k + 1);
        underside.phi.truncate(k + 1);
        underside.z[k] = on_face.z;
        self.clear_past();
        self
    }

    /// The bottom ends at a distance from the keel [m]; what is beyond is a free surface from now on.
    fn detach(&mut self, now: &Solution, along: f64) {
        let kept = now.along.iter().take_while(|at| **at >= along).count();
        let mut freed =
            FreeSurface { z: now.face()[..kept].to_vec(), phi: now.phi_on_face()[..kept].to_vec(), past: Vec::new() };
        if let Some(underside) = &self.underside {
            let before = underside.z.len() - 1;
            freed.z.splice(..0, underside.z[..before].iter().copied());
            freed.phi.splice(..0, underside.phi[..before].iter().copied());
        }
        self.underside = Some(freed);
        self.face = self.face.left_at(along);
    }
}

#[cfg(test)]
mod tests;
