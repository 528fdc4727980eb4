//! Filling a rectangle of water: even cells in a fine zone at the surface, layers growing outward
//! (THEORY WC18). The cells tile the rectangle exactly, so volume and mass are exact from the start.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where the water is, and where it is resolved finely. The fine zone touches the still-water surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basin {
    /// Left and right edge of the water [m].
    pub x: [f64; 2],
    /// Floor and still-water level [m].
    pub y: [f64; 2],
    /// Left and right edge of the fine zone [m].
    pub fine_x: [f64; 2],
    /// Depth of the fine zone below the surface [m].
    pub fine_depth: f64,
    /// Finest spacing [m].
    pub spacing: f64,
    /// Ratio of successive layers outside the fine zone [-]; 1 is uniform.
    pub growth: f64,
}

/// How particles lie in uniform water.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Lattice {
    /// One particle in the middle of each square.
    #[default]
    Square,
    /// Body-centred squares of side √2 Δx with two particles each, at a quarter and at three quarters of the
    /// diagonal: the same number of particles, and the square lattice turned by 45° (THEORY WC18).
    Staggered,
}

/// Least distance of a cell's middle from a thin plate [half cells].
const FROM_PLATE: f64 = 0.5;

/// One cell of the layout: a particle to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Middle [m].
    pub at: [f64; 2],
    /// Width and height [m].
    pub size: [f64; 2],
}

impl Cell {
    /// Area [m²].
    pub fn area(&self) -> f64 {
        self.size[0] * self.size[1]
    }

    /// Least distance of the middle from a body's surface [m], if the cell is to be water. From a thin plate it is shorter: a plate in the
    /// middle between two layers of cells displaces none.
    pub fn clearance(&self, thin_plate: bool) -> f64 {
        let half = 0.5 * self.area().sqrt() * (1.0 - 1e-6);
        if thin_plate { FROM_PLATE * half } else { half }
    }
}

/// A layout of the basin: the fine zone, then rings of cells around it, each ring one layer thicker.
#[derive(Clone, Debug)]
pub struct Layout {
    basin: Basin,
    lattice: Lattice,
    fine: [f64; 4], // left, right, bottom, top
    left: Vec<f64>,
    right: Vec<f64>,
    down: Vec<f64>,
}

impl Layout {
    /// Plan the layers; no cell is made yet.
    pub fn new(basin: Basin) -> Layout {
        let Basin { x, y, fine_x, fine_depth, spacing, growth } = basin;
        let snap = |from: f64, to: f64, edge: f64| {
            // a whole number of spacings from `from`; the whole way if less than a layer would remain
            let layers = ((to - from).abs() / spacing).round().max(1.0);
            let reached = from + layers * spacing * (to - from).signum();
            if (edge - from).abs() < (reached - from).abs() + 0.75 * spacing { edge } else { reached }
        };
        let uniform = growth <= 1.0 + 1e-9;
        let middle = 0.5 * (fine_x[0] + fine_x[1]);
        let anchor = if fine_x[0] <= x[0] + 1e-9 * spacing { x[0] } else { middle };
        let fine = if uniform {
            [x[0], x[1], y[0], y[1]]
        } else {
            let right = snap(anchor, fine_x[1].min(x[1]), x[1]);
            let left = if anchor == x[0] { x[0] } else { snap(anchor, fine_x[0].max(x[0]), x[0]) };
            [left, right, snap(y[1], (y[1] - fine_depth).max(y[0]), y[0]), y[1]]
        };
        Layout {
            basin,
            lattice: Lattice::default(),
            fine,
            left: graded_layers(fine[0] - x[0], spacing, growth),
            right: graded_layers(x[1] - fine[1], spacing, growth),
            down: graded_layers(fine[2] - y[0], spacing, growth),
        }
    }

    /// The same rectangle on another lattice; a staggered one is uniform, whatever the growth.
    pub fn with_lattice(self, lattice: Lattice) -> Layout {
        Layout { lattice, ..self }
    }

    /// The same rectangle in layers whose areas are halves of halves (THEORY WC21): those are what particles become that are
    /// halved later. Only the last layer of each side is stretched to where the basin ends.
    pub fn with_split_rows(mut self) -> Layout {
        for layers in [&mut self.left, &mut self.right, &mut self.down] {
            *layers = halved(layers, self.basin.spacing);
        }
        self
    }

