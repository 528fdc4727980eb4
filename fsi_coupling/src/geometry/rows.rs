//! The layers of boundary particles behind a surface (THEORY WA2).

use sph_core::WallLayout;

/// Layers of boundary particles at depths ½Δx, 1½Δx, … below a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallRows {
    /// Distance between particles and between layers Δx [m].
    pub spacing: f64,
    /// Number of layers.
    pub layers: usize,
    /// Every other layer is shifted by half a spacing (THEORY LE16); else layers are aligned.
    pub staggered: bool,
}

impl WallRows {
    /// Aligned layers.
    pub fn filled(spacing: f64, layers: usize) -> WallRows {
        WallRows { spacing, layers, staggered: false }
    }

    /// The layers that a scheme needs.
    pub fn of(WallLayout { layers, staggered }: WallLayout, spacing: f64) -> WallRows {
        WallRows { spacing, layers, staggered }
    }

    /// Depth of a layer below the surface at a local spacing [m].
    pub fn depth(layer: usize, spacing: f64) -> f64 {
        (layer as f64 + 0.5) * spacing
    }

    /// How deep the layers reach below the surface [m].
    pub fn reach(&self) -> f64 {
        self.layers as f64 * self.spacing
    }

    /// True where layer `layer` is shifted by half a spacing.
    pub(crate) fn is_shifted(&self, layer: usize) -> bool {
        self.staggered && layer % 2 == 1
    }
}
