//! The rows of boundary particles behind a surface (THEORY WA2).

use sph_core::WallLayout;

/// Rows of boundary particles at depths ½Δx, 1½Δx, … below a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallRows {
    /// Distance between particles and between rows Δx [m].
    pub spacing: f64,
    /// Number of rows.
    pub layers: usize,
    /// Every other row is shifted by half a spacing (THEORY LE16); else rows are aligned.
    pub staggered: bool,
}

impl WallRows {
    /// Aligned rows.
    pub fn filled(spacing: f64, layers: usize) -> WallRows {
        WallRows { spacing, layers, staggered: false }
    }

    /// The rows that a scheme needs.
    pub fn of(WallLayout { layers, staggered }: WallLayout, spacing: f64) -> WallRows {
        WallRows { spacing, layers, staggered }
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
        self.staggered && layer % 2 == 1
    }
}
