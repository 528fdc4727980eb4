//! What classical theory says of an impact before it is run: speeds, penetration, compressibility.

use std::f64::consts::{FRAC_PI_2, PI};

use fsi_coupling::geometry::{polygon, underside};
use water_entry::air_cushion::{self, AirCushion};

use super::bottom::{Bottom, PEAK_MASS_RATIO, Reach};
use super::keys::{Body, Motion, WET_HEIGHT};
use crate::vocabulary::ResultName;

/// Why the peak force of a flat contact is refused (THEORY GE23).
pub fn flat_contact_refused() -> String {
    format!(
        "a face within 4 deg of the water meets it at once: the peak follows the speed of sound, or the spacing, and no value is right; {}",
        use_the_impulse()
    )
}

/// What a designer may take where no peak is right.
pub fn use_the_impulse() -> String {
    format!("use results.{}", ResultName::Impulse.name())
}

/// Steps of the penetration integral.
const PENETRATION_STEPS: u32 = 1000;

/// Largest speed over the one at contact from which it counts [-]: less changes the share that compressibility takes by a tenth.
const NOTABLE_GAIN: f64 = 1.05;
/// Share of a body's breadth that its flat bottom has where air is trapped, at least, and largest draught at t = 0 over the breadth [-].
const TRAPPING: [f64; 2] = [0.5, 0.01];
/// Steepest slope of a face that counts beside another [-].
const STEEPEST: f64 = 2.0;
/// Wetted width over the breadth from which chines count as wet: the sides of a rolled wedge have less than that of its flat face [-].
const PAST_CHINES: f64 = 1.1;
/// Draught over the radius from which water leaves a round bottom [-].
const DRY_SIDES: f64 = 0.15;

/// A body's entry into water.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// The bottom that meets the water.
    pub bottom: Bottom,
    /// Half of the body's breadth [m].
    pub half_breadth: f64,
    /// Downward speed at contact, or at t = 0 where the body starts wet [m/s].
    pub speed: f64,
    /// Draught below still water at the end of the run [m]; an upper bound for a free body, negative short of contact.
    pub final_draught: f64,
    /// Largest downward speed in the run [m/s].
    pub fastest: f64,
    /// Largest downward speed until the spray root is at the chines [m/s].
    pub attached_speed: f64,
    /// Draught at the peak of the force [m] (THEORY GE22): where the water's mass is a fifth of the body's, or at the chines.
    pub peak_draught: f64,
    /// Difference of the slopes of the two faces beside the keel of straight faces [-]: 0 upright, more for a body that is rolled.
    pub unequal_faces: f64,
    /// Air that a flat bottom traps (THEORY WC27).
    pub cushion: Option<AirCushion>,
}

