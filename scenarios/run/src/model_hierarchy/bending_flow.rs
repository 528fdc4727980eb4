//! A body whose bottom bends, in water that boundary elements follow (THEORY EN51–EN53).

use std::collections::BTreeMap;

use fsi_coupling::{BendingEntry, BottomPressure, RigidMotion};
use scene::validity::panels::StressPeak;
use scene::{Body, Motion, Scene, Symmetry, rows};
use settings::significant;
use water_entry::{
    BOUNDARY_ELEMENT_DEADRISES, BendingWater, Entry, EntryModel, Instant, Loads, OutOfRange, Section, SectionMotion,
};

use super::upright::at_start;
use crate::build::moving;
use crate::observers::{modal_values, panel_values};
use crate::panel::PanelResult;

/// Instants before the flow begins.
const BEFORE: usize = 200;
/// Steps in a row of which all but one turn the force, by more than a share of the largest so far: a step that is too long for the panel, or
/// elements that are too short [-].
const CHATTER: usize = 8;
const CHATTERS: f64 = 0.05;
/// Share of the largest force that suction takes off, from which air comes in [-].
const SUCTION: f64 = 0.05;

/// A body followed step by step.
#[derive(Clone, Debug)]
pub(super) struct BendingFlow {
    /// The body at the end of each step.
    steps: Vec<Step>,
    /// In each step, at their times: mean upward force [N/m]; pressure on the bottom.
    forces: Vec<[f64; 2]>,
    /// Before the flow begins; density of the water [kg/m³] and gravity [m/s²].
    loads: Loads,
    density: f64,
    gravity: f64,
    pressures: Vec<BottomPressure>,
    /// When suction first takes a share off the force from which air comes in [s], and the largest share [-].
    pub suction: Option<[f64; 2]>,
    /// Extremes of its panels over all steps.
    pub panels: BTreeMap<String, PanelResult>,
    /// Largest stress of each.
    pub stresses: Vec<StressPeak>,
}

/// The body at a moment.
#[derive(Clone, Debug)]
struct Step {
    /// Its force is that of the water in `forces`.
    now: Instant,
    /// Values of the columns of panels or modes.
    columns: Vec<f64>,
}

fn refuse(what: String) -> OutOfRange {
    OutOfRange {
        what,
        range: "panels or modes of a body with a keel or a round bottom that is simulated by half (symmetry = \"x\"), on its way down, from dry chines on".into(),
        next: EntryModel::Wcsph,
    }
}

impl BendingFlow {
    /// Is a scene within its range at the start?
    ///
    /// # Errors
    /// A body that is simulated whole; a flat bottom, all of which meets the water at once.
    pub fn check(scene: &Scene, section: &Section) -> Result<(), OutOfRange> {
        let steep = section.slope(0.0).atan().to_degrees();
        match scene.symmetry {
            Symmetry::X if steep >= BOUNDARY_ELEMENT_DEADRISES[0] || section.is_round() => Ok(()),
            Symmetry::X => Err(refuse("one with a flat keel, which bends when it meets the water at once".into())),
            _ => Err(refuse("a body that is simulated whole".into())),
        }
    }

