//! The quantities by which the program is judged, and which numbers of a run belong to each.

use scene::vocabulary::ResultName;
use serde::{Deserialize, Serialize};

/// A quantity for which bias and scatter are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Force on a body, or its coefficient.
    Force,
    /// Moment on a body.
    Moment,
    /// Impulse of a force.
    Impulse,
    /// Speed of a falling body.
    Velocity,
    /// Height of a body.
    Position,
    /// Roll or trim of a body.
    Attitude,
    /// Acceleration of an aeroplane that lands, across its floor.
    LandingAcceleration,
    /// Deceleration of an aeroplane that lands, along its floor.
    LandingDeceleration,
    /// Largest pressure on a face.
    PeakPressure,
    /// Pressure in time: its integral, or its curve.
    PressureInTime,
    /// Pressure of water at rest.
    StillPressure,
    /// When water arrives at a gauge.
    Arrival,
    /// Front of water on a dry floor.
    Front,
    /// Height of waves.
    WaveHeight,
    /// Period or speed of waves.
    WavePeriod,
    /// Deflection of a structure.
    Deflection,
    /// Stress or strain of a structure.
    Stress,
    /// Period of a structure in water, or the time of its largest deflection.
    WetPeriod,
    /// Lift of a planing hull.
    PlaningLift,
    /// Place of the lift of a planing hull.
    CentreOfPressure,
    /// Mean force of waves on a body.
    Drift,
}

/// Each quantity with its title.
const TABLE: [(Quantity, &str); 21] = [
    (Quantity::Force, "Force"),
    (Quantity::Moment, "Moment"),
    (Quantity::Impulse, "Impulse"),
    (Quantity::Velocity, "Velocity of a falling body"),
    (Quantity::Position, "Height of a body, draught"),
    (Quantity::Attitude, "Roll, trim"),
    (Quantity::LandingAcceleration, "Landing: acceleration across the floor"),
    (Quantity::LandingDeceleration, "Landing: deceleration along the floor"),
    (Quantity::PeakPressure, "Peak pressure"),
    (Quantity::PressureInTime, "Pressure in time"),
    (Quantity::StillPressure, "Pressure at rest"),
    (Quantity::Arrival, "Time of arrival"),
    (Quantity::Front, "Front of water"),
    (Quantity::WaveHeight, "Height of waves"),
    (Quantity::WavePeriod, "Period, speed of waves"),
    (Quantity::Deflection, "Deflection"),
    (Quantity::Stress, "Stress, strain"),
    (Quantity::WetPeriod, "Period in water"),
    (Quantity::PlaningLift, "Lift of a planing hull"),
    (Quantity::CentreOfPressure, "Centre of pressure of a planing hull"),
    (Quantity::Drift, "Mean drift force"),
];

/// Parts of a number's path, or of a comparison's text, and what they say; the first row that fits counts.
const WORDS: [(&str, Quantity); 39] = [
    ("per_amplitude/mean", Quantity::Drift),
    ("y_m/per_amplitude", Quantity::Position),
    ("lift_coefficient", Quantity::PlaningLift),
    ("center_of_pressure", Quantity::CentreOfPressure),
    ("deceleration_g", Quantity::LandingDeceleration),
    ("longitudinal_g", Quantity::LandingDeceleration),
    ("normal_g", Quantity::LandingAcceleration),
    ("drift", Quantity::Drift),
    ("wet_period", Quantity::WetPeriod),
    ("wet_frequency", Quantity::WetPeriod),
    ("deflection_m/time_s", Quantity::WetPeriod),
    ("arrival", Quantity::Arrival),
    ("level1_m, period", Quantity::WavePeriod),
    ("phase_speed", Quantity::WavePeriod),
    (", period", Quantity::WetPeriod),
    ("stress_Pa", Quantity::Stress),
    ("strain", Quantity::Stress),
    ("deflection_m", Quantity::Deflection),
    (".dx_m", Quantity::Deflection),
    (".dy_m", Quantity::Deflection),
    ("_Pa, impulse", Quantity::PressureInTime),
    ("means/floor.p_Pa", Quantity::StillPressure),
    ("means/middle.p_Pa", Quantity::StillPressure),
    ("peak_pressure", Quantity::PeakPressure),
    ("peak_pa", Quantity::PeakPressure),
    ("cp_max", Quantity::PeakPressure),
    ("p_Pa", Quantity::PressureInTime),
    ("moment_N", Quantity::Moment),
    ("_N_per_m, impulse", Quantity::Impulse),
    ("impulse_N_s", Quantity::Impulse),
    ("f_N_per_m", Quantity::Force),
    ("fx_N_per_m", Quantity::Force),
    ("fy_N_per_m", Quantity::Force),
    ("force", Quantity::Force),
    ("vy_m_per_s", Quantity::Velocity),
    ("angle_deg", Quantity::Attitude),
    ("height_ratio", Quantity::WaveHeight),
    ("front_m", Quantity::Front),
    (".y_m", Quantity::Position),
];

