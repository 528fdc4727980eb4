//! `body.displacements`: a motion from a table.

use fsi_coupling::{PrescribedBody, RigidMotion};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use settings::significant;

/// Jump of a velocity from row to row that is reported, over the largest velocity, and over the jumps beside it [-].
const NOTABLE: f64 = 0.1;
const STANDS_OUT: f64 = 4.0;

/// Jitter of a table's accelerations that is reported: what it changes in a force, over the force [-].
const JITTERS: f64 = 0.05;

/// Largest speed of tabulated displacements [m/s, deg/s].
const FASTEST: f64 = 1e4;

/// Prescribed displacements at given times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Displacements {
    /// Rows of time, displacement x, y and rotation from body.position and body.angle_deg, in order of time [s, m, m, deg]; from t = 0 or
    /// before. Between rows cubic in time, with the velocities of parabolas through three rows, and none where it rests between two; after the
    /// table at constant velocity.
    #[schemars(extend("x-default" = "required by tabulated without motion_file"))]
    pub displacements: Vec<[f64; 4]>,
    /// Velocities x, y and of rotation at the rows of body.displacements, instead of those of parabolas [m/s, m/s, deg/s].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(extend("x-default" = "absent"))]
    pub displacement_rates: Vec<[f64; 3]>,
}

/// Rate of column `i` of a table of times and values at row `k`: 0 beside a rest, else of the parabola through it and its neighbours, or of
/// the line through two. Two equal values are a rest, but not at a crest or in a trough (Fritsch & Carlson 1980 flatten these too).
pub(crate) fn parabola_rate(rows: &[[f64; 4]], k: usize, i: usize) -> f64 {
    let last = rows.len() - 1;
    let length = |k: usize| rows[k + 1][0] - rows[k][0];
    let slope = |k: usize| (rows[k + 1][i] - rows[k][i]) / length(k);
    let rests = |k: usize| {
        let turns = k > 0 && k + 1 < last && slope(k - 1) * slope(k + 1) < 0.0;
        slope(k) == 0.0 && !turns
    };
    match k {
        _ if last == 0 => 0.0,
        _ if k > 0 && rests(k - 1) || k < last && rests(k) => 0.0,
        _ if last == 1 => slope(0),
        0 => slope(0) + (slope(0) - slope(1)) * length(0) / (length(0) + length(1)),
        k if k == last => {
            slope(k - 1) + (slope(k - 1) - slope(k - 2)) * length(k - 1) / (length(k - 2) + length(k - 1))
        }
        k => (slope(k - 1) * length(k) + slope(k) * length(k - 1)) / (length(k - 1) + length(k)),
    }
}

/// A motion downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Descent {
    /// Largest speed [m/s].
    pub speed: f64,
    /// Largest depth below the start [m].
    pub depth: f64,
}

impl Displacements {
    /// Velocities x, y [m/s] and angle [deg/s] at a row: as given, or of parabolas.
    fn velocities(&self, row: usize) -> [f64; 3] {
        let of_parabolas = || [1, 2, 3].map(|i| parabola_rate(&self.displacements, row, i));
        self.displacement_rates.get(row).copied().unwrap_or_else(of_parabolas)
    }

    /// What becomes of the body `name` after a table that ends before the run does at `end` [s].
    pub(super) fn short(&self, name: &str, end: f64) -> Option<String> {
        let last = self.displacements.len() - 1;
        let (time, [u, v, spin]) = (self.displacements[last][0], self.velocities(last).map(significant));
        (time < end).then(|| {
            format!("the table of {name}'s motion ends at {time} s, the run at {end} s: from then on it moves at {u}, {v} m/s and {spin} deg/s")
        })
    }

