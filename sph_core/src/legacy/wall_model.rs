//! Which wall pushes the fluid: the choices, and what each needs (THEORY WA3, LE15–LE17).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How boundary particles keep the fluid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WallModel {
    /// Rows of particles that fill the kernel's support; pressure extrapolated from the fluid (WA3, Adami, Hu & Adams
    /// 2012), reflected velocity in continuity (WA4).
    #[default]
    Extrapolated,
    /// One row of points half a spacing below the surface that push by a law of distance (LE15, Monaghan 1994; Monaghan & Kos 1999).
    Repulsive,
    /// Two staggered rows of fluid particles that do not move: density by continuity (LE16, Dalrymple & Knio 2001).
    Dynamic,
    /// As `Extrapolated`, but the pressure comes from the wall particle's mirror point in the fluid, by a corrected
    /// first-order interpolation (LE17, English et al. 2022).
    MirrorPoint,
}

impl WallModel {
    /// True where the fluid behind the wall moves with the reflected velocity (WA4).
    pub(crate) fn reflects(self) -> bool {
        matches!(self, WallModel::Extrapolated | WallModel::MirrorPoint)
    }

    /// True where wall particles push by their pressure (WC5) and count as neighbours (OP4, OP5, WC10).
    pub(crate) fn has_pressure(self) -> bool {
        self != WallModel::Repulsive
    }
}