impl Entry {
    /// The entry of `body` within `end` [s], under gravity [m/s²], shape (2), into water of density ρ [kg/m³], divided by `spacing` [m];
    /// 0 and infinity where they are not known.
    /// `None` where the body neither moves down at t = 0 nor falls from above the surface, or is all under water. Of a table of
    /// displacements from above the water, the largest downward speed counts.
    pub fn of(body: &Body, gravity: [f64; 2], density: f64, end: f64, spacing: f64) -> Option<Entry> {
        let gravity = -gravity[1];
        let [min, max] = polygon::bounding_box(&body.placed_outline());
        let draught = -min[1];
        let half_breadth = 0.5 * (max[0] - min[0]);
        let table = match &body.motion {
            Motion::Tabulated(table) if draught <= 0.0 => Some(table.descent(end)),
            _ => None,
        };
        let initial_speed = table.map_or(-body.velocity[1], |descent| descent.speed);
        let falls = matches!(&body.motion, Motion::Free(freedom) if freedom.y()) && gravity > 0.0;
        let gap = (-draught).max(0.0);
        let speed = match falls {
            true => (initial_speed.powi(2) + 2.0 * gravity * gap).sqrt(),
            false => initial_speed,
        };
        let reached = if end > 0.0 { draught + speed * end } else { f64::INFINITY };
        let bottom = Bottom::of(body, &Reach { density, draught: reached, spacing });
        let submerged = max[1] <= 0.0;
        if submerged || initial_speed < 0.0 || speed <= 0.0 {
            return None;
        }
        let chines = bottom.draught_at(half_breadth);
        let steady = Entry {
            bottom,
            half_breadth,
            speed,
            final_draught: draught + table.map_or(speed * end, |descent| descent.depth),
            fastest: speed,
            attached_speed: speed,
            peak_draught: chines,
            unequal_faces: if matches!(bottom, Bottom::Wedge { .. }) {
                unequal_faces(&body.placed_outline())
            } else {
                0.0
            },
            cushion: cushion(body, draught, speed),
        };
        let Motion::Free(freedom) = &body.motion else { return Some(steady) };
        if !freedom.y() {
            return Some(steady);
        }
        let still = |draught: f64| bottom.still_half_width(draught.max(0.0)).min(half_breadth);
        let added_mass = |draught: f64| FRAC_PI_2 * density * still(draught).powi(2);
        let final_draught = free_draught(draught, initial_speed, freedom.mass, added_mass, gravity, end);
        let fall = Fall { mass: freedom.mass, density, gravity, still: &still };
        let speeds = fall.largest_speeds(draught, initial_speed, end, chines);
        let [fastest, attached_speed] =
            speeds.map(|largest| if largest > NOTABLE_GAIN * speed { largest } else { speed });
        let share = freedom.mass / PEAK_MASS_RATIO / (density * bottom.wetted_added_mass(1.0));
        let of_mass = if matches!(bottom, Bottom::Wedge { .. }) { share.sqrt() } else { share };
        Some(Entry { final_draught, fastest, attached_speed, peak_draught: of_mass.min(chines), ..steady })
    }

    /// Speed of the spray root [m/s], at the body's largest speed until it is at the chines; under a flat bottom, which has none, the body's.
    pub fn root_speed(&self) -> f64 {
        match self.cushion {
            Some(_) => self.attached_speed,
            None => self.bottom.root_speed(self.attached_speed),
        }
    }

    /// True for a bottom that meets the water over its breadth at once: its peak is one of sound, or of the spacing.
    pub fn is_flat(&self) -> bool {
        self.bottom.is_flat()
    }

    /// Does water leave the sides of a round bottom? Deeper than 0.15 radii the pressure beside them is below that of the air (THEORY EN24).
    pub(super) fn leaves_its_sides(&self) -> bool {
        matches!(self.bottom, Bottom::Arc { radius } if self.final_draught > DRY_SIDES * radius)
    }

    /// Does the spray root (Wagner 1932) pass the chines within the run, by a tenth at least?
    pub(super) fn wets_its_chines(&self) -> bool {
        self.bottom.wetted_half_width(self.final_draught.max(0.0)) > PAST_CHINES * self.half_breadth
    }

    /// Draught [m] up to which the spray root is on the bottom: at the chines or at the end of the run.
    pub fn attached_draught(&self) -> f64 {
        self.final_draught.clamp(0.0, self.bottom.draught_at(self.half_breadth))
    }

    /// Length of the face with at least 90 % of the peak pressure [m], at the last attached draught.
    pub fn peak_length(&self) -> f64 {
        self.peak_length_at(self.attached_draught())
    }

    /// The same at a draught D [m], or at the last attached one where that is less.
    ///
    /// 0.76 D tan β: the similarity solutions (Dobrovolskaya 1969) at 10°, 20° and 30° give 0.143, 0.269 and 0.437 D.
    /// Arcs count as the wedge of equal root speed.
    pub fn peak_length_at(&self, draught: f64) -> f64 {
        let draught = draught.clamp(0.0, self.attached_draught());
        let slope = self.bottom.equivalent_slope(draught);
        let wedge_draught = self.bottom.wetted_half_width(draught) * slope / FRAC_PI_2;
        0.76 * wedge_draught * slope
    }
}

/// Difference of the slopes of the faces beside the lowest corner of an outline, each up to [`STEEPEST`] [-].
fn unequal_faces(outline: &[[f64; 2]]) -> f64 {
    let n = outline.len();
    let lowest = (0..n).min_by(|&a, &b| outline[a][1].total_cmp(&outline[b][1])).unwrap_or(0);
    let slope = |other: usize| {
        let [dx, dy] = [0, 1].map(|k| (outline[other % n][k] - outline[lowest][k]).abs());
        if dy < STEEPEST * dx { dy / dx } else { STEEPEST }
    };
    (slope(lowest + 1) - slope(lowest + n - 1)).abs()
}

