//! The motion of a wedge with two deadrises that enters water, down or obliquely, by boundary elements (THEORY EN34, EN47).

use super::{RolledFlow, RolledLoad};
use crate::asymmetric_similarity::AsymmetricFlow;
use crate::boundary_element::entry::{STOPPED, fall, rate, until_the_flow};
use crate::boundary_element::start::{begin_of_wedge, latest_under_gravity, slowed_at};
use crate::entry::SectionMotion;
use crate::model::{EntryModel, OutOfRange};

/// Deepest draught over the sum of the faces' lengths [-].
const DEEPEST: f64 = 1.0;

/// A wedge with two deadrises on its way into still water; pairs are left, right.
#[derive(Clone, Debug)]
pub struct RolledEntry {
    /// Deadrises of the faces [rad].
    pub deadrises: [f64; 2],
    /// Lengths of the faces from the apex to the chine [m].
    pub lengths: [f64; 2],
    /// How it moves; it does not turn.
    pub motion: SectionMotion,
    /// Draught of the apex at t = 0 [m]; negative above the water.
    pub draught: f64,
    /// Downward speed at t = 0 [m/s].
    pub speed: f64,
    /// Constant speed to the right [m/s]; 0 for a free wedge.
    pub sideways: f64,
    /// Acceleration of gravity, downward [m/s²].
    pub gravity: f64,
    /// Density of the water ρ [kg/m³].
    pub density: f64,
}

/// A rolled wedge at a moment; pairs of faces are left, right.
#[derive(Clone, Debug)]
pub struct RolledInstant {
    /// Time [s].
    pub time: f64,
    /// Draught of the apex [m].
    pub draught: f64,
    /// Downward speed [m/s].
    pub speed: f64,
    /// Downward acceleration [m/s²].
    pub rate: f64,
    /// Force of the water [F_x, F_y] [N/m].
    pub force: [f64; 2],
    /// Moment of the water about the apex, counter-clockwise [N].
    pub moment: f64,
    /// Lengths of the wet faces [m].
    pub wetted: [f64; 2],
    /// On the faces, from the jet or the chine to the apex: distance from the apex [m] and pressure [Pa], shape (n, 2); empty before contact.
    pub pressure: [Vec<[f64; 2]>; 2],
}

impl RolledEntry {
    /// The wedge step by step from t = 0 to `end` [s] or as far as the flow can be followed, and why not further. Before the flow begins the load is
    /// that of the similar flow, A V² + M dV/dt.
    ///
    /// # Errors
    /// As [`RolledFlow::new`]; a flow that cannot be followed for two steps.
    pub fn solve(&self, end: f64) -> Result<(Vec<RolledInstant>, Option<OutOfRange>), OutOfRange> {
        let start = [self.draught, self.speed];
        let [g, in_air, at_contact] = self.motion.contact(start, self.gravity);
        let begin = self.begin(at_contact, end - in_air, g)?;
        let similar = RolledFlow::oblique(self.deadrises, self.lengths, begin, [self.sideways, at_contact], 0.0)?;
        let nothing = RolledLoad::default();
        let mut instants: Vec<_> =
            fall(&self.motion, start, in_air, g).map(|state| self.instant(state, &nothing)).collect();
        let [mut time, mut speed] = [in_air, at_contact];
        if self.draught <= 0.0 {
            let (end, rate) = (similar.load(), |time: f64, load: &RolledLoad| self.rate(time, load));
            let load = |h: f64, v: f64| end.scaled(h / similar.draught(), v / similar.speed());
            let keep = |state: [f64; 4], load: &RolledLoad| instants.push(self.instant(state, load));
            [time, speed] = until_the_flow(similar.draught(), 1, [time, speed], load, rate, keep);
        }
        let followed = instants.len();
        let flow = similar.at_speed(speed, self.gravity);
        let why = self.follow(&mut instants, flow, time, end, STOPPED * at_contact);
        if instants.len() < followed + 2 {
            return Err(refuse(format!("one whose flow breaks up at once, at a draught of {begin:.4} m")));
        }
        let last = &instants[instants.len() - 1];
        let over = why
            .map(|why| refuse(format!("{why} from t = {:.4} s on, at a draught of {:.4} m", last.time, last.draught)));
        Ok((instants, over))
    }