    /// Where the velocities of `name`, which follow from its places, jump: the jump is spread over the rows beside it.
    pub(super) fn kinks(&self, name: &str) -> Option<String> {
        let rows = &self.displacements;
        if !self.displacement_rates.is_empty() || rows.len() < 3 {
            return None;
        }
        [(1, "x", "m/s"), (2, "y", "m/s"), (3, "angle", "deg/s")].into_iter().find_map(|(i, column, unit)| {
            let slopes: Vec<f64> = rows.windows(2).map(|pair| (pair[1][i] - pair[0][i]) / (pair[1][0] - pair[0][0])).collect();
            let fastest = slopes.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
            let jump = |k: usize| slopes.get(k + 1).map_or(0.0, |next| (next - slopes[k]).abs());
            let beside = |k: usize| if k == 0 { jump(1) } else { jump(k - 1).max(jump(k + 1)) };
            let is_kink = |k: &usize| jump(*k) > NOTABLE * fastest && jump(*k) > STANDS_OUT * beside(*k);
            (0..slopes.len() - 1).find(is_kink).map(|k| {
                let [before, after] = [slopes[k], slopes[k + 1]].map(significant);
                format!(
                    "the table of {name}'s motion has a kink: at {} s the velocity of {column} goes from {before} to {after} {unit}; it is spread over \
                     the rows from {} to {} s: give velocities, or more rows there",
                    rows[k + 1][0],
                    rows[k][0],
                    rows[k + 2][0]
                )
            })
        })
    }

    /// Whether the accelerations of `name` up and down go up and down from row to row, as those of rounded places do: by how much, times the
    /// depth over the squared speed, is about what it changes in a force that grows as the depth does.
    pub(super) fn jitter(&self, name: &str) -> Option<String> {
        let rows = &self.displacements;
        let length = |k: usize| rows[k + 1][0] - rows[k][0];
        let slope = |k: usize| (rows[k + 1][2] - rows[k][2]) / length(k);
        let intervals = rows.len() - 1;
        // with velocities, what the places add to their accelerations
        let acceleration = |k: usize| match self.displacement_rates.is_empty() {
            true => (slope(k + 1) - slope(k)) / (0.5 * (length(k) + length(k + 1))),
            false => 6.0 * (slope(k) - 0.5 * (self.velocities(k)[1] + self.velocities(k + 1)[1])) / length(k),
        };
        let count = if self.displacement_rates.is_empty() { intervals.saturating_sub(1) } else { intervals };
        let all: Vec<f64> = (0..count).map(acceleration).collect();
        let jumps: Vec<f64> = all.windows(3).map(|w| w[1] - 0.5 * (w[0] + w[2])).collect();
        let turns = jumps.windows(2).filter(|w| w[0] * w[1] < 0.0).count();
        let Descent { speed, depth } = self.descent(f64::INFINITY);
        let jitter = (jumps.iter().map(|jump| jump * jump).sum::<f64>() / jumps.len().max(1) as f64).sqrt();
        let share = jitter * depth / (speed * speed);
        (share > JITTERS && 2 * turns >= jumps.len().saturating_sub(1)).then(|| {
            format!(
                "the accelerations of {name}'s table go up and down from row to row by {} m/s², as those of rounded places do: forces are off by about \
                 {} %: give more digits, or fewer rows",
                significant(jitter),
                significant((100.0 * share).min(100.0))
            )
        })
    }

    /// Does the body only move up and down?
    pub fn is_upright(&self) -> bool {
        self.displacements.iter().all(|[_, x, _, angle]| *x == 0.0 && *angle == 0.0)
            && self.displacement_rates.iter().all(|[u, _, spin]| *u == 0.0 && *spin == 0.0)
    }

    /// The same motion of a body that starts where this one is at a time [s].
    pub fn later(&self, start: f64) -> Displacements {
        let rates: Vec<[f64; 3]> = (0..self.displacements.len()).map(|row| self.velocities(row)).collect();
        let whole = Displacements { displacement_rates: rates, ..self.clone() };
        let Some(law) = PrescribedBody::tabulated(whole.motions(&RigidMotion::default())) else { return whole };
        let RigidMotion { position: [x, y], angle, .. } = law(start);
        let moved = |row: &[f64; 4]| [row[0] - start, row[1] - x, row[2] - y, row[3] - angle.to_degrees()];
        Displacements { displacements: self.displacements.iter().map(moved).collect(), ..whole }
    }

    /// The rows of the motion of a body that starts so.
    pub(super) fn motions(&self, start: &RigidMotion) -> Vec<(f64, RigidMotion)> {
        let row = |(k, [time, x, y, angle]): (usize, &[f64; 4])| {
            let [u, v, spin] = self.velocities(k);
            let motion = RigidMotion {
                position: [start.position[0] + x, start.position[1] + y],
                angle: start.angle + angle.to_radians(),
                velocity: [u, v],
                angular_velocity: spin.to_radians(),
                ..RigidMotion::default()
            };
            (*time, motion)
        };
        self.displacements.iter().enumerate().map(row).collect()
    }

