//! The values that a scene leaves to the program.

use super::impact::Entry;
use super::keys::{Body, Scene, Tank, Water};
use super::validity::compressibility::{ACOUSTIC_REACH, LEAST_SOUND_RATIO, WATER_SOUND, sound_speed_for};

/// Least reach of the tank over the fine zone's [-].
const TANK_OVER_FINE_ZONE: f64 = 10.0;

/// Half width of the fine zone over the spray root's last [-].
const ROOT_MARGIN: f64 = 1.15;

/// Half width of the fine zone over the body's, at most [-]: past the chines the jets fly free.
const PAST_THE_CHINES: f64 = 1.6;

/// Least half width and depth of the fine zone [spacings].
const LEAST_FINE_ZONE: [f64; 2] = [10.0, 4.0];

/// Least c₀² over g times the depth of an impact's tank [-], chosen and admitted: water at the floor is 4 or 8 % denser.
const STIFFNESS: [f64; 2] = [20.0, 10.0];

/// Fastest speed of the flow that is known before the run [m/s]: the spray root's, the body's, and without an impact
/// that of long waves from a wave maker, √(g d), of water falling through the depth, √(2 g d), or running from a broken dam against a body farther than d/4, 2 √(g d) (Ritter 1892).
pub fn fastest_speed(entry: Option<&Entry>, body: Option<&Body>, gravity: [f64; 2], tank: Option<&Tank>) -> f64 {
    let flow = match (entry, tank) {
        (Some(entry), _) => entry.root_speed().max(entry.fastest),
        // a wave maker lets no water fall: nothing is faster than long waves
        (None, Some(tank)) if tank.is_wave_tank() => (gravity[0].hypot(gravity[1]) * tank.depth).sqrt(),
        (None, Some(tank)) => {
            let front = tank.water_width - 0.5 * tank.width;
            let hit =
                tank.water_width < tank.width && body.is_some_and(|body| body.middle() > front + 0.25 * tank.depth);
            let runs_out = if hit { 4.0 } else { 2.0 };
            let gravity = gravity[0].hypot(gravity[1]);
            (gravity * (2.0 * tank.fall()).max(runs_out * tank.depth)).sqrt()
        }
        (None, None) => 0.0,
    };
    flow.max(body.map_or(0.0, Body::fastest_point))
}

/// Least speed of sound for an impact's tank of a depth [m/s], chosen and admitted (THEORY WC17).
pub fn hydrostatic_sound(gravity: [f64; 2], depth: f64) -> [f64; 2] {
    STIFFNESS.map(|stiffness| (stiffness * gravity[1].abs() * depth).sqrt())
}

impl Scene {
    /// g D/V² of the entry, what gravity adds to its flow [-]: D at the end, or where the chines of a falling body get wet; V at contact.
    /// `None` without an entry.
    pub fn gain_of_gravity(&self) -> Option<f64> {
        Some(self.gained_by(self.body.as_ref()?, &self.entry()?))
    }

    /// The same of any body.
    pub(super) fn gained_by(&self, body: &Body, entry: &Entry) -> f64 {
        let draught = if body.is_free() { entry.attached_draught() } else { entry.final_draught.max(0.0) };
        self.gravity[0].hypot(self.gravity[1]) * draught / entry.speed.powi(2)
    }

    /// Level water from wall to wall: what still layers carry is known.
    pub(crate) fn starts_level(&self) -> bool {
        self.tank.is_full() && self.tank.surface().is_none() && self.gravity[0] == 0.0
    }

    /// Speed by which the steps of a projection are limited before anything moves [m/s]: the fastest that is known, but for
    /// the root of a spray no more than four times the body's speed, which a round body exceeds at first touch.
    pub fn projection_speed(&self) -> f64 {
        const ROOT_OVER_BODY: f64 = 4.0;
        let fastest = self.fastest_speed();
        // water leaves the edges of a flat bottom as fast as the root of a spray
        let of_entry = |entry: &Entry| {
            fastest.max(entry.bottom.root_speed(entry.attached_speed)).min(ROOT_OVER_BODY * entry.speed)
        };
        let entries = self.entries();
        if entries.is_empty() {
            return fastest;
        }
        let stays = |body: &&Body| entries.iter().all(|(own, _)| !std::ptr::eq(*own, *body));
        let of_others = self.all_bodies().filter(stays).map(Body::fastest_point);
        entries.iter().map(|(_, entry)| of_entry(entry)).chain(of_others).fold(0.0, f64::max)
    }
}

/// Speed of sound [m/s]: c₀ = min(max(U/M(ε), 10 u, still), 1480 m/s) (THEORY WC17).
///
/// U is the spray root's speed [m/s] and M(ε) the Mach number at which compressibility costs the admitted share ε of
/// the force; without an impact only the fastest known speed u [m/s] counts. `still` is that for the water's weight. Under a flat bottom
/// U/M(ε) is replaced by the speed at which water is as soft as the trapped air (THEORY WC27). Of several entries the largest.
pub fn auto_sound_speed<'a>(
    water: &Water,
    entries: impl IntoIterator<Item = &'a Entry>,
    fastest: f64,
    still: f64,
) -> f64 {
    let of_root = |entry: &Entry| sound_speed_for(water.compressibility_error, entry.root_speed());
    let of_air = |entry: &Entry| entry.cushion_sound_speed(water.fluid.density);
    let impact = entries.into_iter().map(|entry| of_air(entry).unwrap_or_else(|| of_root(entry))).fold(0.0, f64::max);
    impact.max(LEAST_SOUND_RATIO * fastest).max(still).min(WATER_SOUND)
}

