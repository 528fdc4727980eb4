//! The vertical motion of a section that enters water, by boundary elements.

use super::super::entry::{Instant, SectionMotion};
use super::super::model::{EntryModel, OutOfRange};
use super::super::section::Section;
use super::before::Before;
use super::solution::FlowLoad;
use super::start::{AddedKeel, BEGIN, LATEST, ROUND_KEEL, begin_of_wedge, keels, latest_under_gravity, slowed_at};
use super::state::EntryFlow;

/// Steps before the flow begins.
const STEPS_BEFORE: usize = 64;
/// Share of the speed at contact below which the wedge counts as stopped.
pub(super) const STOPPED: f64 = 1e-3;
/// The same for a flow that ended.
const NEARLY_STOPPED: f64 = 0.05;
/// Depth of water in a side that counts as contact, over the half breadth [-].
const SIDE_DEPTH: f64 = 2e-3;

/// A section on its way into still water.
#[derive(Clone, Debug)]
pub struct FlowEntry<'a> {
    /// A wedge, an arc of a circle, or a polygon.
    pub section: &'a Section,
    /// How it moves.
    pub motion: SectionMotion,
    /// Draught of the keel at t = 0 [m]; negative above the water.
    pub draught: f64,
    /// Downward speed at t = 0 [m/s].
    pub speed: f64,
    /// Acceleration of gravity, downward [m/s²].
    pub gravity: f64,
    /// Density of the water ρ [kg/m³].
    pub density: f64,
}

/// Draught over the breadth below which a section starts at the water [-].
const TOUCHES: f64 = 1e-6;

/// A section at the times asked for as far as its flow was followed, its steps, and why not further.
pub type Followed = (Vec<Instant>, FlowHistory, Option<OutOfRange>);

/// The same, and whether the flow ended because it broke up.
struct Found {
    followed: Followed,
    breaks_up: bool,
}

/// A step of the motion.
#[derive(Clone, Debug)]
struct Step {
    now: Instant,
    /// Half breadth of the wet face [m].
    face: f64,
    /// x [m] and pressure [Pa] from the jet or the chine to the keel.
    pressure: Vec<[f64; 2]>,
}

/// A section's entry, step by step.
#[derive(Clone, Debug)]
pub struct FlowHistory {
    steps: Vec<Step>,
    times: Vec<f64>,
    impulse_at_contact: f64,
}

