//! The loads of a hull that was towed: its numbers.

use scene::vocabulary::{Status, Verdict};
use serde::Serialize;
use water_entry::planing::{CENTRE_BAND, LIFT_BAND, Planing, PlaningHull};

use super::model::Scene;

/// A number, and what may be said of it.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Judged {
    /// The number, in the unit of its name.
    pub value: f64,
    /// Half width of the interval around it; absent where none is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub band: Option<f64>,
    /// `resolved` with a band, else `no_band`.
    pub verdict: Verdict,
}

/// A hull that was towed.
#[derive(Clone, Debug)]
pub struct Towed {
    /// The numbers.
    pub summary: Summary,
    /// The load and its distribution.
    pub planing: Planing,
}

/// The numbers of a planing hull.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Its name.
    pub scene: String,
    /// How it ended.
    pub status: Status,
    /// What carried the load.
    pub model: &'static str,
    /// Speed [m/s].
    pub speed_m_per_s: f64,
    /// Trim [deg].
    pub trim_deg: f64,
    /// C_v = U/√(g b) [-].
    pub speed_coefficient: f64,
    /// Mean wetted length over the breadth [-].
    pub wetted_length: f64,
    /// Wetted keel [m].
    pub wetted_keel_m: f64,
    /// Wetted chine [m].
    pub wetted_chine_m: f64,
    /// Wetted area of the bottom aft of the spray root [m²].
    pub wetted_area_m2: f64,
    /// Draught of the keel at the step [m].
    pub draught_m: f64,
    /// Lift [N].
    pub lift_n: Judged,
    /// Lift over ½ρ U² b² [-].
    pub lift_coefficient: Judged,
    /// Centre of pressure ahead of the step, along the keel [m].
    pub center_of_pressure_m: Judged,
    /// Drag of the pressure [N].
    pub pressure_drag_n: Judged,
    /// Drag of the friction [N].
    pub friction_drag_n: Judged,
    /// Their sum [N].
    pub drag_n: Judged,
    /// Why lift, centre of pressure and drag of the pressure have no band; absent where they have one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_band_because: Option<String>,
}

impl Towed {
    pub(super) fn new(scene: &Scene, hull: &PlaningHull, planing: Planing) -> Towed {
        let why = hull.not_judged(&planing.wetted);
        let judged = |value: f64, band: Option<f64>| {
            let band = band.filter(|_| why.is_none());
            let verdict = if band.is_some() { Verdict::Resolved } else { Verdict::NoBand };
            Judged { value, band, verdict }
        };
        let by_lift = |value: f64| judged(value, Some(LIFT_BAND * value));
        let wetted = planing.wetted;
        let friction = 0.5 * hull.density * hull.speed.powi(2) * scene.water.friction * planing.wetted_area;
        let friction = friction * hull.trim_deg.to_radians().cos();
        let summary = Summary {
            scene: scene.name.clone(),
            status: Status::Completed,
            model: "mlm",
            speed_m_per_s: hull.speed,
            trim_deg: hull.trim_deg,
            speed_coefficient: hull.froude(),
            wetted_length: wetted.mean,
            wetted_keel_m: wetted.keel,
            wetted_chine_m: wetted.chine,
            wetted_area_m2: planing.wetted_area,
            draught_m: wetted.draught,
            lift_n: by_lift(planing.lift),
            lift_coefficient: by_lift(planing.lift_coefficient),
            center_of_pressure_m: judged(planing.centre, Some(CENTRE_BAND * wetted.mean * hull.breadth)),
            pressure_drag_n: by_lift(planing.pressure_drag),
            friction_drag_n: judged(friction, None),
            drag_n: judged(planing.pressure_drag + friction, None),
            no_band_because: why.clone(),
        };
        Towed { summary, planing }
    }

    /// The lift along the hull, a row for each slice from the front to the step.
    pub fn slices_csv(&self) -> String {
        let head = "ahead_of_step_m,lift_N_per_m,half_breadth_m,sinking_ratio\n".to_string();
        self.planing.slices.iter().fold(head, |text, s| {
            format!("{text}{:.6},{:.6e},{:.6},{:.6}\n", s.ahead, s.lift_per_m, s.wetted, s.sinking)
        })
    }
}

impl Summary {
    /// The file.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    /// The numbers in a few lines.
    pub fn to_text(&self) -> String {
        let with_band = |j: &Judged, scale: f64, digits: usize, unit: &str| {
            let value = format!("{:.digits$}", j.value * scale);
            match j.band {
                Some(band) => format!("{value} ± {:.digits$}{unit}", band * scale),
                None => format!("{value}{unit} (no_band)"),
            }
        };
        let why = self.no_band_because.as_ref().map_or(String::new(), |why| format!("\n  no_band: {why}"));
        format!(
            "{}: {:.2} m/s, trim {:.2} degrees, C_v {:.2}\n  lift {}, coefficient {}\n  centre of pressure {} ahead of the \
             step\n  drag {}: pressure {}, friction {}\n  wetted keel {:.3} m, chine {:.3} m, mean {:.3} \
             breadths; draught {:.3} m{why}",
            self.scene,
            self.speed_m_per_s,
            self.trim_deg,
            self.speed_coefficient,
            with_band(&self.lift_n, 1e-3, 3, " kN"),
            with_band(&self.lift_coefficient, 1.0, 4, ""),
            with_band(&self.center_of_pressure_m, 1.0, 3, " m"),
            with_band(&self.drag_n, 1e-3, 3, " kN"),
            with_band(&self.pressure_drag_n, 1e-3, 3, " kN"),
            with_band(&self.friction_drag_n, 1e-3, 3, " kN"),
            self.wetted_keel_m,
            self.wetted_chine_m,
            self.wetted_length,
            self.draught_m,
        )
    }
}
