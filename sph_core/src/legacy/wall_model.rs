//! Which wall pushes the fluid: the choices, and what each needs (THEORY E9, W1–W3).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How boundary particles keep the fluid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WallModel {
    /// Rows of particles that fill the kernel's support; pressure extrapolated from the fluid (E9, Adami, Hu & Adams
    /// 2012), reflected velocity in continuity (E10).
    #[default]
    Extrapolated,
    /// One row of points half a spacing below the surface that push by a law of distance (W1, Monaghan 1994; Monaghan & Kos 1999).
    Repulsive,
    /// Two staggered rows of fluid particles that do not move: density by continuity (W2, Dalrymple & Knio 2001).
    Dynamic,
    /// As `Extrapolated`, but the pressure comes from the wall particle's mirror point in the fluid, by a corrected
    /// first-order interpolation (W3, English et al. 2022).
    MirrorPoint,
}

impl WallModel {
    /// True where the fluid behind the wall moves with the reflected velocity (E10).
    pub(crate) fn reflects(self) -> bool {
        matches!(self, WallModel::Extrapolated | WallModel::MirrorPoint)
    }

    /// True where wall particles push by their pressure (E6) and count as neighbours (E12–E14).
    pub(crate) fn has_pressure(self) -> bool {
        self != WallModel::Repulsive
    }
}
