//! Contact and joints of bodies.

use fsi_coupling::{ContactLaw, JointKind, JointSpec};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Name of the tank among the bodies of a joint.
pub(crate) const TANK: &str = "tank";

/// How rigid bodies push each other, the floor and the walls (THEORY CO37).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SolidContact {
    /// Coefficient of friction [-].
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 10.0))]
    pub friction: f64,
    /// Coefficient of restitution: normal speed after over that before an impact [-].
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub restitution: f64,
    /// Distance at which surfaces touch, in resolution.spacing: a film of fewer rows of particles
    /// does not hold the water's pressure: with one the projection may throw the body up [-].
    #[serde(default = "two")]
    #[schemars(range(min = 0.0, max = 4.0))]
    pub gap: f64,
}

fn two() -> f64 {
    2.0
}

impl Default for SolidContact {
    fn default() -> SolidContact {
        SolidContact { friction: 0.0, restitution: 0.0, gap: two() }
    }
}

impl SolidContact {
    pub(crate) fn is_default(&self) -> bool {
        *self == SolidContact::default()
    }

    /// The law of contact at a spacing [m].
    pub fn law(&self, spacing: f64) -> ContactLaw {
        ContactLaw { friction: self.friction, restitution: self.restitution, gap: self.gap * spacing }
    }
}

/// A joint between two rigid bodies, or a body and the tank (THEORY CO38). Its columns are NAME.angle_rad of a hinge or
/// NAME.extension_m, from the start, and NAME.fx_N_per_m, NAME.fy_N_per_m, the mean force on the second body over a step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Joint {
    /// Name in output columns.
    pub name: String,
    /// What it holds.
    pub kind: JointName,
    /// Names of the two bodies; "tank" for the tank.
    pub bodies: [String; 2],
    /// Place x, y at t = 0 [m].
    pub at: [f64; 2],
    /// Direction of a slider at t = 0, fixed in the first body [-]. absent: not a slider.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 2]>,
    /// Other end of a spring at t = 0, on the second body [m]. absent: not a spring.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<[f64; 2]>,
    /// Stiffness of the motion that it leaves free, unloaded at t = 0: per metre of a slider or spring, per radian of a hinge
    /// [N/m^2, N/rad].
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub stiffness: f64,
    /// Damping of the motion that it leaves free [N s/m^2, N s/rad].
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub damping: f64,
    /// Force at which it breaks, a mean over one step [N/m]. absent: never.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub breaks_at: Option<f64>,
}

/// Kinds of joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointName {
    /// Both bodies keep the point in common.
    Hinge,
    /// The second body slides along the axis and does not turn against the first.
    Slider,
    /// A spring and a damper along the line between both ends.
    Spring,
}

impl Joint {
    /// Whether it joins two bodies of these names.
    pub(crate) fn joins(&self, a: &str, b: &str) -> bool {
        self.bodies == [a, b] || self.bodies == [b, a]
    }

    /// Columns of the series.
    pub fn columns(&self) -> [String; 3] {
        let unit = if self.kind == JointName::Hinge { "angle_rad" } else { "extension_m" };
        [unit, "fx_N_per_m", "fy_N_per_m"].map(|column| format!("{}.{column}", self.name))
    }

    /// The joint between bodies that are numbered by `index`.
    pub fn spec(&self, index: impl Fn(&str) -> usize) -> JointSpec {
        let [x, y] = self.axis.unwrap_or([1.0, 0.0]);
        let length = x.hypot(y);
        JointSpec {
            name: self.name.clone(),
            bodies: [index(&self.bodies[0]), index(&self.bodies[1])],
            at: self.at,
            kind: match self.kind {
                JointName::Hinge => JointKind::Hinge,
                JointName::Slider => JointKind::Slider { axis: [x / length, y / length] },
                JointName::Spring => JointKind::Spring { to: self.to.unwrap_or(self.at) },
            },
            stiffness: self.stiffness,
            damping: self.damping,
            breaks_at: self.breaks_at,
        }
    }
}
