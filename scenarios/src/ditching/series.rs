//! The series of a landing: its columns, rows and file.

use water_entry::ditching::{Landing, LandingState, Swell};

use super::accelerometers::signals;
use super::model::Scene;

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

/// Where the load of a metre of keel is largest, from the nose [m], and that load [N/m].
fn heaviest(moment: &LandingState) -> [f64; 2] {
    let loaded = moment.strips.iter().filter_map(|(s, f)| Some([s.entry?.at.x, f / s.entry?.length]));
    loaded.fold([f64::NAN, 0.0], |worst, now| if now[1] > worst[1] { now } else { worst })
}

/// A series: names of the columns, and rows.
pub struct Series {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Rows, shape (moments, columns).
    pub rows: Vec<Vec<f64>>,
}

impl Series {
    /// Of a landing's moments: motion and loads, with waves elevation and phase below the centre of mass, then each accelerometer, then the force of the water on each part.
    pub(super) fn new(scene: &Scene, landing: &Landing<'_>, moments: &[LandingState]) -> Series {
        let (craft, weight) = (&landing.aeroplane, scene.aeroplane.mass * scene.water.gravity);
        let mut columns: Vec<String> = COLUMNS.iter().map(|(name, _)| (*name).to_string()).collect();
        let mut rows: Vec<Vec<f64>> =
            moments.iter().map(|m| COLUMNS.iter().map(|(_, read)| read(m, weight)).collect()).collect();
        let mut add = |name: String, values: Vec<f64>| {
            columns.push(name);
            rows.iter_mut().zip(values).for_each(|(row, value)| row.push(value));
        };
        if scene.sea.is_some() {
            let of_centre = |read: fn(&Swell, f64) -> f64| {
                let at = |m: &LandingState| read(&landing.swell.later(m.time), m.attitude.place[0]);
                moments.iter().map(at).collect::<Vec<f64>>()
            };
            add("elevation_m".into(), of_centre(|swell, x| swell.water(x).elevation));
            if landing.swell.components.is_none() {
                add("phase_deg".into(), of_centre(|swell, x| swell.phase_at(x).to_degrees()));
            }
        }
        for keys in &scene.accelerometers {
            let [normal, longitudinal] = signals(scene, keys, moments, craft.bending.as_ref());
            add(format!("{}.normal_g", keys.name), normal);
            add(format!("{}.longitudinal_g", keys.name), longitudinal);
        }
        for (part, name) in craft.part_names().into_iter().enumerate() {
            for (k, axis) in ["fx_N", "fz_N"].into_iter().enumerate() {
                let force = |m: &LandingState| m.parts[part].iter().map(|p| p.force[k]).sum();
                add(format!("{name}.{axis}"), moments.iter().map(force).collect());
            }
        }
        Series { columns, rows }
    }

    /// A column by its name.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let k = self.columns.iter().position(|column| column == name)?;
        Some(self.rows.iter().map(|row| row[k]).collect())
    }

    /// The file. What is not there, as the wetted part of an aeroplane in the air, is left empty.
    pub(super) fn csv(&self) -> String {
        let mut text = self.columns.join(",") + "\n";
        for row in &self.rows {
            let cell = |v: &f64| if v.is_finite() { format!("{v:.9e}") } else { String::new() };
            text += &(row.iter().map(cell).collect::<Vec<_>>().join(",") + "\n");
        }
        text
    }
}
