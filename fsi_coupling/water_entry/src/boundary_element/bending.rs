//! Flow about a bottom that bends: what its motion gives the water, and the step of both (THEORY EN51–EN53).

use faer::c64;

use super::super::model::{EntryModel, OutOfRange};
use super::super::section::Section;
use super::FlowEnded;
use super::cauchy::{Complex, Contour};
use super::deflection::{AlongBottom, Deflection};
use super::entry::LATEST_UNDER_GRAVITY;
use super::solution::{Solution, SymmetricSolution};
use super::state::EntryFlow;

/// Draught at which the flow about a bottom that bends begins, over that at which its chines are wet [-].
const BEGIN: f64 = 0.08;
/// Elements next to the jet, over those about a rigid bottom [-]: stress and deflection change by 0.6 %.
const JET: f64 = 1.5;

/// The stream function that a bending bottom gives, at the nodes of the face.
pub(super) struct Bending {
    /// Beyond that of the rigid motion [m²/s].
    pub psi: Vec<f64>,
    /// Rate at a place that moves with the bottom [m²/s²].
    rate: Vec<f64>,
    /// Velocity of the bottom [m/s].
    velocity: Vec<c64>,
}

impl Bending {
    /// EN52: ψ_t at node k of the face, where the water has a velocity [m²/s²].
    pub fn rate_of_psi(&self, k: usize, water: c64) -> f64 {
        let body = self.velocity[k];
        self.rate[k] + body.re * water.im - body.im * water.re
    }
}

/// Motion of a bottom that bends.
#[derive(Clone, Debug)]
pub struct BottomMotion {
    /// Draught of the undeformed keel [m].
    pub draught: f64,
    /// Downward speed of the frame [m/s].
    pub speed: f64,
    /// Against the frame.
    pub deflection: Deflection,
}

/// A body whose bottom bends, one side of a symmetric one.
pub trait BendingBottom {
    /// Why it cannot move on.
    type Error;

    /// Its motion at a time from now [s].
    fn motion(&self, ahead: f64) -> BottomMotion;

    /// EN53: advance by `dt` [s] under the water's load, found together with its accelerations.
    ///
    /// # Errors
    /// The structure's.
    fn advance(&mut self, dt: f64, water: &WaterOnBottom<'_>) -> Result<(), Self::Error>;
}

/// The water's pressure on one side of a bottom, as a function of its accelerations; over the density.
pub struct WaterOnBottom<'a> {
    contour: &'a Contour,
    solution: &'a Solution,
    /// Distances of the nodes from the keel along the face, from the jet or the chine on [m].
    pub along: &'a [f64],
    /// Where they are [m].
    pub places: &'a [c64],
    /// p/ρ there without accelerations [m²/s²].
    pub steady: Vec<f64>,
    /// Is it that of the middle of the step, or that of its start?
    pub in_middle: bool,
}

impl WaterOnBottom<'_> {
    /// p/ρ at the nodes [m²/s²] due to accelerations of the bottom along it [m/s²].
    pub fn pressure_of(&self, acceleration: &AlongBottom) -> Vec<f64> {
        let n = self.solution.nodes.len();
        let contact = self.solution.contact;
        let psi = streamed(self.along, self.places, |s| acceleration.sample(s)[0]);
        let mut rate = Complex {
            phi: vec![0.0; n],
            psi: (0..n).map(|k| if k < contact { 0.0 } else { psi[k - contact] }).collect(),
        };
        self.contour.solve(&mut rate);
        rate.phi[contact..].iter().map(|phi| -phi).collect()
    }
}

/// ∫ Im(v̄ dz) from the keel to each node of the face, by Simpson's rule; `of` gives v at a distance from the keel.
fn streamed(along: &[f64], places: &[c64], of: impl Fn(f64) -> c64) -> Vec<f64> {
    let last = along.len() - 1;
    let mut psi = vec![0.0; along.len()];
    for k in (0..last).rev() {
        let [from, to] = [along[k + 1], along[k]];
        let mean = (of(from) + of(0.5 * (from + to)) * 4.0 + of(to)) / 6.0;
        psi[k] = psi[k + 1] + (mean.conj() * (places[k] - places[k + 1])).im;
    }
    psi
}

/// Why a step of water and bottom failed.
#[derive(Debug, thiserror::Error)]
pub enum BendingStepError<E> {
    /// The flow.
    #[error(transparent)]
    Flow(FlowEnded),
    /// The structure.
    #[error(transparent)]
    Structure(E),
}

impl EntryFlow {
    /// EN51, EN52 at nodes of the face, at distances from the keel along it.
    pub(super) fn bending(&self, along: &[f64]) -> Bending {
        let places: Vec<c64> = along.iter().map(|s| self.face.place(*s).z).collect();
        let psi = streamed(along, &places, |s| self.face.velocity(s));
        let velocity: Vec<c64> = along.iter().map(|s| self.body_velocity(*s)).collect();
        let mut rate = vec![0.0; along.len()];
        for k in (0..along.len() - 1).rev() {
            let mean = 0.5 * (velocity[k] + velocity[k + 1]);
            rate[k] = rate[k + 1] + (mean.conj() * (velocity[k] - velocity[k + 1])).im;
        }
        Bending { psi, rate, velocity }
    }