    /// Call `make` with every cell: the fine zone first, then ring after ring.
    pub fn for_each(&self, mut make: impl FnMut(Cell)) {
        let s = self.basin.spacing;
        let [mut left, mut right, mut bottom, top] = self.fine;
        if self.lattice == Lattice::Staggered {
            let side = std::f64::consts::SQRT_2 * s;
            return block([left, right], [bottom, top], [side, side], &mut |cell| halves(cell, &mut make));
        }
        block([left, right], [bottom, top], [s, s], &mut make);
        let rings = self.left.len().max(self.right.len()).max(self.down.len());
        for k in 0..rings {
            let layer = |layers: &[f64]| layers.get(k).copied().unwrap_or(0.0);
            let (l, r, d) = (layer(&self.left), layer(&self.right), layer(&self.down));
            block([left - l, left], [bottom, top], [l, l], &mut make);
            block([right, right + r], [bottom, top], [r, r], &mut make);
            block([left, right], [bottom - d, bottom], [d, d], &mut make);
            block([left - l, left], [bottom - d, bottom], [l, d], &mut make);
            block([right, right + r], [bottom - d, bottom], [r, d], &mut make);
            (left, right, bottom) = (left - l, right + r, bottom - d);
        }
    }

    /// Number of cells.
    pub fn count(&self) -> usize {
        let mut n = 0;
        self.for_each(|_| n += 1);
        n
    }

    /// Local spacing [m] at a place in the basin or next to it: the thickness of the layer it lies in.
    pub fn spacing_at(&self, at: [f64; 2]) -> f64 {
        let along = |distance: f64, layers: &[f64]| {
            let mut edge = 0.0;
            for &layer in layers {
                edge += layer;
                if distance < edge {
                    return layer;
                }
            }
            layers.last().copied().unwrap_or(self.basin.spacing)
        };
        let mut spacing = self.basin.spacing;
        let outside = [
            (self.fine[0] - at[0], &self.left),
            (at[0] - self.fine[1], &self.right),
            (self.fine[2] - at[1], &self.down),
        ];
        for (distance, layers) in outside {
            if distance > 0.0 {
                spacing = f64::max(spacing, along(distance, layers));
            }
        }
        spacing.min(self.basin.y[1] - self.basin.y[0])
    }
}

/// Square cells of about `spacing` that tile a rectangle `from` one corner `to` the other exactly (THEORY WC18).
pub fn tile(from: [f64; 2], to: [f64; 2], spacing: f64, mut make: impl FnMut(Cell)) {
    block([from[0], to[0]], [from[1], to[1]], [spacing; 2], &mut make);
}

/// A block of cells of about the wished size that tile a rectangle exactly; nothing if it is empty.
fn block(x: [f64; 2], y: [f64; 2], wish: [f64; 2], make: &mut impl FnMut(Cell)) {
    let (width, height) = (x[1] - x[0], y[1] - y[0]);
    if width <= 0.0 || height <= 0.0 {
        return;
    }
    // where the basin is shallower than the layer is thick, cells stay square by being smaller
    let most = width.min(height);
    let columns = (width / wish[0].min(most)).round().max(1.0);
    let layers = (height / wish[1].min(most)).round().max(1.0);
    let size = [width / columns, height / layers];
    for j in 0..layers as usize {
        for i in 0..columns as usize {
            make(Cell { at: [x[0] + (i as f64 + 0.5) * size[0], y[1] - (j as f64 + 0.5) * size[1]], size });
        }
    }
}

/// WC18: the two particles of a body-centred cell. Each has half its area and is taken for a square of that area.
fn halves(cell: Cell, make: &mut impl FnMut(Cell)) {
    let [width, height] = cell.size;
    for side in [-0.25, 0.25] {
        let at = [cell.at[0] + side * width, cell.at[1] + side * height];
        make(Cell { at, size: cell.size.map(|length| std::f64::consts::FRAC_1_SQRT_2 * length) });
    }
}