impl FlowEntry<'_> {
    /// Deepest draught under a section, over its breadth [-]: beyond, the surface next to wet chines breaks up.
    pub const DEEPEST: f64 = 1.0;

    /// The section at `times` [s], which increase from 0 on, as far as the flow can be followed, and why not further. Before the flow begins the
    /// load is that of the similar flow of a wedge, A V² + M dV/dt, and that of the modified Logvinovich model under a round bottom.
    ///
    /// # Errors
    /// As [`EntryFlow::new`]; a flow that cannot be followed for two steps.
    pub fn solve(&self, times: &[f64]) -> Result<Followed, OutOfRange> {
        let mut best: Option<Result<Found, OutOfRange>> = None;
        let reached = |found: &Result<Found, OutOfRange>| found.as_ref().map_or(0, |found| found.followed.0.len());
        EntryModel::BoundaryElement.covers(self.section, 0.0)?;
        if self.draught > 0.0 && self.draught < TOUCHES * 2.0 * self.section.half_breadth() {
            return FlowEntry { draught: 0.0, motion: self.motion.clone(), ..*self }.solve(times);
        }
        for keel in keels(self.section) {
            let found = self.solve_with(keel, times);
            // another keel does not help a flow that ended for a reason of its own
            let is_last = found.as_ref().is_ok_and(|found| !found.breaks_up);
            best = Some(match best {
                Some(best) if reached(&best) >= reached(&found) => best,
                _ => found,
            });
            if is_last {
                break;
            }
        }
        best.unwrap_or_else(|| self.solve_with(ROUND_KEEL, times)).map(|found| found.followed)
    }

    /// The same with a keel under a blunt bottom.
    fn solve_with(&self, keel: AddedKeel, times: &[f64]) -> Result<Found, OutOfRange> {
        let end = times.last().copied().unwrap_or(0.0);
        let first = EntryFlow::first_draught(self.section, keel).unwrap_or(0.0);
        if self.draught > 0.0 && self.draught < first {
            return Err(OutOfRange {
                what: format!("one that starts {:.4} m deep, where its flow begins {first:.4} m deep", self.draught),
                range: "blunt sections that start over or at the water, or deeper".into(),
                next: EntryModel::Wcsph,
            });
        }
        let start = [self.draught, self.speed];
        let [g, in_air, in_fall] = self.motion.contact(start, self.gravity);
        let kept = if self.draught <= 0.0 { self.motion.kept_at_contact(self.section, self.density) } else { 1.0 };
        let at_contact = kept * in_fall;
        let begin = self.begin(at_contact, end - in_air, g, keel);
        let mut flow = EntryFlow::with_keel(self.section, begin, at_contact, self.gravity, keel)?;
        let calm = EntryFlow { gravity: 0.0, ..flow.clone() };
        let before = Before::new(self.section, &calm, self.gravity)?;

        let nothing = FlowLoad { force: 0.0, added_mass: 0.0, pressure: vec![[0.0; 3]; 2] };
        let mut steps: Vec<Step> =
            fall(&self.motion, start, in_air, g).map(|state| self.step_of(state, &nothing, [0.0; 2])).collect();
        let mut time = in_air;
        if self.draught <= 0.0 {
            let speed;
            let keep = |state: [f64; 4], _: &[f64; 2]| {
                let load = before.load(state[1], state[2]);
                steps.push(self.step_of(state, &load, [load.half_breadth(); 2]));
            };
            let (forces, rate) =
                (|h: f64, v: f64| before.forces(h, v), |time: f64, of: &[f64; 2]| self.rate(time, *of));
            [time, speed] = until_the_flow(begin, before.grading(), [in_air, at_contact], forces, rate, keep);
            flow = flow.at_speed(speed);
        }
        let (more, is_wet_again) = self.followed(flow, &before, time, end, STOPPED * at_contact);
        steps.extend(more);
        if steps.len() < 2 {
            return Err(OutOfRange {
                what: format!("one whose flow breaks up at once, at a draught of {begin:.4} m"),
                range: "sections on their way down".into(),
                next: EntryModel::Wcsph,
            });
        }
        let touches = self.draught <= 0.0;
        let mass = if touches { self.density * self.section.mass_at_contact() } else { 0.0 };
        let history = FlowHistory {
            times: steps.iter().map(|step| step.now.time).collect(),
            steps,
            impulse_at_contact: mass * at_contact,
        };
        let reached = history.times.last().copied().unwrap_or(0.0);
        let instants: Vec<Instant> =
            times.iter().take_while(|time| **time <= reached).map(|time| history.at(*time)).collect();
        if instants.len() == times.len() {
            return Ok(Found { followed: (instants, history, None), breaks_up: false });
        }
        let now = history.steps[history.steps.len() - 1].now;
        let at = format!("from t = {:.4} s on, at a draught of {:.4} m", now.time, now.draught);
        if let Err(OutOfRange { what, range, next }) = EntryModel::BoundaryElement.covers(self.section, now.wetted) {
            let over = OutOfRange { what: format!("{what}, {at}"), range, next };
            return Ok(Found { followed: (instants, history, Some(over)), breaks_up: false });
        }
        let (why, breaks_up) = match now {
            _ if now.draught > self.deepest() => ("one deeper than its breadth", false),
            _ if is_wet_again => ("one whose water reaches a side or an outer part of the body", false),
            _ if now.speed < NEARLY_STOPPED * at_contact => ("one that leaves the water", false),
            _ => ("one whose flow breaks up", true),
        };
        let over = OutOfRange {
            what: format!("{why} {at}"),
            range: "sections on their way down, to a draught of their breadth".into(),
            next: EntryModel::Wcsph,
        };
        Ok(Found { followed: (instants, history, Some(over)), breaks_up })
    }

    /// The draught at which the flow begins [m]: a wedge's from a share of that at which its chines are wet, or at which it would be after
    /// the time `left` [s] in the water.
    fn begin(&self, at_contact: f64, left: f64, g: f64, keel: AddedKeel) -> f64 {
        match (self.draught, EntryFlow::first_draught(self.section, keel)) {
            (draught, _) if draught > 0.0 => draught,
            (_, Some(first)) => first,
            (draught, None) => {
                let wet = |x: f64| self.section.wagner_draught(x);
                let half_breadth = self.section.followed_half_breadth();
                let chines = wet(half_breadth);
                let last = match &self.motion {
                    SectionMotion::Given(way) => way.deepest(),
                    _ => draught.max(0.0) + at_contact * left + 0.5 * g * left * left,
                };
                let last = last.min(chines);
                let without_gravity = latest_under_gravity(at_contact, self.gravity, self.section.slope(0.0));
                let last = last.max(1e-9 * chines);
                let begin = if self.section.is_followed_as_wedge() {
                    let slowed = slowed_at(&self.motion, self.density).min(half_breadth);
                    begin_of_wedge(&self.motion, self.gravity, last, wet(slowed))
                } else {
                    BEGIN * last
                };
                begin.min(LATEST * wet(self.section.first_face()[0])).min(without_gravity)
            }
        }
    }

    fn deepest(&self) -> f64 {
        FlowEntry::DEEPEST * 2.0 * self.section.half_breadth()
    }

    /// The downward acceleration at a time [s] under a force and an added mass over the density [m/s²].
    fn rate(&self, time: f64, forces: [f64; 2]) -> f64 {
        rate(&self.motion, time, self.gravity, self.density, forces)
    }

    /// The steps of the flow from `time` to `end` [s], and whether water came to a side or an outer part of the body before.
    fn followed(
        &self,
        mut flow: EntryFlow,
        before: &Before,
        mut time: f64,
        end: f64,
        stopped: f64,
    ) -> (Vec<Step>, bool) {
        let mut steps = Vec::new();
        let mut is_wet_again = false;
        while !is_wet_again {
            let (draught, speed, width) = (flow.draught(), flow.speed(), flow.half_width());
            let rate = |load: &FlowLoad| self.rate(time, before.forces_instead_of(load, draught, speed));
            let Ok((dt, load)) = flow.step(rate) else { break };
            let load = before.instead_of(load, draught, speed);
            let face = load.half_breadth().min(self.section.followed_half_breadth());
            let rate = self.rate(time, [load.force, load.added_mass]);
            steps.push(self.step_of([time, draught, speed, rate], &load, [face, width]));
            let over = EntryModel::BoundaryElement.covers(self.section, width).is_err();
            if time >= end || speed < stopped || draught > self.deepest() || over {
                break;
            }
            is_wet_again = self.is_wet_again(&flow);
            time += dt;
            if let SectionMotion::Given(way) = &self.motion {
                let [draught, speed, _] = way.at(time);
                flow.place(draught, speed);
            }
        }
        (steps, is_wet_again)
    }

    /// Has water come into a side beyond the place where the flow leaves the bottom, or into what reaches farther out?
    fn is_wet_again(&self, flow: &EntryFlow) -> bool {
        if flow.surface().into_iter().any(|[x, y]| self.section.is_beyond([x, y + flow.draught()])) {
            return true;
        }
        let [inner, outer] = [self.section.followed_half_breadth(), self.section.half_breadth()];
        let depth = |[x, y]: [f64; 2]| y + flow.draught() - self.section.height(x);
        let past_bottom = |x: f64| inner < x && x < outer;
        inner < outer && flow.surface().into_iter().any(|at| past_bottom(at[0]) && depth(at) > SIDE_DEPTH * outer)
    }

    fn step_of(&self, [time, draught, speed, rate]: [f64; 4], load: &FlowLoad, [face, wetted]: [f64; 2]) -> Step {
        let rho = self.density;
        let force = rho * (load.force + load.added_mass * rate);
        Step {
            now: Instant { time, draught, speed, rate, force, wetted },
            face,
            pressure: load.pressure.iter().map(|[x, steady, added]| [*x, rho * (steady + added * rate)]).collect(),
        }
    }
}