/// Draught [m] of a free body after `end` [s] by the momentum of von Karman (1929), without pile-up and buoyancy,
/// so an upper bound: (m + m_a(D)) dD/dt = (m + m_a(D₀)) V₀ + m g t, with m_a = (π/2) ρ c² [kg/m].
fn free_draught(start: f64, speed: f64, mass: f64, added_mass: impl Fn(f64) -> f64, gravity: f64, end: f64) -> f64 {
    let momentum = (mass + added_mass(start)) * speed;
    let rate = |t: f64, draught: f64| (momentum + mass * gravity * t) / (mass + added_mass(draught));
    let dt = end / f64::from(PENETRATION_STEPS);
    (0..PENETRATION_STEPS).fold(start, |draught, n| {
        let t = f64::from(n) * dt;
        let half_way = draught + 0.5 * dt * rate(t, draught);
        draught + dt * rate(t + 0.5 * dt, half_way)
    })
}

/// A free fall into water by the momentum of von Karman (1929) with buoyancy.
struct Fall<'a> {
    mass: f64,
    density: f64,
    gravity: f64,
    /// Half width of the cut with the still water [m] at a draught [m].
    still: &'a dyn Fn(f64) -> f64,
}

impl Fall<'_> {
    /// Largest downward speeds [m/s] within `end` [s]: in all, and up to a draught [m].
    fn largest_speeds(&self, start: f64, speed: f64, end: f64, chines: f64) -> [f64; 2] {
        let moved = |draught: f64| self.mass + FRAC_PI_2 * self.density * (self.still)(draught).powi(2);
        let (dt, mut draught, mut area) = (end / f64::from(PENETRATION_STEPS), start, 0.0);
        let (mut momentum, mut largest) = (moved(start) * speed, [speed; 2]);
        for _ in 0..PENETRATION_STEPS {
            momentum += dt * self.gravity * (self.mass - self.density * area);
            let speed = momentum / moved(draught);
            draught += dt * speed;
            area += 2.0 * (self.still)(draught) * dt * speed;
            largest[0] = largest[0].max(speed);
            largest[1] = if draught <= chines { largest[1].max(speed) } else { largest[1] };
        }
        largest
    }
}

/// Air under the bottom of a body that meets the water at a speed [m/s].
fn cushion(body: &Body, draught: f64, speed: f64) -> Option<AirCushion> {
    let outline = body.placed_outline();
    let [min, max] = polygon::bounding_box(&outline);
    let (breadth, flat) =
        (max[0] - min[0], underside::flat_width(&outline, air_cushion::LARGEST_SLOPE_DEG.to_radians()));
    let turns = body.angular_velocity_deg_per_s != 0.0;
    let traps = !turns && flat >= TRAPPING[0] * breadth && draught <= TRAPPING[1] * breadth;
    traps.then_some(AirCushion { half_breadth: 0.5 * flat, speed })
}

/// Largest deadrise of the solutions that [`jet_reach`] is fitted to [deg].
const LARGEST_DEADRISE_DEG: f64 = 50.0;

/// Reach of the jet's tip along a wedge of deadrise β [deg] at constant speed, x_tip/(V t) [-] (THEORY EN11):
/// (π − 0.98 β^1.78)/tan β with β in radians.
///
/// A fit to the similarity solutions (Dobrovolskaya 1969) at 10, 20, 30, 45 and 50°, within 0.2 %; π/tan β, twice the
/// spray root's, is the limit of small β (Wagner 1932). `None` above 50°.
pub fn jet_reach(deadrise_deg: f64) -> Option<f64> {
    let beta = deadrise_deg.to_radians();
    (deadrise_deg <= LARGEST_DEADRISE_DEG).then(|| (PI - 0.98 * beta.powf(1.78)) / beta.tan())
}

/// Points this share of the breadth above the lowest one are as low [-].
const FLAT: f64 = 1e-6;