    /// The flow about a bottom that bends, when it begins: about the rigid one at a downward `speed` [m/s] under a `gravity` [m/s²] in the water; at
    /// `draught` [m] where that is later.
    ///
    /// # Errors
    /// As [`EntryFlow::new`]; a bottom without a keel.
    pub fn before_bending(section: &Section, draught: f64, speed: f64, gravity: f64) -> Result<EntryFlow, OutOfRange> {
        let wet = section.wagner_draught(section.followed_half_breadth());
        let of_gravity = LATEST_UNDER_GRAVITY * speed * speed / gravity.max(f64::MIN_POSITIVE);
        if section.is_blunt() {
            return Err(OutOfRange {
                what: "one without a keel, which bends at the first contact".into(),
                range: "bottoms with a keel that bend".into(),
                next: EntryModel::Wcsph,
            });
        }
        let first = (BEGIN * wet).min(of_gravity);
        let mut flow = EntryFlow::new(section, first.max(draught), speed, gravity)?;
        flow.sizes.jet *= JET;
        Ok(flow)
    }

    /// The distance from the keel along the rigid bottom at which it is `x` [m] from the plane of symmetry.
    pub fn along_bottom(&self, x: f64) -> f64 {
        let face = &self.face;
        let (mut low, mut high) = (0.0, face.whole_length());
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if face.rigid_place(middle).z.re < x { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// The half breadth of the bottom that the flow follows [m].
    pub fn bottom_half_breadth(&self) -> f64 {
        self.face.rigid_place(self.face.whole_length()).z.re
    }

    /// The same flow about the bottom where it is now.
    fn with_motion(mut self, BottomMotion { draught, speed, deflection }: BottomMotion) -> EntryFlow {
        let of_keel = self.face.keel_speed(self.half_width()) * (draught - self.draught);
        self.face = self.face.at_draught(self.face.draught + of_keel).bent(deflection);
        (self.draught, self.speed) = (draught, speed);
        let edge = self.face.edge();
        if let Some(at_chine) = self.underside.as_mut().and_then(|surface| surface.z.last_mut()) {
            *at_chine = edge;
        }
        self
    }

    /// EN53: one step of water and bottom together, no longer than `longest` [s]. Returns the step [s].
    ///
    /// # Errors
    /// A flow that breaks up, or the structure's; the flow before the step is kept.
    pub fn step_with<B: BendingBottom>(
        &mut self,
        body: &mut B,
        longest: f64,
    ) -> Result<f64, BendingStepError<B::Error>> {
        let mut now = self.clone().with_motion(body.motion(0.0));
        let (mut start, mut matrix) = now.solve_keeping_matrix();
        if now.leaves_chine(&start.sides[0]) {
            now.clear_past();
            (start, matrix) = now.solve_keeping_matrix();
        }
        let ended = |flow: &EntryFlow| BendingStepError::Flow(FlowEnded { draught: flow.draught, speed: flow.speed });
        let (dt, end) = if now.has_past() {
            let dt = now.extrapolated_dt(&start.sides[0]).min(longest);
            body.advance(dt, &start.on_bottom(&matrix, false)).map_err(BendingStepError::Structure)?;
            (dt, now.extrapolated(&start.sides[0], 0.0, dt))
        } else {
            let dt = now.stable_dt(&start.sides[0]).min(longest);
            let half = now.moved(now.speed, &start.sides[0], 0.0, 0.5 * dt).with_motion(body.motion(0.5 * dt));
            if !half.is_finite() {
                return Err(ended(&half));
            }
            let (middle, matrix) = half.solve_keeping_matrix();
            body.advance(dt, &middle.on_bottom(&matrix, true)).map_err(BendingStepError::Structure)?;
            (dt, now.moved(half.speed, &middle.sides[0], 0.0, dt))
        };
        let too_short = now.is_too_short(dt) && dt < longest;
        let end = EntryFlow { draught: now.draught, face: now.face.clone(), ..end }.with_motion(body.motion(0.0));
        if !end.is_finite() || !start.force.is_finite() || too_short {
            return Err(ended(&end));
        }
        *self = end.after(&now, &start.sides[0], 0.0, dt).attached().redistributed();
        Ok(dt)
    }
}

impl SymmetricSolution {
    fn on_bottom<'a>(&'a self, contour: &'a Contour, in_middle: bool) -> WaterOnBottom<'a> {
        let solution = &self.sides[0];
        let steady = self.load.pressure.iter().map(|[_, steady, _]| *steady).collect();
        WaterOnBottom { contour, solution, along: &solution.along, places: solution.face(), steady, in_middle }
    }
}
