//! Names of results.

use std::fmt;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number that a designer takes away from a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ResultName {
    /// Largest force of the water on the body.
    PeakForce,
    /// Largest acceleration of the body's frame, in units of 9.80665 m/s².
    PeakAcceleration,
    /// Largest pressure of a gauge.
    PeakPressure,
    /// Magnitude of the impulse of the water on the body over the run.
    Impulse,
    /// Largest magnitude of the stress of an outer fibre of a panel.
    PeakStress,
    /// Largest magnitude of the strain of an outer fibre; absent for a panel that has not yielded.
    PeakStrain,
    /// Allowable stress over the largest; after yield the rupture strain over the largest strain; absent without such a limit.
    ReserveFactor,
}

/// Each result: its name in `summary.json`, which ends with its unit, its title, the SI unit of the title.
const TABLE: [(ResultName, &str, &str, &str); 7] = [
    (ResultName::PeakForce, "peak_force_N_per_m", "Peak force", "N/m"),
    (ResultName::PeakAcceleration, "peak_acceleration_g", "Peak acceleration", "g"),
    (ResultName::PeakPressure, "peak_pressure_Pa", "Peak pressure", "Pa"),
    (ResultName::Impulse, "impulse_N_s_per_m", "Impulse", "N s/m"),
    (ResultName::PeakStress, "peak_stress_Pa", "Peak stress in", "Pa"),
    (ResultName::PeakStrain, "peak_strain", "Peak strain in", "-"),
    (ResultName::ReserveFactor, "reserve_factor", "Reserve factor of", "-"),
];

impl ResultName {
    fn row(self) -> &'static (ResultName, &'static str, &'static str, &'static str) {
        &TABLE[self as usize]
    }

    /// As in `summary.json`.
    pub fn name(self) -> &'static str {
        self.row().1
    }

    /// SI unit; g for accelerations.
    pub fn si(self) -> &'static str {
        self.row().3
    }

    /// The result of a name in `summary.json`.
    pub fn of(name: &str) -> Option<ResultName> {
        TABLE.iter().find(|row| row.1 == name).map(|row| row.0)
    }
}

impl Serialize for ResultName {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for ResultName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<ResultName, D::Error> {
        let name = String::deserialize(deserializer)?;
        ResultName::of(&name).ok_or_else(|| serde::de::Error::custom(format!("{name} is no result")))
    }
}

/// A result of a run: of the body, or of one of its panels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResultId {
    /// The panel; `None` for the body.
    pub panel: Option<String>,
    /// The result.
    pub name: ResultName,
}

impl ResultId {
    /// The result that a text such as `peak_force_N_per_m` or `PANEL.peak_stress_Pa` names.
    pub fn of(text: &str) -> Option<ResultId> {
        match text.rsplit_once('.') {
            None => ResultName::of(text).map(|name| ResultId { panel: None, name }),
            Some((panel, name)) => ResultName::of(name).map(|name| ResultId { panel: Some(panel.into()), name }),
        }
    }

    /// In words, without its unit.
    pub fn title(&self) -> String {
        let (.., title, _) = self.name.row();
        self.panel.as_ref().map_or(title.to_string(), |panel| format!("{title} {panel}"))
    }

    /// The panel, for its result of this name.
    pub fn of_panel(&self, name: ResultName) -> Option<&str> {
        self.panel.as_deref().filter(|_| self.name == name)
    }
}

impl fmt::Display for ResultId {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.panel.iter().try_for_each(|panel| write!(out, "{panel}."))?;
        out.write_str(self.name.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_each_result_in_its_place_and_each_name_once() {
        for (k, (result, name, ..)) in TABLE.iter().enumerate() {
            assert_eq!((*result as usize, ResultName::of(name)), (k, Some(*result)));
        }
        let stress = ResultId::of("bay.1.peak_stress_Pa").expect("a result");
        assert_eq!(
            (stress.title().as_str(), stress.to_string().as_str()),
            ("Peak stress in bay.1", "bay.1.peak_stress_Pa")
        );
        assert_eq!(ResultId::of("audit.energy"), None);
    }
}
