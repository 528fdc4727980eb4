//! `series.csv` of a landing: a row per sample.

use fsi_coupling::entry_theory::ditching::LandingState;

/// Reads a column from a moment; m g is given.
type Read = fn(&LandingState, f64) -> f64;

/// The columns, with what they read.
pub(super) const COLUMNS: [(&str, Read); 20] = [
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
pub(super) fn heaviest(moment: &LandingState) -> [f64; 2] {
    let loaded = moment.strips.iter().filter_map(|(s, f)| Some([s.entry?.at.x, f / s.entry?.length]));
    loaded.fold([f64::NAN, 0.0], |worst, now| if now[1] > worst[1] { now } else { worst })
}

/// Rows in the order of [`COLUMNS`].
pub(super) fn rows(moments: &[LandingState], weight: f64) -> Vec<Vec<f64>> {
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