impl Quantity {
    /// The quantity of a number by its path in `summary.json`, or of a comparison by its text; `None` where it belongs to none, as an audit.
    pub fn of(number: &str) -> Option<Quantity> {
        WORDS.iter().find(|(word, _)| number.contains(word)).map(|row| row.1).filter(|_| !number.starts_with("audit/"))
    }

    /// The quantity of a result.
    pub fn of_result(name: ResultName) -> Option<Quantity> {
        match name {
            ResultName::PeakForce | ResultName::PeakAcceleration => Some(Quantity::Force),
            ResultName::PeakPressure => Some(Quantity::PeakPressure),
            ResultName::Impulse => Some(Quantity::Impulse),
            ResultName::PeakStress | ResultName::PeakStrain => Some(Quantity::Stress),
            ResultName::ReserveFactor => None,
        }
    }

    /// On a page.
    pub fn title(self) -> &'static str {
        TABLE[self as usize].1
    }

    /// All, in the order of the pages.
    pub fn all() -> impl Iterator<Item = Quantity> {
        TABLE.iter().map(|row| row.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_each_quantity_in_its_place() {
        assert!(TABLE.iter().enumerate().all(|(k, (quantity, _))| *quantity as usize == k));
    }

    #[test]
    fn numbers_belong_to_the_quantity_that_their_words_name() {
        for (number, quantity) in [
            ("similarity/force_coefficient", Some(Quantity::Force)),
            ("means/wedge.fy_N_per_m", Some(Quantity::Force)),
            ("arc.fy_N_per_m, impulse", Some(Quantity::Impulse)),
            ("results/impulse_N_s_per_m/value", Some(Quantity::Impulse)),
            ("wedge.moment_N, impulse", Some(Quantity::Moment)),
            ("p3.p_Pa, impulse", Some(Quantity::PressureInTime)),
            ("d1.p_Pa, arrival [s]", Some(Quantity::Arrival)),
            ("means/middle.p_Pa", Some(Quantity::StillPressure)),
            ("gauges/flat_50/peak_pa", Some(Quantity::PeakPressure)),
            ("level1_m, period [s]", Some(Quantity::WavePeriod)),
            ("plate.at50.deflection_m, peak", Some(Quantity::Deflection)),
            ("peaks/plate.at0.deflection_m/time_s", Some(Quantity::WetPeriod)),
            ("cylinder.y_m", Some(Quantity::Position)),
            ("accelerometers/0/normal_g/value", Some(Quantity::LandingAcceleration)),
            ("center_of_pressure_m/value", Some(Quantity::CentreOfPressure)),
            ("audit/momentum", None),
            ("rest/center_rise_m", None),
        ] {
            assert_eq!(Quantity::of(number), quantity, "{number}");
        }
    }
}