    /// Bound of the speed of a point at `arm` [m] from the frame's origin [m/s], at the rows.
    pub(super) fn fastest(&self, arm: f64) -> f64 {
        let speed = |k: usize| {
            let [u, v, spin] = self.velocities(k);
            u.hypot(v) + spin.to_radians().abs() * arm
        };
        (0..self.displacements.len()).map(speed).fold(0.0, f64::max)
    }

    /// How fast and how far it goes down within `end` [s].
    pub(crate) fn descent(&self, end: f64) -> Descent {
        let rows = || self.displacements.iter().enumerate().filter(|(_, row)| row[0] <= end);
        let speed = rows().map(|(k, _)| -self.velocities(k)[1]).fold(0.0, f64::max);
        let depth = rows().map(|(_, row)| -row[2]).fold(0.0, f64::max);
        Descent { speed, depth }
    }

    /// What is wrong with the table, if anything is.
    pub(crate) fn fault(&self, half: bool) -> Option<&'static str> {
        let rows = &self.displacements;
        let sideways = rows.iter().any(|[_, x, _, angle]| *x != 0.0 || *angle != 0.0)
            || self.displacement_rates.iter().any(|[u, _, spin]| *u != 0.0 || *spin != 0.0);
        let too_fast = |k: usize| self.velocities(k).iter().any(|v| !v.is_finite() || v.abs() > FASTEST);
        match () {
            _ if rows.len() < 2 => Some("two rows at least"),
            _ if rows.iter().flatten().any(|value| !value.is_finite()) => Some("finite numbers"),
            _ if rows.windows(2).any(|pair| pair[1][0] <= pair[0][0]) => Some("rows in order of time"),
            _ if rows[0][0] > 0.0 => Some("a first row at t = 0 or before, where the run starts"),
            _ if !matches!(self.displacement_rates.len(), n if n == 0 || n == rows.len()) => {
                Some("as many rows as body.displacement_rates has")
            }
            _ if (0..rows.len()).any(too_fast) => Some("speeds up to 10 000 m/s and deg/s"),
            _ if half && sideways => Some("rows [t, 0, y, 0] with symmetry = \"x\""),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::{Motion, Moved};

    /// Displacements that are quadratic in time come back exactly, with their velocities, from rows at uneven times.
    #[test]
    fn a_table_of_a_constant_acceleration_is_exact() {
        let exact = |t: f64| [t, 0.3 * t - t * t, 0.5 * t * t, 10.0 * t];
        let table = Displacements {
            displacements: [0.0, 0.1, 0.3, 0.35, 0.8].map(exact).to_vec(),
            displacement_rates: Vec::new(),
        };
        let start = RigidMotion { position: [1.0, 2.0], angle: 0.5, ..RigidMotion::default() };
        let Moved::ByLaw(law) = Motion::Tabulated(table.clone()).moved(&start) else { panic!("a law") };
        for t in [0.0, 0.05, 0.3, 0.32, 0.7] {
            let now = law(t);
            let [_, x, y, angle] = exact(t);
            let found = [now.position[0] - 1.0 - x, now.position[1] - 2.0 - y, now.angle - 0.5 - angle.to_radians()];
            assert!(found.iter().all(|gap| gap.abs() < 1e-13), "t = {t}: {found:?}");
            assert!((now.velocity[0] - 0.3 + 2.0 * t).abs() < 1e-12 && (now.velocity[1] - t).abs() < 1e-12, "{now:?}");
        }
        assert!((table.fastest(0.0) - 1.3_f64.hypot(0.8)).abs() < 1e-12, "{}", table.fastest(0.0));
        assert_eq!(table.fault(false), None);
        assert!(table.fault(true).is_some_and(|fault| fault.contains("symmetry")));
    }
    /// At rest, then downwards at 2 m/s: nothing moves before, no step back is made, and the kink is reported.
    #[test]
    fn a_body_that_rests_between_rows_stays_there() {
        let places = [0.0, 0.0, 0.0, -0.2, -0.4, -0.6];
        let displacements: Vec<[f64; 4]> =
            (0_u8..).zip(places).map(|(k, y)| [0.1 * f64::from(k), 0.0, y, 0.0]).collect();
        let table = Displacements { displacements, displacement_rates: Vec::new() };
        let Moved::ByLaw(law) = Motion::Tabulated(table.clone()).moved(&RigidMotion::default()) else {
            panic!("a law")
        };
        let mut last = 0.0;
        for k in 0..=500 {
            let (t, now) = (0.001 * f64::from(k), law(0.001 * f64::from(k)));
            assert!(t > 0.2 || (now.position[1] == 0.0 && now.velocity[1] == 0.0), "at rest at {t} s: {now:?}");
            assert!(now.position[1] <= last + 1e-15, "back up at {t} s");
            last = now.position[1];
        }
        assert!((law(0.5).velocity[1] + 2.0).abs() < 1e-12);
        assert!(
            table.kinks("box").is_some_and(|notes| notes.contains("at 0.2 s") && notes.contains("from 0 to -2 m/s"))
        );
        // two equal rows about a crest are no rest
        let crest = [[0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0], [2.0, 0.0, 1.0, 0.0], [3.0, 0.0, 0.0, 0.0]];
        assert_eq!([1, 2].map(|k| parabola_rate(&crest, k, 2)), [0.5, -0.5]);
        let smooth = |k: i32| [0.1 * f64::from(k), 0.0, (0.5 * f64::from(k)).sin(), 0.0];
        let table = Displacements { displacements: (0..30).map(smooth).collect(), displacement_rates: Vec::new() };
        assert_eq!(table.kinks("box"), None);
    }

    /// A constant deceleration in six rows: exact, it says nothing; rounded to a millimetre, its accelerations do not hold.
    #[test]
    fn rounded_places_are_reported() {
        let exact = |t: f64| -(5.0 * t - 50.0 * t * t);
        let table = |digits: f64, rates: bool| {
            let times = (0..6).map(|k| 0.003 * f64::from(k));
            let place = |t: f64| (exact(t) * digits).round() / digits;
            Displacements {
                displacements: times.clone().map(|t| [t, 0.0, place(t), 0.0]).collect(),
                displacement_rates: times.filter(|_| rates).map(|t| [0.0, -5.0 + 100.0 * t, 0.0]).collect(),
            }
        };
        for rates in [false, true] {
            assert_eq!(table(1e9, rates).jitter("box"), None);
            assert!(table(1e3, rates).jitter("box").is_some_and(|notes| notes.contains("rounded places")));
        }
        // a deceleration that rises and falls within a few rows is none
        let impact =
            |k: i32| [1e-3 * f64::from(k), 0.0, -5e-3 * f64::from(k) + 5e-3 * (0.1 * f64::from(k)).sin().powi(4), 0.0];
        let smooth = Displacements { displacements: (0..30).map(impact).collect(), displacement_rates: Vec::new() };
        assert_eq!(smooth.jitter("box"), None);
    }

    /// A table of velocities: they are the body's at the rows, and linear between.
    #[test]
    fn velocities_that_a_table_gives_are_the_bodys() {
        let table = Displacements {
            displacements: vec![[0.0; 4], [0.02, 0.0, -0.08, 0.0], [0.05, 0.0, -0.2, 0.0]],
            displacement_rates: vec![[0.0, -5.0, 0.0], [0.0, -3.0, 0.0], [0.0, -5.0, 0.0]],
        };
        let Moved::ByLaw(law) = Motion::Tabulated(table.clone()).moved(&RigidMotion::default()) else {
            panic!("a law")
        };
        for (t, v, a) in
            [(0.0, -5.0, 100.0), (0.005, -4.5, 100.0), (0.02, -3.0, -200.0 / 3.0), (0.035, -4.0, -200.0 / 3.0)]
        {
            let now = law(t);
            assert!((now.velocity[1] - v).abs() < 1e-12 && (now.acceleration[1] - a).abs() < 1e-9, "t = {t}: {now:?}");
        }
        assert_eq!(table.short("box", 0.05), None);
        assert!(
            table
                .short("box", 0.06)
                .is_some_and(|notes| notes.contains("ends at 0.05 s") && notes.contains("0, -5 m/s"))
        );
        let late = Displacements {
            displacements: vec![[12.5, 0.0, 0.0, 0.0], [12.9, 0.0, -1.0, 0.0]],
            displacement_rates: Vec::new(),
        };
        assert!(late.fault(false).is_some_and(|fault| fault.contains("t = 0 or before")));
    }
}