    /// Follow the body of a scene by half; also why it was not followed to the end.
    pub fn of(
        scene: &Scene,
        body: &Body,
        section: &Section,
        motion: SectionMotion,
    ) -> Result<(BendingFlow, Option<OutOfRange>), OutOfRange> {
        BendingFlow::check(scene, section)?;
        let (density, gravity) = (scene.water().density, -scene.gravity[1]);
        let wrong = |error: &dyn std::fmt::Display| refuse(error.to_string());
        let moved = |by: f64, speed: f64| {
            let [x, y] = body.position;
            RigidMotion { position: [x, y - by], velocity: [0.0, -speed], ..RigidMotion::default() }
        };
        let whole = moving(scene, body, &rows(scene), (moved(0.0, 1.0), 0.0)).map_err(|error| wrong(&error))?;
        let columns = columns_of(&*whole).len();
        // rigid, by the modified Logvinovich model, until the flow begins; its mass is its momentum at 1 m/s
        let motion = match motion {
            SectionMotion::Free(_) => SectionMotion::Free(-whole.momentum().momentum[1]),
            given => given,
        };
        let before = Before::of(scene, body, section, motion)?;
        let Before { start, draught, speed, .. } = before;
        let water = BendingWater::new(section, draught, speed, gravity)?;
        let later = later(body, start);
        let motion = moved(water.draught() - body.draught(), speed);
        let built = moving(scene, &later, &rows(scene), (motion, start)).map_err(|error| wrong(&error))?;
        let mut entry = BendingEntry::new(built, section, water, density).map_err(|error| wrong(&error))?;
        let mut found = BendingFlow {
            steps: before.instants.iter().map(|now| Step::rigid(now, columns)).collect(),
            forces: before.instants.iter().map(|now| [now.time, now.force]).collect(),
            loads: before.loads,
            density,
            gravity,
            pressures: Vec::new(),
            suction: None,
            panels: BTreeMap::new(),
            stresses: Vec::new(),
        };
        found.steps.push(Step::of(&entry, start));
        let mut over = None;
        let end = scene.time.end - start;
        while entry.time() < end * (1.0 - 1e-12) {
            let before = entry.time() + start;
            let stepped = entry.step(end);
            if let Err(error) = stepped {
                let at = format!("one of which, from t = {} s on, {error}", significant(before));
                over = Some(refuse(at));
                break;
            }
            let step = Step::of(&entry, start);
            found.forces.push([0.5 * (before + step.now.time), step.now.force]);
            if !entry.pressure().places.is_empty() {
                let BottomPressure { time, places } = entry.pressure().clone();
                found.pressures.push(BottomPressure { time: time + start, places });
            }
            if chatters(&found.forces) {
                let at = significant(before);
                over = Some(refuse(format!(
                    "one whose panels are too soft or light, the force on which turns in every step from t = {at} s on"
                )));
                break;
            }
            let risen = step.now.speed <= 0.0;
            found.steps.push(step);
            if risen {
                over = Some(refuse(format!(
                    "one that leaves the water from t = {} s on",
                    significant(entry.time() + start)
                )));
                break;
            }
        }
        found.suction = suction(&found.forces, &found.pressures);
        let panels = entry.body().panels();
        found.panels = panels.iter().map(|panel| (panel.name.clone(), PanelResult::from(panel))).collect();
        found.stresses = panels.iter().map(StressPeak::from).collect();
        let modes = entry.body().modes();
        found.stresses.extend(modes.as_ref().and_then(StressPeak::of_modes));
        Ok((found, over))
    }

    /// The body at `times` [s], as far as it was followed.
    pub fn instants(&self, times: &[f64]) -> Vec<Instant> {
        let end = self.steps[self.steps.len() - 1].now.time * (1.0 + 1e-9);
        times.iter().take_while(|time| **time <= end).map(|time| self.at(*time)).collect()
    }

    fn at(&self, time: f64) -> Instant {
        let (k, share) = between(&self.steps, |step| step.now.time, time);
        let (a, b) = (&self.steps[k], &self.steps[(k + 1).min(self.steps.len() - 1)]);
        Instant { force: self.force(time), ..Instant::between(&a.now, &b.now, share, time) }
    }

    /// Upward force [N/m]: means of steps, linear between their middles.
    fn force(&self, time: f64) -> f64 {
        let [Some(first), Some(last)] = [self.forces.first(), self.forces.last()] else { return 0.0 };
        if time <= first[0] {
            return first[1];
        }
        if time >= last[0] {
            return last[1];
        }
        let (k, share) = between(&self.forces, |force| force[0], time);
        self.forces[k][1] + share * (self.forces[k + 1][1] - self.forces[k][1])
    }

    /// Values of the columns of panels or modes at a time [s].
    pub fn columns(&self, time: f64) -> Vec<f64> {
        let (k, share) = between(&self.steps, |step| step.now.time, time);
        let (a, b) = (&self.steps[k], &self.steps[(k + 1).min(self.steps.len() - 1)]);
        a.columns.iter().zip(&b.columns).map(|(a, b)| a + share * (b - a)).collect()
    }