/// Time, draught, downward speed and acceleration in air until `contact` [s].
pub(super) fn fall(
    motion: &SectionMotion,
    [draught, speed]: [f64; 2],
    contact: f64,
    g: f64,
) -> impl Iterator<Item = [f64; 4]> {
    let count = if contact > 0.0 { STEPS_BEFORE } else { 0 };
    let times = (0..count).map(move |k| contact * k as f64 / count as f64);
    times.map(move |time| match motion {
        SectionMotion::Given(way) => {
            let [draught, speed, rate] = way.at(time);
            [time, draught, speed, rate]
        }
        _ => [time, draught + speed * time + 0.5 * g * time * time, speed + g * time, g],
    })
}

/// The downward acceleration [m/s²] at a time [s] under an upward force [m³/s²] and an added mass [m²] over the density.
pub(super) fn rate(
    motion: &SectionMotion,
    time: f64,
    gravity: f64,
    density: f64,
    [force, added_mass]: [f64; 2],
) -> f64 {
    match motion {
        SectionMotion::Constant => 0.0,
        SectionMotion::Given(way) => way.at(time)[2],
        SectionMotion::Free(mass) => (mass * gravity - density * force) / (mass + density * added_mass),
    }
}

/// From contact at [time, speed] to the draught `begin` [m] under the `load` at a draught and a speed: midpoint rule in the draught, whose steps are
/// even or graded by a power. `keep` takes time, draught, speed and acceleration with the load. Returns time and speed at the end.
pub(super) fn until_the_flow<L>(
    begin: f64,
    grading: i32,
    [mut time, mut speed]: [f64; 2],
    load: impl Fn(f64, f64) -> L,
    rate: impl Fn(f64, &L) -> f64,
    mut keep: impl FnMut([f64; 4], &L),
) -> [f64; 2] {
    let even = begin / STEPS_BEFORE as f64;
    let graded = |k: usize| begin * (k as f64 / STEPS_BEFORE as f64).powi(grading);
    for k in 0..STEPS_BEFORE {
        let [draught, dh] = match grading {
            1 => [even * k as f64, even],
            _ => [graded(k), graded(k + 1) - graded(k)],
        };
        let now = load(draught, speed);
        let at_start = rate(time, &now);
        keep([time, draught, speed, at_start], &now);
        let half = speed + at_start * 0.5 * dh / speed;
        let in_middle = rate(time + 0.5 * dh / half, &load(draught + 0.5 * dh, half));
        time += dh / half;
        speed += in_middle * dh / half;
    }
    [time, speed]
}

