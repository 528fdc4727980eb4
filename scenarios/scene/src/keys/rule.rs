//! What airworthiness rules ask for, to state their loads beside the computed ones.

use fsi_coupling::Shape;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use settings::{Problem, require};

use super::Body;

/// Numbers of the whole aircraft, from which the loads that rules state are listed beside the computed ones (THEORY RU1–RU5).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Rule {
    /// Stalling speed V_S1 at the design take-off weight with flaps for take-off, for the local pressures of 14 CFR 25.533(b) [m/s]. absent: these
    /// are not stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub takeoff_speed: Option<f64>,
    /// Design take-off weight of the seaplane, as a mass, for the load factor of 25.531 [kg]. absent: it is not stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "x-when" = "rule.takeoff_speed"))]
    pub takeoff_mass: Option<f64>,
    /// Stalling speed V_S0 with landing flaps, without slipstream, for 25.527 and the distributed pressure of 25.533(c) [m/s]. absent: these are
    /// not stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required with landing_mass"))]
    pub landing_speed: Option<f64>,
    /// Design landing weight of the seaplane, as a mass [kg].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required with landing_speed"))]
    pub landing_mass: Option<f64>,
    /// Deadrise at the main step [deg]. absent: that of the section at its keel.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 4.0, max = 60.0))]
    pub step_deadrise_deg: Option<f64>,
    /// Hull station weighing factor K2 of bottom pressures, from figure 2 of Appendix B to Part 25: 2 at the bow, 0.75 half way to the main step, 1
    /// before it, 0.5 behind it, 1 at the stern [-].
    #[serde(default = "usual::k2")]
    #[schemars(range(max = 2.0), extend("exclusiveMinimum" = 0))]
    pub k2: f64,
    /// Limit load factor of a rotorcraft on floats (29.473(b)), for 29.521 [-]. absent: float loads are not stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required with rotorcraft_mass"))]
    pub limit_load_factor: Option<f64>,
    /// Mass of the rotorcraft [kg].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required with limit_load_factor"))]
    pub rotorcraft_mass: Option<f64>,
    /// Floats of the rotorcraft [-].
    #[serde(default = "usual::floats")]
    #[schemars(range(min = 1))]
    pub floats: u32,
}

mod usual {
    pub fn k2() -> f64 {
        1.0
    }
    pub fn floats() -> u32 {
        2
    }
}

impl Rule {
    /// Refuses a table from which no load follows.
    pub(crate) fn check(&self) -> Result<(), Problem> {
        let pair = |first: Option<f64>, second: Option<f64>, key: &str, what: &str| match (first, second) {
            (Some(_), None) => Err(Problem::missing(key, what)),
            _ => Ok(()),
        };
        pair(self.landing_speed, self.landing_mass, "rule.landing_mass", "the design landing weight, as a mass [kg]")?;
        pair(self.landing_mass, self.landing_speed, "rule.landing_speed", "the stalling speed V_S0 [m/s]")?;
        pair(self.limit_load_factor, self.rotorcraft_mass, "rule.rotorcraft_mass", "the rotorcraft's mass [kg]")?;
        pair(self.rotorcraft_mass, self.limit_load_factor, "rule.limit_load_factor", "its limit load factor [-]")?;
        let some = [self.takeoff_speed, self.landing_speed, self.limit_load_factor].iter().any(Option::is_some);
        require(
            some,
            "rule",
            "a table without a load",
            "takeoff_speed, landing_speed and landing_mass, or limit_load_factor",
        )
    }
}

impl Body {
    /// Deadrise of the bottom beside its lowest point, upright and as it lies at t = 0, of the flatter side [deg]; 0 of a flat or a round keel.
    pub fn keel_deadrise_deg(&self) -> f64 {
        if matches!(self.shape, Shape::Arc { .. }) {
            return 0.0;
        }
        let outline = self.placed_outline();
        let n = outline.len();
        let lowest = (0..n).min_by(|a, b| outline[*a][1].total_cmp(&outline[*b][1])).unwrap_or_default();
        let rise = |k: usize| {
            let [dx, dy] = [0, 1].map(|axis| outline[k % n][axis] - outline[lowest][axis]);
            dy.atan2(dx.abs()).to_degrees()
        };
        rise(lowest + 1).min(rise(lowest + n - 1)).max(0.0)
    }
}