    /// Pressure [Pa] at a distance `x` from the plane of symmetry [m], at a time [s]: linear between steps at the same share of the wet
    /// bottom.
    pub fn pressure(&self, time: f64, x: f64) -> f64 {
        if self.pressures.first().is_none_or(|first| time < first.time) {
            let Instant { draught, speed, rate, .. } = self.at(time);
            let at_rest = self.density * self.gravity * (draught - self.loads.section().height(x)).max(0.0);
            return self.loads.pressure(x, draught, speed, rate, self.density).unwrap_or(0.0) + at_rest;
        }
        let (k, share) = between(&self.pressures, |pressure| pressure.time, time);
        let (a, b) = (&self.pressures[k].places, &self.pressures[(k + 1).min(self.pressures.len() - 1)].places);
        let wet = a[0][0] + share * (b[0][0] - a[0][0]);
        let on_face = x.abs() / wet;
        if on_face > 1.0 {
            return 0.0;
        }
        let [a, b] = [a, b].map(|places| at_place(places, on_face * places[0][0]));
        a + share * (b - a)
    }
}

impl Step {
    /// Before the flow begins, with a number of columns.
    fn rigid(now: &Instant, columns: usize) -> Step {
        Step { now: *now, columns: vec![0.0; columns] }
    }

    /// In a flow that began at `start` [s].
    fn of(entry: &BendingEntry, start: f64) -> Step {
        let motion = entry.body().motion().unwrap_or_default();
        let now = Instant {
            time: entry.time() + start,
            draught: entry.draught(),
            speed: -motion.velocity[1],
            rate: -motion.acceleration[1],
            force: motion.force[1],
            wetted: entry.half_width(),
        };
        Step { now, columns: columns_of(entry.body()) }
    }
}

/// Does the force turn in every step?
fn chatters(forces: &[[f64; 2]]) -> bool {
    let Some(late) = forces.len().checked_sub(CHATTER + 1).map(|first| &forces[first..]) else { return false };
    let largest = forces.iter().map(|force| force[1].abs()).fold(0.0, f64::max);
    let changes: Vec<f64> = late.windows(2).map(|pair| pair[1][1] - pair[0][1]).collect();
    let turns = changes.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
    let mean = changes.iter().map(|change| change.abs()).sum::<f64>() / CHATTER as f64;
    turns + 2 >= CHATTER && mean > CHATTERS * largest
}

/// When suction on the bottom first takes off a share of the largest force from which air comes in, and the largest share.
fn suction(forces: &[[f64; 2]], pressures: &[BottomPressure]) -> Option<[f64; 2]> {
    let largest = forces.iter().map(|force| force[1]).fold(f64::MIN_POSITIVE, f64::max);
    let below = |places: &[[f64; 2]]| -> f64 {
        places.windows(2).map(|pair| -(pair[0][1] + pair[1][1]).min(0.0) * (pair[0][0] - pair[1][0])).sum()
    };
    let shares = pressures.iter().map(|pressure| [pressure.time, below(&pressure.places) / largest]);
    let beyond: Vec<[f64; 2]> = shares.filter(|share| share[1] > SUCTION).collect();
    Some([beyond.first()?[0], beyond.iter().map(|share| share[1]).fold(0.0, f64::max)])
}

/// Values of the columns of a body's panels and modes.
fn columns_of(body: &dyn fsi_coupling::Body) -> Vec<f64> {
    let (panels, modes) = (body.panels(), body.modes());
    panels.iter().flat_map(panel_values).chain(modes.iter().flat_map(modal_values)).collect()
}

/// The body before the flow about it begins.
struct Before {
    loads: Loads,
    instants: Vec<Instant>,
    /// When the flow begins [s]; draught [m] and downward speed [m/s] then.
    start: f64,
    draught: f64,
    speed: f64,
}

