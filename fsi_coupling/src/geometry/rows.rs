//! How the rows of boundary particles lie, by wall model.

use sph_core::{Parameters, WallModel};

/// How rows of boundary particles lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arrangement {
    /// At depths ½Δx, 1½Δx, … below the surface, one behind the other.
    #[default]
    Filled,
    /// At the same depths, every other row half a spacing aside (THEORY W2).
    Staggered,
}

impl Arrangement {
    /// What a wall model needs, and how many rows of it.
    pub fn of(parameters: &Parameters) -> (Arrangement, usize) {
        let filling = (2.0 * parameters.smoothing_ratio - 1e-9).ceil() as usize;
        match parameters.walls.model {
            WallModel::Extrapolated | WallModel::MirrorPoint => (Arrangement::Filled, filling),
            WallModel::Dynamic => (Arrangement::Staggered, 2),
            WallModel::Repulsive => (Arrangement::Filled, 1),
        }
    }

    /// True where row `layer` stands half a spacing aside.
    pub(crate) fn aside(self, layer: usize) -> bool {
        self == Arrangement::Staggered && layer % 2 == 1
    }
}
