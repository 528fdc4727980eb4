//! The entries of all bodies of a scene: each automatic value is that of the body that asks for most.

use fsi_coupling::geometry::polygon;

use super::auto::{auto_fine_zone, fastest_speed};
use super::impact::{Entry, middle_of_wet};
use super::keys::{Body, Joint, Motion, Scene, Tank};

/// Share of its speed at contact at which a body still presses half as hard [-].
const STILL_FAST: f64 = 0.7;

/// The water that bodies meet, and how long.
#[derive(Clone, Copy)]
pub(super) struct Meeting {
    /// Gravity [m/s²].
    pub gravity: [f64; 2],
    /// Density [kg/m³].
    pub density: f64,
    /// End of the run [s].
    pub end: f64,
    /// Finest spacing [m]; infinite where it is not known.
    pub spacing: f64,
}

impl Meeting {
    /// How a body meets the water; `None` for one that does not fall or move down into it, or that a joint holds: links change how it moves.
    pub fn entry(&self, body: &Body, joints: &[Joint]) -> Option<Entry> {
        let joined = joints.iter().any(|joint| joint.bodies.contains(&body.name));
        if joined { None } else { Entry::of(body, self.gravity, self.density, self.end, self.spacing) }
    }

    /// The same of those of many bodies that do.
    pub fn entries<'a>(&self, bodies: impl IntoIterator<Item = &'a Body>, joints: &[Joint]) -> Vec<(&'a Body, Entry)> {
        bodies.into_iter().filter_map(|body| Some((body, self.entry(body, joints)?))).collect()
    }
}

/// Fastest speed of the flow that is known before the run, the largest of all bodies [m/s]; without `tank` of the bodies alone.
pub(super) fn fastest_of_all<'a>(
    bodies: impl IntoIterator<Item = &'a Body>,
    entries: &[(&Body, Entry)],
    gravity: [f64; 2],
    tank: Option<&Tank>,
) -> f64 {
    let of = |body: &Body| {
        let entry = entries.iter().find(|(own, _)| std::ptr::eq(*own, body)).map(|(_, entry)| entry);
        fastest_speed(entry, Some(body), gravity, tank.filter(|_| entries.is_empty()))
    };
    let without = fastest_speed(None, None, gravity, tank.filter(|_| entries.is_empty()));
    bodies.into_iter().map(of).fold(without, f64::max)
}

/// x of the middle of what is wet at the end [m]: a single body's; of several, midway between the ends of those that move; 0 without a body.
pub(super) fn middle_of_all<'a>(bodies: impl IntoIterator<Item = &'a Body>, entries: &[(&Body, Entry)]) -> f64 {
    let bodies: Vec<&Body> = bodies.into_iter().collect();
    let moving: Vec<&Body> = bodies.iter().copied().filter(|body| body.motion != Motion::Fixed).collect();
    let wet = |body: &Body| {
        let entry = entries.iter().find(|(own, _)| std::ptr::eq(*own, body)).map(|(_, entry)| entry);
        entry.map_or_else(|| body.middle(), |entry| middle_of_wet(&body.placed_outline(), entry.final_draught))
    };
    match (&bodies[..], &moving[..]) {
        ([], _) => 0.0,
        ([only], _) | (_, [only]) => wet(only),
        ([first, ..], []) => first.middle(),
        (_, moving) => {
            let all: Vec<[f64; 2]> = moving.iter().flat_map(|body| body.placed_outline()).collect();
            let [min, max] = polygon::bounding_box(&all);
            0.5 * (min[0] + max[0])
        }
    }
}

/// Half width and depth of the fine zone about `middle` that holds those of all entries [m], shape (2).
pub(super) fn zone_of_all(entries: &[(&Body, Entry)], middle: f64, spacing: f64) -> [f64; 2] {
    let of = |(body, entry): &(&Body, Entry)| {
        let [half_width, depth] = auto_fine_zone(entry, spacing);
        [(middle_of_wet(&body.placed_outline(), entry.final_draught) - middle).abs() + half_width, depth]
    };
    entries.iter().map(of).fold([0.0; 2], |most, zone| [0, 1].map(|k| zone[k].max(most[k])))
}

impl Scene {
    fn meeting(&self) -> Meeting {
        let (gravity, density) = (self.gravity, self.water().density);
        Meeting { gravity, density, end: self.time.end, spacing: self.resolution.spacing }
    }

    /// How the first body meets the water, by which its results are judged; `None` where it does not fall or move down into it, or where a joint
    /// holds it.
    pub fn entry(&self) -> Option<Entry> {
        self.meeting().entry(self.body.as_ref()?, &self.joints)
    }

    /// Names of the panels whose stress may still grow at the end of a run: the body is still fast and the water has not come over most of them.
    pub fn panels_not_passed(&self, now: &fsi_coupling::Motion) -> Vec<String> {
        let (Some(body), Some(entry)) = (&self.body, self.entry()) else { return Vec::new() };
        let is_fast = -now.velocity[1] > STILL_FAST * entry.speed;
        if is_fast { body.panels_not_passed(now) } else { Vec::new() }
    }

    /// How each body that falls or moves down into the water meets it; bodies that joints hold are left out.
    pub fn entries(&self) -> Vec<(&Body, Entry)> {
        self.meeting().entries(self.all_bodies(), &self.joints)
    }

    /// How bodies that joints hold would meet the water alone.
    pub(super) fn held_entries(&self) -> Vec<(&Body, Entry)> {
        let alone = self.meeting().entries(self.all_bodies(), &[]);
        let held = |body: &Body| self.joints.iter().any(|joint| joint.bodies.contains(&body.name));
        alone.into_iter().filter(|(body, _)| held(body)).collect()
    }

    /// Fastest speed of the flow that is known before the run [m/s].
    pub fn fastest_speed(&self) -> f64 {
        fastest_of_all(self.all_bodies(), &self.entries(), self.gravity, Some(&self.tank)) + self.tank.block_speed()
    }

    /// x of the fine zone's middle [m]: that of what is wet of a body at the end; of several, midway between the ends of those that move; 0
    /// without a body.
    pub fn fine_zone_center(&self) -> f64 {
        middle_of_all(self.all_bodies(), &self.entries())
    }

    /// What a sentence about a body of several starts with.
    pub(super) fn about(&self, body: &Body) -> String {
        if self.bodies.is_empty() { String::new() } else { format!("body {}: ", body.name) }
    }
}
