//! A landing that was followed: its series and its numbers.

use std::time::Instant;

use fsi_coupling::entry_theory::ditching::{LandingEnd, LandingResult, LandingState};
use serde::Serialize;

use super::model::{Scene, hull, landing};
use crate::report::run_page::quantity::digits;
use crate::run::summary::{Peak, Status};

/// A landing that was followed.
pub struct Landed {
    /// The numbers.
    pub summary: Summary,
    /// Its motion in time.
    pub run: LandingResult,
    /// Rows of the series.
    pub(super) rows: Vec<Vec<f64>>,
}

/// Follow a landing that was [loaded](super::load).
///
/// # Panics
/// A scene that was changed by hand into one that [`load`](super::load) refuses.
pub fn follow(scene: &Scene) -> Landed {
    let hull = hull(scene).unwrap_or_else(|problem| panic!("{}", problem.sentence));
    let start = Instant::now();
    let run = landing(scene, &hull).solve();
    let rows = rows(&run.moments, scene.aeroplane.mass * scene.water.gravity);
    let summary = Summary::new(scene, &run, &rows, start.elapsed().as_secs_f64());
    Landed { summary, run, rows }
}

impl Landed {
    /// A column of the series by its name.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let k = COLUMNS.iter().position(|(column, _)| *column == name)?;
        Some(self.rows.iter().map(|row| row[k]).collect())
    }
}

/// Reads a column from a moment; m g is given.
type Read = fn(&LandingState, f64) -> f64;

/// The columns, with what they read.
const COLUMNS: [(&str, Read); 20] = [
    ("time_s", |m, _| m.time),
    ("x_m", |m, _| m.attitude.place[0]),
    ("z_m", |m, _| m.attitude.place[1]),
    ("pitch_deg", |m, _| m.attitude.place[2].to_degrees()),
    ("u_m_per_s", |m, _| m.attitude.rate[0]),
    ("w_m_per_s", |m, _| m.attitude.rate[1]),
    ("pitch_rate_deg_per_s", |m, _| m.attitude.rate[2].to_degrees()),
    ("ax_m_per_s2", |m, _| m.acceleration[0]),
    ("az_m_per_s2", |m, _| m.acceleration[1]),
    ("pitch_acceleration_deg_per_s2", |m, _| m.acceleration[2].to_degrees()),
    ("load_factor", |m, weight| (m.force[1] + m.lift) / weight),
    ("fx_N", |m, _| m.force[0]),
    ("fz_N", |m, _| m.force[1]),
    ("moment_Nm", |m, _| m.force[2]),
    ("lift_N", |m, _| m.lift),
    ("wetted_from_m", |m, _| m.wetted.map_or(f64::NAN, |[from, _]| from)),
    ("wetted_to_m", |m, _| m.wetted.map_or(f64::NAN, |[_, to]| to)),
    ("draught_m", |m, _| m.strips.iter().map(|(s, _)| s.wet.draught).fold(0.0, f64::max)),
    ("line_load_N_per_m", |m, _| heaviest(m)[1]),
    ("line_load_at_m", |m, _| heaviest(m)[0]),
];

/// Where the keel bears most, from the nose [m], and how much a metre [N/m].
fn heaviest(moment: &LandingState) -> [f64; 2] {
    let loaded = moment.strips.iter().filter_map(|(s, f)| Some([s.entry?.at.x, f / s.entry?.length]));
    loaded.fold([f64::NAN, 0.0], |worst, now| if now[1] > worst[1] { now } else { worst })
}

/// Rows in the order of [`COLUMNS`].
fn rows(moments: &[LandingState], weight: f64) -> Vec<Vec<f64>> {
    moments.iter().map(|m| COLUMNS.iter().map(|(_, read)| read(m, weight)).collect()).collect()
}

/// The file. What is not there, as the wetted part of an aeroplane in the air, is left empty.
pub(super) fn csv(rows: &[Vec<f64>]) -> String {
    let mut text = COLUMNS.map(|(name, _)| name).join(",") + "\n";
    for row in rows {
        let cell = |v: &f64| if v.is_finite() { format!("{v:.9e}") } else { String::new() };
        text += &(row.iter().map(cell).collect::<Vec<_>>().join(",") + "\n");
    }
    text
}

/// A time of a landing, in seconds on the whole page.
pub(super) fn seconds(time_s: f64) -> String {
    format!("{}\u{a0}s", digits(time_s))
}

/// The numbers of a landing.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Its name.
    pub scene: String,
    /// How it ended.
    pub status: Status,
    /// Why, where that is no end that was asked for.
    pub message: Option<String>,
    /// What bore the load.
    pub model: &'static str,
    /// Strips along the fuselage.
    pub strips: usize,
    /// Steps taken.
    pub steps: u64,
    /// Time at the end [s].
    pub time_end_s: f64,
    /// Time that it took here [s].
    pub wall_time_s: f64,
    /// Way on the water up to the end [m].
    pub run_length_m: f64,
    /// Forward speed at the first touch and at the end [m/s], shape (2).
    pub speed_m_per_s: [f64; 2],
    /// Pitch at the first touch, the least and the most [deg], shape (3).
    pub pitch_deg: [f64; 3],
    /// Largest upward acceleration over g.
    pub az_g: Peak,
    /// Largest deceleration over g.
    pub deceleration_g: Peak,
    /// Largest lift of water and wing over the weight: what an accelerometer shows.
    pub load_factor: Peak,
    /// Largest upward force of the water [N].
    pub fz_n: Peak,
    /// Largest moment of the water about the centre of mass, nose up or down [N m].
    pub moment_nm: Peak,
    /// Largest load of a metre of the keel [N/m].
    pub line_load_n_per_m: Peak,
    /// Where that is, from the nose [m].
    pub line_load_at_m: f64,
    /// The same at each station: the largest of the strips that are nearer to it than to another.
    pub stations: Vec<StationLoad>,
}

