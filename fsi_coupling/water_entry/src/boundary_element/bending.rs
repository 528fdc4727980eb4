//! Flow about a bottom that bends: what its motion gives the water, and the step of both (THEORY EN51–EN53).

use faer::c64;

use super::super::model::{EntryModel, OutOfRange};
use super::super::section::Section;
use super::FlowEnded;
use super::cauchy::{Complex, Contour};
use super::deflection::{AlongBottom, BottomMotion};
use super::first_contact::{FirstContact, PlateLoad};
use super::solution::{Solution, SymmetricSolution};
use super::start::{keels, latest_under_gravity};
use super::state::EntryFlow;

/// Draught at which the flow about a bottom that bends begins, over that at which its chines are wet [-].
const BEGIN: f64 = 0.08;
/// Elements next to the jet, over those about a rigid bottom [-]: stress and deflection change by 0.6 %.
const JET: f64 = 1.5;
/// Half width at which a round bottom begins to bend, over that of its first flow [-].
const FIRST_WIDTH: f64 = 0.05;

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
    flow: Option<(&'a Contour, &'a Solution)>,
    /// The load at the first contact, and its share [-].
    first: Option<(&'a PlateLoad<'a>, f64)>,
    /// Distances of the nodes from the keel along the face, from the jet or the chine on [m].
    pub along: Vec<f64>,
    /// How far they are from the plane of symmetry [m].
    pub places: Vec<f64>,
    /// p/ρ there without accelerations [m²/s²].
    pub steady: Vec<f64>,
    /// Is it that of the middle of the step, or that of its start?
    pub in_middle: bool,
}

impl<'a> WaterOnBottom<'a> {
    /// About a bottom that bends, in a flow.
    fn of_flow(flow: &'a SymmetricSolution, contour: &'a Contour, in_middle: bool) -> WaterOnBottom<'a> {
        let solution = &flow.sides[0];
        let places = solution.face().iter().map(|z| z.re).collect();
        let steady = flow.load.pressure.iter().map(|[_, steady, _]| *steady).collect();
        let along = solution.along.clone();
        WaterOnBottom { flow: Some((contour, solution)), first: None, along, places, steady, in_middle }
    }

    /// At the first contact.
    fn of_first(load: &'a PlateLoad<'a>) -> WaterOnBottom<'a> {
        let places = load.places();
        let along = places.iter().map(|x| load.along(*x)).collect();
        let steady = load.steady(&places);
        WaterOnBottom { flow: None, first: Some((load, 1.0)), along, places, steady, in_middle: false }
    }

    /// With a share of the load at the first contact.
    fn mixed_with(self, first: Option<&'a (PlateLoad<'a>, f64)>) -> WaterOnBottom<'a> {
        let Some((load, share)) = first else { return self };
        let steady = mix(&self.steady, &load.steady(&self.places), *share);
        WaterOnBottom { first: Some((load, *share)), steady, ..self }
    }

    /// p/ρ at the nodes [m²/s²] due to accelerations of the bottom along it [m/s²].
    pub fn pressure_of(&self, acceleration: &AlongBottom) -> Vec<f64> {
        let at_first = self.first.map(|(load, share)| (load.pressure_of(acceleration, &self.places), share));
        let Some((contour, solution)) = self.flow else { return at_first.map_or_else(Vec::new, |(own, _)| own) };
        let n = solution.nodes.len();
        let contact = solution.contact;
        let psi = streamed(&self.along, solution.face(), |s| acceleration.sample(s)[0]);
        let mut rate = Complex {
            phi: vec![0.0; n],
            psi: (0..n).map(|k| if k < contact { 0.0 } else { psi[k - contact] }).collect(),
        };
        contour.solve(&mut rate);
        let of_flow: Vec<f64> = rate.phi[contact..].iter().map(|phi| -phi).collect();
        at_first.map_or(of_flow.clone(), |(own, share)| mix(&of_flow, &own, share))
    }
}