    /// The draught at which the flow begins [m].
    fn begin(&self, at_contact: f64, left: f64, g: f64) -> Result<f64, OutOfRange> {
        if self.draught > 0.0 {
            return Ok(self.draught);
        }
        let similar = AsymmetricFlow::oblique(self.deadrises[0], self.deadrises[1], self.sideways / at_contact)
            .map_err(|none| refuse(none.as_case()))?;
        let wet = (0..2).map(|i| self.lengths[i] / similar.faces()[i].peak).fold(f64::INFINITY, f64::min);
        let last = (at_contact * left + 0.5 * g * left * left).min(wet);
        let slope = self.deadrises[0].max(self.deadrises[1]).tan();
        let without_gravity = latest_under_gravity(at_contact, self.gravity, slope);
        let half_width = |i: usize| similar.faces()[i].peak * self.deadrises[i].cos(); // per draught
        let slowed = slowed_at(&self.motion, self.density) / (0.5 * (half_width(0) + half_width(1)));
        Ok(begin_of_wedge(&self.motion, self.gravity, last.max(1e-9 * wet), slowed).min(without_gravity))
    }

    fn rate(&self, time: f64, load: &RolledLoad) -> f64 {
        rate(&self.motion, time, self.gravity, self.density, [load.force[1], load.added_mass[1]])
    }

    /// The steps of the flow from `time` to `end` [s]; why it ended earlier.
    fn follow(
        &self,
        instants: &mut Vec<RolledInstant>,
        mut flow: RolledFlow,
        mut time: f64,
        end: f64,
        stopped: f64,
    ) -> Option<&'static str> {
        loop {
            let [draught, speed] = [flow.draught(), flow.speed()];
            let Ok((dt, load)) = flow.step(|load| self.rate(time, load)) else {
                return Some("one whose flow breaks up");
            };
            instants.push(self.instant([time, draught, speed, self.rate(time, &load)], &load));
            if time >= end {
                return None;
            }
            if speed < stopped {
                return Some("one that leaves the water");
            }
            if draught > DEEPEST * (self.lengths[0] + self.lengths[1]) {
                return Some("one deeper than its breadth");
            }
            time += dt;
        }
    }

    fn instant(&self, [time, draught, speed, rate]: [f64; 4], load: &RolledLoad) -> RolledInstant {
        let rho = self.density;
        let pressure = load
            .pressure
            .each_ref()
            .map(|face| face.iter().map(|[s, steady, added]| [*s, rho * (steady + added * rate)]).collect::<Vec<_>>());
        RolledInstant {
            time,
            draught,
            speed,
            rate,
            force: [0, 1].map(|i| rho * (load.force[i] + load.added_mass[i] * rate)),
            moment: rho * (load.moment + load.added_moment * rate),
            wetted: pressure.each_ref().map(|face| face.first().map_or(0.0, |p| p[0])),
            pressure,
        }
    }
}

impl RolledInstant {
    /// The wedge at times between those of `steps`, linear [s]; pressures are those of the step before.
    pub fn between(steps: &[RolledInstant], time: f64) -> RolledInstant {
        let k = steps.partition_point(|step| step.time <= time).clamp(1, steps.len() - 1) - 1;
        let [a, b] = [&steps[k], &steps[k + 1]];
        let share = ((time - a.time) / (b.time - a.time)).clamp(0.0, 1.0);
        let mix = |a: f64, b: f64| a + share * (b - a);
        RolledInstant {
            time,
            draught: mix(a.draught, b.draught),
            speed: mix(a.speed, b.speed),
            rate: mix(a.rate, b.rate),
            force: [0, 1].map(|i| mix(a.force[i], b.force[i])),
            moment: mix(a.moment, b.moment),
            wetted: [0, 1].map(|i| mix(a.wetted[i], b.wetted[i])),
            pressure: a.pressure.clone(),
        }
    }

    /// Pressure [Pa] on the left (0) or the right (1) face at the distance `along` it from the apex [m].
    pub fn pressure_at(&self, face: usize, along: f64) -> f64 {
        let pressure = &self.pressure[face];
        let after = pressure.partition_point(|p| p[0] > along);
        if after == 0 || pressure.len() < 2 {
            return 0.0;
        }
        let after = after.min(pressure.len() - 1);
        let ([s0, p0], [s1, p1]) = (pressure[after - 1], pressure[after]);
        p0 + (p1 - p0) * (s0 - along) / (s0 - s1)
    }
}

impl RolledLoad {
    /// Of the similar flow with all lengths times `length` and all velocities times `speed`.
    fn scaled(&self, length: f64, speed: f64) -> RolledLoad {
        let square = speed * speed;
        RolledLoad {
            force: self.force.map(|f| f * length * square),
            moment: self.moment * length * length * square,
            added_mass: self.added_mass.map(|m| m * length * length),
            added_moment: self.added_moment * length.powi(3),
            pressure: self
                .pressure
                .each_ref()
                .map(|face| face.iter().map(|[s, p, m]| [s * length, p * square, m * length]).collect::<Vec<_>>()),
        }
    }
}

fn refuse(what: String) -> OutOfRange {
    OutOfRange {
        what,
        range: "wedges on their way down, to a draught of their breadth".into(),
        next: EntryModel::Wcsph,
    }
}

#[cfg(test)]
mod tests;