/// What a station bore.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct StationLoad {
    /// Its place, from the nose [m].
    pub x_m: f64,
    /// Largest load of a metre of the keel [N/m].
    pub line_load_n_per_m: Peak,
}

/// What each station bore.
fn station_loads(scene: &Scene, moments: &[LandingState]) -> Vec<StationLoad> {
    let places = scene.stations.iter().map(|station| station.x);
    let mut loads: Vec<_> = places.map(|x_m| StationLoad { x_m, line_load_n_per_m: Peak::default() }).collect();
    for moment in moments {
        for (strip, force) in &moment.strips {
            let Some(entry) = &strip.entry else { continue };
            let distance = |load: &&mut StationLoad| (load.x_m - entry.at.x).abs();
            let nearest = loads.iter_mut().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            let value = force / entry.length;
            if let Some(load) = nearest.filter(|load| value > load.line_load_n_per_m.value) {
                load.line_load_n_per_m = Peak { value, time_s: moment.time, verdict: None };
            }
        }
    }
    loads
}

impl Summary {
    fn new(scene: &Scene, run: &LandingResult, rows: &[Vec<f64>], wall_time_s: f64) -> Summary {
        let column = |name: &str| COLUMNS.iter().position(|(column, _)| *column == name).unwrap_or_default();
        let most = |name: &str, measure: fn(f64) -> f64, over: f64| {
            let k = column(name);
            let first = Peak::default();
            rows.iter().fold(first, |worst, row| match measure(row[k] / over) > measure(worst.value) {
                true => Peak { value: row[k] / over, time_s: row[0], verdict: None },
                false => worst,
            })
        };
        let (first, last) = (&rows[0], &rows[rows.len() - 1]);
        let pitch = rows.iter().map(|row| row[column("pitch_deg")]);
        let line_load = most("line_load_N_per_m", |v| v, 1.0);
        let heaviest = rows.iter().find(|row| row[0] == line_load.time_s).unwrap_or(first);
        let deceleration = most("ax_m_per_s2", |v| -v, scene.water.gravity);
        let (status, message) = match &run.ended {
            LandingEnd::Time | LandingEnd::Slow => (Status::Completed, None),
            LandingEnd::Aloft(what) => (Status::CompletedWithDoubts, Some(what.clone())),
            LandingEnd::OutOfRange(what) => (Status::Failed, Some(what.clone())),
        };
        Summary {
            scene: scene.name.clone(),
            status,
            message,
            model: scene.model.name(),
            strips: scene.landing.strips,
            steps: (last[0] / scene.landing.step).round() as u64,
            time_end_s: last[0],
            wall_time_s,
            run_length_m: last[column("x_m")] - first[column("x_m")],
            speed_m_per_s: [first, last].map(|row| row[column("u_m_per_s")]),
            pitch_deg: [
                first[column("pitch_deg")],
                pitch.clone().fold(f64::INFINITY, f64::min),
                pitch.fold(f64::NEG_INFINITY, f64::max),
            ],
            az_g: most("az_m_per_s2", |v| v, scene.water.gravity),
            deceleration_g: Peak { value: -deceleration.value, ..deceleration },
            load_factor: most("load_factor", |v| v, 1.0),
            fz_n: most("fz_N", |v| v, 1.0),
            moment_nm: most("moment_Nm", f64::abs, 1.0),
            line_load_n_per_m: line_load,
            line_load_at_m: heaviest[column("line_load_at_m")],
            stations: station_loads(scene, &run.moments),
        }
    }

    /// The file.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    /// The numbers in a few lines.
    pub fn to_text(&self) -> String {
        let at = |p: &Peak, unit: &str| format!("{:.2}{unit} at {:.3} s", p.value, p.time_s);
        format!(
            "{}: {} strips, {} steps, {:.1} s of wall time\n  vertical {}, load factor {}; deceleration {}\n  water {:.0} kN \
             at {:.3} s; {:.0} kN/m of keel {:.1} m from the nose at {:.3} s\n  {:.1} m in {:.2} s, from {:.1} to {:.1} m/s; pitch \
             {:.1} to {:.1} degrees{}",
            self.scene,
            self.strips,
            self.steps,
            self.wall_time_s,
            at(&self.az_g, " g"),
            at(&self.load_factor, ""),
            at(&self.deceleration_g, " g"),
            1e-3 * self.fz_n.value,
            self.fz_n.time_s,
            1e-3 * self.line_load_n_per_m.value,
            self.line_load_at_m,
            self.line_load_n_per_m.time_s,
            self.run_length_m,
            self.time_end_s,
            self.speed_m_per_s[0],
            self.speed_m_per_s[1],
            self.pitch_deg[1],
            self.pitch_deg[2],
            self.message
                .as_ref()
                .filter(|_| self.status.is_completed())
                .map_or(String::new(), |what| format!("\n  DOUBT: {what}"))
        )
    }
}
