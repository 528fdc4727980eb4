//! Sums over pairs on a lattice with a flat surface: the norm of gradients, and the depth of a row.

use crate::kernel::Kernel;

/// Sums on a square lattice of spacing 1 (THEORY PR4, PR7).
#[derive(Clone, Copy, Debug)]
pub struct Lattice {
    /// κ = −½ Σ V r·∇W (OP6) [-] inside.
    pub gradient: f64,
    /// Σ V W [-] inside.
    pub kernel_sum: f64,
    /// Range of 2 Σ V W [-] along a wall half a spacing beside the first row (GE2).
    pub face: [f64; 2],
    rows: [Closure; ROWS],
}

/// Rows of a flat surface that are looked at.
const ROWS: usize = 4;

/// The missing part of the sums in a row of a flat surface.
#[derive(Clone, Copy, Debug, Default)]
pub struct Closure {
    /// Filling Σ V W [-].
    pub kernel_sum: f64,
    /// Depth below the surface, in spacings.
    pub depth: f64,
    /// |Σ V ∇W| Δx/(depth/Δx) [-]: half of the diagonal's excess that makes a linear pressure exact.
    pub link: f64,
    /// τ: the missing share of the pressure gradient beside air, over that of the row's own pressure [-].
    pub pull: f64,
}

impl Lattice {
    /// The sums for a kernel with h = `ratio` spacings.
    pub fn new(kernel: Kernel, ratio: f64) -> Lattice {
        let reach = (2.0 * ratio).ceil() as i32;
        let (mut gradient, mut kernel_sum) = (0.0, 0.0);
        let each = |f: &mut dyn FnMut(f64, f64, f64, f64)| {
            for i in -reach..=reach {
                for j in -reach..=reach {
                    let (x, y) = (f64::from(i), f64::from(j));
                    let r = x.hypot(y);
                    f(x, y, kernel.value(r, ratio), if r > 0.0 { kernel.gradient_factor(r, ratio) } else { 0.0 });
                }
            }
        };
        each(&mut |x, y, w, grad_factor| {
            kernel_sum += w;
            gradient -= 0.5 * (x * x + y * y) * grad_factor;
        });
        let face = [0.5, 0.0].map(|beside| {
            let place = |i: i32, j: i32| kernel.value((f64::from(i) + beside).hypot(f64::from(j) + 0.5), ratio);
            let sum = (-reach..=reach).flat_map(|i| (0..=reach).map(move |j| place(i, j))).sum::<f64>();
            2.0 * sum
        });
        let face = [face[0].min(face[1]), face[0].max(face[1])];
        let mut rows = [Closure::default(); ROWS];
        for (k, row) in rows.iter_mut().enumerate() {
            let depth = k as f64 + 0.5;
            let (mut present, mut missing, mut linear) = (0.0, 0.0, 0.0);
            each(&mut |_, y, w, grad_factor| {
                if y <= depth {
                    present += w;
                } else {
                    // air at height y − depth above the surface, y above the row
                    let push = -grad_factor * y; // |∂W/∂y|: r_ab = −y points down
                    missing += push;
                    linear += (1.0 - (y - depth) / depth) * push;
                }
            });
            let pull = if missing > 0.0 { linear / missing } else { 0.0 };
            *row = Closure { kernel_sum: present / kernel_sum, depth, link: missing / depth, pull };
        }
        Lattice { gradient, kernel_sum, face, rows }
    }

    /// Σ V W over the water beside a flat wall, for a wall particle `depth` spacings behind its surface [-].
    pub fn beside_wall(&self, depth: f64) -> f64 {
        let row = (depth - 0.5).round().clamp(0.0, (ROWS - 1) as f64) as usize;
        self.kernel_sum * (1.0 - self.rows[row].kernel_sum)
    }

    /// Missing share of the kernel sum in the deepest row where any is missing [-].
    pub fn faintest(&self) -> f64 {
        self.rows.iter().map(|row| 1.0 - row.kernel_sum).filter(|&missing| missing > 1e-9).fold(1.0, f64::min)
    }

    /// The missing part of the sums of a particle of this kernel sum, near air.
    pub fn closure(&self, kernel_sum: f64) -> Closure {
        let kernel_sum = kernel_sum / self.kernel_sum;
        let first = self.rows[0];
        if kernel_sum <= first.kernel_sum {
            // above the top row: the link grows as the neighbours go
            let more = (1.0 - kernel_sum) / (1.0 - first.kernel_sum);
            return Closure { kernel_sum, depth: first.depth / more, link: first.link * more * more, ..first };
        }
        for pair in self.rows.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            if kernel_sum < b.kernel_sum {
                let t = (kernel_sum - a.kernel_sum) / (b.kernel_sum - a.kernel_sum);
                let mix = |from: f64, to: f64| from + t * (to - from);
                return Closure {
                    kernel_sum,
                    depth: mix(a.depth, b.depth),
                    link: mix(a.link, b.link),
                    pull: mix(a.pull, b.pull),
                };
            }
        }
        Closure { kernel_sum, depth: self.rows[ROWS - 1].depth, ..Closure::default() }
    }
}
