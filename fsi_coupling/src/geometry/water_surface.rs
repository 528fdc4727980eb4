//! A water surface that is not level (THEORY WC19): cells stretched upwards or downwards to it, column by column.

use crate::geometry::layout::Cell;

/// η(x) = A cos(mπ(x − x₀)/(x₁ − x₀)) + (x − ½(x₀ + x₁)) tan φ over water of depth H (WC19).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaterSurface {
    /// Walls x₀ and x₁ that the waves stand between [m].
    pub x: [f64; 2],
    /// Depth H of the same water at rest, whose surface is y = 0 [m].
    pub depth: f64,
    /// Amplitude A [m].
    pub amplitude: f64,
    /// Number of half waves m between the walls.
    pub mode: u32,
    /// Slope tan φ [-], upwards to the right.
    pub slope: f64,
}

impl WaterSurface {
    /// Mean of η over a ≤ x ≤ b [m], exactly.
    pub fn mean(&self, a: f64, b: f64) -> f64 {
        let [left, right] = self.x;
        let k = f64::from(self.mode) * std::f64::consts::PI / (right - left);
        let wave = if k * (b - a) == 0.0 {
            (k * (a - left)).cos()
        } else {
            ((k * (b - left)).sin() - (k * (a - left)).sin()) / (k * (b - a))
        };
        self.amplitude * wave + self.slope * (0.5 * (a + b) - 0.5 * (left + right))
    }

    /// A bound of |η| [m]: |A| + ½(x₁ − x₀)|tan φ|.
    pub fn largest(&self) -> f64 {
        self.amplitude.abs() + 0.5 * (self.x[1] - self.x[0]) * self.slope.abs()
    }

    /// A cell of level water, stretched with its column by 1 + η̄/H, and η̄ over it [m].
    pub fn lift(&self, cell: Cell) -> (Cell, f64) {
        let [width, height] = cell.size;
        let rise = self.mean(cell.at[0] - 0.5 * width, cell.at[0] + 0.5 * width);
        let stretch = 1.0 + rise / self.depth;
        let at = [cell.at[0], stretch * (cell.at[1] + self.depth) - self.depth];
        (Cell { at, size: [width, stretch * height] }, rise)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::layout::{Basin, Lattice, Layout};
    use proptest::prelude::*;

    fn basin(growth: f64) -> Basin {
        Basin { x: [-1.0, 1.0], y: [-0.5, 0.0], fine_x: [-0.3, 0.3], fine_depth: 0.2, spacing: 0.05, growth }
    }

    proptest! {
        /// Whatever the surface, the water's area is that at rest, and a column's top layer ends at the surface.
        #[test]
        fn stretched_cells_end_at_the_surface(amplitude in -0.1..0.1f64, mode in 0..6u32, slope in -0.1..0.1f64, way in 0..3u8) {
            let (growth, lattice) = [(1.0, Lattice::Square), (1.0, Lattice::Staggered), (1.1, Lattice::Square)][way as usize];
            let amplitude = if mode == 0 { 0.0 } else { amplitude };
            let surface = WaterSurface { x: [-1.0, 1.0], depth: 0.5, amplitude, mode, slope };
            let mut area = 0.0;
            Layout::new(basin(growth)).with_lattice(lattice).for_each(|cell| {
                let (lifted, rise) = surface.lift(cell);
                area += lifted.area();
                assert!(rise.abs() <= surface.largest() + 1e-12);
                assert!(lifted.at[1] > -0.5 && lifted.at[1] < rise);
                let (above, there) = (-cell.at[1], rise - lifted.at[1]);
                assert!((there / above - (1.0 + rise / 0.5)).abs() < 1e-9, "{there} below the surface, {above} at rest");
            });
            prop_assert!((area - 1.0).abs() < 1e-9, "{area}");
        }
    }

    #[test]
    fn the_mean_of_a_wave_is_its_integral() {
        let surface = WaterSurface { x: [-1.0, 1.0], depth: 0.5, amplitude: 0.1, mode: 3, slope: 0.2 };
        let (a, b, n) = (-0.4, 0.3, 20_000);
        let exact = |x: f64| 0.1 * (1.5 * std::f64::consts::PI * (x + 1.0)).cos() + 0.2 * x;
        let sum: f64 = (0..n).map(|i| exact(a + (b - a) * (f64::from(i) + 0.5) / f64::from(n))).sum();
        assert!((surface.mean(a, b) - sum / f64::from(n)).abs() < 1e-9);
        assert!((surface.mean(0.1, 0.1) - exact(0.1)).abs() < 1e-15, "a place is its own mean");
    }
}