impl Before {
    /// Of a scene's body as it stands at the start, which moves so.
    fn of(scene: &Scene, body: &Body, section: &Section, motion: SectionMotion) -> Result<Before, OutOfRange> {
        let (draught, speed) = at_start(body, &motion);
        let (gravity, density) = (-scene.gravity[1], scene.water().density);
        let [_, in_air, at_contact] = motion.contact([draught, speed], gravity);
        let begin = BendingWater::new(section, draught.max(0.0), at_contact, gravity)?.draught();
        let loads = Loads::new(EntryModel::Mlm, &section.convex())?;
        let entry = Entry { loads: &loads, motion, draught, speed, gravity, density, buoyancy: true, steep: true };
        // the fall, and twice the time that it would take at the speed of the contact
        let longest = in_air + 2.0 * (begin - draught.max(0.0)) / at_contact;
        let times: Vec<f64> = (0..=BEFORE).map(|k| longest * k as f64 / BEFORE as f64).collect();
        let (mut instants, _) = entry.solve_while_in_range(&times);
        let last = instants.partition_point(|now| now.draught < begin);
        let Some([a, b]) = last.checked_sub(1).and_then(|k| instants.get(k..k + 2)).map(|pair| [pair[0], pair[1]])
        else {
            let now = Before { loads, instants: Vec::new(), start: 0.0, draught: draught.max(begin), speed };
            return if draught >= begin { Ok(now) } else { Err(refuse("one that does not get into the water".into())) };
        };
        let share = (begin - a.draught) / (b.draught - a.draught);
        instants.truncate(last);
        let mix = |a: f64, b: f64| a + share * (b - a);
        Ok(Before { loads, instants, start: mix(a.time, b.time), draught: begin, speed: mix(a.speed, b.speed) })
    }
}

/// The body at a later time [s], at which its table begins.
fn later(body: &Body, start: f64) -> Body {
    match &body.motion {
        Motion::Tabulated(table) => Body { motion: Motion::Tabulated(table.later(start)), ..body.clone() },
        _ => body.clone(),
    }
}

/// Times from 0 to an `end`, `every` [s].
pub(super) fn times_every(every: f64, end: f64) -> Vec<f64> {
    let rows = (end / every - 1e-9).ceil() as usize;
    (0..=rows).map(|k| (k as f64 * every).min(end)).collect()
}

/// The last of ordered items whose time is not after `time` and that has one after it, and how far it is from there to the next [-].
fn between<T>(items: &[T], at: impl Fn(&T) -> f64, time: f64) -> (usize, f64) {
    if items.len() < 2 {
        return (0, 0.0);
    }
    let k = items.partition_point(|item| at(item) <= time).clamp(1, items.len() - 1) - 1;
    let [a, b] = [at(&items[k]), at(&items[k + 1])];
    (k, ((time - a) / (b - a)).clamp(0.0, 1.0))
}

/// A pressure at x, linear between places from the jet to the keel.
fn at_place(places: &[[f64; 2]], x: f64) -> f64 {
    let after = places.partition_point(|place| place[0] > x).clamp(1, places.len() - 1);
    let ([x0, p0], [x1, p1]) = (places[after - 1], places[after]);
    if x0 == x1 { p1 } else { p0 + (p1 - p0) * ((x0 - x) / (x0 - x1)).clamp(0.0, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A force that turns in every step by a fifth of itself counts; one that rises, or turns by a hundredth, does not.
    #[test]
    fn a_force_that_turns_in_every_step() {
        let forces = |turn: f64| -> Vec<[f64; 2]> {
            (0..20).map(|k| [f64::from(k), 100.0 + f64::from(k) + if k % 2 == 0 { turn } else { -turn }]).collect()
        };
        assert!(chatters(&forces(10.0)));
        assert!(!chatters(&forces(1.0)) && !chatters(&forces(0.0)));
        assert!(!chatters(&forces(10.0)[..CHATTER]), "too few steps");
    }

    /// On each half −1 kPa over 0.2 m, and half of it over 0.2 m more, take 600 N/m off.
    #[test]
    fn suction_is_the_force_of_pressures_below_that_of_the_air() {
        let pressure = |time: f64, low: f64| BottomPressure {
            time,
            places: vec![[0.5, 0.0], [0.3, low], [0.1, low], [0.0999, 2e3], [0.0, 2e3]],
        };
        let pressures = [pressure(1.0, 10.0), pressure(2.0, -1e3), pressure(3.0, -500.0)];
        let found = suction(&[[1.0, 4000.0], [2.0, 1000.0]], &pressures).expect("more than a twentieth");
        assert_eq!(found[0], 2.0);
        assert!((found[1] - 0.15).abs() < 1e-3, "{found:?}");
        assert!(suction(&[[1.0, 1e6]], &pressures).is_none());
    }
}