/// Half width and depth of the fine zone of an impact [m], shape (2).
///
/// Half width: 1.15 times the wetted half width at the end of the run (Wagner 1932), at most 1.6 times half the
/// breadth: the fine rows hold the spray root's last position. Depth: f D with the draught D at the end, f = 0.3 for a
/// deadrise (of the wedge with the same spray root) up to 30°, rising linearly to 1.5 at 45° and beyond, where the
/// pressure peaks at the keel. At least 10 by 4 spacings; half the breadth of a flat bottom that traps air.
pub fn auto_fine_zone(entry: &Entry, spacing: f64) -> [f64; 2] {
    let draught = entry.final_draught.max(0.0);
    let wetted = entry.bottom.wetted_half_width(draught);
    let half_width = (ROOT_MARGIN * wetted).min(PAST_THE_CHINES * entry.half_breadth);
    let deadrise = entry.bottom.equivalent_slope(draught).atan().to_degrees();
    let share = 0.3 + 1.2 * ((deadrise - 30.0) / 15.0).clamp(0.0, 1.0);
    let [least_width, least_depth] = LEAST_FINE_ZONE;
    // a flat bottom is wet at once, and its pulse goes down by its breadth (THEORY WC27)
    let [wet, pulse] = entry.cushion.map_or([0.0; 2], |air| [PAST_THE_CHINES * entry.half_breadth, air.half_breadth]);
    [half_width.max(least_width * spacing).max(wet), (share * draught).max(least_depth * spacing).max(pulse)]
}

/// Half width and depth of a tank that an impact does not feel [m], shape (2): outside acoustic reach,
/// 0.65 c₀ t_end, and at least 10 times the fine zone; no deeper than the speed of sound allows under gravity.
pub fn auto_reach(sound_speed: f64, end: f64, fine_zone: [f64; 2], gravity: [f64; 2]) -> [f64; 2] {
    let least = fine_zone.map(|fine| TANK_OVER_FINE_ZONE * fine);
    let reach = ACOUSTIC_REACH * sound_speed * end;
    let carried = (sound_speed / hydrostatic_sound(gravity, 1.0)[0]).powi(2); // infinite without gravity
    [reach.max(least[0]), reach.min(carried).max(least[1])]
}

#[cfg(test)]
mod tests {
    use sph_core::FluidSettings;

    use super::super::bottom::Bottom;
    use super::*;

    fn wedge(deadrise_deg: f64, half_breadth: f64, final_draught: f64) -> Entry {
        let slope = deadrise_deg.to_radians().tan();
        let bottom = Bottom::Wedge { slope };
        Entry {
            bottom,
            half_breadth,
            speed: 1.0,
            final_draught,
            fastest: 1.0,
            attached_speed: 1.0,
            peak_draught: 1.0,
            unequal_faces: 0.0,
            cushion: None,
        }
    }

    #[test]
    fn fine_zone_holds_the_exact_spray_root() {
        // Similarity solution (Dobrovolskaya 1969): the free surface turns at x = 8.901, 4.314, 2.723, 1.578 V t.
        for (deadrise, root) in [(10.0, 8.901), (20.0, 4.314), (30.0, 2.723), (45.0, 1.578)] {
            let [half_width, _] = auto_fine_zone(&wedge(deadrise, 100.0, 1.0), 0.01);
            assert!((1.05..1.3).contains(&(half_width / root)), "{deadrise}: {half_width}");
        }
    }

    #[test]
    fn fine_zone_depth_follows_the_deadrise() {
        for (deadrise, depth) in [(10.0, 0.3), (30.0, 0.3), (37.5, 0.9), (45.0, 1.5), (70.0, 1.5)] {
            assert!((auto_fine_zone(&wedge(deadrise, 100.0, 1.0), 0.01)[1] - depth).abs() < 1e-12);
        }
    }

    #[test]
    fn fine_zone_ends_past_the_chines_and_never_vanishes() {
        assert_eq!(auto_fine_zone(&wedge(10.0, 0.5, 1.0), 0.01)[0], 0.8);
        assert_eq!(auto_fine_zone(&wedge(10.0, 0.5, -1.0), 0.01), [0.1, 0.04]);
    }

    #[test]
    fn sound_speed_is_ten_times_the_flow_without_an_impact() {
        let water = Water { water: None, fluid: FluidSettings::default(), compressibility_error: 0.01 };
        assert_eq!(auto_sound_speed(&water, None, 4.0, 0.0), 40.0);
        let entry = wedge(30.0, 1.0, 1.0);
        let c = auto_sound_speed(&water, Some(&entry), 0.0, 0.0);
        assert!((24.5..26.0).contains(&(c / entry.root_speed())), "{c}");
    }
}
