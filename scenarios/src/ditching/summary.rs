//! `summary.json` of a landing.

use fsi_coupling::entry_theory::ditching::{LandingEnd, LandingResult};
use serde::Serialize;

use super::model::Scene;
use super::series::COLUMNS;
use crate::summary::Status;

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
}

/// An extreme value and its time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Peak {
    /// The value.
    pub value: f64,
    /// Time since the first touch [s].
    pub time_s: f64,
}

impl Summary {
    pub(super) fn new(scene: &Scene, run: &LandingResult, rows: &[Vec<f64>], wall_time_s: f64) -> Summary {
        let column = |name: &str| COLUMNS.iter().position(|(column, _)| *column == name).unwrap_or_default();
        let most = |name: &str, measure: fn(f64) -> f64, over: f64| {
            let k = column(name);
            let first = Peak { value: 0.0, time_s: 0.0 };
            rows.iter().fold(first, |worst, row| match measure(row[k] / over) > measure(worst.value) {
                true => Peak { value: row[k] / over, time_s: row[0] },
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
             {:.1} to {:.1} degrees",
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
            self.pitch_deg[2]
        )
    }
}
