//! Masses on springs over a body.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A mass that moves upright over the body on a spring and a damper (THEORY CO35). At t = 0 the spring is unloaded and the mass moves with the
/// body. Its columns are BODY.NAME.extension_m and BODY.NAME.ay_m_per_s2.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SprungMass {
    /// Name in output columns.
    pub name: String,
    /// Mass, besides body.mass [kg/m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: f64,
    /// Stiffness of the spring, per metre of span [N/m^2].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub stiffness: f64,
    /// Coefficient of the damper, per metre of span [N s/m^2].
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub damping: f64,
}

impl SprungMass {
    /// Columns after the body's name and a dot.
    pub fn columns(&self) -> [String; 2] {
        [format!("{}.extension_m", self.name), format!("{}.ay_m_per_s2", self.name)]
    }
}