impl FlowHistory {
    /// EN50: impulse that a flat keel gives the water at contact [N s/m], which no force here contains; 0 of other bottoms.
    pub fn impulse_at_contact(&self) -> f64 {
        self.impulse_at_contact
    }

    /// The section at a time [s], linear between steps.
    fn at(&self, time: f64) -> Instant {
        let (k, share) = self.between(time);
        Instant::between(&self.steps[k].now, &self.steps[k + 1].now, share, time)
    }

    /// Pressure [Pa] on the face at the distance `x` from the plane of symmetry [m], at a time [s]; linear between steps, at the same share of
    /// the wet face.
    pub fn pressure(&self, time: f64, x: f64) -> f64 {
        let (k, share) = self.between(time);
        let [a, b] = [&self.steps[k], &self.steps[k + 1]];
        let wet = a.face + share * (b.face - a.face);
        let on_face = x.abs() / wet;
        if on_face.is_nan() || on_face > 1.0 {
            return 0.0;
        }
        let [a, b] = [a, b].map(|step| step.pressure_at(on_face * step.face));
        a + share * (b - a)
    }

    /// The step before a time, and the share of it that has passed [-].
    fn between(&self, time: f64) -> (usize, f64) {
        let k = self.times.partition_point(|at| *at <= time).clamp(1, self.times.len() - 1) - 1;
        (k, ((time - self.times[k]) / (self.times[k + 1] - self.times[k])).clamp(0.0, 1.0))
    }
}

impl Step {
    fn pressure_at(&self, x: f64) -> f64 {
        let after = self.pressure.partition_point(|p| p[0] > x).clamp(1, self.pressure.len() - 1);
        let ([x0, p0], [x1, p1]) = (self.pressure[after - 1], self.pressure[after]);
        if x > x0 || x0 == x1 { 0.0 } else { p0 + (p1 - p0) * ((x0 - x) / (x0 - x1)).min(1.0) }
    }
}
