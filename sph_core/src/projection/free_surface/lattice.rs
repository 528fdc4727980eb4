//! What a lattice with a flat surface gives the sums of a survey: the norm of gradients, and how a row's depth shows.

use crate::interactions::kernel::Kernel;

/// Sums on a square lattice of spacing 1 (THEORY I4, I7).
#[derive(Clone, Copy, Debug)]
pub struct Lattice {
    /// κ = −½ Σ V r·∇W [-] inside.
    pub gradient: f64,
    /// Σ V W [-] inside.
    pub filling: f64,
    /// Range of 2 Σ V W [-] along a wall half a spacing beside the first row (E18).
    pub face: [f64; 2],
    rows: [Closure; ROWS],
}

/// Rows of a flat surface that are looked at.
const ROWS: usize = 4;

/// What a row of a flat surface lacks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Closure {
    /// Filling Σ V W [-].
    pub filling: f64,
    /// Depth below the surface, in spacings.
    pub depth: f64,
    /// |Σ V ∇W| Δx/(depth/Δx) [-]: half of the diagonal's excess that makes a linear pressure exact.
    pub link: f64,
    /// τ: what the air's share of the pressure gradient lacks, over what the row's own pressure gives [-].
    pub pull: f64,
}

impl Lattice {
    /// The sums for a kernel with h = `ratio` spacings.
    pub fn new(kernel: Kernel, ratio: f64) -> Lattice {
        let reach = (2.0 * ratio).ceil() as i32;
        let (mut gradient, mut filling) = (0.0, 0.0);
        let each = |f: &mut dyn FnMut(f64, f64, f64, f64)| {
            for i in -reach..=reach {
                for j in -reach..=reach {
                    let (x, y) = (f64::from(i), f64::from(j));
                    let r = x.hypot(y);
                    f(x, y, kernel.value(r, ratio), if r > 0.0 { kernel.gradient_factor(r, ratio) } else { 0.0 });
                }
            }
        };
        each(&mut |x, y, w, slope| {
            filling += w;
            gradient -= 0.5 * (x * x + y * y) * slope;
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
            let (mut present, mut lack, mut linear) = (0.0, 0.0, 0.0);
            each(&mut |_, y, w, slope| {
                if y <= depth {
                    present += w;
                } else {
                    // air at height y − depth above the surface, y above the row
                    let push = -slope * y; // |∂W/∂y|: r_ab = −y points down
                    lack += push;
                    linear += (1.0 - (y - depth) / depth) * push;
                }
            });
            let pull = if lack > 0.0 { linear / lack } else { 0.0 };
            *row = Closure { filling: present / filling, depth, link: lack / depth, pull };
        }
        Lattice { gradient, filling, face, rows }
    }

    /// Share of its filling that the deepest row which lacks anything lacks [-].
    pub fn faintest(&self) -> f64 {
        self.rows.iter().map(|row| 1.0 - row.filling).filter(|&lack| lack > 1e-9).fold(1.0, f64::min)
    }

    /// What a particle of this filling, near air, lacks.
    pub fn closure(&self, filling: f64) -> Closure {
        let filling = filling / self.filling;
        let first = self.rows[0];
        if filling <= first.filling {
            // above the top row: the link grows as the neighbours go
            let more = (1.0 - filling) / (1.0 - first.filling);
            return Closure { filling, depth: first.depth / more, link: first.link * more * more, ..first };
        }
        for pair in self.rows.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            if filling < b.filling {
                let t = (filling - a.filling) / (b.filling - a.filling);
                let mix = |from: f64, to: f64| from + t * (to - from);
                return Closure {
                    filling,
                    depth: mix(a.depth, b.depth),
                    link: mix(a.link, b.link),
                    pull: mix(a.pull, b.pull),
                };
            }
        }
        Closure { filling, depth: self.rows[ROWS - 1].depth, ..Closure::default() }
    }
}