/// WC18: thicknesses s g, s g², … that fill `distance` exactly, with a ratio g no larger than asked.
fn graded_layers(distance: f64, spacing: f64, growth: f64) -> Vec<f64> {
    if distance <= 1e-9 * spacing {
        return Vec::new();
    }
    let total = |g: f64, n: usize| (1..=n).map(|k| spacing * g.powi(k as i32)).sum::<f64>();
    let n = (1..).find(|&n| total(growth, n) >= distance).unwrap_or(1);
    let (mut low, mut high) = (0.5, growth.max(1.0));
    for _ in 0..100 {
        let g = 0.5 * (low + high);
        if total(g, n) < distance { low = g } else { high = g }
    }
    let g = 0.5 * (low + high);
    let fit = distance / total(g, n);
    (1..=n).map(|k| fit * spacing * g.powi(k as i32)).collect()
}

/// WC21: layers of the same total with thicknesses √2ⁿ s, about as thick as the given ones at the same distance; the last takes
/// up what remains.
fn halved(layers: &[f64], spacing: f64) -> Vec<f64> {
    let distance: f64 = layers.iter().sum();
    let mut made = Vec::new();
    let (mut reached, mut next) = (0.0, 0);
    let mut given = 0.0;
    while reached < distance * (1.0 - 1e-9) {
        while next + 1 < layers.len() && given + layers[next] <= reached {
            given += layers[next];
            next += 1;
        }
        let level = (2.0 * (layers[next] / spacing).log2()).floor();
        let layer = spacing * (0.5 * level).exp2();
        let left = distance - reached;
        made.push(if left < 1.5 * layer { left } else { layer });
        reached += made[made.len() - 1];
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Whatever the basin, the cells tile it exactly and no cell is far from square.
        #[test]
        fn cells_tile_the_basin(width in 0.5..20.0f64, depth in 0.5..10.0f64, fine in 0.1..1.0f64, growth in 1.0..1.3f64, half: bool) {
            let spacing = 0.05;
            let x = if half { [0.0, width] } else { [-width, width] };
            let fine_x = if half { [0.0, fine * width] } else { [-fine * width, fine * width] };
            let layout = Layout::new(Basin { x, y: [-depth, 0.0], fine_x, fine_depth: fine * depth, spacing, growth });
            let mut area = 0.0;
            layout.for_each(|cell| {
                area += cell.area();
                let aspect = cell.size[0] / cell.size[1];
                assert!(aspect > 0.5 && aspect < 2.0, "aspect {aspect}");
                assert!(cell.at[0] > x[0] && cell.at[0] < x[1] && cell.at[1] > -depth && cell.at[1] < 0.0);
            });
            let exact = (x[1] - x[0]) * depth;
            prop_assert!((area / exact - 1.0).abs() < 1e-9, "{area} against {exact}");
        }
    }

    proptest! {
        /// A staggered filling has the basin's area exactly, and about as many particles as the square one.
        #[test]
        fn staggered_particles_fill_the_basin(width in 0.5..5.0f64, depth in 0.5..3.0f64) {
            let basin = Basin {
                x: [0.0, width], y: [-depth, 0.0], fine_x: [0.0, width], fine_depth: depth, spacing: 0.05, growth: 1.0,
            };
            let (mut area, mut places) = (0.0, Vec::new());
            Layout::new(basin).with_lattice(Lattice::Staggered).for_each(|cell| {
                area += cell.area();
                places.push(cell.at);
            });
            prop_assert!((area / (width * depth) - 1.0).abs() < 1e-12);
            prop_assert!((0.0025 * places.len() as f64 / (width * depth) - 1.0).abs() < 0.2);
            // each particle's nearest neighbours are along the diagonals, half a diagonal away
            let [a, b] = [places[0], places[1]];
            prop_assert!(((a[0] - b[0]).hypot(a[1] - b[1]) / 0.05 - 1.0).abs() < 0.1);
        }
    }

    #[test]
    fn grading_saves_particles_and_spacing_is_what_the_cells_have() {
        let basin =
            Basin { x: [0.0, 10.0], y: [-10.0, 0.0], fine_x: [0.0, 0.5], fine_depth: 0.3, spacing: 0.01, growth: 1.1 };
        let graded = Layout::new(basin);
        assert!(graded.count() < 15_000, "{}", graded.count());
        let mut worst = 1.0_f64;
        graded.for_each(|cell| {
            let ratio = graded.spacing_at(cell.at) / cell.area().sqrt();
            worst = worst.max(ratio.max(1.0 / ratio));
        });
        assert!(worst < 1.3, "{worst}");
    }
}
