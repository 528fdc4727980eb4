//! The rows of boundary particles behind a surface (THEORY WA2).

use sph_core::WallLayout;

/// How rows of boundary particles lie behind each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arrangement {
    /// At depths ½Δx, 1½Δx, … below the surface, aligned.
    #[default]
    Filled,
    /// At the same depths, every other row shifted by half a spacing (THEORY LE16).
    Staggered,
}

/// Rows of boundary particles below a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallRows {
    /// Distance between particles and between rows Δx [m].
    pub spacing: f64,
    /// Number of rows.
    pub layers: usize,
    /// How they lie behind each other.
    pub arrangement: Arrangement,
}

impl WallRows {
    /// Aligned rows.
    pub fn filled(spacing: f64, layers: usize) -> WallRows {
        WallRows { spacing, layers, arrangement: Arrangement::Filled }
    }

    /// The rows that a scheme needs.
    pub fn of(WallLayout { layers, staggered }: WallLayout, spacing: f64) -> WallRows {
        let arrangement = if staggered { Arrangement::Staggered } else { Arrangement::Filled };
        WallRows { spacing, layers, arrangement }
    }

    /// Depth of a row below the surface at a local spacing [m].
    pub fn depth(layer: usize, spacing: f64) -> f64 {
        (layer as f64 + 0.5) * spacing
    }

    /// How deep the rows reach below the surface [m].
    pub fn reach(&self) -> f64 {
        self.layers as f64 * self.spacing
    }

    /// True where row `layer` is shifted by half a spacing.
    pub(crate) fn is_shifted(&self, layer: usize) -> bool {
        self.arrangement == Arrangement::Staggered && layer % 2 == 1
    }
}