/// Values of a flow with a share of others.
fn mix(of_flow: &[f64], others: &[f64], share: f64) -> Vec<f64> {
    of_flow.iter().zip(others).map(|(flow, other)| flow + share * (other - flow)).collect()
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
        self.place(draught, speed);
        self.face = self.face.bent(deflection);
        let edge = self.face.edge();
        if let Some(at_chine) = self.underside.as_mut().and_then(|surface| surface.z.last_mut()) {
            *at_chine = edge;
        }
        self
    }

    /// EN53: one step of water and bottom together, no longer than `longest` [s]. Returns the step [s].
    fn step_with<B: BendingBottom>(
        &mut self,
        body: &mut B,
        longest: f64,
        first: Option<&FirstContact>,
    ) -> Result<f64, BendingStepError<B::Error>> {
        let at_first = |motion: BottomMotion| {
            let load =
                first.map(|first| Ok((first, first.load(motion)?))).transpose().map_err(BendingStepError::Flow)?;
            Ok(load.map(|(first, load)| {
                let share = 1.0 - first.share_of_flow(load.half_width);
                (load, share)
            }))
        };
        let mut now = self.clone().with_motion(body.motion(0.0));
        let (mut start, mut matrix) = now.solve_keeping_matrix();
        if now.leaves_chine(&start.sides[0]) {
            now.clear_past();
            (start, matrix) = now.solve_keeping_matrix();
        }
        let ended = |flow: &EntryFlow| BendingStepError::Flow(FlowEnded { draught: flow.draught, speed: flow.speed });
        let (dt, end) = if now.has_past() {
            let dt = now.extrapolated_dt(&start.sides[0]).min(longest);
            let own = at_first(body.motion(0.0))?;
            let water = WaterOnBottom::of_flow(&start, &matrix, false).mixed_with(own.as_ref());
            body.advance(dt, &water).map_err(BendingStepError::Structure)?;
            (dt, now.extrapolated(&start.sides[0], 0.0, dt))
        } else {
            let dt = now.stable_dt(&start.sides[0]).min(longest);
            let half = now.moved(now.speed, &start.sides[0], 0.0, 0.5 * dt).with_motion(body.motion(0.5 * dt));
            if !half.is_finite() {
                return Err(ended(&half));
            }
            let (middle, matrix) = half.solve_keeping_matrix();
            let own = at_first(body.motion(0.5 * dt))?;
            let water = WaterOnBottom::of_flow(&middle, &matrix, true).mixed_with(own.as_ref());
            body.advance(dt, &water).map_err(BendingStepError::Structure)?;
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

    /// The first flow about a bottom that has bent before.
    fn after_first(&self, load: &PlateLoad<'_>, draught: f64) -> EntryFlow {
        let flow = self.clone().at_speed(load.speed_of_rigid());
        let face = flow.face.at_draught(flow.face.draught + load.displacement_at_edge());
        EntryFlow { face, draught, ..flow }
    }
}

/// Water about one half of a symmetric bottom that bends: that at its first contact, then a flow.
pub struct BendingWater {
    flow: EntryFlow,
    /// Of a round bottom.
    first: Option<FirstContact>,
    /// Half widths at the first contact, now and when the flow begins [m]; `None` in the flow.
    widths: Option<[f64; 2]>,
}

impl BendingWater {
    /// Where a bottom begins to bend: rigid until then, it comes at a downward `speed` [m/s] under a `gravity` [m/s²] in the water; at `draught`
    /// [m] where that is later.
    ///
    /// # Errors
    /// As [`EntryFlow::new`]; a flat or nearly flat bottom.
    pub fn new(section: &Section, draught: f64, speed: f64, gravity: f64) -> Result<BendingWater, OutOfRange> {
        if section.is_blunt() && !section.is_round() {
            return Err(OutOfRange {
                what: "one with a flat keel, which bends when it meets the water at once".into(),
                range: "bottoms that bend with a keel or round".into(),
                next: EntryModel::Wcsph,
            });
        }
        let wet = section.wagner_draught(section.followed_half_breadth());
        let of_gravity = latest_under_gravity(speed, gravity, section.slope(0.0));
        let of_round = if section.is_round() { EntryFlow::first_half_width(section, keels(section)[0]) } else { None };
        let first = of_round.map_or((BEGIN * wet).min(of_gravity), |half_width| section.wagner_draught(half_width));
        let mut flow = EntryFlow::new(section, first.max(draught), speed, gravity)?;
        flow.sizes.jet *= JET;
        let Some(end) = of_round.filter(|_| draught < first) else {
            return Ok(BendingWater { flow, first: None, widths: None });
        };
        flow.draught = section.wagner_draught(FIRST_WIDTH * end).max(draught);
        let contact = FirstContact::new(section, &flow, gravity);
        let start = contact.half_width(&|half_width| section.wagner_draught(half_width) - flow.draught);
        Ok(BendingWater { flow, first: Some(contact), widths: Some([start, end]) })
    }

    /// Draught of the undeformed keel [m].
    pub fn draught(&self) -> f64 {
        self.flow.draught
    }

    /// The distance from the keel along the rigid bottom at which it is `x` [m] from the plane of symmetry.
    pub fn along_bottom(&self, x: f64) -> f64 {
        self.flow.along_bottom(x)
    }

    /// The half breadth of the bottom that the flow follows [m].
    pub fn bottom_half_breadth(&self) -> f64 {
        self.flow.face.rigid_place(self.flow.face.whole_length()).z.re
    }

    /// Half breadth of the wet part, in a flow that between the ends of the jets [m].
    pub fn half_width(&self) -> f64 {
        self.widths.map_or_else(|| self.flow.half_width(), |[now, _]| now)
    }

    /// Has the flow left the chines?
    pub fn chines_wet(&self) -> bool {
        self.flow.chines_wet()
    }

    /// One step of water and bottom together, no longer than `longest` [s]. Returns the step [s].
    ///
    /// # Errors
    /// A flow that breaks up, or the structure's; the flow before the step is kept.
    pub fn step_with<B: BendingBottom>(
        &mut self,
        body: &mut B,
        longest: f64,
    ) -> Result<f64, BendingStepError<B::Error>> {
        if let (Some(first), Some([_, end])) = (&self.first, self.widths) {
            let motion = body.motion(0.0);
            let draught = motion.draught;
            let load = first.load(motion).map_err(BendingStepError::Flow)?;
            if load.half_width < end {
                let dt = load.longest_dt().min(longest);
                self.flow.draught = draught;
                self.widths = Some([load.half_width, end]);
                body.advance(dt, &WaterOnBottom::of_first(&load)).map_err(BendingStepError::Structure)?;
                return Ok(dt);
            }
            self.flow = self.flow.after_first(&load, draught);
            self.widths = None;
        }
        let dt = self.flow.step_with(body, longest, self.first.as_ref())?;
        if self.first.as_ref().is_some_and(|first| first.share_of_flow(self.flow.half_width()) >= 1.0) {
            self.first = None;
        }
        Ok(dt)
    }
}