/// x midway between the ends of what is wet of an outline [m] at a draught [m]: what is lower than π/2 draughts above its lowest point.
pub(crate) fn middle_of_wet(outline: &[[f64; 2]], draught: f64) -> f64 {
    let [min, max] = polygon::bounding_box(outline);
    let top = min[1] + (WET_HEIGHT * draught).max(FLAT * (max[0] - min[0]));
    let wet = outline.iter().zip(outline.iter().cycle().skip(1)).flat_map(|(a, b)| {
        let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) }; // so that mirrored edges are cut at mirrored places
        let share = (top - low[1]) / (high[1] - low[1]);
        let cut = (low[1] < top && top <= high[1]).then(|| [low[0] + share * (high[0] - low[0]), top]);
        (a[1] < top).then_some(*a).into_iter().chain(cut)
    });
    let [left, right] = polygon::bounding_box(&wet.collect::<Vec<_>>());
    0.5 * (left[0] + right[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Table;

    #[test]
    fn the_jet_reaches_as_far_as_in_the_similarity_solutions() {
        let name = "wedge_similarity/summary.csv";
        let table = Table::load(name).expect("a built-in table");
        let [deadrise, tip] = ["beta_deg", "x_tip"].map(|column| table.column(name, column).expect("a column"));
        assert_eq!(deadrise.len(), 5);
        for (beta, exact) in deadrise.into_iter().zip(tip) {
            let ours = jet_reach(beta).expect("within the fit's range");
            assert!((ours / exact - 1.0).abs() < 2e-3, "{beta} deg: {ours}, exact {exact}");
        }
        assert_eq!(jet_reach(60.0), None);
    }

    #[test]
    fn the_jet_of_a_flat_wedge_is_twice_as_far_out_as_its_root() {
        let beta: f64 = 0.5;
        let root = FRAC_PI_2 / beta.to_radians().tan();
        assert!((jet_reach(beta).expect("within the fit's range") / root - 2.0).abs() < 1e-3);
    }

    #[test]
    fn von_karman_wedge_without_gravity() {
        // m V₀ = (m + k D²) D' integrates to m D + k D³/3 = m V₀ t.
        let (mass, k, speed, end) = (50.0, 4000.0, 5.0, 0.05);
        let d = free_draught(0.0, speed, mass, |d| k * d * d, 0.0, end);
        assert!((mass * d + k * d.powi(3) / 3.0 - mass * speed * end).abs() < 1e-4);
    }

    #[test]
    fn von_karman_drops_agree_with_an_independent_integration_and_bound_the_boundary_elements() {
        // (deadrise [deg], mass [kg/m], speed [m/s], time [s], draught [m]) of an adaptive integration elsewhere.
        for (deadrise, mass, speed, end, draught) in
            [(30.0_f64, 241.0, 6.15, 0.026112574, 0.14433757), (20.0, 100.0, 4.0, 0.038357371, 0.10919107)]
        {
            let slope = deadrise.to_radians().tan();
            let added_mass = |d: f64| FRAC_PI_2 * 1000.0 * (d / slope).powi(2);
            let ours = free_draught(0.0, speed, mass, added_mass, 9.81, end);
            assert!((ours / draught - 1.0).abs() < 1e-5, "{ours} {draught}");
        }
        // 25°, 78.3 kg/m, 5.05 m/s: boundary elements (Zhao & Faltinsen 1993) integrate to 0.1227 m in 40.1 ms.
        let slope = 25.0_f64.to_radians().tan();
        let added_mass = |d: f64| FRAC_PI_2 * 1000.0 * (d / slope).powi(2);
        let bound = free_draught(0.0, 5.05, 78.3, added_mass, 9.81, 0.0401);
        assert!((1.0..1.15).contains(&(bound / 0.1227)), "{bound}");
    }

    #[test]
    fn free_fall_in_air_is_a_parabola() {
        let d = free_draught(-1.0, 2.0, 50.0, |_| 0.0, 9.81, 0.2);
        assert!((d - (-1.0 + 0.4 + 0.5 * 9.81 * 0.04)).abs() < 1e-12);
    }
}
