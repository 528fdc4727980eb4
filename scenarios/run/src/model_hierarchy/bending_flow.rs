//! A body whose bottom bends, in water that boundary elements follow (THEORY EN50–EN52).

use std::collections::BTreeMap;

use fsi_coupling::{BendingEntry, BendingEntryError, BottomPressure};
use scene::validity::panels::StressPeak;
use scene::{Body, Scene, Symmetry, rows};
use settings::significant;
use water_entry::{EntryModel, Instant, OutOfRange, Section};

use crate::build::of_scene;
use crate::observers::{modal_values, panel_values};
use crate::panel::PanelResult;

/// A body followed step by step.
#[derive(Clone, Debug)]
pub(super) struct BendingFlow {
    /// The body at the end of each step.
    steps: Vec<Step>,
    /// In each step, at their times: mean upward force [N/m]; pressure on the bottom.
    forces: Vec<[f64; 2]>,
    pressures: Vec<BottomPressure>,
    /// Extremes of its panels over all steps.
    pub panels: BTreeMap<String, PanelResult>,
    /// Largest stress of each.
    pub stresses: Vec<StressPeak>,
}

/// The body at a moment.
#[derive(Clone, Debug)]
struct Step {
    time: f64,
    draught: f64,
    speed: f64,
    rate: f64,
    wetted: f64,
    /// Values of the columns of panels or modes.
    columns: Vec<f64>,
}

impl BendingFlow {
    /// Follow the body of a scene by half; also why it was not followed to the end.
    pub fn of(scene: &Scene, body: &Body, section: &Section) -> Result<(BendingFlow, Option<OutOfRange>), OutOfRange> {
        let refuse = |what: String| OutOfRange {
            what,
            range: "panels or modes of a body that is simulated by half (symmetry = \"x\"), from dry chines on".into(),
            next: EntryModel::Wcsph,
        };
        if scene.symmetry != Symmetry::X {
            return Err(refuse("a body that is simulated whole".into()));
        }
        let built = of_scene(scene, body, &rows(scene)).map_err(|error| refuse(error.to_string()))?;
        let (draught, gravity) = (body.draught(), -scene.gravity[1]);
        let entry = BendingEntry::new(built, section.clone(), draught, scene.water().density, gravity);
        let mut entry = entry.map_err(|error| match error {
            BendingEntryError::OutOfRange(out) => out,
            error => refuse(error.to_string()),
        })?;
        let mut found = BendingFlow {
            steps: vec![Step::of(&entry)],
            forces: Vec::new(),
            pressures: Vec::new(),
            panels: BTreeMap::new(),
            stresses: Vec::new(),
        };
        let mut over = None;
        while entry.time() < scene.time.end * (1.0 - 1e-12) {
            let before = entry.time();
            let stepped = entry.step(scene.time.end);
            if let Err(error) = stepped {
                let at = format!("one of which, from t = {} s on, {error}", significant(before));
                over = Some(refuse(at));
                break;
            }
            let step = Step::of(&entry);
            let force = entry.body().motion().map_or(0.0, |motion| motion.force[1]);
            found.forces.push([0.5 * (before + step.time), force]);
            if !entry.pressure().places.is_empty() {
                found.pressures.push(entry.pressure().clone());
            }
            let risen = step.speed <= 0.0;
            found.steps.push(step);
            if risen {
                over = Some(refuse(format!("one that leaves the water from t = {} s on", significant(entry.time()))));
                break;
            }
        }
        let panels = entry.body().panels();
        found.panels = panels.iter().map(|panel| (panel.name.clone(), PanelResult::from(panel))).collect();
        found.stresses = panels.iter().map(StressPeak::from).collect();
        let modes = entry.body().modes();
        found.stresses.extend(modes.as_ref().and_then(StressPeak::of_modes));
        Ok((found, over))
    }

    /// The body at `times` [s], as far as it was followed.
    pub fn instants(&self, times: &[f64]) -> Vec<Instant> {
        let end = self.steps[self.steps.len() - 1].time * (1.0 + 1e-9);
        times.iter().take_while(|time| **time <= end).map(|time| self.at(*time)).collect()
    }

    fn at(&self, time: f64) -> Instant {
        let (k, share) = between(&self.steps, |step| step.time, time);
        let (a, b) = (&self.steps[k], &self.steps[(k + 1).min(self.steps.len() - 1)]);
        let mix = |a: f64, b: f64| a + share * (b - a);
        Instant {
            time,
            draught: mix(a.draught, b.draught),
            speed: mix(a.speed, b.speed),
            rate: mix(a.rate, b.rate),
            force: self.force(time),
            wetted: mix(a.wetted, b.wetted),
        }
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
        let (k, share) = between(&self.steps, |step| step.time, time);
        let (a, b) = (&self.steps[k], &self.steps[(k + 1).min(self.steps.len() - 1)]);
        a.columns.iter().zip(&b.columns).map(|(a, b)| a + share * (b - a)).collect()
    }

    /// Pressure [Pa] at a distance `x` from the plane of symmetry [m], at a time [s]: linear between steps at the same share of the wet
    /// bottom.
    pub fn pressure(&self, time: f64, x: f64) -> f64 {
        let Some(first) = self.pressures.first() else { return 0.0 };
        if time < first.time {
            return 0.0;
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
    fn of(entry: &BendingEntry) -> Step {
        let motion = entry.body().motion().unwrap_or_default();
        let (panels, modes) = (entry.body().panels(), entry.body().modes());
        let columns = panels.iter().flat_map(panel_values).chain(modes.iter().flat_map(modal_values));
        Step {
            time: entry.time(),
            draught: entry.draught(),
            speed: -motion.velocity[1],
            rate: -motion.acceleration[1],
            wetted: entry.half_width(),
            columns: columns.collect(),
        }
    }
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
